"""What a SPACAR file describes: nodes, elements, what their coordinates and deformations are, masses, loads."""

from __future__ import annotations

from dataclasses import dataclass, field

from singletrack.multibody.spacar.kinds import KINDS, WIDTHS

__all__ = ["Description", "Element", "Freedom", "Input", "Key", "Output"]

#: Number of an element or node, and component from 1.
Key = tuple[int, int]

#: What a coordinate or deformation may be.
FREEDOMS = ("calculated", "fixed", "dynamic", "kinematic", "prescribed")
Freedom = str


@dataclass(frozen=True)
class Element:
    """One element: its kind (a key of :data:`KINDS`), its nodes, the axis given, where it stands in the file."""

    kind: str
    nodes: tuple[int, ...]
    axis: tuple[float, ...]
    line: int


@dataclass(frozen=True)
class Input:
    """Input of the linear model: a force dual to a deformation (``e``) or a coordinate (``x``)."""

    number: int
    what: str
    key: Key


@dataclass(frozen=True)
class Output:
    """Output of the linear model: a deformation ``e``, its rate ``ed``, a coordinate ``x``, its rate ``xd``."""

    number: int
    what: str
    key: Key


@dataclass
class Description:
    """A model as its file describes it.

    Attributes
    ----------
    where, dialect
        Name of the file; ``delft`` or ``twente``.
    elements
        By number.
    nodes
        Kind of each node (of ``WIDTHS``) by number, in order of number.
    drawn
        Drawn coordinates by node.
    x_freedoms, e_freedoms
        What coordinates and deformations are (of ``FREEDOMS``), where it is not the default: a coordinate is
        ``calculated``, a deformation ``fixed``. A released deformation is ``calculated``.
    more_freedoms
        Deformations that are freedoms of the linear model although the motion does not change them (``LINE``).
    initial_x, initial_e
        Initial values, rates and accelerations (of prescribed ones) by key; a value that is not given is NaN.
    masses
        By node: mass, moment of inertia or six components.
    line_masses
        By element: mass per length and, for a beam in space, moment of inertia about the axis per length.
    stiffness, damping
        By element, as given.
    forces, torques
        By node: constant force or moment in the frame of the ground; torque in the body's axes.
    gravity
        Acceleration, up to three components.
    inputs, outputs
        Of the linear model.
    steps, duration
        Of the simulation.
    settings
        Tolerances by keyword.
    remarks
        What was read but has no effect, and why.
    """

    where: str
    dialect: str
    elements: dict[int, Element] = field(default_factory=dict)
    nodes: dict[int, str] = field(default_factory=dict)
    drawn: dict[int, tuple[float, ...]] = field(default_factory=dict)
    x_freedoms: dict[Key, Freedom] = field(default_factory=dict)
    e_freedoms: dict[Key, Freedom] = field(default_factory=dict)
    more_freedoms: list[Key] = field(default_factory=list)
    initial_x: dict[Key, tuple[float, float, float]] = field(default_factory=dict)
    initial_e: dict[Key, tuple[float, float, float]] = field(default_factory=dict)
    masses: dict[int, tuple[float, ...]] = field(default_factory=dict)
    line_masses: dict[int, tuple[float, ...]] = field(default_factory=dict)
    stiffness: dict[int, tuple[float, ...]] = field(default_factory=dict)
    damping: dict[int, tuple[float, ...]] = field(default_factory=dict)
    forces: dict[int, tuple[float, ...]] = field(default_factory=dict)
    torques: dict[int, tuple[float, ...]] = field(default_factory=dict)
    gravity: tuple[float, ...] = ()
    inputs: list[Input] = field(default_factory=list)
    outputs: list[Output] = field(default_factory=list)
    steps: int = 0
    duration: float = 0.0
    settings: dict[str, float] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)

    def components(self, element: int) -> int:
        """Return how many deformations an element has."""
        return len(KINDS[self.elements[element].kind].components)

    def width(self, node: int) -> int:
        """Return how many coordinates a node has."""
        return WIDTHS[self.nodes[node]]

    def coordinates(self, node: int) -> tuple[float, ...]:
        """Return the drawn coordinates of a node; where none are given, zero, for Euler parameters no turn."""
        default = (1.0, 0.0, 0.0, 0.0) if self.nodes[node] == "o3" else (0.0,) * self.width(node)
        return self.drawn.get(node, default)
