"""YAML parameter sets of the BicycleParameters package: the sets of Meijaard et al. (2007) and of Moore (2019)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError, unknown_name
from singletrack.files.format import Format
from singletrack.files.meijaard import bicycle_from_values, values_by_symbol
from singletrack.files.principal import bicycle_from_principal, principal_values
from singletrack.files.yaml_text import Item, numbers, read_mapping
from singletrack.parameters.bicycle import FRAME_GEOMETRY, Bicycle
from singletrack.parameters.split_fork import SPLIT_SYMBOLS
from singletrack.parameters.symbols import MODEL_SYMBOLS

if TYPE_CHECKING:
    from singletrack.files.format import Clues
    from singletrack.files.named_values import NamedValues
    from singletrack.parameters.rider import Rider

__all__ = ["BENCHMARK", "PARAMETERIZATIONS", "PRINCIPAL", "read_parameter_set", "write_parameter_set"]

PARAMETERIZATIONS = ("benchmark", "principal")
_ALSO_CALLED = {"Meijaard2007": "benchmark", "Moore2019": "principal"}
_HEADER = ("parameterization", "parameters", "rider", "description", "values")


def read_parameter_set(text: str, where: str) -> Bicycle:
    """Return the bicycle of a YAML parameter set; the rider of a principal set is lumped into the rear frame.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        Names file, line, symbol, what was found and what is allowed.
    """
    parameterization, given, with_rider = _contents(read_mapping(text, where), where)
    source = f"parameter set {Path(where).name}"
    make = bicycle_from_principal if parameterization == "principal" else bicycle_from_values
    bicycle = make(given, source)
    return bicycle.replace(extras={**bicycle.extras, "rider": 1.0}) if with_rider else bicycle


def _contents(items: dict[str, Item], where: str) -> tuple[str, NamedValues, bool]:
    """Return parameterization, values, and whether they include a rider."""
    stem = Path(where).stem
    guessed = next((p for p in PARAMETERIZATIONS if stem.startswith(p)), "benchmark")
    name = stem.removeprefix(f"{guessed}-")
    if "values" not in items:
        return ("principal" if "kDaa" in items else "benchmark"), numbers(items, where, name), False
    for key, item in items.items():
        if key not in _HEADER:
            raise InputError(f"{where}, line {item.line}: {unknown_name('entry', key[:60], _HEADER)}")
        if (key == "values") == isinstance(item.value, str):
            wanted = "a mapping of symbols to numbers" if key == "values" else "text"
            raise InputError(f"{where}, line {item.line}: {key} must be {wanted}")
    header = {key: str(item.value) for key, item in items.items() if key != "values"}
    parameterization = header.get("parameterization", "benchmark")
    parameterization = _ALSO_CALLED.get(parameterization, parameterization)
    if parameterization not in PARAMETERIZATIONS:
        message = unknown_name("parameterization", parameterization[:60], PARAMETERIZATIONS)
        raise InputError(f"{where}, line {items['parameterization'].line}: {message}")
    values = items["values"].value
    if isinstance(values, str):  # refused above
        raise InputError(f"{where}: values must be a mapping")
    name = header.get("parameters") or name
    description = " ".join(header.get("description", "").split())
    return parameterization, numbers(values, where, name, description), header.get("rider", "").lower() == "true"


def write_parameter_set(bicycle: Bicycle, parameterization: str = "benchmark", speed: float = 0.0) -> str:
    """Return a bicycle as a YAML parameter set; standard deviations stand in comments, since the format has none.

    Parameters
    ----------
    bicycle : Bicycle
    parameterization : {"benchmark", "principal"}
    speed : float
        Forward speed in m/s, which the format asks for; used where the bicycle came without one.

    Raises
    ------
    InputError
        For an unknown parameterization.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> print(write_parameter_set(load_bicycle("benchmark")))
    parameterization: benchmark
    parameters: "benchmark"
    ...
      zH: -0.7
    <BLANKLINE>
    """
    if parameterization not in PARAMETERIZATIONS:
        raise InputError(unknown_name("parameterization", parameterization, PARAMETERIZATIONS))
    deviations: dict[str, float] = {}
    if parameterization == "principal":
        values = principal_values(bicycle)
    else:
        numbers_given = {s: number for s, number in values_by_symbol(bicycle).items() if s in MODEL_SYMBOLS}
        values = {symbol: value for symbol, (value, _) in numbers_given.items()}
        deviations = {symbol: sd for symbol, (_, sd) in numbers_given.items() if sd is not None}
    values = {**values, "v": bicycle.extras.get("v", speed)}
    lines = [
        f"parameterization: {parameterization}",
        f"parameters: {json.dumps(bicycle.name)}",
        f"rider: {bool(bicycle.extras.get('rider'))}",
        f"description: {json.dumps(bicycle.description)}",
        "values:",
    ]
    for symbol in sorted(values):
        comment = f"  # +/- {float(deviations[symbol])!r}" if symbol in deviations else ""
        lines.append(f"  {symbol}: {_yaml_float(values[symbol])}{comment}")
    return "\n".join(lines) + "\n"


def _yaml_float(value: float) -> str:
    """Return the shortest text that YAML 1.1 reads as this double (it takes 1e-05 for a word: a point is needed)."""
    text = repr(float(value))
    mantissa, exponent, power = text.partition("e")
    return text if not exponent or "." in mantissa else f"{mantissa}.0e{power}"


def _losses(record: Bicycle | Rider) -> tuple[str, ...]:
    """Return what a parameter set does not hold of a record."""
    found = []
    if record.standard_deviations:
        found.append("a parameter set holds no standard deviations; they stand in its comments")
    geometry = [name for name in record.values() if name in FRAME_GEOMETRY]
    if geometry:
        found.append(f"a parameter set holds no {', '.join(geometry)}")
    if any(symbol in record.extras for symbol in SPLIT_SYMBOLS):
        found.append("a parameter set holds no handlebar and fork apart, only the front frame they make")
    return tuple(found)


def _is_principal(clues: Clues) -> bool:
    named = clues.values.get("parameterization", "").strip("\"' ")
    return _ALSO_CALLED.get(named, named) == "principal" or (not named and "kDaa" in clues.values)


PRINCIPAL = Format(
    name="principal",
    description="a principal YAML parameter set of BicycleParameters",
    recognises=_is_principal,
    suffixes=(".yml", ".yaml"),
    variant="principal",
    read_bicycle=read_parameter_set,
    write_bicycle=lambda bicycle: write_parameter_set(bicycle, "principal"),
    losses=_losses,
)
BENCHMARK = Format(
    name="benchmark",
    description="a YAML parameter set of BicycleParameters",
    recognises=lambda clues: clues.suffix in {".yml", ".yaml"} or clues.colons > clues.equals,
    suffixes=(".yml", ".yaml"),
    variant="benchmark",
    read_bicycle=read_parameter_set,
    write_bicycle=write_parameter_set,
    losses=_losses,
)
