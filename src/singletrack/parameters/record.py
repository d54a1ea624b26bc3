"""What a parameter is, and the base of the records that hold them.

The fields of a record describe themselves once (unit, symbol in the paper, meaning, allowed values); validation,
file reading, templates, tables and schemas all read that description.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Self

from singletrack.arrays import Array, is_concrete
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import InputError
from singletrack.parameters.hints import unknown_parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["ALLOWED", "Parameter", "Record", "parameter"]

#: Kinds of allowed values: the words a user reads, and a test on NumPy arrays (finite is tested before).
ALLOWED: dict[str, tuple[str, Callable[[Any], Any]]] = {
    "any": ("a finite number", lambda x: x == x),  # noqa: PLR0124  # true for all finite numbers
    "positive": ("greater than zero", lambda x: x > 0),
    "not negative": ("zero or more", lambda x: x >= 0),
    "angle": ("between 0 and 90 deg (a bare number is in radians)", lambda x: (x > 0) & (x < 1.5707963267948966)),
    "tilt": ("between -90 and 90 deg (a bare number is in radians)", lambda x: abs(x) < 1.5707963267948966),
    "above ground": ("less than zero (z points down, the ground is at zero)", lambda x: x < 0),
    "fraction": ("greater than 0 and less than 1", lambda x: (x > 0) & (x < 1)),
}


@dataclass(frozen=True)
class Parameter:
    """The description of one parameter.

    Attributes
    ----------
    unit : str
        SI unit as pint reads it, "" for a plain number.
    symbol : str
        The paper's symbol.
    meaning : str
        What it is, for templates and tables.
    allowed : str
        A key of :data:`ALLOWED`.
    group : str
        Heading under which it is listed.
    optional : bool
        Whether a record can do without it.
    """

    unit: str
    symbol: str
    meaning: str
    allowed: str
    group: str
    optional: bool = False


def parameter(
    unit: str, symbol: str, meaning: str, allowed: str = "positive", *, group: str, optional: bool = False
) -> Any:
    """Declare a field of a record as a parameter (arguments as in :class:`Parameter`)."""
    description = Parameter(unit, symbol, meaning, allowed, group, optional)
    if optional:
        return field(default=None, metadata={"parameter": description})
    return field(metadata={"parameter": description})


@dataclass(frozen=True, kw_only=True, eq=False)
class Record:
    """Base of the frozen parameter records; every parameter may be a number or an array (a batch of designs).

    Attributes
    ----------
    name : str
        What the thing is called; ``""`` if nothing.
    description : str
        One sentence about it.
    source : str
        Where the numbers come from.
    standard_deviations : mapping of str to float
        Measurement uncertainty of parameters, SI, where known.
    extras : mapping of str to float
        Numbers of a file in another format that are no parameters (such as the speed of a parameter set), kept so
        that they can be written back.
    """

    kind: ClassVar[str] = "record"

    name: str = ""
    description: str = ""
    source: str = ""
    standard_deviations: Mapping[str, Array] = field(default_factory=dict)
    extras: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_standing", refuse_single(self.faults(), where=self.name))

    @property
    def standing_faults(self) -> tuple[Fault, ...]:
        """The faults that some design of a batch has, as found when the record was made."""
        found: tuple[Fault, ...] = self.__dict__["_standing"]
        return found

    @classmethod
    def descriptions(cls) -> dict[str, Parameter]:
        """Return the description of every parameter by name, in the order of the record."""
        return {f.name: f.metadata["parameter"] for f in dataclasses.fields(cls) if "parameter" in f.metadata}

    def values(self) -> dict[str, Array]:
        """Return the parameters that are present, by name."""
        found = {name: getattr(self, name) for name in self.descriptions()}
        return {name: value for name, value in found.items() if value is not None}

    def replace(self, **changes: Array) -> Self:
        """Return a copy with parameters changed; values may be arrays, which broadcast as NumPy does.

        Raises
        ------
        InputError
            If a name is unknown or a value is not allowed.
        """
        self.require_known(changes)
        return dataclasses.replace(self, **changes)

    @classmethod
    def require_known(cls, names: Mapping[str, Any], also: tuple[str, ...] = ()) -> None:
        """Raise InputError for the first name that is no field of this record (nor one of ``also``)."""
        known = [f.name for f in dataclasses.fields(cls)]
        for name in names:
            if name not in known and name not in also:
                raise unknown_parameter(cls.kind, name, cls.descriptions())

    def faults(self) -> tuple[Fault, ...]:
        """Return what is wrong with the values, one fault per rule, with a mask over the batch."""
        import numpy as np

        # Numbers near the largest double overflow on the way to being refused.
        with np.errstate(over="ignore", invalid="ignore"):
            return tuple(self._faults())

    def _faults(self) -> Iterator[Fault]:
        for name, description in self.descriptions().items():
            yield from _faults_of_value(name, getattr(self, name), description)
        yield from self._physical_faults()

    def _physical_faults(self) -> Iterator[Fault]:
        """Yield faults that concern several parameters; only called on values that are numbers."""
        yield from ()

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch of designs; () for a single one."""
        import numpy as np

        return np.broadcast_shapes(*(np.shape(value) for value in self.values().values()))


def _faults_of_value(name: str, value: Array, description: Parameter) -> Iterator[Fault]:
    if value is None:
        if not description.optional:
            yield Fault(bad=True, text=f"{name} is missing", error=InputError, parameters=(name,))
        return
    if not is_concrete(value):
        return
    import numpy as np

    array = np.asarray(value)
    if array.dtype.kind not in "iufc":
        found = repr(value)[:80].replace("{", "{{").replace("}", "}}")
        text = f"{name} = {found} is not a number"
        yield Fault(bad=True, text=text, error=InputError, parameters=(name,), allowed="a number")
        return
    unit = f" {description.unit}" if description.unit else ""
    words, test = ALLOWED[description.allowed]
    finite = np.isfinite(array)
    bad = ~finite | ~np.where(finite, test(np.where(finite, array.real, 1.0)), False)  # noqa: FBT003
    found = f"{name} = {{found:.6g}}{unit}"
    if description.allowed in {"angle", "tilt"}:
        found += " ({degrees:.6g} deg)"
    values = {"found": array, "degrees": np.degrees(array.real)}
    yield Fault(bad, f"{found}, must be {words}", values, InputError, (name,), words)
