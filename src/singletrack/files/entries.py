"""What a file says, name by name, with the line it says it on; and messages that point there."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeVar

from singletrack.errors import InputError, SingletrackError, unknown_name
from singletrack.mechanics.rigid import PlanarBody
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.symbols import MODEL_SYMBOLS, NAMES, SYMBOLS
from singletrack.parameters.units import Quantity

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Entries", "bicycle_from_entries", "rigid_rider_from_entries"]

T = TypeVar("T")


@dataclass(frozen=True)
class Entries:
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
    header: Mapping[str, str] = field(default_factory=dict)

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
        """Raise InputError listing the names that are missing."""
        missing = [name for name in names if name not in self.quantities]
        if missing:
            raise InputError(f"{self.where}: {what} lacks {', '.join(missing)}")

    def require_known(self, known: Iterable[str], what: str) -> None:
        """Raise InputError for the first name that is not known, with the nearest that is."""
        known = list(known)
        for name in self.quantities:
            if name not in known:
                raise InputError(f"{self.place(name)}: {unknown_name(what, name, known)}")

    def require_equal(self, expected: Mapping[str, float]) -> None:
        """Raise InputError if a dependent value is given and is not what follows from the others."""
        for name, value in expected.items():
            if name in self.quantities:
                found = self.quantities[name].value
                if not math.isclose(found, value, rel_tol=1e-4, abs_tol=1e-9):
                    raise InputError(
                        f"{self.place(name)}: {name} = {found:g}, must be {value:g}: it follows from the rest"
                    )

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


#: Values that follow from the 25 parameters; some files state them all the same.
_DEPENDENT: dict[str, Callable[[Mapping[str, float]], float]] = {
    **dict.fromkeys(("xR", "yB", "yR", "yH", "yF", "IRxz", "IFxz"), lambda _: 0.0),
    "xF": lambda b: b["w"],
    "zR": lambda b: -b["rR"],
    "zF": lambda b: -b["rF"],
    "IRzz": lambda b: b["IRxx"],
    "IFzz": lambda b: b["IFxx"],
}
_LARGEST = 1e6
_RIGID_RIDER = {"mB", "xB", "yB", "zB", "IBxx", "IByy", "IBzz", "IBxz"}
#: Values that are no bicycle's, but stand in parameter sets.
_CONDITIONS = ("v",)


def bicycle_from_entries(entries: Entries, source: str) -> Bicycle:
    """Return the bicycle that a file of Meijaard's symbols describes.

    Raises
    ------
    InputError
        For symbols that are unknown or missing, and values that are not allowed; names file, line and symbol.
    """
    entries.require_known([*SYMBOLS.values(), *_CONDITIONS, *_DEPENDENT], "symbol")
    if "mB" in entries.quantities and set(entries.quantities) <= _RIGID_RIDER:
        raise InputError(
            f"{entries.where}: holds only {', '.join(entries.quantities)}: is a rigid rider or a lone body, must "
            "be a bicycle; `singletrack convert BICYCLE OUTPUT --rigid-rider FILE` puts a rigid rider on one"
        )
    entries.require(MODEL_SYMBOLS, "the parameter set")
    values, deviations = entries.values(), entries.deviations()
    entries.require_equal({name: follow(values) for name, follow in _DEPENDENT.items() if name in values})
    return entries.build(
        lambda: Bicycle(
            name=entries.name,
            description=entries.description,
            source=source,
            standard_deviations={NAMES[s]: sd for s, sd in deviations.items() if s in NAMES},
            extras={s: values[s] for s in _CONDITIONS if s in values},
            **{NAMES[s]: value for s, value in values.items() if s in NAMES},
        ),
        SYMBOLS,
    )


def rigid_rider_from_entries(entries: Entries) -> PlanarBody:
    """Return the rigid rider that a file of the symbols ``mB, xB, zB, IBxx, IByy, IBzz, IBxz`` describes.

    Raises
    ------
    InputError
        For symbols that are unknown or missing, and values that no body has; names file, line and symbol.
    """
    entries.require_known(sorted(_RIGID_RIDER), "symbol of a rigid rider")
    entries.require(sorted(_RIGID_RIDER - {"yB"}), "the rigid rider")
    values = entries.values()
    entries.require_equal({"yB": 0.0})
    for name in ("mB", "IBxx", "IByy", "IBzz"):
        if not 0 < values[name] < _LARGEST:
            raise InputError(f"{entries.place(name)}: {name} = {values[name]:g}, must be greater than zero")
    for name in ("xB", "zB", "IBxz"):
        if not abs(values[name]) < _LARGEST:
            raise InputError(f"{entries.place(name)}: {name} = {values[name]:g}, must be less than {_LARGEST:g}")
    if values["zB"] >= 0:
        raise InputError(f"{entries.place('zB')}: zB = {values['zB']:g} m, must be less than zero (z points down)")
    if values["IBxz"] ** 2 >= values["IBxx"] * values["IBzz"]:
        text = "no body's: its square must be less than IBxx IBzz"
        raise InputError(f"{entries.place('IBxz')}: IBxz = {values['IBxz']:g} kg*m^2 is {text}")
    moments = (values[f"IB{axes}"] for axes in ("xx", "yy", "zz", "xz"))
    return PlanarBody(values["mB"], values["xB"], values["zB"], *moments)
