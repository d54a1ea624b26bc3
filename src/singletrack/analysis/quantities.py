"""What constraints are put on: lengths and angles that follow from a bicycle's parameters, safe for complex steps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import complex_steps
from singletrack.body.skeleton import frame_points
from singletrack.errors import InputError, unknown_name

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.analysis.designs import Design
    from singletrack.arrays import Array, Number
    from singletrack.parameters import Bicycle

__all__ = ["QUANTITIES", "quantities_with_gradients", "quantity", "quantity_unit"]

_STEP = 1e-30


def _front_clearance(bicycle: Bicycle) -> Array:
    p = frame_points(bicycle)
    x, z = p[7][..., 0] - p[5][..., 0], p[7][..., 2] - p[5][..., 2]
    return (x**2 + z**2) ** 0.5 - bicycle.front_wheel_radius


def _reach(bicycle: Bicycle) -> Array:
    p = frame_points(bicycle)
    return p[19][..., 0] - p[5][..., 0]


def _grip_height(bicycle: Bicycle) -> Array:
    return -frame_points(bicycle)[19][..., 2]


def _fork_offset(bicycle: Bicycle) -> Array:
    tilt = np.asarray(bicycle.steer_axis_tilt)
    return bicycle.front_wheel_radius * np.sin(tilt) - bicycle.trail * np.cos(tilt)


def _mechanical_trail(bicycle: Bicycle) -> Array:
    return bicycle.trail * np.cos(np.asarray(bicycle.steer_axis_tilt))


#: Quantities that constraints may be put on: unit, meaning, function of a bicycle.
QUANTITIES: dict[str, tuple[str, str, Callable[[Bicycle], Number]]] = {
    "reach": ("m", "grips ahead of the crank axle", _reach),
    "grip_height": ("m", "grips above the ground", _grip_height),
    "front_clearance": (
        "m",
        "crank axle to the front tyre: crank and shoe must pass",
        _front_clearance,
    ),
    "ride_height": ("m", "crank axle above the ground", lambda bicycle: bicycle.bottom_bracket_height),
    "fork_offset": ("m", "front hub ahead of the steer axis", _fork_offset),
    "mechanical_trail": ("m", "normal to the steer axis", _mechanical_trail),
    "head_angle": ("rad", "steer axis from the ground", lambda bicycle: np.pi / 2 - bicycle.steer_axis_tilt),
}


def quantity_unit(design: Design, name: str) -> str:
    """Return the SI unit of a quantity or parameter.

    Parameters
    ----------
    design : Design
    name : str

    Raises
    ------
    InputError
        If there is no such quantity, or the bicycle has no frame geometry to get it from.
    """
    if name in QUANTITIES:
        missing = design.bicycle.missing_geometry()
        if missing and name in {"reach", "grip_height", "front_clearance", "ride_height"}:
            raise InputError(f"{name}: needs frame geometry, {design.title} lacks {', '.join(missing)}")
        return QUANTITIES[name][0]
    units = design.units()
    if name not in units:
        raise InputError(unknown_name("quantity", name, (*QUANTITIES, *units)))
    return units[name]


def quantity(design: Design, name: str) -> Array:
    """Return a quantity or parameter of a design, SI, of shape (...).

    Parameters
    ----------
    design : Design
    name : str
        One of :data:`QUANTITIES`, or a parameter.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.designs import Design
    >>> round(float(quantity(Design.of(load_bicycle("browser")), "front_clearance")), 3)
    0.321
    """
    value = QUANTITIES[name][2](design.bicycle) if name in QUANTITIES else design.values()[name]
    result: Array = np.asarray(value)
    return result


def quantities_with_gradients(
    design: Design, quantities: tuple[str, ...], names: tuple[str, ...]
) -> tuple[np.ndarray, np.ndarray]:
    """Return q quantities (q,) of a design and their derivatives (q, k) with respect to parameters, SI.

    Parameters
    ----------
    design : Design
        A single one.
    quantities : tuple of str
        The q quantities.
    names : tuple of str
        The k parameters.
    """
    values = np.array([float(np.real(quantity(design, name))) for name in quantities])
    if not quantities:
        return values, np.zeros((0, len(names)))
    with complex_steps():
        moved = design.shifted(names, 1j * _STEP * np.eye(len(names)))
        rows = [np.broadcast_to(np.imag(quantity(moved, name)) / _STEP, (len(names),)) for name in quantities]
    return values, np.array(rows)
