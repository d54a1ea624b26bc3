"""What control cannot be asked: each is refused by name, with what is allowed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.control.effort import Effort, effort
from singletrack.control.measures import distance_to_uncontrollability, gramian, modal_controllability
from singletrack.control.responses import discretised, impulse_response, response, step_response
from singletrack.control.signals import lateral_force, with_inputs, with_path

if TYPE_CHECKING:
    from collections.abc import Callable

BICYCLE, RIDER = load_bicycle("stratos"), load_rider("rider-a")
MODEL = coefficients(BICYCLE)
BATCH = coefficients(BICYCLE.replace(trail=np.array([0.05, 0.06])))
SYSTEM, SEVERAL = MODEL.state_space(5.0), MODEL.state_space([4.0, 5.0])
TIME = np.linspace(0.0, 1.0, 11)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (lambda: discretised(SYSTEM, 0.01, hold="second"), "hold 'second'"),
        (lambda: discretised(SYSTEM, 0.0), "step = 0.0 s, must be greater than zero"),
        (lambda: discretised(SYSTEM, np.nan), "step = nan s, must be greater than zero"),
        (lambda: response(SYSTEM, TIME, np.zeros((11, 3))), r"inputs \(11, 3\) and start \(4,\), must be \(11, 2\)"),
        (lambda: response(SYSTEM, TIME, start=np.zeros(3)), r"start \(3,\), must be .* and \(4,\)"),
        (lambda: response(SYSTEM, [0.0]), "must be finite times"),
        (lambda: response(SYSTEM, [0.0, np.inf]), "must be finite times"),
        (lambda: response(SYSTEM, [0.0, 1.0, 3.0]), "must be evenly spaced and ascending"),
        (lambda: response(SYSTEM, [0.0, -1.0]), "must be evenly spaced and ascending"),
        (lambda: step_response(SYSTEM, TIME, "saddle torque"), "unknown input 'saddle torque'"),
        (lambda: impulse_response(SYSTEM, TIME, "saddle torque"), "unknown input 'saddle torque'"),
        (lambda: with_inputs(MODEL, {"steer torque": np.array([0.0, 1.0])}), "is there already"),
        (
            lambda: with_inputs(MODEL, {"saddle": np.array([0.0, 1.0, 2.0])}),
            r"column of shape \(3,\), must be \(..., 2\)",
        ),
        (lambda: lateral_force(BICYCLE, "hip centre"), "needs a rider"),
        (lambda: lateral_force(BICYCLE, "hip", RIDER, "leaned"), "unknown point 'hip'"),
        (lambda: with_path(SEVERAL, BICYCLE), "a path is that of a single one"),
        (lambda: modal_controllability(BATCH, [5.0]), "takes a single design"),
        (lambda: effort(BATCH, [5.0]), "effort takes a single design"),
        (lambda: effort(MODEL, [5.0], "saddle torque"), "unknown input 'saddle torque'"),
        (lambda: distance_to_uncontrollability(SEVERAL, "steer torque"), "takes a single one"),
        (lambda: distance_to_uncontrollability(SYSTEM, "saddle torque"), "unknown input 'saddle torque'"),
        (lambda: gramian(SEVERAL, "steer torque"), "takes a single one"),
        (lambda: gramian(SYSTEM, "saddle torque"), "unknown input 'saddle torque'"),
    ],
)
def test_each_is_refused(asked: Callable[[], object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        asked()


def test_a_root_on_the_axis_has_no_gramian() -> None:
    low = coefficients(load_bicycle("benchmark"))
    weave = low.critical_speeds().weave[0]
    with pytest.raises(InputError, match="on the imaginary axis"):
        gramian(low.state_space(weave), "steer torque")


def test_a_force_at_a_point_of_the_frame_needs_no_rider() -> None:
    """Its work on lean is its height; at the rear contact's height it has none, and at the contact none on steer."""
    assert lateral_force(BICYCLE, (0.0, -1.2)).tolist() == [1.2, 0.0]
    assert lateral_force(BICYCLE, (0.5, 0.0))[1] > 0


def test_what_is_endless_is_none_in_json() -> None:
    numbers = {"least_energy": [1.0, np.inf], "cost": [np.inf, 2.0], "push_norm": [0.0, 1.0], "largest_torque": [3, 4]}
    fields = {name: np.array(values, dtype=float) for name, values in numbers.items()}
    known = {name: getattr(effort(MODEL, [5.0, 6.0]), name) for name in Effort.__dataclass_fields__}
    told = Effort(**(known | fields)).to_dict()
    assert told["least_energy"] == [1.0, None]
    assert told["cost"] == [None, 2.0]


def test_what_an_input_cannot_hold_costs_without_end() -> None:
    """A torque that works on nothing holds up nothing."""
    idle = with_inputs(MODEL, {"idle": np.array([0.0, 0.0])})
    found = effort(idle, [3.0], "idle")
    assert not np.isfinite(found.cost).any()
