"""Mechanisms that are a shipped posture under whatever name: from a file that a user has not changed yet, say."""

from __future__ import annotations

import dataclasses
import functools
from typing import TYPE_CHECKING, Any

from singletrack.library import shipped
from singletrack.posture.shipped import load_posture

if TYPE_CHECKING:
    from collections.abc import Hashable

    from singletrack.posture.mechanism import Mechanism

__all__ = ["shipped_alike"]


def shipped_alike(mechanism: Mechanism) -> str | None:
    """Return the name of the file of the shipped posture with the same joints, loops and segments, or None.

    Parameters
    ----------
    mechanism : Mechanism

    Examples
    --------
    >>> shipped_alike(load_posture("upright"))
    'upright-axial'
    """
    outline = _outline(mechanism)
    return None if outline is None else _shipped().get(outline)


@functools.cache
def _shipped() -> dict[Hashable, str]:
    found = {_outline(load_posture(name)): name for name in shipped("posture")}
    return {outline: name for outline, name in found.items() if outline is not None}


def _outline(mechanism: Mechanism) -> Hashable | None:
    """Return what a mechanism is, but for names of its own; None where it varies by design."""
    parts = [_values(part) for part in (*mechanism.joints, *mechanism.loops)]
    outline = (*parts, frozenset(mechanism.segments.items()), mechanism.arms)
    try:
        hash(outline)
    except TypeError:  # an array
        return None
    return outline


def _values(part: Any) -> tuple[Any, ...]:
    return tuple(getattr(part, field.name) for field in dataclasses.fields(part))
