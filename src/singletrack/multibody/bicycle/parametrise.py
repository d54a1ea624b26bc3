"""Numbers of a design as parameters of a model, so that designs of one kind share one derivation."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from singletrack.multibody.engine.elements import parameter

if TYPE_CHECKING:
    from collections.abc import Iterable

    from singletrack.multibody.engine.elements import Scalar

__all__ = ["Numbers"]

_STRUCTURAL = (0.0, 1.0, -1.0)


@dataclass(frozen=True)
class Numbers:
    """Turns numbers into parameters and remembers their values.

    Numbers that are exactly 0, 1 or -1 stay numbers, which makes the equations short; where they stand is part of
    the design's kind.

    Examples
    --------
    >>> numbers = Numbers()
    >>> numbers.vector("hip", (0.3, 0.0, -1.1))
    (SX(hip.x), 0.0, SX(hip.z))
    >>> numbers.values
    {'hip.x': 0.3, 'hip.z': -1.1}
    """

    values: dict[str, float] = field(default_factory=dict)
    structure: dict[str, float] = field(default_factory=dict)

    def number(self, name: str, value: Any) -> Scalar:
        """Return a parameter for a number, or the number where it is structural.

        Parameters
        ----------
        name : str
            Of the parameter.
        value : number
            SI; exactly 0, 1 or -1 is structural.
        """
        value = float(value)
        if value in _STRUCTURAL:
            self.structure[name] = value + 0.0  # no negative zero
            return self.structure[name]
        self.values[name] = value
        return parameter(name)

    def always(self, name: str, value: Any) -> Scalar:
        """Return a parameter for a number, whatever it is.

        Parameters
        ----------
        name : str
            Of the parameter.
        value : number
            SI.
        """
        self.values[name] = float(value)
        return parameter(name)

    def vector(self, name: str, components: Iterable[Any]) -> tuple[Scalar, ...]:
        """Return three parameters, ``name.x`` to ``name.z``.

        Parameters
        ----------
        name : str
            How the parameters' names begin.
        components : three numbers
            SI.
        """
        return tuple(self.number(f"{name}.{axis}", value) for axis, value in zip("xyz", components, strict=True))

    def inertia(self, name: str, matrix: Any) -> tuple[Scalar, ...]:
        """Return the six parameters of an inertia matrix (3, 3), as :class:`~singletrack.multibody.Body` takes them.

        Parameters
        ----------
        name : str
            How the parameters' names begin.
        matrix : array, shape (3, 3)
            In kg m^2.
        """
        places = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "yz": (1, 2), "xz": (0, 2)}
        return tuple(self.number(f"{name}.{axes}", matrix[place]) for axes, place in places.items())

    def key(self) -> tuple[Any, ...]:
        """Return what identifies the kind of design: the names, and where the structural numbers stand."""
        return (frozenset(self.values), frozenset(self.structure.items()))
