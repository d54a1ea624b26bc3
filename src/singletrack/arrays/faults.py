"""What is wrong with a design: raised for one design, flagged in place for a batch.

A :class:`Fault` is a mask over the batch with a reason. A single design with a fault is refused at once; in a batch the
other designs go on, and the faulty ones carry their reason with them (``coefficients(...).faults``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays.namespace import Array, Number, is_concrete
from singletrack.errors import SingletrackError

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Fault", "refuse_single", "valid_mask"]


@dataclass(frozen=True)
class Fault:
    """One way in which designs are wrong.

    Attributes
    ----------
    bad : bool array, shape (...)
        True where the design is wrong.
    text : str
        The reason, with ``{name}`` for values.
    values : mapping of str to arrays, each broadcastable to ``bad``
        The values that the text names; those under a parameter's name, or ``found``, are what was found.
    error : type
        The exception to raise for a single design.
    parameters : tuple of str
        The parameters that are wrong, or wrong together.
    allowed : str
        What they must be, in words.

    Examples
    --------
    >>> import numpy as np
    >>> found = {"mass": np.array([1.0, -2.0])}
    >>> fault = Fault(np.array([False, True]), "mass = {mass:g} kg", found, parameters=("mass",))
    >>> fault.reason((1,)), fault.kind
    ('mass = -2 kg', 'mass = <mass> kg')
    """

    bad: Array | bool
    text: str
    values: Mapping[str, Number] = field(default_factory=dict)
    error: type[SingletrackError] = SingletrackError
    parameters: tuple[str, ...] = ()
    allowed: str = ""

    def __getitem__(self, index: Any) -> Fault:
        """Return the fault of some designs of the batch."""
        shape = np.shape(self.bad)
        some = {name: np.broadcast_to(np.asarray(value), shape)[index] for name, value in self.values.items()}
        return replace(self, bad=np.asarray(self.bad)[index], values=some)

    def broadcast_to(self, shape: tuple[int, ...]) -> Fault:
        """Return the fault with a mask and values of the full shape."""
        full = {name: np.broadcast_to(np.asarray(value), shape) for name, value in self.values.items()}
        return replace(self, bad=np.broadcast_to(np.asarray(self.bad), shape), values=full)

    def padded(self, before: int, after: int) -> Fault:
        """Return the fault of a batch (k,) as that of a longer one: so many sound designs before and after."""
        full = {name: np.pad(np.asarray(value), (before, after)) for name, value in self.values.items()}
        return replace(self, bad=np.pad(np.asarray(self.bad), (before, after)), values=full)

    @property
    def kind(self) -> str:
        """The reason with names in place of the values: the same for all designs that have this fault."""
        return self.text.format_map({name: _Name(f"<{name}>") for name in self.values})

    def reason(self, index: tuple[int, ...] = ()) -> str:
        """Return the reason with the values of the design at ``index``."""
        return self.text.format(**self._values_at(index))

    def at(self, index: tuple[int, ...] = ()) -> SingletrackError:
        """Return the error that the design at ``index`` is, with its parameters, what was found and what is allowed."""
        values = self._values_at(index)
        found = {name: values[name] for name in self.parameters if name in values}
        return self.error(
            self.text.format(**values),
            parameters=self.parameters,
            found=values.get("found", next(iter(found.values())) if len(found) == 1 else found or None),
            allowed=self.allowed,
        )

    def _values_at(self, index: tuple[int, ...]) -> dict[str, Any]:
        shape = np.shape(self.bad)
        return {name: np.broadcast_to(np.asarray(value), shape)[index] for name, value in self.values.items()}


class _Name(str):
    """A name that stands for a number, whatever the number's format."""

    __slots__ = ()

    def __format__(self, spec: str) -> str:
        return str(self)


def refuse_single(faults: Iterable[Fault], where: str = "") -> tuple[Fault, ...]:
    """Raise what is wrong with a single design; return the faults of a batch (those that hit any design).

    Parameters
    ----------
    faults : iterable of Fault
        Faults with masks that can be looked at; those being traced are passed over.
    where : str
        The error's place, such as the name of the bicycle, unless someone knows better later.

    Raises
    ------
    SingletrackError
        Of the class named by the first fault, with all reasons, if the masks have no dimensions.
    """
    hit = [fault for fault in faults if is_concrete(fault.bad) and np.any(np.asarray(fault.bad))]
    single = [fault for fault in hit if np.ndim(fault.bad) == 0]
    if single:
        raise SingletrackError.of_all([fault.at() for fault in single]).at(where)
    return tuple(hit)


def valid_mask(faults: Iterable[Fault], shape: tuple[int, ...] = ()) -> np.ndarray:
    """Return True for the designs that no fault hits, shape broadcast from ``shape`` and the masks."""
    good = np.ones(shape, dtype=bool)
    for fault in faults:
        good = good & ~np.asarray(fault.bad)
    return good
