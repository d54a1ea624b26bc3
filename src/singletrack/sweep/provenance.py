"""What decides the numbers of a sweep, and their places: written down, hashed, and compared in words."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from singletrack.parameters import Rider
from singletrack.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters import Bicycle
    from singletrack.posture import Options

__all__ = ["differences", "fingerprint_of", "options_values", "programs", "record_values"]

_MOST_NAMED = 8
_MISSING = object()


def programs() -> dict[str, str]:
    """Return the versions of the programs that decide the last bits: ours, NumPy and SciPy (quasi-random numbers).

    The compiled kernels are not among them: they give the bits of the plain ones.
    """
    return {"singletrack": __version__, "numpy": np.__version__, "scipy": scipy.__version__}


def record_values(record: Bicycle | Rider) -> dict[str, Any]:
    """Return all values of a record, with its name, as plain values."""
    values: dict[str, Any] = {name: float(value) for name, value in record.values().items()}
    if isinstance(record, Rider) and record.shapes:
        values["shapes"] = {name: dataclasses.asdict(shape) for name, shape in record.shapes.items()}
    return {"name": record.name, **values}


def options_values(options: Options) -> dict[str, Any]:
    """Return all of a rider's options as plain values, whatever they are."""
    return {entry.name: _plain(getattr(options, entry.name)) for entry in dataclasses.fields(options)}


def _plain(value: Any) -> Any:
    if dataclasses.is_dataclass(value):
        return {entry.name: _plain(getattr(value, entry.name)) for entry in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(name): _plain(inner) for name, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def fingerprint_of(described: dict[str, Any]) -> str:
    """Return the SHA-256 of what is described in plain values; orders that matter are lists in them."""
    return hashlib.sha256(json.dumps(described, sort_keys=True).encode()).hexdigest()


def differences(old: dict[str, Any], new: dict[str, Any]) -> str:
    """Return in words what has changed between two descriptions, old and new: where, what was there, what is there now.

    >>> differences({"bicycle": {"trail": 0.06}, "keep": ["M"]}, {"bicycle": {"trail": 0.07}, "keep": ["M"]})
    'bicycle.trail was 0.06, is 0.07'
    """
    found = list(_differences("", json.loads(json.dumps(old)), json.loads(json.dumps(new))))
    more = f"; and {len(found) - _MOST_NAMED} more" if len(found) > _MOST_NAMED else ""
    return "; ".join(found[:_MOST_NAMED]) + more


def _differences(place: str, old: Any, new: Any) -> Iterator[str]:
    if isinstance(old, dict) and isinstance(new, dict):
        for name in dict.fromkeys([*old, *new]):
            inner = f"{place}.{name}" if place else str(name)
            yield from _differences(inner, old.get(name, _MISSING), new.get(name, _MISSING))
    elif old is _MISSING or new is _MISSING:
        yield f"{place} is new: {_short(new)}" if old is _MISSING else f"{place} is gone, was {_short(old)}"
    elif json.dumps(old) != json.dumps(new):  # NaN is NaN
        yield f"{place} was {_short(old)}, is {_short(new)}"


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 60 else f"{text[:40]} ... ({len(value) if hasattr(value, '__len__') else 1} entries)"
