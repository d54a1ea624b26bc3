"""How a rider's joints follow: batches like singles, loops in any order, lengths kept to second order, misses seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from singletrack import InputError, PostureError, coefficients, load_bicycle, load_rider
from singletrack.library.template import template
from singletrack.posture import Options, loop_residual, moved_skeleton, seat, slaved_bodies
from singletrack.posture import residual as residual_module
from singletrack.posture.mechanism import FRAME, Direction, JointPlan, Place
from singletrack.posture.mechanism_file import parse_mechanism
from singletrack.posture.motion import joint_motion, rider_motion
from singletrack.posture.shipped import load_posture, with_torso_lean

BICYCLE, RIDER = load_bicycle("stratos"), load_rider("rider-a")
TEXT = template("posture")
LEANING = Options("leaned", torso_lean=True)


def test_the_order_of_loops_is_nothing() -> None:
    parts = TEXT.split("[[loops]]")
    assert len(parts) == 3
    last, _, rest = parts[2].partition("\n[")
    swapped = f"{parts[0]}[[loops]]{last}\n[[loops]]{parts[1].rstrip()}\n\n[{rest}"
    one, other = (coefficients(BICYCLE, RIDER, parse_mechanism(text, "mine.toml")) for text in (TEXT, swapped))
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("posture", ["upright", "leaned", LEANING])
def test_a_batch_moves_as_its_designs(posture: str | Options) -> None:
    masses = np.array([60.0, 75.0, 90.0])
    lengths = np.array([0.28, 0.29, 0.30])
    batch = RIDER.replace(rider_mass=masses, upper_arm_length=lengths)
    whole = seat(BICYCLE, batch, posture)
    bodies, (first, second, _) = slaved_bodies(whole, BICYCLE), joint_motion(whole, BICYCLE)
    for k, (mass, length) in enumerate(zip(masses, lengths, strict=True)):
        single = seat(BICYCLE, RIDER.replace(rider_mass=mass, upper_arm_length=length), posture)
        alone, (rates, bends, _) = slaved_bodies(single, BICYCLE), joint_motion(single, BICYCLE)
        np.testing.assert_allclose(bodies.mass[k], alone.mass)
        np.testing.assert_allclose(bodies.displacement[k], alone.displacement, atol=1e-13)
        for name, rate in rates.items():
            assert first[name].shape == (3,)
            np.testing.assert_allclose([first[name][k], second[name][k]], [rate, bends[name]], atol=1e-12)


@pytest.mark.parametrize("posture", ["upright", "leaned", LEANING, Options("leaned", arms="bent")])
def test_hands_stay_at_the_grips_for_every_freedom(posture: str | Options) -> None:
    assert float(loop_residual(seat(BICYCLE, RIDER, posture), BICYCLE)) < 1e-12


def test_no_hand_misses_where_there_is_none() -> None:
    assert float(loop_residual(seat(BICYCLE, RIDER, "rigid"), BICYCLE)) == 0.0


@pytest.mark.parametrize("freedom", [0, 1])
def test_a_hand_that_misses_is_seen_for_every_freedom(monkeypatch: pytest.MonkeyPatch, freedom: int) -> None:
    """Joints that turn otherwise than the loops ask, with the steer or with the torso's lean."""
    posture = seat(BICYCLE, RIDER, LEANING)
    motion = rider_motion(posture, BICYCLE)
    rates = np.array(motion.rates)
    shoulder = next(i for i, joint in enumerate(posture.joints) if "flexion" in joint.name)
    rates[shoulder, freedom] += 0.1
    monkeypatch.setattr(residual_module, "rider_motion", lambda *_: replace(motion, rates=rates))
    assert 0.01 < float(loop_residual(posture, BICYCLE)) < 0.1  # of an arm of some 0.6 m, in the worst direction


