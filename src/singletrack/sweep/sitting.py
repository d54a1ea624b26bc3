"""How the rider of a study sits: the entries posture, shoulder, arms, torso_lean, springs and dampers of its file."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError
from singletrack.library import shipped
from singletrack.parameters.units import parse_quantity
from singletrack.posture import ARMS, POSTURES, SHOULDERS, Options, mechanism_of, named_posture

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

__all__ = ["beside", "parse_options"]


def parse_options(found: Mapping[str, Any], folder: Path, place: Callable[[str], str]) -> Options:
    """Return the options of a model from the entries of a study file.

    Parameters
    ----------
    found : mapping of str to values
        ``posture``, ``shoulder``, ``arms``, ``torso_lean``, ``springs``, ``dampers``: those that are given.
    folder : Path
        Of the study file, for posture files beside it.
    place : callable
        Returns file and line of an entry, for messages.

    Raises
    ------
    InputError
        With the entry, what was found and what is allowed.
    """
    posture = found.get("posture", POSTURES[0])
    path = beside("posture", posture, folder)
    if path == posture and posture not in POSTURES and posture not in shipped("posture"):
        allowed = ", ".join(map(repr, POSTURES))
        raise InputError(f"{place('posture')}: posture = {posture[:80]!r}, must be {allowed} or a mechanism file")
    for name, known in (("shoulder", SHOULDERS), ("arms", ARMS)):
        if name in found and found[name] not in known:
            allowed = ", ".join(map(repr, known))
            raise InputError(f"{place(name)}: {name} = {found[name][:80]!r}, must be {allowed}")
    try:
        plain = Options(named_posture(path), found.get("shoulder"), found.get("arms"), bool(found.get("torso_lean")))
        springs, dampers = (_laws(name, found.get(name, {}), plain) for name in ("springs", "dampers"))
        options = replace(plain, springs=springs, dampers=dampers)
        if found:
            mechanism_of(options)  # whether it has the joints that are sprung
    except InputError as error:
        raise error.at(place("posture")) from None
    return options


def _laws(entry: str, found: Mapping[str, Any], plain: Options) -> dict[str, float]:
    """Return stiffness or damping in SI by joint; the unit is that of a hinge, or of a point where hands are held."""
    if not found:
        return {}
    turning, sliding = ("N*m/rad", "N/m") if entry == "springs" else ("N*m*s/rad", "N*s/m")
    hands = {"hands", *(loop.name for loop in mechanism_of(plain).loops)}
    values = {}
    for joint, value in found.items():
        try:
            values[joint] = parse_quantity(value, sliding if joint in hands else turning).value
        except InputError as error:
            raise InputError(f"{entry}.{joint} = {error}") from None
    return values


def beside(kind: str, found: str, folder: Path) -> str | Path:
    """Return the file beside a study that a name stands for, or the name, if it is a shipped one or there is none.

    Parameters
    ----------
    kind : {"bicycle", "rider", "posture"}
    found : str
        What the study says.
    folder : Path
        Of the study file.
    """
    path = folder / found
    try:
        there = path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL
        return found
    return path if there and found not in shipped(kind) else found
