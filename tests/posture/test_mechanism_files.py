"""Mechanism files: what they can say, what they cannot, and messages that name joint, loop or segment."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, PostureError, coefficients, load_bicycle, load_rider
from singletrack.closed_form import coefficients as closed_form_coefficients
from singletrack.library import shipped
from singletrack.library.template import template
from singletrack.posture import Options, load_posture, seat
from singletrack.posture.mechanism_file import parse_mechanism

BICYCLE, RIDER = load_bicycle("browser"), load_rider("rider-a")
TEXT = template("posture")
ELBOW = (
    '[[joints]]\nname = "right elbow"\nparent = "right shoulder rotation"\npoint = "right elbow"\naxis = "right elbow"'
)


def model(text):
    return coefficients(BICYCLE, RIDER, parse_mechanism(text, "mine.toml"))


def test_the_template_is_the_upright_rider():
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_array_equal(
            getattr(model(TEXT), name), getattr(coefficients(BICYCLE, RIDER, "upright"), name)
        )


@pytest.mark.parametrize("name", shipped("posture"))
def test_shipped_postures_are_files_and_seat_the_rider(name):
    mechanism = load_posture(name)
    assert mechanism.source
    assert mechanism.description
    seated = seat(BICYCLE, RIDER, Options(mechanism))
    assert sum(float(segment.mass) for segment in seated.segments.values()) == pytest.approx(72.0)


def test_a_file_is_a_posture(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT)
    np.testing.assert_array_equal(coefficients(BICYCLE, RIDER, path).M, model(TEXT).M)
    np.testing.assert_array_equal(coefficients(BICYCLE, RIDER, str(path)).M, model(TEXT).M)


def test_numbers_and_coordinates_stand_for_names():
    text = TEXT.replace('point = "right shoulder"', "point = 21").replace('axis = "y"', "axis = [0, 2, 0]")
    np.testing.assert_allclose(model(text).M, model(TEXT).M, rtol=1e-14)
    at = seat(BICYCLE, RIDER, "upright").skeleton[21].tolist()
    text = TEXT.replace('point = "right shoulder"', f"point = {at}")
    np.testing.assert_allclose(model(text).M, model(TEXT).M, rtol=1e-14)
    middle = TEXT.replace('point = "right shoulder"', "point = { from = 21, to = 23, share = 0.0 }")
    np.testing.assert_allclose(model(middle).M, model(TEXT).M, rtol=1e-14)


def test_laws_and_freedoms_come_from_the_file():
    soft = TEXT.replace('to = "handlebar"', 'to = "handlebar"\nstiffness = "2 kN/m"\ndamping = "30 N*s/m"')
    freed = soft.replace('axis = "y"', 'axis = "y"\nfree = true')
    freed = freed.replace('shoulder", to = "right elbow" }', 'shoulder", to = "right elbow" }\nfree = true')
    freed = freed.replace('shoulder", to = "left elbow" }', 'shoulder", to = "left elbow" }\nfree = true')
    freed = freed.replace('axis = "right elbow"', 'axis = "right elbow"\nfree = true\nstiffness = "20 N*m/rad"')
    freed = freed.replace('axis = "left elbow"', 'axis = "left elbow"\nfree = true\ndamping = "3 N*m*s/rad"')
    found = model(freed)
    laws = {"springs": {"hands": 2000.0, "right elbow": 20.0}, "dampers": {"hands": 30.0, "left elbow": 3.0}}
    expected = coefficients(BICYCLE, RIDER, "upright", **laws)
    assert found.coordinates == expected.coordinates
    assert len(found.coordinates) == 8
    for name in ("M", "K0", "S0", "C0"):
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "error", "words"),
    [
        ('kind = "posture"', 'kind = "rider"', InputError, r"mine\.toml: is no mechanism: kind = .rider., must be"),
        ('kind = "posture"', 'kind = "posture"\nkind = 3', InputError, r"mine\.toml: is not valid TOML"),
        ('name = "mine"', 'nam = "mine"', InputError, r"mine\.toml, line \d+: unknown entry 'nam'; did you mean name"),
        ('arms = "bent"', 'arms = "bend"', InputError, "unknown arms 'bend'; did you mean bent"),
        ('name = "right elbow"\n', 'name = "left elbow"\n', InputError, "two joints are called 'left elbow'"),
        ('parent = "right shoulder rotation"', 'parent = "right wrist"', InputError, "joint right elbow: parent"),
        ('parent = "right shoulder rotation"', 'parent = "left elbow"', InputError, "joint right elbow: parent"),
        (
            'point = "right elbow"',
            'point = "right knie"',
            InputError,
            "right elbow: point.*did you mean right knee",
        ),
        ('point = "right elbow"', "point = 32", InputError, "joint right elbow: point = 32, must be a skeleton point"),
        ('point = "right elbow"', "point = [1, 2]", InputError, "joint right elbow: point .* three components"),
        ('axis = "right elbow"', 'axis = "right"', InputError, "joint right elbow: axis: unknown axis 'right'"),
        ('axis = "right elbow"', "axis = [0, 0, 0]", InputError, "joint right elbow: axis .* must not be zero"),
        (
            'axis = "right elbow"',
            "axis = { from = 21, to = 21 }",
            InputError,
            "right elbow: axis: from and to are",
        ),
        ('axis = "right elbow"', 'axis = "y"\nstiffness = "3 kg"', InputError, "joint right elbow: stiffness: '3 kg'"),
        (
            'axis = "right elbow"',
            'axis = "y"\ndamping = -1',
            InputError,
            "right elbow: damping = -1 N\\*m\\*s/rad",
        ),
        (
            'axis = "right elbow"',
            'axis = "y"\nfree = 1',
            InputError,
            "right elbow: free = 1, must be true or false",
        ),
        (
            'axis = "right elbow"',
            'axis = "y"\nfree = true\npreload = 3',
            InputError,
            "right elbow: preload",
        ),
        ('axis = "right elbow"', 'axis = "y"\nfre = true', InputError, "joint right elbow: unknown entry 'fre'"),
        ('joint = "right elbow"', 'joint = "elbow"', InputError, "loop right hand: joint"),
        ('to = "handlebar"', 'to = "bar"', InputError, "loop right hand: to"),
        ('point = "right grip"', "", InputError, "loop right hand: must have either point"),
        (
            'point = "right grip"',
            'point = "right grip"\nat = 20',
            PostureError,
            r"right hand cannot close: .* 0\.44 m",
        ),
        (
            'point = "right grip"',
            'perpendicular = ["x", [1, 0, 1]]',
            PostureError,
            "loop right hand cannot close: its directions are 45 deg apart",
        ),
        ('right_lower_arm = "right elbow"\n', "", InputError, "segment right_lower_arm: hangs on no joint"),
        ('right_lower_arm = "right elbow"', 'right_lower_arm = "wrist"', InputError, "segment right_lower_arm: joint"),
        ('right_lower_arm = "right elbow"', 'right_arm = "right elbow"', InputError, "unknown segment 'right_arm'"),
    ],
)
def test_what_a_file_cannot_say(old, new, error, words):
    assert old in TEXT
    with pytest.raises(error, match=words) as found:
        model(TEXT.replace(old, new, 1))
    assert "mine" in str(found.value)


LOOSE = '[[joints]]\nname = "neck"\nparent = "frame"\npoint = 15\naxis = "x"\n\n'


def test_a_joint_that_nothing_determines():
    with pytest.raises(PostureError, match="posture mine: joint neck: no loop determines it, and it is not declared"):
        model(TEXT.replace(ELBOW, LOOSE + ELBOW))
    between = LOOSE.replace('"frame"', '"right shoulder rotation"')
    with pytest.raises(PostureError, match=r"give 6 conditions for 7 joints .* declare 1 free"):
        model(TEXT.replace(ELBOW, between + ELBOW.replace('"right shoulder rotation"', '"neck"')))


def test_loops_that_ask_too_much():
    more = '[[loops]]\nname = "right foot"\njoint = "right elbow"\npoint = 26\n\n[[loops]]'
    with pytest.raises(PostureError, match="loop right foot, right hand, left hand: cannot stay closed"):
        model(TEXT.replace("[[loops]]", more, 1))


def test_loops_that_are_singular_name_joint_and_loop():
    text = TEXT.replace('axis = { from = "right shoulder", to = "right elbow" }', 'axis = "y"')
    with pytest.raises(PostureError, match=r"joint right (shoulder|elbow).* is not determined .* loop right hand"):
        model(text)


def test_a_free_joint_without_mass():
    text = TEXT.replace(ELBOW, LOOSE.replace('axis = "x"', 'axis = "x"\nfree = true') + ELBOW)
    with pytest.raises(PostureError, match="joint neck is free and moves no mass"):
        model(text)


@pytest.mark.parametrize("seed", range(3))
def test_a_ball_joint_of_three_hinges_may_have_any_axes(seed):
    """The arms of Moore (2012): three turns at the shoulder, whichever axes they are about."""
    rng = np.random.default_rng(seed)
    text = shipped("posture")["moore-2012"].read_text(encoding="utf-8")
    for old in ('{ from = "fork crown", to = "head tube top", across = "y" }', 'axis = "y"'):
        new = rng.normal(size=3).round(3).tolist()
        text = text.replace(old, f"axis = {new}" if old.startswith("axis") else str(new))
    expected = coefficients(BICYCLE, RIDER, "moore-2012")
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(model(text), name), getattr(expected, name), rtol=1e-10, atol=1e-11)


def test_the_arms_of_moore_have_no_stable_speed_as_he_found():
    """The oscillation is always stable, one real mode never is (figures of his chapter Extensions, Rider Arms)."""
    found = coefficients(BICYCLE, RIDER, "moore-2012")
    assert found.critical_speeds().stable_ranges == []
    modes = found.modes([0.5, 3.0, 5.0, 8.0])
    assert (modes.eigenvalues[:, 0].real < 0).all()
    assert (modes.eigenvalues[:, 2].real > 0).all()


@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_one_hand_steers_half_of_what_two_hands_steer(name):
    """Both arms are mirror images and the equations are sums over bodies: the mean of no hand and of both."""
    bicycle = load_bicycle(name)
    one, none, both = (
        closed_form_coefficients(bicycle, RIDER, Options.of(posture))
        for posture in ("one-hand", "rigid", Options("upright", shoulder="abduction"))
    )
    for matrix in ("M", "C1", "K0", "K2"):
        mean = (getattr(none, matrix) + getattr(both, matrix)) / 2
        np.testing.assert_allclose(getattr(one, matrix), mean, rtol=1e-12, atol=1e-12)
