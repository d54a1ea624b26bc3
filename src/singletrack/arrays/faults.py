"""What is wrong with a design: raised for one design, flagged in place for a batch.

A :class:`Fault` is a mask over the batch with a reason. A single design with a fault is refused at once; in a batch the
other designs go on, and the faulty ones carry their reason with them (``coefficients(...).faults``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from singletrack.arrays.namespace import Array, is_concrete
from singletrack.errors import SingletrackError

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np

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
        What was found.
    error : type
        The exception to raise for a single design.

    Examples
    --------
    >>> import numpy as np
    >>> Fault(np.array([False, True]), "mass = {mass:g} kg", {"mass": np.array([1.0, -2.0])}).reason((1,))
    'mass = -2 kg'
    """

    bad: Array
    text: str
    values: Mapping[str, Array] = field(default_factory=dict)
    error: type[SingletrackError] = SingletrackError

    def __getitem__(self, index: Any) -> Fault:
        """Return the fault of some designs of the batch."""
        import numpy as np

        shape = np.shape(self.bad)
        some = {name: np.broadcast_to(np.asarray(value), shape)[index] for name, value in self.values.items()}
        return replace(self, bad=np.asarray(self.bad)[index], values=some)

    def broadcast_to(self, shape: tuple[int, ...]) -> Fault:
        """Return the fault with a mask and values of the full shape."""
        import numpy as np

        full = {name: np.broadcast_to(np.asarray(value), shape) for name, value in self.values.items()}
        return replace(self, bad=np.broadcast_to(np.asarray(self.bad), shape), values=full)

    def padded(self, before: int, after: int) -> Fault:
        """Return the fault of a batch (k,) as that of a longer one: so many sound designs before and after."""
        import numpy as np

        full = {name: np.pad(np.asarray(value), (before, after)) for name, value in self.values.items()}
        return replace(self, bad=np.pad(np.asarray(self.bad), (before, after)), values=full)

    def reason(self, index: tuple[int, ...] = ()) -> str:
        """Return the reason with the values of the design at ``index``."""
        import numpy as np  # lazy: records can be made without NumPy

        shape = np.shape(self.bad)
        found = {name: np.broadcast_to(np.asarray(value), shape)[index] for name, value in self.values.items()}
        return self.text.format(**found)


def refuse_single(faults: Iterable[Fault], where: str = "") -> tuple[Fault, ...]:
    """Raise what is wrong with a single design; return the faults of a batch (those that hit any design).

    Parameters
    ----------
    faults : iterable of Fault
        Faults with masks that can be looked at; those being traced are passed over.
    where : str
        Put before the message, such as the file or the name of the bicycle.

    Raises
    ------
    SingletrackError
        Of the class named by the first fault, with all reasons, if the masks have no dimensions.
    """
    import numpy as np

    hit = [fault for fault in faults if is_concrete(fault.bad) and np.any(np.asarray(fault.bad))]
    single = [fault for fault in hit if np.ndim(fault.bad) == 0]
    if single:
        prefix = f"{where}: " if where else ""
        raise single[0].error(prefix + "; ".join(fault.reason() for fault in single))
    return tuple(hit)


def valid_mask(faults: Iterable[Fault], shape: tuple[int, ...] = ()) -> np.ndarray:
    """Return True for the designs that no fault hits, shape broadcast from ``shape`` and the masks."""
    import numpy as np

    good = np.ones(shape, dtype=bool)
    for fault in faults:
        good = good & ~np.asarray(fault.bad)
    return good
