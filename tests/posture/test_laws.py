"""Springs and dampers of several joints add up, a joint may turn about the steer axis, chains start at the frame."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.library.template import template
from singletrack.posture import Options, seat
from singletrack.posture.mechanism_file import parse_mechanism

BICYCLE, RIDER = load_bicycle("browser"), load_rider("rider-a")
JOINTS = {"right elbow": 3.0, "left shoulder rotation": 5.0, "steer": 7.0}


@pytest.mark.parametrize(("option", "matrix"), [("dampers", "C0"), ("springs", "S0")])
def test_laws_of_several_joints_add_up(option: str, matrix: str) -> None:
    alone = [
        getattr(coefficients(BICYCLE, RIDER, "upright", **{option: {joint: law}}), matrix)
        for joint, law in JOINTS.items()
    ]
    together = getattr(coefficients(BICYCLE, RIDER, "upright", **{option: JOINTS}), matrix)
    assert all(one[1, 1] > 0 for one in alone)
    np.testing.assert_allclose(together, sum(alone), rtol=1e-13, atol=1e-13)


def test_a_joint_about_the_steer_axis() -> None:
    tilt = float(BICYCLE.steer_axis_tilt)
    text = template("posture")
    named = text.replace('axis = "right elbow"', 'axis = "steer"')
    assert named != text
    given = text.replace('axis = "right elbow"', f"axis = [{float(np.sin(tilt))!r}, 0, {float(np.cos(tilt))!r}]")
    joints = [
        {joint.name: joint for joint in seat(BICYCLE, RIDER, Options(parse_mechanism(each, "mine.toml"))).joints}
        for each in (named, given)
    ]
    np.testing.assert_allclose(joints[0]["right elbow"].axis, joints[1]["right elbow"].axis, atol=1e-14)


@pytest.mark.parametrize("numbers", ["[1, 2]", "[1, 2, 3, 4]"])
def test_a_point_has_three_components(numbers: str) -> None:
    text = template("posture").replace('point = "right elbow"', f"point = {numbers}")
    with pytest.raises(InputError, match="must have three components"):
        parse_mechanism(text, "mine.toml")


def test_a_chain_leads_from_the_frame_to_its_joint() -> None:
    posture = seat(BICYCLE, RIDER, "upright")
    for joint in posture.joints:
        chain = posture.chain(joint.name)
        assert chain[0].parent == ""
        assert chain[-1].name == joint.name
        assert all(after.parent == before.name for before, after in pairwise(chain))
