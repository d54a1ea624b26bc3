"""The wrong thing, or the right thing in a wrong place, is told with what to type."""

from __future__ import annotations

from pathlib import Path

import pytest

from singletrack import Bicycle, InputError, coefficients, load_bicycle, load_rider
from singletrack.public import require_bicycle

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
