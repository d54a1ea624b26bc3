"""Bicycles and riders as the page takes them: plain numbers and text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError, unknown
from singletrack.library import load_bicycle, load_rider, shipped
from singletrack.parameters import Rider

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.parameters import Bicycle

__all__ = ["page_records"]

#: What the page begins with, unless it is told.
_FIRST = ("stratos", "rider-a", "leaned")
#: Those whose equations the page holds.
_POSTURES = ("rigid", "leaned", "upright")


def page_records(
    bicycles: Sequence[Bicycle] = (), rider: Rider | None = None, posture: str | None = None
) -> dict[str, Any]:
    """Return own and shipped records for the page, own ones first.

    Parameters
    ----------
    bicycles : sequence of Bicycle
        Single designs.
    rider : Rider, optional
    posture : str, optional
        What the page begins with.

    Raises
    ------
    InputError
        For a batch of designs, two bicycles of one name, a posture that the page does not have.
    """
    _check(bicycles, rider, posture)
    own_bicycles = _named([*bicycles, *(load_bicycle(name) for name in shipped("bicycle"))])
    own_riders = _named([*([] if rider is None else [rider]), *(load_rider(name) for name in shipped("rider"))])
    first = next(iter(own_bicycles)) if bicycles else _FIRST[0]
    return {
        "bicycles": [_record(record) for record in own_bicycles.values()],
        "riders": [_record(record) for record in own_riders.values()],
        "bicycle": first,
        "rider": next(iter(own_riders)) if rider is not None or not bicycles else "",
        "posture": posture or (_FIRST[2] if rider is not None or not bicycles else "rigid"),
    }


def _check(bicycles: Sequence[Bicycle], rider: Rider | None, posture: str | None) -> None:
    if posture is not None and posture not in _POSTURES:
        raise unknown("posture", posture, _POSTURES, "page")
    if posture not in (None, "rigid") and bicycles and rider is None:
        raise InputError(f"posture {posture} needs a rider; allowed without one: rigid")
    names = [bicycle.name for bicycle in bicycles]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"{name or 'bicycle'}: two bicycles have this name; the page tells them apart by it")


def _named(records: Sequence[Any]) -> dict[str, Any]:
    """Return records by name, the first of each."""
    found: dict[str, Any] = {}
    for record in records:
        found.setdefault(record.name or record.kind, record)
    return found


def _record(record: Bicycle | Rider) -> dict[str, Any]:
    if record.shape != ():
        raise InputError(f"{record.name or record.kind}: is a batch of shape {record.shape}, must be a single design")
    found: dict[str, Any] = {
        "kind": record.kind,
        "name": record.name or record.kind,
        "description": record.description,
        "source": record.source,
        "values": {name: float(value) for name, value in record.values().items()},
    }
    if isinstance(record, Rider):
        found["forward_lean_angles"] = {name: float(angle) for name, angle in record.forward_lean_angles.items()}
    return found
