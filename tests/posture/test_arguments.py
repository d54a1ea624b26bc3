"""The wrong thing, or the right thing in a wrong place, is told with what to type."""

from __future__ import annotations

from pathlib import Path

import pytest

from singletrack import Bicycle, InputError, coefficients, load_bicycle, load_rider, multibody
from singletrack.multibody.bicycle.model import ride
from singletrack.posture import require_bicycle

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("stratos",), r"""bicycle = 'stratos' is text, must be a Bicycle; type load_bicycle\("stratos"\)"""),
        ((Path("mine.toml"),), r"""type load_bicycle\("mine.toml"\)"""),
        ((RIDER, STRATOS), r"must be \(bicycle, rider\), in this order"),
        ((RIDER,), "bicycle is a Rider, must be a Bicycle"),
        ((STRATOS, "rider-a"), r"""rider = 'rider-a' is text, .*type load_rider\("rider-a"\)"""),
        ((STRATOS, "upright"), 'type posture="upright", after the rider'),
        ((STRATOS, STRATOS), "rider is a Bicycle, must be a Rider, or None"),
        ((Bicycle,), "is the class"),
        (({"wheel_base": 1.0},), r"bicycle is a dict, must be a Bicycle; type Bicycle\(\*\*bicycle\)"),
        ((None,), "bicycle is a NoneType"),
        ((STRATOS, RIDER, 5), "posture is a int, must be one of rigid, leaned, upright"),
        ((STRATOS, RIDER, ["upright"]), "posture is a list"),
        ((STRATOS, RIDER, "upright", "abducted"), "unknown shoulder 'abducted'"),
        ((STRATOS, RIDER, RIDER), "posture is a Rider"),
    ],
    ids=str,
)
def test_wrong_arguments_say_what_to_type(arguments, says):
    with pytest.raises(InputError, match=says):
        coefficients(*arguments)


def test_a_bicycle_is_what_it_is():
    assert require_bicycle(STRATOS) is None


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"springs": [3.0]}, "springs = .*, must be a dictionary by joint"),
        ({"dampers": 3.0}, "dampers = 3.0, must be a dictionary by joint"),
        ({"torso_lean": "yes"}, "torso_lean = 'yes', must be True or False"),
    ],
)
def test_options_of_the_wrong_type(options, says):
    with pytest.raises(InputError, match=says):
        coefficients(STRATOS, RIDER, "upright", **options)


def test_the_engine_tells_the_same():
    with pytest.raises(InputError, match=r"""type load_bicycle\("stratos"\)"""):
        multibody.coefficients("stratos")
    with pytest.raises(InputError, match=r"model is a Bicycle, must be a Model; type ride\(bicycle_model"):
        ride(STRATOS, 5)
