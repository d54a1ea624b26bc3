"""Gains of a rider or a controller, in a small TOML file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError, shown, unknown_name
from singletrack.files.toml_keys import place_of
from singletrack.files.toml_text import parse_toml
from singletrack.parameters.feedback import Feedback
from singletrack.parameters.units import parse_quantity

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["gain_unit", "read_gains"]

_UNITS = {"limit": "N*m", "delay": "s", "period": "s"}
_ENTRIES = ("kind", "name", *_UNITS, "gains")


def read_gains(text: str, where: str) -> Feedback:
    r"""Return the feedback that a TOML text describes.

    Parameters
    ----------
    text : str
        ``[gains."steer torque"]`` with ``"lean rate" = "8 N*m*s/rad"`` or coefficients of 1, v, v² in SI; above it,
        where wanted, ``limit``, ``delay`` and ``period``.
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        Names file, line, entry, what was found and what is allowed.

    Examples
    --------
    >>> found = read_gains('limit = 20\n[gains."steer torque"]\n"lean rate" = [50, -10]', "gains.toml")
    >>> found.limit, found.gains
    (20.0, {('steer torque', 'lean rate'): [50.0, -10.0]})
    """
    document = parse_toml(text, where)
    for name in document:
        if name not in _ENTRIES:
            raise InputError(f"{place_of(where, text, name)}: {unknown_name('entry', name, _ENTRIES)}")
    if document.get("kind", "gains") != "gains":
        raise InputError(f"{place_of(where, text, 'kind')}: is a {shown(document['kind'])} file, must be one of gains")
    if not isinstance(document.get("name", ""), str):
        raise InputError(f"{place_of(where, text, 'name')}: name = {shown(document['name'])}, must be text")
    settings: dict[str, Any] = {}
    for name, unit in _UNITS.items():
        if name in document:
            settings[name] = _number(document[name], unit, place_of(where, text, name), name)
    gains = _gains(document.get("gains"), text, where)
    try:
        return Feedback(gains, **settings)
    except InputError as error:
        raise error.at(where) from None


def gain_unit(signal: str) -> str:
    """Return the unit of a gain of a signal.

    Examples
    --------
    >>> gain_unit("lean rate")
    'N*m*s/rad'
    """
    return "N*m*s/rad" if signal.endswith(" rate") else "N*m/rad"


def _gains(found: object, text: str, where: str) -> dict[tuple[str, str], float | Sequence[float]]:
    if not isinstance(found, dict) or not found:
        raise InputError(f'{where}: has no gains; must have a table such as [gains."steer torque"] with lean = 10')
    gains: dict[tuple[str, str], float | Sequence[float]] = {}
    for target, row in found.items():
        if not isinstance(row, dict):
            raise InputError(f"{place_of(where, text, target)}: {target} = {shown(row)}, must be a table of signals")
        _add(gains, target, row, text, where)
    return gains


def _add(
    gains: dict[tuple[str, str], float | Sequence[float]], target: str, row: Mapping[str, object], text: str, where: str
) -> None:
    for signal, gain in row.items():
        place = place_of(where, text, signal)
        if isinstance(gain, list):
            gains[target, signal] = [_number(part, "", place, signal) for part in gain]
        else:
            gains[target, signal] = _number(gain, gain_unit(signal), place, signal)


def _number(found: object, unit: str, place: str, name: str) -> float:
    try:
        return parse_quantity(found, unit).value
    except InputError as error:
        raise error.of(name).at(place) from None
