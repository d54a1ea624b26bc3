"""The base of the records that hold parameters: frozen, checked when made, any batch."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Self

import numpy as np

from singletrack.arrays import Number, is_concrete
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import InputError, SingletrackError
from singletrack.parameters.description import ALLOWED, Parameter, faults_of_value, parameter
from singletrack.parameters.display import line_of, table_of
from singletrack.parameters.hints import unknown_parameter
from singletrack.parameters.values import FrozenDict, as_parameter, real_numbers

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["ALLOWED", "Parameter", "Record", "parameter"]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
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
    written : mapping of str to str
        How a file or ``--set`` wrote parameters, such as ``"16.9 deg"``, where that is known: exact, where the values
        are rounded. What no longer says the value is not to be used (:mod:`singletrack.parameters.exact`).
    """

    kind: ClassVar[str] = "record"
    #: The parameters that say most of what it is, for one line at a prompt.
    in_short: ClassVar[tuple[str, ...]] = ()

    name: str = ""
    description: str = ""
    source: str = ""
    standard_deviations: Mapping[str, Number] = field(default_factory=dict)
    extras: Mapping[str, float] = field(default_factory=dict)
    written: Mapping[str, str] = field(default_factory=dict)

    def __new__(cls, *unnamed: Any, **named: Any) -> Self:
        """Refuse names that are none of its fields before Python does, with what to type instead."""
        if unnamed:
            raise InputError(f"{cls.__name__} takes its parameters by name, such as {cls.in_short[0]}=...")
        cls.require_known(named)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        _take_texts(self)
        _take_values(self)
        _check_mappings(self)
        object.__setattr__(self, "_standing", refuse_single(self.faults(), where=self.name))

    def __repr__(self) -> str:
        return line_of(self, self.in_short)

    def _repr_html_(self) -> str:
        """Return all parameters as a table, for notebooks."""
        return table_of(self)

    @property
    def standing_faults(self) -> tuple[Fault, ...]:
        """The faults that some design of a batch has, as found when the record was made."""
        found: tuple[Fault, ...] = self.__dict__["_standing"]
        return found

    @classmethod
    def descriptions(cls) -> dict[str, Parameter]:
        """Return the description of every parameter by name, in the order of the record."""
        return dict(_descriptions(cls))

    def values(self) -> dict[str, Number]:
        """Return the parameters that are present, by name.

        Each of a shape (...) of its own that broadcasts with the others, SI.

        Each of a shape (...) of its own that broadcasts with the others, SI.
        """
        found = {name: getattr(self, name) for name in _descriptions(type(self))}
        return {name: value for name, value in found.items() if value is not None}

    def replace(self, **changes: Any) -> Self:
        """Return a copy with parameters changed; values may be arrays, which broadcast as NumPy does.

        Raises
        ------
        InputError
            If a name is unknown or a value is not allowed.
        """
        self.require_known(changes)
        own = self.__dict__
        return type(self)(**{name: own[name] for name in _layout(type(self)).names} | changes)

    @classmethod
    def require_known(cls, names: Mapping[str, Any], also: tuple[str, ...] = ()) -> None:
        """Raise InputError for the first name that is no field of this record (nor one of ``also``)."""
        if names.keys() <= cls.__dataclass_fields__.keys():
            return
        for name in names:
            if name not in cls.__dataclass_fields__ and name not in also:
                raise unknown_parameter(cls.kind, name, cls.descriptions())

    def faults(self) -> tuple[Fault, ...]:
        """Return what is wrong with the values, with a mask over the batch each; sound numbers have no faults."""
        if self.is_single:
            return tuple(self._physical_faults() if _is_plain(self) else self._faults())
        # Numbers near the largest double overflow on the way to being refused.
        with np.errstate(over="ignore", invalid="ignore"):
            return tuple(self._faults())

    def _faults(self) -> Iterator[Fault]:
        needed = (name for name, description in _descriptions(type(self)).items() if not description.optional)
        missing = tuple(name for name in needed if getattr(self, name) is None)
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            text = f"{', '.join(missing)} {verb} missing"
            yield Fault(bad=True, text=text, error=InputError, parameters=missing, allowed="a number")
        for name, description in _descriptions(type(self)).items():
            value = getattr(self, name)
            if type(value) is float or is_concrete(value):
                yield from faults_of_value(name, value, description)
        yield from self._physical_faults()

    def _physical_faults(self) -> Iterator[Fault]:
        """Yield faults that concern several parameters; only called on values that are numbers."""
        yield from ()

    @property
    def is_single(self) -> bool:
        """Whether every parameter is one plain number: a single design, and not one that JAX looks at."""
        single: bool = self.__dict__["_single"]
        return single

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch of designs; () for a single one."""
        shape: tuple[int, ...] = self.__dict__["_shape"]
        return shape


class _Layout(NamedTuple):
    """What reading off the fields of a class of records takes longer than checking the values."""

    names: tuple[str, ...]
    descriptions: dict[str, Parameter]
    texts: tuple[str, ...]
    mappings: tuple[str, ...]
    #: Each parameter's name, plain range and whether it is optional.
    ranges: tuple[tuple[str, float, float, bool], ...]


_LAYOUTS: dict[type[Record], _Layout] = {}


def _layout(cls: type[Record]) -> _Layout:
    if cls not in _LAYOUTS:
        fields = dataclasses.fields(cls)
        descriptions = {f.name: f.metadata["parameter"] for f in fields if "parameter" in f.metadata}
        _LAYOUTS[cls] = _Layout(
            tuple(f.name for f in fields),
            descriptions,
            tuple(f.name for f in fields if f.default == ""),
            tuple(f.name for f in fields if f.default_factory is not dataclasses.MISSING),
            tuple((name, *each.plain, each.optional) for name, each in descriptions.items()),
        )
    return _LAYOUTS[cls]


def _descriptions(cls: type[Record]) -> dict[str, Parameter]:
    return _layout(cls).descriptions


def _is_plain(record: Record) -> bool:
    """Tell whether each number of a single design is sound by itself, and none is missing; False where in doubt."""
    own = record.__dict__
    for name, low, high, optional in _layout(type(record)).ranges:
        value = own[name]
        if value is None:
            if not optional:
                return False
        elif not low <= value <= high:
            return False
    return True


def _take_texts(record: Record) -> None:
    """Refuse names that are no text; take copies of the mappings, which cannot be changed."""
    own, layout = record.__dict__, _layout(type(record))
    for name in layout.texts:
        value = own[name]
        if not isinstance(value, str):
            reason = f"{name} = {value!r:.80}, must be text"
            raise InputError(reason, parameters=(name,), found=value, allowed="text")
    for name in layout.mappings:
        value = own[name]
        if not isinstance(value, Mapping):
            reason = f"{name} = {value!r:.80}, must be a dictionary"
            raise InputError(reason, parameters=(name,), found=value, allowed="a dictionary")
        own[name] = FrozenDict(value)


def _check_mappings(record: Record) -> None:
    """Raise what is wrong with standard deviations and extras: they are numbers, deviations of parameters."""
    own = record.__dict__
    for name, value in record.standard_deviations.items():
        parameter = name.partition(" on ")[0] if isinstance(name, str) else name
        if parameter not in _descriptions(type(record)) and name not in record.extras:
            raise unknown_parameter(record.kind, str(name), record.descriptions()).at("standard_deviations")
        number = _number_of(f"standard_deviations[{name!r}]", value)
        if not _is_spread(number):
            allowed = "finite and zero or more"
            reason = f"standard_deviations[{name!r}] = {value!r:.80}, must be {allowed}"
            raise InputError(reason, parameters=(name,), found=value, allowed=allowed, place=record.name)
    own["extras"] = FrozenDict({name: _number_of(f"extras[{name!r}]", value) for name, value in record.extras.items()})


def _number_of(name: str, value: Any) -> Number:
    try:
        return as_parameter(value)
    except InputError as error:
        raise error.of(name) from None


def _is_spread(value: Number) -> bool:
    """Tell whether a standard deviation is finite and not negative, as far as it can be looked at."""
    if isinstance(value, float):
        return 0 <= value < inf
    numbers = real_numbers(value)
    return numbers is None or bool(((numbers[0] >= 0) & (numbers[0] < inf)).all())


def _take_values(record: Record) -> None:
    """Put parameters into the record as doubles and note the batch's shape; raise what is wrong with their types."""
    own = record.__dict__
    wrong: list[SingletrackError] = []
    arrays: dict[str, tuple[int, ...]] = {}
    single = True
    for name in _descriptions(type(record)):
        value = own[name]
        if type(value) is float or value is None:
            continue
        try:
            own[name] = value = as_parameter(value)
        except InputError as error:
            wrong.append(error.of(name))
            continue
        if type(value) is not float:
            single = False
            arrays[name] = getattr(value, "shape", ())
    if wrong:
        raise SingletrackError.of_all(wrong).at(record.name)
    own["_single"], own["_shape"] = single, _common_shape(record.name, arrays) if arrays else ()


def _common_shape(name: str, shapes: dict[str, tuple[int, ...]]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        several = {parameter: shape for parameter, shape in shapes.items() if shape}
        reason = f"{', '.join(f'{p} has shape {shape}' for p, shape in several.items())}, must broadcast to one shape"
        raise InputError(
            reason, parameters=several, found=several, allowed="shapes that broadcast", place=name
        ) from None
