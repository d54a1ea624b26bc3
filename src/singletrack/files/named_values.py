"""What a file says, name by name, with the line it says it on; and messages that point there."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from singletrack.errors import InputError, SingletrackError, unknown
from singletrack.parameters.units import Quantity

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["NamedValues"]

T = TypeVar("T")


@dataclass(frozen=True)
class NamedValues:
    """Numbers by the name the file gives them.

    Attributes
    ----------
    where : str
        The file's name, for messages.
    quantities : mapping of str to Quantity
    lines : mapping of str to int
        The line each stands on, counted from 1.
    name, description : str
        What the file calls itself.
    """

    where: str
    quantities: Mapping[str, Quantity]
    lines: Mapping[str, int]
    name: str = ""
    description: str = ""

    def place(self, name: str) -> str:
        """Return the file, with the line on which a name stands."""
        return f"{self.where}, line {self.lines[name]}" if name in self.lines else self.where

    def values(self) -> dict[str, float]:
        """Return the numbers without their standard deviations."""
        return {name: quantity.value for name, quantity in self.quantities.items()}

    def deviations(self) -> dict[str, float]:
        """Return the standard deviations where they are given."""
        return {name: q.deviation for name, q in self.quantities.items() if q.deviation is not None}

    def require(self, names: Iterable[str], what: str) -> None:
        """Raise InputError listing the names that are missing.

        Parameters
        ----------
        names : iterable of str
        what : str
            What lacks them.
        """
        missing = [name for name in names if name not in self.quantities]
        if missing:
            raise InputError(f"{self.where}: {what} lacks {', '.join(missing)}", parameters=missing)

    def require_known(self, known: Iterable[str], what: str) -> None:
        """Raise InputError for the first name that is not known, with the nearest that is.

        Parameters
        ----------
        known : iterable of str
        what : str
            What the names should be.
        """
        known = tuple(known)
        for name in self.quantities:
            if name not in known:
                raise unknown(what, name, known, self.place(name))

    def require_equal(self, expected: Mapping[str, float], relative: float = 1e-4, absolute: float = 1e-9) -> None:
        """Raise InputError if a dependent value is given and is not what follows from the others.

        Parameters
        ----------
        expected : mapping of str to float
            What follows, by name, SI.
        relative, absolute : float
            How far a value may be off, as a share of it and in its unit: they are rounded.
        """
        for name, value in expected.items():
            if name in self.quantities:
                found = self.quantities[name].value
                if not math.isclose(found, value, rel_tol=relative, abs_tol=absolute):
                    reason = f"{name} = {found:g}, must be {value:g}: it follows from the rest"
                    raise InputError(reason, parameters=(name,), found=found, allowed=value, place=self.place(name))

    def build(self, make: Callable[[], T], symbols: Mapping[str, str]) -> T:
        """Return what ``make`` returns; a refusal is said with file, line and the file's own name of the parameter.

        Parameters
        ----------
        make : callable
            Makes a record; may raise SingletrackError, which names its parameters.
        symbols : mapping of str to str
            The file's name of each parameter of the record.
        """
        try:
            return make()
        except SingletrackError as error:
            raise error.located(lambda names: self._place_of(names, symbols)) from None

    def _place_of(self, names: tuple[str, ...], symbols: Mapping[str, str]) -> str:
        """Return file, line and the file's own name of the first of the parameters that the file gives."""
        given = [(name, symbols[name]) for name in names if symbols.get(name) in self.lines]
        if not given:
            return self.where
        name, symbol = given[0]
        return self.place(symbol) if symbol == name else f"{self.place(symbol)}: {symbol}"
