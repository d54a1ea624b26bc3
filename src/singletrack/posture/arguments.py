"""Bicycles and riders as a program hands them in: the wrong thing, or the right one in a wrong place, is told so."""

from __future__ import annotations

from pathlib import PurePath
from typing import Any

from singletrack.errors import InputError
from singletrack.parameters import Bicycle, Rider
from singletrack.posture.mechanism import Mechanism
from singletrack.posture.options import POSTURES

__all__ = ["require_bicycle", "require_posture", "require_records"]


def require_records(bicycle: object, rider: object = None) -> None:
    """Raise InputError unless these are a bicycle, and a rider or None; the message says what to type.

    >>> from singletrack import load_bicycle, load_rider
    >>> require_records(load_rider("rider-a"), load_bicycle("stratos"))
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: bicycle is a Rider and rider is a Bicycle: must be (bicycle, rider), in this order
    """
    if isinstance(bicycle, Rider) and isinstance(rider, Bicycle):
        raise InputError(
            "bicycle is a Rider and rider is a Bicycle: must be (bicycle, rider), in this order",
            parameters=("bicycle", "rider"),
            allowed="a Bicycle, a Rider",
        )
    require_bicycle(bicycle)
    if rider is not None and not isinstance(rider, Rider):
        raise _refusal("rider", rider, Rider, "a Rider, or None for a bicycle alone")


def require_bicycle(bicycle: object) -> None:
    """Raise InputError unless this is a bicycle.

    >>> require_bicycle("stratos")
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: bicycle = 'stratos' is text, must be a Bicycle; type load_bicycle("stratos")
    """
    if not isinstance(bicycle, Bicycle):
        raise _refusal("bicycle", bicycle, Bicycle, "a Bicycle")


def require_posture(posture: object) -> None:
    """Raise InputError unless this can be a posture: a name, a file or a mechanism.

    >>> require_posture(5)
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: posture is a int, must be one of rigid, leaned, upright, a file or a Mechanism
    """
    if not isinstance(posture, str | PurePath | Mechanism):
        allowed = f"one of {', '.join(POSTURES)}, a file or a Mechanism"
        reason = f"posture is a {type(posture).__name__}, must be {allowed}"
        raise InputError(reason, parameters=("posture",), found=posture, allowed=allowed)


def _refusal(name: str, found: Any, wanted: type[Bicycle | Rider], allowed: str) -> InputError:
    hint = ""
    if isinstance(found, str) and found in POSTURES:
        what, hint = f"{name} = {found!r} is the name of a posture", f'; type posture="{found}", after the rider'
    elif isinstance(found, str | PurePath):
        what, hint = f"{name} = {str(found)!r} is text", f'; type load_{wanted.kind}("{found}")'
    elif isinstance(found, type) and issubclass(found, wanted):
        what, hint = f"{name} = {found.__name__} is the class", f'; type load_{wanted.kind}("..."), or make one'
    else:
        what = f"{name} is a {type(found).__name__}"
        if isinstance(found, dict):
            hint = f"; type {wanted.__name__}(**{name})"
    return InputError(f"{what}, must be {allowed}{hint}", parameters=(name,), found=found, allowed=allowed)
