"""Study files: which bicycle and rider, what varies and how, at which speeds, and what to keep.

The file is checked in full before anything is computed; all that is wrong is said at once, a line for each entry.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from singletrack.errors import InputError, unknown_name
from singletrack.files.source import read_text
from singletrack.files.speeds import parse_speeds
from singletrack.files.toml_keys import place_of
from singletrack.files.toml_text import parse_toml
from singletrack.library import load_bicycle, load_rider
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import Options
from singletrack.sweep.designs import Designs, make_designs
from singletrack.sweep.provenance import fingerprint_of, options_values, programs, record_values
from singletrack.sweep.sitting import beside, parse_options
from singletrack.sweep.vary import parse_variation

__all__ = ["KEEP", "Study", "load_study"]

KEEP = ("matrices", "eigenvalues", "critical_speeds", "stable_ranges")

_SITTING = ("posture", "shoulder", "arms", "torso_lean", "springs", "dampers")

Method = Literal["grid", "list", "random", "latin-hypercube", "sobol"]


_Number = Annotated[float, Field(strict=True)]  # true is no number


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _Sampling(_Strict):
    method: Method = "grid"
    samples: Annotated[int, Field(strict=True, ge=1, le=100_000_000)] | None = None
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**32)] = 0


class _StudyFile(_Strict):
    kind: Literal["study"] = "study"
    name: str = ""
    description: str = ""
    bicycle: str
    rider: str | None = None
    posture: str | None = None
    shoulder: str | None = None
    arms: str | None = None
    torso_lean: Annotated[bool, Field(strict=True)] | None = None
    springs: dict[str, str | _Number] | None = None
    dampers: dict[str, str | _Number] | None = None
    speeds: str | _Number | list[_Number]
    keep: Annotated[list[Literal["matrices", "eigenvalues", "critical_speeds", "stable_ranges"]], Field(min_length=1)]
    sampling: _Sampling = _Sampling()
    vary: Annotated[dict[str, Any], Field(min_length=1)]


@dataclass(frozen=True, eq=False)
class Study:
    """A study, ready to run.

    Attributes
    ----------
    name, description : str
    bicycle : Bicycle
    rider : Rider or None
    options : Options
        How the rider sits.
    designs : Designs
        The parameters that vary.
    speeds : array, shape (n,)
        In m/s.
    keep : tuple of str
        Of :data:`KEEP`.
    """

    name: str
    description: str
    bicycle: Bicycle
    rider: Rider | None
    options: Options
    designs: Designs
    speeds: np.ndarray
    keep: tuple[str, ...]

    @property
    def posture(self) -> str:
        """The rider's posture."""
        return self.options.name

    def to_dict(self) -> dict[str, Any]:
        """Return all that decides the results and their places, for provenance: plain values, SI units."""
        return {
            "programs": programs(),
            "bicycle": record_values(self.bicycle),
            "rider": None if self.rider is None else record_values(self.rider),
            "options": options_values(self.options),
            "designs": self.designs.to_dict(),
            "speeds": self.speeds.tolist(),
            "keep": list(self.keep),
        }

    @property
    def fingerprint(self) -> str:
        """Hash of :meth:`to_dict`: equal for studies with equal results, each in its place."""
        return fingerprint_of(self.to_dict())


def load_study(path: str | Path) -> Study:
    """Load a study file.

    Parameters
    ----------
    path : str or path
        A TOML file. Bicycle and rider are shipped names or files, relative to the study file.

    Raises
    ------
    InputError
        One line for each thing that is wrong: file, line, entry, what was found and what is allowed.
    """
    path = Path(path)
    try:
        there = path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL
        there = False
    if not there:
        raise InputError(f"{path}: there is no such study file")
    text = read_text(path)
    document = parse_toml(text, str(path))
    try:
        checked = _StudyFile.model_validate(document)
    except ValidationError as error:
        lines = [f"{_place(path, text, problem['loc'])}: {_words(problem)}" for problem in error.errors()]
        raise InputError("\n".join(dict.fromkeys(lines))) from None
    return _resolved(checked, path, text)


def _resolved(file: _StudyFile, path: Path, text: str) -> Study:
    bicycle = load_bicycle(beside("bicycle", file.bicycle, path.parent))
    rider = None if file.rider is None else load_rider(beside("rider", file.rider, path.parent))
    sitting = {name: found for name in _SITTING if (found := getattr(file, name)) is not None}
    options = parse_options(sitting, path.parent, lambda name: _place(path, text, (name,)))
    if rider is None:
        if options.posture != Options().posture:
            raise InputError(f"{_place(path, text, ('posture',))}: posture = {file.posture!r} needs a rider = ...")
        try:
            options.require_rider()
        except InputError as error:
            raise error.at(str(path)) from None
    variations = [
        parse_variation(name, found, _place(path, text, ("vary", name)), with_rider=rider is not None)
        for name, found in file.vary.items()
    ]
    if rider is not None and "forward_lean_angle" not in file.vary:
        rider = rider.on(bicycle)
    sampling = file.sampling
    designs = make_designs(variations, sampling.method, sampling.samples, sampling.seed, str(path))
    return Study(
        name=file.name or path.stem,
        description=file.description,
        bicycle=bicycle,
        rider=rider,
        options=options,
        designs=designs,
        speeds=_speeds(file.speeds, _place(path, text, ("speeds",))),
        keep=tuple(name for name in KEEP if name in file.keep),
    )


def _speeds(found: str | float | list[float], place: str) -> np.ndarray:
    if isinstance(found, str):
        try:
            return parse_speeds(found, "speeds =")
        except InputError as error:
            raise error.at(place) from None
    speeds = np.atleast_1d(np.asarray(found, dtype=float))
    if not len(speeds) or not np.isfinite(speeds).all() or (speeds < 0).any():
        raise InputError(f"{place}: speeds = {found}, must be finite numbers of zero or more, in m/s")
    return speeds


def _place(path: Path, text: str, location: tuple[int | str, ...]) -> str:
    name = next((str(part) for part in reversed(location) if isinstance(part, str) and f"{part}" in text), "")
    return place_of(str(path), text, name) if name else str(path)


def _words(problem: Any) -> str:
    """Return one of pydantic's findings in our words: entry, found, allowed."""
    names = [str(part) for part in problem["loc"] if part in _entries()]
    entry = ".".join(names) or str(problem["loc"][-1])
    if problem["type"] == "extra_forbidden":
        return unknown_name("entry", str(problem["loc"][-1]), _entries())
    if problem["type"] == "missing":
        return f"lacks {entry}"
    allowed = problem["msg"].removeprefix("Input should be ").replace("Input should have", "having")
    return f"{entry} = {str(problem['input'])[:80]!r}, must be {allowed}"


def _entries() -> list[str]:
    return [*_StudyFile.model_fields, *_Sampling.model_fields]
