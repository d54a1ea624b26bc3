"""The body that the optional package ``yeadon`` makes of 95 measurements, as segments of ours."""

from __future__ import annotations

import contextlib
import io
import math
import warnings
from typing import TYPE_CHECKING, Protocol

import numpy as np

from singletrack.errors import InputError, install_hint
from singletrack.parameters.shapes import SegmentShape

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Human", "SegmentBody", "make_human", "segment_bodies", "shape_of"]


class _Solid(Protocol):
    """What we take of the package's solids."""

    mass: float
    height: float
    rel_center_of_mass: np.ndarray
    rel_inertia: np.ndarray


class _Part(Protocol):
    """A part of the body: pelvis (P), thorax (T), chest and head (C), upper and lower arm (A), leg (J)."""

    solids: list[_Solid]


class Human(Protocol):
    """What we take of the package's body."""

    meas: dict[str, float]
    P: _Part
    T: _Part
    C: _Part
    A1: _Part
    A2: _Part
    J1: _Part
    J2: _Part


def make_human(metres: dict[str, float], mass: float | None, where: str) -> Human:
    """Return the body that the package makes of measurements.

    Parameters
    ----------
    metres : dict of str to float
        The 95 measurements in m.
    mass : float, optional
        Of the whole body in kg.
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        If the measurements make no body, or the package is not installed.
    """
    try:
        import yeadon  # optional
    except ImportError:
        raise InputError(f"{where}: reading Yeadon's measurements needs yeadon: {install_hint('yeadon')}") from None
    # The package prints and warns about odd cross sections and raises errors of all kinds.
    try:
        with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            human = yeadon.Human(dict(metres))
            # Its densities are shared by all humans and would stay scaled: scale a copy.
            human.segmental_densities = {key: dict(value) for key, value in human.segmental_densities.items()}
            if mass is not None:
                human.scale_human_by_mass(mass)
    except Exception as error:  # noqa: BLE001  # the package raises bare Exception
        reason = str(error).strip().splitlines()[0][:200] if str(error).strip() else type(error).__name__
        raise InputError(f"{where}: the measurements make no body ({reason})") from None
    body: Human = human
    return body


# Solids of each segment by number in yeadon's stacks: s up the trunk, a down the left arm, j down the left leg.
_STACKS = {
    "torso": ("s", slice(0, 5)),
    "head": ("s", slice(5, 8)),
    "upper_arm": ("a", slice(0, 2)),
    "lower_arm": ("a", slice(2, 7)),
    "upper_leg": ("j", slice(0, 3)),
    "lower_leg": ("j", slice(3, 9)),
}
#: Mass in kg, distance of the centre from the inner joint in m, moments along, sideways and across in kg m^2.
SegmentBody = tuple[float, float, tuple[float, float, float]]


def _solids(human: Human) -> dict[str, list[SegmentBody]]:
    """Return the solids of each segment, their centres measured from the segment's inner joint, outwards."""
    stacks = {
        "s": [*human.P.solids, *human.T.solids, *human.C.solids],
        "a": [*human.A1.solids, *human.A2.solids],
        "j": [*human.J1.solids, *human.J2.solids],
    }
    # The shoulders are at level 4 of the trunk; the head's centre is counted from there.
    starts = {"head": human.meas["Ls5L"] - human.meas["Ls4L"]}
    found = {}
    for name, (stack, part) in _STACKS.items():
        position, bodies = starts.get(name, 0.0), []
        for solid in stacks[stack][part]:
            # Limbs hang down from their joint, but their solids are counted upwards.
            own = float(solid.rel_center_of_mass[2, 0])
            inward = own if stack == "s" else float(solid.height) - own
            tensor = solid.rel_inertia
            moments = (float(tensor[2, 2]), float(tensor[0, 0]), float(tensor[1, 1]))
            bodies.append((float(solid.mass), position + inward, moments))
            position += float(solid.height)
        found[name] = bodies
    return found


def segment_bodies(human: Human) -> dict[str, SegmentBody]:
    """Return mass, centre and moments of a rider's six kinds of segment.

    Parameters
    ----------
    human : Human
    """
    return {name: _combined(parts) for name, parts in _solids(human).items()}


def _combined(parts: Sequence[SegmentBody]) -> SegmentBody:
    mass = sum(m for m, _, _ in parts)
    centre = sum(m * c for m, c, _ in parts) / mass if mass else math.nan
    along = sum(moments[0] for _, _, moments in parts)
    sideways = sum(moments[1] + m * (c - centre) ** 2 for m, c, moments in parts)
    across = sum(moments[2] + m * (c - centre) ** 2 for m, c, moments in parts)
    return mass, centre, (along, sideways, across)


def shape_of(body: SegmentBody, length: float) -> SegmentShape:
    """Return a body as fractions of its segment's length in m (arguments: ``body``, ``length``)."""
    mass, centre, moments = body
    if not mass > 0 or min(moments) <= 0:
        raise InputError("a segment has no mass or no inertia: its lengths must increase from joint to joint")
    return SegmentShape(centre / length, *(math.sqrt(moment / mass) / length for moment in moments))
