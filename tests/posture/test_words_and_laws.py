"""What a mechanism is made of is read as it stands and told as it is; preloads, springs and singular loops."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.library.template import template
from singletrack.posture import load_posture, seat
from singletrack.posture.describe import mechanism_lines
from singletrack.posture.inverses import _inverse, _singular
from singletrack.posture.mechanism_file import parse_mechanism

if TYPE_CHECKING:
    from singletrack.posture.mechanism import JointPlan, LoopPlan

BICYCLE, RIDER = load_bicycle("browser"), load_rider("rider-a")
TEXT = template("posture")
HINGE = 'name = "right elbow"\nparent = "right shoulder rotation"\npoint = "right elbow"\naxis = "right elbow"'
HAND = 'to = "handlebar"'


def joint(text: str) -> JointPlan:
    """Return the plan of the right elbow of the template with that text in place of its own."""
    changed = TEXT.replace(HINGE, text)
    assert changed != TEXT
    return {plan.name: plan for plan in parse_mechanism(changed, "mine.toml").joints}["right elbow"]


def hand(more: str) -> LoopPlan:
    return parse_mechanism(TEXT.replace(HAND, f"{HAND}\n{more}", 1), "mine.toml").loops[0]


@pytest.mark.parametrize(("kind", "slides", "unit"), [("slider", True, "N/m"), ("hinge", False, "N*m/rad")])
def test_sliders_slide_and_hinges_turn(kind: str, slides: bool, unit: str) -> None:
    plan = joint(f'{HINGE}\nkind = "{kind}"\nstiffness = "3 {unit}"')
    assert (plan.slides, plan.stiffness) == (slides, 3.0)
    other = "N/m" if kind == "hinge" else "N*m/rad"
    with pytest.raises(InputError, match="stiffness"):
        joint(f'{HINGE}\nkind = "{kind}"\nstiffness = "3 {other}"')


def test_a_slider_needs_no_point_but_a_hinge_does() -> None:
    without = HINGE.replace('point = "right elbow"\n', "")
    assert joint(f'{without}\nkind = "slider"').slides
    with pytest.raises(InputError, match="joint right elbow: point is missing"):
        joint(without)


@pytest.mark.parametrize(
    ("more", "laws"),
    [
        ("", (None, 0.0)),
        ('stiffness = "2 N/m"', (2.0, 0.0)),
        ('damping = "3 N*s/m"', (0.0, 3.0)),
        ('stiffness = "2 N/m"\ndamping = "3 N*s/m"', (2.0, 3.0)),
    ],
)
def test_a_hand_is_soft_if_either_law_is_given(more: str, laws: tuple[float | None, float]) -> None:
    loop = hand(more)
    assert (loop.stiffness, loop.damping) == laws


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('axis = "right elbow"', "axis = [1e-300, 0, 0]", "right elbow: axis .* largest component must be 0 or of a"),
        ('axis = "right elbow"', "axis = [1e308, 0, 0]", "right elbow: axis .* from 1e-09 to 100$"),
        ('point = "right elbow"', 'point = ["1e308 ft", 0, 0]', "right elbow: point"),
        ('point = "right elbow"', "point = [0, 101, 0]", "right elbow: point .* to 100 m"),
        ('point = "right elbow"', "point = { from = 21, to = 23, share = 1e308 }", "share = 1e.308, must be a number"),
        (
            'axis = "right elbow"',
            'axis = "y"\nstiffness = 1e13',
            r"stiffness = 1e\+13 N\*m/rad, must be at most 1e\+12",
        ),
        ('axis = "right elbow"', 'axis = "y"\npreload = -1e13', r"preload = -1e\+13 N\*m, must be at most 1e\+12"),
        (HAND, f'{HAND}\nstiffness = "1e308 N/ft"', "stiffness"),
    ],
)
def test_numbers_beyond_all_that_is_ridden_are_refused(old: str, new: str, words: str) -> None:
    with pytest.raises(InputError, match=rf"mine\.toml.*{words}"):
        parse_mechanism(TEXT.replace(old, new), "mine.toml")


@pytest.mark.parametrize("name", ["upright-abduction", "leaned-bent-abduction", "leaned-straight-abduction"])
def test_a_joint_stands_below_the_one_that_carries_it(name: str) -> None:
    """Two spaces for each joint between it and the frame, and itself."""
    mechanism = load_posture(name)
    parents = {plan.name: plan.parent for plan in mechanism.joints}
    lines = [line for line in mechanism_lines(mechanism) if line.startswith("  ")]
    assert [line.partition(":")[0].strip() for line in lines] != []
    for line in lines:
        at = line.partition(":")[0].strip()
        above = 0
        while at in parents:
            at, above = parents[at], above + 1
        assert len(line) - len(line.lstrip()) == 2 * above


def test_a_place_on_a_line_is_told_by_its_ends() -> None:
    text = TEXT.replace(
        'point = "right elbow"', 'point = { from = "right shoulder", to = "right elbow", share = 0.25 }'
    )
    told = "\n".join(mechanism_lines(parse_mechanism(text, "mine.toml")))
    assert "at 0.25 from right shoulder to right elbow" in told


def test_a_preload_is_a_spring_without_damping_and_works_in_proportion() -> None:
    """The potential of a torque p about a joint is -p s: it adds to the stiffness alone, twice as much for twice p."""

    def added(preload: float) -> tuple[np.ndarray, np.ndarray]:
        text = TEXT.replace('axis = "right elbow"', f'axis = "right elbow"\npreload = {preload}')
        model = coefficients(BICYCLE, RIDER, parse_mechanism(text, "mine.toml"))
        return model.C0, model.S0

    once, twice, back = (added(preload) for preload in (10.0, 20.0, -10.0))
    assert all(not np.any(damping) for damping, _ in (once, twice, back))
    assert abs(once[1][1, 1]) > 1e-3
    np.testing.assert_allclose(twice[1], 2 * once[1], rtol=1e-12)
    np.testing.assert_allclose(back[1], -once[1], rtol=1e-12)


def test_a_spring_of_one_with_a_preload_of_one_is_a_spring_with_a_preload() -> None:
    def stiffness(laws: str) -> np.ndarray:
        text = TEXT.replace('axis = "right elbow"', f'axis = "right elbow"\n{laws}')
        return coefficients(BICYCLE, RIDER, parse_mechanism(text, "mine.toml")).S0

    both = stiffness("stiffness = 1\npreload = 1")
    np.testing.assert_allclose(both, stiffness("stiffness = 1") + stiffness("preload = 1"), rtol=1e-12)
    assert both[1, 1] > stiffness("preload = 1")[1, 1]


def test_preloads_of_two_joints_add_up() -> None:
    def stiffness(*joints: str) -> np.ndarray:
        text = TEXT
        for name in joints:
            text = text.replace(f'axis = "{name}"', f'axis = "{name}"\npreload = 10')
        return coefficients(BICYCLE, RIDER, parse_mechanism(text, "mine.toml")).S0

    both = stiffness("right elbow", "left elbow")
    np.testing.assert_allclose(both, stiffness("right elbow") + stiffness("left elbow"), rtol=1e-12)
    np.testing.assert_allclose(both[1, 1], 2 * stiffness("right elbow")[1, 1], rtol=1e-9)  # left and right are alike


def test_singular_loops_are_named() -> None:
    """Of a matrix whose only defect is one empty row and one empty column: that row's loop, that column's joint."""
    posture = seat(BICYCLE, RIDER, "upright")
    joints, loops = posture.tree.dependent, posture.loops
    matrices, names = [], []
    for row in range(6):
        for column in range(6):
            ones = iter(set(range(6)) - {column})
            matrix = np.zeros((6, 6))
            for other in set(range(6)) - {row}:
                matrix[other, next(ones)] = 1.0 + other / 10
            matrices.append(matrix)
            names.append((posture.joints[joints[column]].name, loops[row % 2].name))
    _, bad = _inverse(np.array(matrices))
    assert bad is not None
    assert bad.all()
    fault = _singular(posture, np.array(matrices), bad, np.arange(36), 36, (36,))
    assert list(zip(fault.values["joint"], fault.values["loop"], strict=True)) == names
    assert fault.bad.all()


def test_loops_are_refused_where_they_are_singular_and_not_before() -> None:
    """Just on either side of the bound of the singular values' ratio, whatever quicker test comes before."""
    matrix = np.array([np.diag([1.0, 1.0, 1.0, 1.0, 1.0, least]) for least in (1.5e-6, 0.5e-6, 1.0)])
    inverse, bad = _inverse(matrix)
    assert bad is not None
    assert bad.tolist() == [False, True, False]
    np.testing.assert_allclose((inverse @ matrix)[[0, 2]], [np.eye(6)] * 2, atol=1e-12)
    assert np.isnan(inverse[1]).all()


@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize("place", [0, 1, 2])
def test_axes_are_those_of_the_frame(sign: str, place: int) -> None:
    """x, y, z and what points the other way."""
    wanted = np.eye(3)[place] * (-1.0 if sign else 1.0)
    plan = joint(HINGE.replace('axis = "right elbow"', f'axis = "{sign}{"xyz"[place]}"'))
    assert plan.axis.vector == tuple(wanted)
