"""Checks on the numbers of elements; parameters pass, as their values are not known yet."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import ModelError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["check_axis", "check_inertia", "check_number", "check_vector", "is_number"]


def is_number(value: Any) -> bool:
    """Tell whether a value is known now (a parameter is not)."""
    return isinstance(value, (int, float)) or not hasattr(value, "is_constant")


def check_number(element: str, quantity: str, value: Any, low: float = -math.inf) -> Any:
    """Return a parameter as it is and a number as a float; refuse what is not finite or below ``low``.

    Parameters
    ----------
    element, quantity : str
        What it is a property of, and which, for a message.
    value : number or parameter
    low : float
        The least that is allowed.
    """
    if not is_number(value):
        return value
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ModelError(f"{element}: {quantity} must be a number, found {value!r}") from None
    if not math.isfinite(number) or number < low:
        allowed = "a finite number" if low == -math.inf else f"a finite number, {low:g} or more"
        raise ModelError(f"{element}: {quantity} is {value!r}; allowed: {allowed}")
    return number


def check_vector(element: str, quantity: str, value: Sequence[Any]) -> tuple[Any, ...]:
    """Return three checked numbers.

    Parameters
    ----------
    element, quantity : str
        What it is a property of, and which, for a message.
    value : three numbers or parameters
    """
    try:
        components = tuple(value)
    except TypeError:
        components = ()
    if len(components) != 3:
        raise ModelError(f"{element}: {quantity} must have three components, found {value!r}")
    return tuple(check_number(element, quantity, component) for component in components)


def check_axis(element: str, quantity: str, value: Sequence[Any]) -> tuple[Any, ...]:
    """Return a unit vector (a vector of parameters is returned as it is).

    Parameters
    ----------
    element, quantity : str
        What it is a property of, and which, for a message.
    value : three numbers or parameters
        Of any length but zero.
    """
    axis = check_vector(element, quantity, value)
    if not all(is_number(component) for component in axis):
        return axis
    length = math.hypot(*axis)
    if length == 0.0:
        raise ModelError(f"{element}: {quantity} has no direction: its length is zero")
    return tuple(component / length for component in axis)


def check_inertia(element: str, inertia: Sequence[float]) -> None:
    """Refuse an inertia that no body can have (negative, or against the triangle inequality).

    Parameters
    ----------
    element : str
        What has it, for a message.
    inertia : six numbers
        xx, yy, zz, xy, xz, yz in kg m^2.
    """
    xx, yy, zz, xy, yz, xz = inertia
    principal = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    slack = 1e-9 * max(abs(principal))
    if principal[0] < -slack or principal[2] > principal[0] + principal[1] + slack:
        found = ", ".join(f"{value:g}" for value in principal)
        raise ModelError(
            f"{element}: no body has the principal inertias {found} kg m^2 (none may be negative, "
            "nor exceed the sum of the others)"
        )
