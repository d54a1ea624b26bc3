"""Bicycles and riders by name or path: shipped ones, and files in any format."""

from __future__ import annotations

import dataclasses
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from singletrack.errors import InputError, SingletrackError, unknown_name
from singletrack.files.reading import is_rider, read_record
from singletrack.files.source import read_text
from singletrack.files.toml_read import parse_record
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.record import Record
from singletrack.parameters.rider import Rider
from singletrack.parameters.units import parse_quantity

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

__all__ = ["load_any", "load_bicycle", "load_rider", "override", "shipped"]

R = TypeVar("R", bound=Record)


def shipped(kind: str) -> dict[str, Traversable]:
    """Return the files that come with the package, by name.

    Parameters
    ----------
    kind : {"bicycle", "rider"}

    Examples
    --------
    >>> list(shipped("bicycle"))
    ['benchmark', 'browser', 'kooijman-2008', 'stratos']
    """
    folder = resources.files("singletrack") / "data" / f"{kind}s"
    files = sorted((file for file in folder.iterdir() if file.name.endswith(".toml")), key=lambda file: file.name)
    return {file.name.removesuffix(".toml"): file for file in files}


def load_bicycle(name_or_path: str | Path) -> Bicycle:
    """Load a bicycle.

    Parameters
    ----------
    name_or_path : str or path
        A shipped name (``benchmark``, ``stratos``, ``browser``, ``kooijman-2008``) or a file: TOML, a parameter text
        file or raw measurements of BicycleParameters, one of its YAML parameter sets.

    Raises
    ------
    InputError
        If there is no such thing, or the file is not a bicycle; names file, line, parameter, found and allowed.

    Examples
    --------
    >>> load_bicycle("stratos").wheel_base
    1.037
    """
    return _load(Bicycle, name_or_path)


def load_rider(name_or_path: str | Path) -> Rider:
    """Load a rider: a shipped name (``rider-a``), a TOML file, or Yeadon's 95 measurements.

    Errors as in :func:`load_bicycle`. Yeadon's measurements need the optional package ``yeadon``.

    Examples
    --------
    >>> load_rider("rider-a").rider_mass
    72.0
    """
    return _load(Rider, name_or_path)


def load_any(name_or_path: str | Path) -> Bicycle | Rider:
    """Load a bicycle or a rider, whichever it is; errors as in :func:`load_bicycle`.

    >>> load_any("rider-a").kind
    'rider'
    """
    if str(name_or_path) in shipped("rider"):
        return load_rider(name_or_path)
    if str(name_or_path) in shipped("bicycle"):
        return load_bicycle(name_or_path)
    path = Path(name_or_path)
    if not _is_there(path):
        known = [*shipped("bicycle"), *shipped("rider")]
        raise InputError(f"{unknown_name('name', str(name_or_path)[:200], known)}, and there is no such file")
    return load_rider(path) if is_rider(read_text(path), str(path)) else load_bicycle(path)


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL
        return False


def _load(cls: type[R], name_or_path: str | Path) -> R:
    known = shipped(cls.kind)
    if isinstance(name_or_path, str) and name_or_path in known:
        return parse_record(cls, known[name_or_path].read_text(encoding="utf-8"), name_or_path)
    path = Path(name_or_path)
    if not _is_there(path):
        raise InputError(f"{unknown_name(cls.kind, str(name_or_path)[:200], known)}, and there is no such file")
    return read_record(cls, read_text(path), str(path))


def override(record: R, texts: dict[str, str], where: str = "--set") -> R:
    """Return a record with values replaced by texts such as ``"18.5 deg"``, as given on the command line.

    Raises
    ------
    InputError
        If a name is unknown, or a value is not allowed.

    Examples
    --------
    >>> override(load_bicycle("stratos"), {"trail": "60 mm"}).trail
    0.06
    """
    descriptions = record.descriptions()
    record.require_known(dict.fromkeys(name for name in texts if name not in descriptions))
    changes: dict[str, Any] = {}
    deviations = dict(record.standard_deviations)
    for name, text in texts.items():
        try:
            quantity = parse_quantity(text, descriptions[name].unit)
        except InputError as error:
            raise error.at(f"{where} {name}") from None
        changes[name] = quantity.value
        deviations.pop(name, None)
        if quantity.deviation is not None:
            deviations[name] = quantity.deviation
    try:
        return dataclasses.replace(record, **changes, standard_deviations=deviations)
    except SingletrackError as error:
        raise error.at(where) from None