def test_the_normal_of_each_elbow_is_normal_to_its_own_arm() -> None:
    posture = seat(BICYCLE, RIDER, Options("leaned", arms="bent"))
    names = ("right", "left")
    axes = {joint.name: joint.axis for joint in posture.joints}
    wide = load_bicycle("browser").replace(handlebar_width=0.7)  # arms in planes of their own, mirror images
    posture_file = seat(wide, RIDER, parse_mechanism(TEXT, "mine.toml"))
    points = posture_file.skeleton
    for side, shoulder, elbow, grip in (("right", 21, 23, 19), ("left", 22, 24, 20)):
        axis = {joint.name: joint.axis for joint in posture_file.joints}[f"{side} elbow"]
        for one, two in ((shoulder, elbow), (elbow, grip)):
            assert abs(float(np.dot(axis, points[two] - points[one]))) < 1e-12
    assert all(any(name.startswith(side) for name in axes) for side in names)


def test_limbs_keep_their_lengths_to_second_order() -> None:
    """Steer and lean of the torso together: what is left is of third order, an eighth for half the angles."""
    posture = seat(BICYCLE, RIDER, LEANING)

    def error(size: float) -> float:
        still = posture.skeleton.points
        moved = moved_skeleton(posture, BICYCLE, size * np.array([1.0, 0.7]))
        limbs = ((21, 22), (21, 25), (22, 25))  # shoulders and head, which the torso carries
        sizes = [
            np.linalg.norm(points[..., a - 1, :] - points[..., b - 1, :]) for points in (moved, still) for a, b in limbs
        ]
        return float(np.max(np.abs(np.subtract(sizes[:3], sizes[3:]))))

    assert error(0.02) < 0.2 * error(0.04)


def test_a_rider_who_does_not_move_stays() -> None:
    posture = seat(BICYCLE, RIDER, "rigid")
    moved = moved_skeleton(posture, BICYCLE, np.array([0.1]))
    assert np.isfinite(moved).all()
    np.testing.assert_array_equal(moved[20:25], posture.skeleton.points[20:25])


def test_legs_on_joints_of_their_own_do_not_lean_with_the_torso() -> None:
    mechanism = load_posture("upright")
    knee = JointPlan("right knee", FRAME, Place(14), Direction(vector=(0.0, 1.0, 0.0)), free=True)
    segments = dict(mechanism.segments) | {"right_lower_leg": "right knee"}
    leaning = with_torso_lean(replace(mechanism, joints=(*mechanism.joints, knee), segments=segments))
    parents = {joint.name: joint.parent for joint in leaning.joints}
    assert parents["right knee"] == FRAME
    assert parents["right shoulder flexion"] == "torso lean"
    with pytest.raises(InputError, match="has a joint torso lean already"):
        with_torso_lean(leaning)


def test_how_many_joints_to_free_is_said() -> None:
    """Three more hinges in an arm: its hand's three conditions determine three of six."""
    hinge = '[[joints]]\nname = "more {}"\nparent = "{}"\npoint = "right elbow"\naxis = {}\n'
    more = "".join(
        hinge.format(k, parent, axis)
        for k, parent, axis in ((1, "right elbow", "[1, 0, 0]"), (2, "more 1", "[0, 0, 1]"), (3, "more 2", "[1, 0, 1]"))
    )
    text = TEXT.replace("[[loops]]", f"{more}\n[[loops]]", 1).replace('joint = "right elbow"', 'joint = "more 3"')
    with pytest.raises(PostureError, match=r"6 conditions for 9 joints .* declare 3 free"):
        coefficients(BICYCLE, RIDER, parse_mechanism(text, "mine.toml"))
    one = text[text.index("[[loops]]") :]
    left = one[one.index("[[loops]]", 5) : one.index("\n[", one.index("[[loops]]", 5) + 9)]
    with pytest.raises(PostureError, match=r"left .*no loop determines it"):
        coefficients(BICYCLE, RIDER, parse_mechanism(text.replace(left, ""), "mine.toml"))


def test_a_spring_at_a_joint_frees_nothing_but_soft_hands_do() -> None:
    fixed = coefficients(BICYCLE, RIDER, "upright")
    sprung = coefficients(BICYCLE, RIDER, "upright", springs={"right elbow": 3.0})
    soft = coefficients(BICYCLE, RIDER, "upright", springs={"hands": 1e4})
    assert sprung.coordinates == fixed.coordinates == ("lean", "steer")
    assert len(soft.coordinates) == 8
