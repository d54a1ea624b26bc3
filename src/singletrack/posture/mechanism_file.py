"""Mechanism files (TOML): a rider's joints, loops and segments as text."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from singletrack.body import POINT_NAMES
from singletrack.errors import InputError, unknown_name
from singletrack.files.toml_keys import place_of
from singletrack.files.toml_text import parse_toml
from singletrack.parameters.units import parse_quantity
from singletrack.posture.mechanism import FRAME, HANDLEBAR, STIFFEST, Direction, JointPlan, LoopPlan, Mechanism, Place

__all__ = ["parse_mechanism"]

_AXES = {
    "x": (1.0, 0.0, 0.0),
    "y": (0.0, 1.0, 0.0),
    "z": (0.0, 0.0, 1.0),
    "-x": (-1.0, 0.0, 0.0),
    "-y": (0.0, -1.0, 0.0),
    "-z": (0.0, 0.0, -1.0),
}
_NAMED_AXES = ("steer", "right elbow", "left elbow")
_UNITS = {
    "hinge": {"stiffness": "N*m/rad", "damping": "N*m*s/rad", "preload": "N*m"},
    "slider": {"stiffness": "N/m", "damping": "N*s/m", "preload": "N"},
}
#: Of points in m, of axes, of shares of a line: what is beyond is a mistake.
_NEAREST, _FARTHEST = 1e-9, 100.0
_JOINT = ("name", "parent", "kind", "point", "axis", "free", "stiffness", "damping", "preload")
_LOOP = ("name", "joint", "to", "point", "at", "perpendicular", "stiffness", "damping")
_TOP = ("kind", "name", "description", "source", "arms", "joints", "loops", "segments")


def parse_mechanism(text: str, where: str) -> Mechanism:
    """Return the mechanism that a TOML text describes.

    Parameters
    ----------
    text : str
        The file's text; `singletrack template posture` prints one with all that can be said.
    where : str
        Name of the file, for messages.

    Raises
    ------
    InputError
        Names the file, the joint, loop or segment, what was found and what is allowed.

    Examples
    --------
    >>> parse_mechanism('kind = "posture"', "free.toml")
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: free.toml: posture free: segment head, torso, ... hangs on no joint; ...
    """
    document: dict[str, Any] = parse_toml(text, where)
    if document.get("kind") != "posture":
        raise InputError(f'{where}: is no mechanism: kind = {document.get("kind")!r}, must be kind = "posture"')
    reader = _Reader(where, text)
    reader.refuse_unknown("entry", document, _TOP)
    joints, loops = (reader.tables(document, key) for key in ("joints", "loops"))
    segments = document.get("segments", {})
    if not isinstance(segments, dict) or not all(isinstance(joint, str) for joint in segments.values()):
        raise InputError(f'{where}: segments: must be a table [segments] of lines such as torso = "frame"')
    try:
        return Mechanism(
            name=reader.text_of(document, "name", Path(where).stem),
            joints=tuple(reader.joint(entry) for entry in joints),
            loops=tuple(reader.loop(entry) for entry in loops),
            segments=segments,
            arms=reader.text_of(document, "arms", "bent"),
            description=reader.text_of(document, "description", ""),
            source=reader.text_of(document, "source", ""),
        )
    except InputError as error:
        message = str(error)
        raise InputError(message if message.startswith(where) else f"{where}: {message}") from None


@dataclass(frozen=True)
class _Reader:
    """Entries of a file, checked; messages name the file and the joint or loop."""

    where: str
    text: str

    def refuse_unknown(self, what: str, found: dict[str, Any], known: tuple[str, ...], of: str = "") -> None:
        for name in found:
            if name not in known:
                place = place_of(self.where, self.text, name)
                raise InputError(f"{place}: {of}{unknown_name(what, name, known)}")

    def tables(self, document: dict[str, Any], key: str) -> list[dict[str, Any]]:
        found = document.get(key, [])
        if not isinstance(found, list) or not all(isinstance(entry, dict) for entry in found):
            raise InputError(f"{self.where}: {key}: must be tables [[{key}]]")
        for entry in found:
            if not isinstance(entry.get("name"), str) or not entry["name"]:
                raise InputError(f"{self.where}: [[{key}]]: found one without name = ..., each must have its own")
        return found

    def text_of(self, entry: dict[str, Any], name: str, default: str | None = None, of: str = "") -> str:
        found = entry.get(name, default)
        if not isinstance(found, str):
            problem = "is missing" if found is None else f"= {found!r}"
            raise InputError(f"{self.where}: {of}{name} {problem}, must be text")
        return found

    def quantity(self, entry: dict[str, Any], name: str, unit: str, of: str, *, least: float | None = 0.0) -> float:
        try:
            value = parse_quantity(entry.get(name, 0.0), unit).value
        except InputError as error:
            raise InputError(f"{self.where}: {of}{name}: {error}") from None
        if not math.isfinite(value) or (least is not None and value < least):
            raise InputError(f"{self.where}: {of}{name} = {value:g} {unit}, must be a finite number of zero or more")
        if abs(value) > STIFFEST:
            raise InputError(f"{self.where}: {of}{name} = {value:g} {unit}, must be at most {STIFFEST:g} {unit}")
        return value

    def joint(self, entry: dict[str, Any]) -> JointPlan:
        of = f"joint {entry['name']}: "
        self.refuse_unknown("entry", entry, _JOINT, of)
        kind = self.text_of(entry, "kind", "hinge", of)
        if kind not in _UNITS:
            raise InputError(f"{self.where}: {of}{unknown_name('kind', kind, _UNITS)}")
        free = entry.get("free", False)
        if not isinstance(free, bool):
            raise InputError(f"{self.where}: {of}free = {free!r}, must be true or false")
        if free and "preload" in entry:
            raise InputError(
                f"{self.where}: {of}preload: a free joint has the preload that balances it at rest; remove it"
            )
        units = _UNITS[kind]
        return JointPlan(
            entry["name"],
            self.text_of(entry, "parent", FRAME, of),
            self.place(entry.get("point", [0.0, 0.0, 0.0] if kind == "slider" else None), f"{of}point"),
            self.direction(entry.get("axis"), f"{of}axis"),
            kind == "slider",
            free,
            self.quantity(entry, "stiffness", units["stiffness"], of),
            self.quantity(entry, "damping", units["damping"], of),
            self.quantity(entry, "preload", units["preload"], of, least=None),
        )

    def loop(self, entry: dict[str, Any]) -> LoopPlan:
        of = f"loop {entry['name']}: "
        self.refuse_unknown("entry", entry, _LOOP, of)
        if ("point" in entry) == ("perpendicular" in entry):
            raise InputError(f"{self.where}: {of}must have either point = ... or perpendicular = [..., ...]")
        pair = entry.get("perpendicular")
        if pair is not None and (not isinstance(pair, list) or len(pair) != 2):
            raise InputError(f"{self.where}: {of}perpendicular = {pair!r}, must be two directions")
        soft = "stiffness" in entry or "damping" in entry
        if soft and pair is not None:
            raise InputError(f"{self.where}: {of}only a point can be held softly, not two directions")
        return LoopPlan(
            entry["name"],
            self.text_of(entry, "joint", None, of),
            self.text_of(entry, "to", HANDLEBAR, of),
            None if pair is not None else self.place(entry["point"], f"{of}point"),
            None if pair is None else (self.direction(pair[0], of), self.direction(pair[1], of)),
            self.quantity(entry, "stiffness", "N/m", of) if soft else None,
            self.quantity(entry, "damping", "N*s/m", of),
            self.place(entry["at"], f"{of}at") if "at" in entry else None,
        )

    def number_of_point(self, found: object, what: str) -> int:
        if isinstance(found, str) and found in POINT_NAMES:
            return POINT_NAMES.index(found) + 1
        if isinstance(found, int) and not isinstance(found, bool) and 1 <= found <= len(POINT_NAMES):
            return found
        if isinstance(found, str):
            raise InputError(f"{self.where}: {what}: {unknown_name('skeleton point', found, POINT_NAMES)}")
        raise InputError(f"{self.where}: {what} = {found!r}, must be a skeleton point (1 to 31, or its name)")

    def place(self, found: object, what: str) -> Place:
        if isinstance(found, list):
            return Place(at=self.triple(found, what, "m"))
        if isinstance(found, dict):
            self.refuse_unknown("entry", found, ("from", "to", "share"), f"{what}: ")
            start, end = (self.number_of_point(found.get(key), f"{what}: {key}") for key in ("from", "to"))
            share = found.get("share", 0.5)
            if isinstance(share, bool) or not isinstance(share, int | float) or not abs(share) <= _FARTHEST:
                wanted = f"a number of at most {_FARTHEST:g}, such as 0.5 for the middle"
                raise InputError(f"{self.where}: {what}: share = {share!r}, must be {wanted}")
            return Place(start, end, float(share))
        if found is None:
            raise InputError(
                f"{self.where}: {what} is missing: must be a skeleton point (1 to 31, or its name), [x, y, z] or "
                "{ from = .., to = .., share = .. }"
            )
        return Place(self.number_of_point(found, what))

    def triple(self, found: list[Any], what: str, unit: str) -> tuple[float, float, float]:
        if len(found) != 3:
            raise InputError(f"{self.where}: {what} = {found!r}, must have three components")
        try:
            x, y, z = (parse_quantity(value, unit).value for value in found)
        except InputError as error:
            raise InputError(f"{self.where}: {what}: {error}") from None
        size = max(abs(x), abs(y), abs(z))
        if size > _FARTHEST or 0 < size < _NEAREST:
            wanted = f"0 or of a size from {_NEAREST:g} to {_FARTHEST:g} {unit}".rstrip()
            raise InputError(f"{self.where}: {what} = {found!r}, its largest component must be {wanted}")
        return x, y, z

    def direction(self, found: object, what: str) -> Direction:
        if isinstance(found, str) and found in _AXES:
            return Direction(vector=_AXES[found])
        if isinstance(found, str) and found in _NAMED_AXES:
            return Direction(name=found)
        if isinstance(found, str):
            raise InputError(f"{self.where}: {what}: {unknown_name('axis', found, (*_AXES, *_NAMED_AXES))}")
        if isinstance(found, list):
            vector = self.triple(found, what, "")
            if not any(vector):
                raise InputError(f"{self.where}: {what} = {found!r}, must not be zero")
            return Direction(vector=vector)
        if not isinstance(found, dict):
            raise InputError(
                f"{self.where}: {what} = {found!r}, must be one of {', '.join((*_AXES, *_NAMED_AXES))}, [x, y, z] or "
                "{ from = point, to = point } (with across = axis for the normal to both)"
            )
        self.refuse_unknown("entry", found, ("from", "to", "across"), f"{what}: ")
        start, end = (self.place(found.get(key), f"{what}: {key}") for key in ("from", "to"))
        if start == end:
            raise InputError(f"{self.where}: {what}: from and to are the same point, must be two")
        across = None
        if "across" in found:
            across = self.direction(found["across"], f"{what}: across").vector
            if across is None:
                raise InputError(f"{self.where}: {what}: across must be x, y, z or [x, y, z]")
        return Direction(start=start, end=end, across=across)
