"""Split forks: handlebar (G) and fork (S) measured apart, which together are the front frame (H)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.mechanics.rigid import PlanarBody, combine

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.parameters.bicycle import Bicycle
    from singletrack.parameters.units import Quantity

__all__ = ["SPLIT_SYMBOLS", "WHOLE_SYMBOLS", "combined", "combined_deviations", "still_split"]


def _symbols(letter: str) -> tuple[str, ...]:
    moments = (f"I{letter}{axes}" for axes in ("xx", "yy", "zz", "xz"))
    return (f"m{letter}", f"x{letter}", f"z{letter}", *moments)


#: Symbols of handlebar and fork, and of the front frame that both are, in the same order.
SPLIT_SYMBOLS = (*_symbols("G"), *_symbols("S"))
WHOLE_SYMBOLS = _symbols("H")
_STEP = 1e-30


def combined(values: Mapping[str, float]) -> dict[str, float]:
    """Return the front frame that handlebar and fork are together, by symbol.

    Parameters
    ----------
    values : mapping of str to float
        With all of :data:`SPLIT_SYMBOLS`, SI.

    Examples
    --------
    >>> combined(dict.fromkeys(SPLIT_SYMBOLS, 1.0))["mH"]
    2.0
    """
    return {symbol: float(value) for symbol, value in zip(WHOLE_SYMBOLS, _whole(values), strict=True)}


def _whole(values: Mapping[str, Any]) -> PlanarBody:
    handlebar, fork = (PlanarBody(*(values[symbol] for symbol in _symbols(letter))) for letter in "GS")
    # Numbers near the largest double overflow; the record then refuses what is not finite.
    with np.errstate(all="ignore"):
        return PlanarBody.of(combine([handlebar.body(), fork.body()]))


def combined_deviations(quantities: Mapping[str, Quantity]) -> dict[str, float]:
    """Return the standard deviations of the front frame, handlebar and fork being measured independently.

    Parameters
    ----------
    quantities : mapping of str to Quantity
        With all of :data:`SPLIT_SYMBOLS`.
    """
    variances = dict.fromkeys(WHOLE_SYMBOLS, 0.0)
    values = {symbol: quantities[symbol].value for symbol in SPLIT_SYMBOLS}
    for symbol in SPLIT_SYMBOLS:
        deviation = quantities[symbol].deviation
        if deviation:
            stepped = _whole({**values, symbol: values[symbol] + 1j * _STEP})
            for whole, value in zip(WHOLE_SYMBOLS, stepped, strict=True):
                variances[whole] += (float(np.asarray(value).imag) / _STEP * deviation) ** 2
    return {symbol: variance**0.5 for symbol, variance in variances.items() if variance > 0}


def still_split(bicycle: Bicycle, whole: Mapping[str, float]) -> dict[str, float]:
    """Return the handlebar and fork that a bicycle was read with, if they still make its front frame.

    Parameters
    ----------
    bicycle : Bicycle
    whole : mapping of str to float
        Its front frame by symbol.
    """
    kept = {symbol: float(value) for symbol, value in bicycle.extras.items() if symbol in SPLIT_SYMBOLS}
    if len(kept) < len(SPLIT_SYMBOLS):
        return {}
    expected = combined(kept)
    same = all(np.isclose(whole[symbol], expected[symbol], rtol=1e-3, atol=1e-5) for symbol in WHOLE_SYMBOLS)
    return kept if same else {}
