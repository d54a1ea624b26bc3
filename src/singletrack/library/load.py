"""Bicycles and riders by name or path: shipped ones, and files in any format."""

from __future__ import annotations

import dataclasses
import tomllib
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from singletrack.errors import InputError, SingletrackError, shown, unknown_name
from singletrack.files.registry import read_any, read_bicycle, read_rider
from singletrack.files.source import LARGEST_PARAMETERS, is_there, read_text
from singletrack.files.yeadon import read_configuration, read_yeadon
from singletrack.parameters.record import Record
from singletrack.parameters.units import parse_quantity

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

    from singletrack.parameters.bicycle import Bicycle
    from singletrack.parameters.rider import Rider

__all__ = ["descriptions", "load_any", "load_bicycle", "load_rider", "override", "shipped"]

R = TypeVar("R", bound=Record)


def shipped(kind: str) -> dict[str, Traversable]:
    """Return the files that come with the package, by name.

    Parameters
    ----------
    kind : {"bicycle", "rider", "posture"}

    Examples
    --------
    >>> list(shipped("bicycle"))
    ['benchmark', 'browser', 'browser-2012', 'kooijman-2008', 'stratos', 'stratos-2012']
    """
    folder = resources.files("singletrack") / "data" / f"{kind}s"
    files = sorted(
        (file for file in folder.iterdir() if file.name.endswith(".toml")),
        key=lambda file: file.name.removesuffix(".toml"),
    )
    return {file.name.removesuffix(".toml"): file for file in files}


def descriptions(kind: str) -> dict[str, str]:
    """Return what the shipped files of a kind say about themselves, by name, without reading the rest of them.

    Parameters
    ----------
    kind : {"bicycle", "rider", "posture"}

    Examples
    --------
    >>> descriptions("bicycle")["stratos"] == load_bicycle("stratos").description
    True
    """
    return {
        name: tomllib.loads(file.read_text(encoding="utf-8"))["description"] for name, file in shipped(kind).items()
    }


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
    return read_bicycle(*_text(name_or_path, "bicycle"))


def load_rider(name_or_path: str | Path, configuration: str | Path | None = None) -> Rider:
    """Load a rider: a shipped name (``rider-a``), a TOML file, or Yeadon's 95 measurements.

    Errors as in :func:`load_bicycle`. Yeadon's measurements need the optional package ``yeadon``.

    Parameters
    ----------
    name_or_path : str or path
    configuration : path, optional
        Configuration of Yeadon's human, for the forward lean angle of a rider by 95 measurements.

    Examples
    --------
    >>> load_rider("rider-a").rider_mass
    72.0
    """
    if configuration is None:
        return read_rider(*_text(name_or_path, "rider"))
    lean = read_configuration(read_text(Path(configuration), LARGEST_PARAMETERS), str(configuration))
    return read_yeadon(*_text(name_or_path, "rider"), lean)


def load_any(name_or_path: str | Path, configuration: str | Path | None = None) -> Bicycle | Rider:
    """Load a bicycle or a rider, whichever it is (arguments and errors as for :func:`load_rider`).

    >>> load_any("rider-a").kind
    'rider'
    """
    if configuration is not None:
        return load_rider(name_or_path, configuration)
    return read_any(*_text(name_or_path, "bicycle", "rider"))


def _text(name_or_path: str | Path, *kinds: str) -> tuple[str, str]:
    """Return the text of a shipped thing or a file, and what to call it in messages."""
    if not isinstance(name_or_path, str | Path) or name_or_path == "":  # which Path would take for this folder
        raise InputError(f"{' or '.join(kinds)} {shown(name_or_path)}: must be a name or a path")
    known = {name: file for kind in kinds for name, file in shipped(kind).items()}
    if isinstance(name_or_path, str) and name_or_path in known:
        return known[name_or_path].read_text(encoding="utf-8"), f"{name_or_path}.toml"
    path = Path(name_or_path)
    if not is_there(path):
        what = kinds[0] if len(kinds) == 1 else "name"
        raise InputError(f"{unknown_name(what, str(name_or_path)[:200], known)}, and there is no such file")
    return read_text(path, LARGEST_PARAMETERS), str(path)


def override(record: R, texts: dict[str, str], where: str = "--set") -> R:
    """Return a record with values replaced by texts such as ``"18.5 deg"``, as given on the command line.

    Parameters
    ----------
    record : Bicycle or Rider
    texts : dict of str to str
        By parameter.
    where : str
        For messages.

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
        written = {**record.written, **texts}
        return dataclasses.replace(record, **changes, standard_deviations=deviations, written=written)
    except SingletrackError as error:
        raise error.at(where) from None
