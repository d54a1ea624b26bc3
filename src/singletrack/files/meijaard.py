"""Bicycles in the symbols of Meijaard et al. (2007), as several file formats give them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.split_fork import (
    SPLIT_SYMBOLS,
    WHOLE_SYMBOLS,
    combined,
    combined_deviations,
    still_split,
)
from singletrack.parameters.symbols import MODEL_SYMBOLS, NAMES, SYMBOLS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from singletrack.files.named_values import NamedValues

__all__ = ["bicycle_from_values", "values_by_symbol"]

#: Values that follow from the 25 parameters; some files state them all the same.
_DEPENDENT: dict[str, Callable[[Mapping[str, float]], float]] = {
    **dict.fromkeys(("xR", "yB", "yR", "yH", "yF", "yG", "yS", "IRxz", "IFxz"), lambda _: 0.0),
    "xF": lambda b: b["w"],
    "zR": lambda b: -b["rR"],
    "zF": lambda b: -b["rF"],
    "IRzz": lambda b: b["IRxx"],
    "IFzz": lambda b: b["IFxx"],
}
#: Values that are no bicycle's, but stand in parameter sets.
_CONDITIONS = ("v",)


def bicycle_from_values(given: NamedValues, source: str) -> Bicycle:
    """Return the bicycle that a file of Meijaard's symbols describes.

    A handlebar (G) and a fork (S) measured apart make the front frame (H), or must be it where it is given too; they
    are kept in ``extras``, so that they can be written back.

    Parameters
    ----------
    given : NamedValues
    source : str
        Where the numbers come from.

    Raises
    ------
    InputError
        For symbols that are unknown or missing, and values that are not allowed; names file, line and symbol.
    """
    given.require_known([*SYMBOLS.values(), *_CONDITIONS, *_DEPENDENT, *SPLIT_SYMBOLS], "symbol")
    values, deviations = given.values(), given.deviations()
    if any(symbol in values for symbol in SPLIT_SYMBOLS):
        given.require(SPLIT_SYMBOLS, "the split fork")
        # Rounded on their way through other files; a front frame left out is made of them.
        given.require_equal(combined(values), relative=1e-3, absolute=1e-5)
        if not any(symbol in values for symbol in WHOLE_SYMBOLS):
            values |= combined(values)
            deviations |= combined_deviations(given.quantities)
    given.require([symbol for symbol in MODEL_SYMBOLS if symbol not in values], "the parameter set")
    given.require_equal({name: follow(values) for name, follow in _DEPENDENT.items() if name in values})
    kept = (*_CONDITIONS, *SPLIT_SYMBOLS)
    parameters: dict[str, Any] = {NAMES[s]: value for s, value in values.items() if s in NAMES}
    uncertain = {NAMES.get(s, s): sd for s, sd in deviations.items() if s in NAMES or s in SPLIT_SYMBOLS}
    return given.build(
        lambda: Bicycle(
            name=given.name,
            description=given.description,
            source=source,
            standard_deviations=uncertain,
            extras={symbol: values[symbol] for symbol in kept if symbol in values},
            **parameters,
        ),
        SYMBOLS,
    )


def values_by_symbol(bicycle: Bicycle) -> dict[str, tuple[float, float | None]]:
    """Return a bicycle's values and standard deviations by Meijaard's symbols, with those of another file kept with it.

    Parameters
    ----------
    bicycle : Bicycle
        A single design.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> values_by_symbol(load_bicycle("stratos"))["w"]
    (1.037, None)
    """
    deviations = {name: float(sd) for name, sd in bicycle.standard_deviations.items()}
    found = {SYMBOLS[name]: (float(v), deviations.get(name)) for name, v in bicycle.values().items()}
    whole = {symbol: found[symbol][0] for symbol in WHOLE_SYMBOLS}
    kept = still_split(bicycle, whole) | {s: float(v) for s, v in bicycle.extras.items() if s in _CONDITIONS}
    return found | {symbol: (value, deviations.get(symbol)) for symbol, value in kept.items()}
