"""Where a rider cannot be fitted: the lean that comes nearest, found by trying all; and how far limbs are stretched."""

from __future__ import annotations

import sys
from math import pi, radians

import numpy as np
import pytest

from singletrack import InputError, PostureError, load_bicycle, load_rider
from singletrack.body import skeleton
from singletrack.body.fit import elbow_angle, fit, fitted
from singletrack.body.reach import reach

STRATOS, BROWSER, RIDER = load_bicycle("stratos"), load_bicycle("browser"), load_rider("rider-a")


def test_elbows_are_at_150_deg_unless_asked_otherwise() -> None:
    assert elbow_angle(BROWSER, fit(BROWSER, RIDER)) == pytest.approx(radians(150.0), abs=1e-9)


@pytest.mark.parametrize("elbow", [0.0, -0.1, pi + 1e-9])
def test_an_elbow_angle_that_is_none(elbow: float) -> None:
    with pytest.raises(InputError, match="more than 0 and at most pi"):
        fit(BROWSER, RIDER, elbow)


def mismatch(rider: object, elbow: float, lean: np.ndarray) -> np.ndarray:
    """Return by how much shoulder and grip are too far apart or too close at some leans, in m."""
    points = skeleton(BROWSER, load_rider("rider-a"))
    hip, grip = np.asarray(points[13]), np.asarray(points[19])
    side = np.asarray(points[21]) - np.asarray(points[15])
    torso, upper, lower = (getattr(rider, f"{name}_length") for name in ("torso", "upper_arm", "lower_arm"))
    shoulder = hip + side + torso * np.stack([np.cos(lean), 0 * lean, -np.sin(lean)], axis=-1)
    wanted = np.sqrt(upper**2 + lower**2 - 2 * upper * lower * np.cos(elbow))
    found: np.ndarray = np.linalg.norm(grip - shoulder, axis=-1) - wanted
    return found


@pytest.mark.parametrize("torso", [0.02, 0.05, 0.48, 1.2, 2.0])
@pytest.mark.parametrize("arm", [0.05, 0.31, 0.6])
def test_the_nearest_lean_is_nearest(torso: float, arm: float) -> None:
    rider = RIDER.replace(torso_length=np.array([torso]), upper_arm_length=arm, lower_arm_length=arm)
    result, faults = fitted(BROWSER, rider, np.array(radians(160.0)))
    lean = float(np.asarray(result.forward_lean_angle)[0])
    leans = np.linspace(1e-3, pi / 2 - 1e-3, 20001)
    plain = RIDER.replace(torso_length=torso, upper_arm_length=arm, lower_arm_length=arm)
    misses = np.abs(mismatch(plain, radians(160.0), leans))
    miss = abs(float(mismatch(plain, radians(160.0), np.array(lean))))
    assert miss <= misses.min() + 1e-12
    if faults:
        assert miss > 1e-6
    else:
        assert miss < 1e-12


@pytest.mark.parametrize("bicycle", [STRATOS, BROWSER], ids=lambda bicycle: bicycle.name)
def test_how_far_limbs_are_stretched(bicycle: object) -> None:
    points = skeleton(bicycle, RIDER)
    found = reach(points, RIDER)
    leg = np.linalg.norm(np.asarray(points[13]) - np.asarray(points[5]))
    arm = np.linalg.norm(np.asarray(points[21]) - np.asarray(points[19]))
    assert found["leg"] == pytest.approx(leg / (RIDER.upper_leg_length + RIDER.lower_leg_length), rel=1e-14)
    assert found["arm"] == pytest.approx(arm / (RIDER.upper_arm_length + RIDER.lower_arm_length), rel=1e-14)


@pytest.mark.parametrize(
    ("grip", "torso", "arms", "nearest"),
    [
        # Straight arms that just reach, along the torso and against it; a torso that would lie flat, or stand upright.
        ((3.0, 0.0, -4.0), 2.0, 3.0, np.arctan2(4.0, 3.0)),
        ((3.0, 0.0, 4.0), 2.0, 7.0, pi / 2),
        ((0.0, 0.0, 1.0), 0.75, 1.25, 0.0),
        ((1.0, 0.0, 0.0), 0.75, 1.25, pi / 2),
    ],
)
def test_what_is_just_out_of_reach_is_out_of_reach(
    monkeypatch: pytest.MonkeyPatch, grip: tuple[float, ...], torso: float, arms: float, nearest: float
) -> None:
    """All numbers are exact in binary: the bounds themselves are no leans, and the one that comes nearest is told."""
    zero = np.zeros(3)
    monkeypatch.setattr(sys.modules[fitted.__module__], "_places", lambda *_: (zero, zero, np.array(grip)))
    rider = RIDER.replace(torso_length=np.array([torso]), upper_arm_length=arms / 2, lower_arm_length=arms / 2)
    found, faults = fitted(STRATOS, rider, np.array(pi))
    assert len(faults) == 1
    assert faults[0].bad.tolist() == [True]
    assert found.forward_lean_angle == pytest.approx(nearest, abs=2e-3)
    single = rider.replace(torso_length=torso)
    with pytest.raises(PostureError, match=r"the arms span .* m too (near|far)$"):
        fit(STRATOS, single, pi)
