"""The symbols of Meijaard et al. (2007), as the files of this field spell them, and our names."""

from __future__ import annotations

from singletrack.parameters.bicycle import Bicycle

__all__ = ["GEOMETRY_SYMBOLS", "MODEL_SYMBOLS", "NAMES", "SYMBOLS"]


def _ascii(symbol: str) -> str:
    return symbol.replace("λ", "lam")


#: Symbol of every parameter of a bicycle by name (``trail``: ``c``).
SYMBOLS = {name: _ascii(p.symbol) for name, p in Bicycle.descriptions().items()}

#: Name of every parameter of a bicycle by symbol.
NAMES = {symbol: name for name, symbol in SYMBOLS.items()}

#: Symbols of the 25 parameters of the linear model (and gravity), in the order of the record.
MODEL_SYMBOLS = tuple(symbol for name, symbol in SYMBOLS.items() if not Bicycle.descriptions()[name].optional)

#: Symbols of the frame geometry that seats a rider.
GEOMETRY_SYMBOLS = tuple(symbol for name, symbol in SYMBOLS.items() if Bicycle.descriptions()[name].optional)
