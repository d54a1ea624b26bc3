"""A SPACAR model to ask: states, accelerations, motion, small motions, statics."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from singletrack.errors import InputError, ModelError
from singletrack.multibody.spacar.describe import describe
from singletrack.multibody.spacar.evaluate import strains
from singletrack.multibody.spacar.layout import Layout, lay_out
from singletrack.multibody.spacar.linearise import SmallMotions, small_motions
from singletrack.multibody.spacar.listing import listing
from singletrack.multibody.spacar.rows import Rows, choose, names_of, solver_at
from singletrack.multibody.spacar.simulate import simulate
from singletrack.multibody.spacar.state import Motion, State, accelerate, configure, prescribed, rates
from singletrack.multibody.spacar.statements import MOST_CHARACTERS, Source, parse, write
from singletrack.multibody.spacar.statics import Buckling, buckling, equilibrium, frequencies

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Array
    from singletrack.multibody.spacar.description import Description, Key

__all__ = ["Spacar", "read", "read_text"]

MOST_HALVINGS = 8


@dataclass(frozen=True, eq=False)
class Spacar:
    """A model of nodes and elements.

    Attributes
    ----------
    source
        The statements it was read from.
    layout
        The model as arrays.

    Examples
    --------
    >>> pendulum = read_text('''
    ... PLTRUSS 1 1 2
    ... PLBEAM 2 1 3 2 4
    ... X 2 1.0 0.0
    ... FIX 1
    ... DYNX 3 1
    ... MASS 2 1.0
    ... GRAVITY 0 -9.81
    ... ''')
    >>> pendulum.by_node(pendulum.motion().a)[3]
    [-9.81]
    """

    source: Source
    layout: Layout

    @property
    def description(self) -> Description:
        """What the file says."""
        return self.layout.description

    @cached_property
    def rows(self) -> Rows:
        """The chosen constraints and generalised coordinates."""
        return choose(self.layout, strains(self.layout, self.layout.drawn)[1])

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Names of the generalised coordinates: ``x NODE COMPONENT`` or ``e ELEMENT COMPONENT``."""
        return self.rows.names()

    def text(self) -> str:
        """Return the model as a file."""
        return write(self.source)

    def drawn(self) -> State:
        """Return the drawn configuration at rest."""
        e, _ = strains(self.layout, self.layout.drawn)
        return State(0.0, self.layout.drawn.copy(), np.zeros_like(self.layout.drawn), e)

    def _wanted(self, time: float) -> tuple[Array, Array, Array, Array]:
        """Return the initial values of deformations and coordinates, and which are given."""
        layout, d = self.layout, self.description
        of_e, of_x = prescribed(layout, time, 0)
        e_given = np.isin(layout.e_is, ("prescribed", "dynamic", "kinematic"))
        x_given = np.isin(layout.x_is, ("prescribed", "dynamic", "kinematic"))
        for target, index, initial, is_ in (
            (of_e, layout.e_index, d.initial_e, layout.e_is),
            (of_x, layout.x_index, d.initial_x, layout.x_is),
        ):
            for key, i in index.items():
                if is_[i] in {"dynamic", "kinematic"}:
                    value = initial.get(key, (np.nan,))[0]
                    drawn = layout.drawn[i] if target is of_x else 0.0
                    target[i] = drawn if np.isnan(value) else value
        return of_e, of_x, np.flatnonzero(e_given), np.flatnonzero(x_given)

    def state(
        self, e: Mapping[Key, float] | None = None, ed: Mapping[Key, float] | None = None, time: float = 0.0
    ) -> State:
        """Return a state by the generalised coordinates.

        Parameters
        ----------
        e, ed
            Values and rates of dynamic deformations by (element, component), in the units of the file, angles in rad;
            where not given, those of the file.
        time
            For what is prescribed, s.

        Raises
        ------
        InputError
            For a deformation that is not dynamic (or kinematic, for its value).
        ModelError
            Where there is no such configuration.
        """
        layout, rows = self.layout, self.rows
        of_e, of_x, e_given, x_given = self._wanted(time)
        for key, value in (e or {}).items():
            of_e[self._dynamic(key, ("dynamic", "kinematic"))] = value
        place = self._reach(of_e, of_x, e_given, x_given)
        moving_e, moving_x = np.zeros(len(layout.e_is)), np.zeros(len(layout.x_is))
        for target, index, initial in (
            (moving_e, layout.e_index, self.description.initial_e),
            (moving_x, layout.x_index, self.description.initial_x),
        ):
            for key, values in initial.items():
                target[index[key]] = values[1]
        for key, value in (ed or {}).items():
            moving_e[self._dynamic(key, ("dynamic",))] = value
        solver = solver_at(rows, strains(layout, place.x)[1])
        v = rates(solver, time, rows.generalised(moving_e, moving_x))
        return replace(place, v=v, time=time)

    def _reach(self, of_e: Array, of_x: Array, e_given: Array, x_given: Array) -> State:
        """Go from the drawing to a configuration, in smaller steps where it is far."""
        start = self.drawn()
        for halvings in range(MOST_HALVINGS + 1):
            state, count = start, 2**halvings
            try:
                for i in range(1, count + 1):
                    part = i / count
                    x = start.x + part * (of_x - start.x)
                    state = configure(self.rows, state, part * of_e, x, e_given, x_given)
            except ModelError:
                if halvings == MOST_HALVINGS:
                    raise
            else:
                return state
        raise AssertionError

    def _dynamic(self, key: Key, allowed: tuple[str, ...]) -> int:
        index = self.layout.e_index.get(key)
        if index is None or self.layout.e_is[index] not in allowed:
            known = [k for k, i in self.layout.e_index.items() if self.layout.e_is[i] in allowed]
            raise InputError(
                f"deformation {key} is not {' or '.join(allowed)}; these are: {', '.join(map(str, known)) or 'none'}"
            )
        return index

    def forces(self, forces: Mapping[Key, float] | None) -> Array:
        """Return generalised forces (q,), N or N m, of a mapping of forces by (element, component)."""
        of_e, of_x = np.zeros(len(self.layout.e_is)), np.zeros(len(self.layout.x_is))
        for key, value in (forces or {}).items():
            of_e[self._dynamic(key, ("dynamic",))] = value
        return self.rows.generalised(of_e, of_x)

    def motion(self, state: State | None = None, forces: Mapping[Key, float] | None = None) -> Motion:
        """Return a state (the initial one) with accelerations and stresses under forces (N, N m) on deformations."""
        return accelerate(self.rows, self.state() if state is None else state, self.forces(forces))

    def accelerations(
        self,
        e: Mapping[Key, float] | None = None,
        ed: Mapping[Key, float] | None = None,
        forces: Mapping[Key, float] | None = None,
    ) -> dict[Key, float]:
        r"""Return the accelerations of the dynamic deformations.

        Parameters
        ----------
        e, ed, forces
            Values, rates and applied forces (N, N m) of dynamic deformations by (element, component); forces are zero
            where not given, values and rates those of the file.

        Examples
        --------
        >>> model = read_text("PLHINGE 1 1 2\nFIX 1\nDYNE 1 1\nMASS 2 4.0\nESTIFF 1 8.0")
        >>> model.accelerations({(1, 1): 0.5}, {}, {(1, 1): 1.0})
        {(1, 1): -0.75}
        """
        motion = self.motion(self.state(e, ed), forces)
        return {
            key: float(motion.accelerations[i])
            for key, i in self.layout.e_index.items()
            if self.layout.e_is[i] == "dynamic"
        }

    def run(self, times: Array | None = None, forces: Mapping[Key, float] | None = None) -> list[Motion]:
        """Return the motion from the initial state under ``forces``, at ``times`` (k,), s (by default of TIMESTEP)."""
        d = self.description
        if times is None:
            times = np.linspace(0.0, d.duration, d.steps + 1) if d.steps else np.zeros(1)
        return simulate(
            self.rows, self.state(time=float(times[0])), np.asarray(times, dtype=float), self.forces(forces)
        )

    def linearise(self, motion: Motion | None = None) -> SmallMotions:
        """Return the small motions about a motion (the initial one), with the file's inputs and outputs."""
        return small_motions(self.rows, self.motion() if motion is None else motion)

    def equilibrium(self, factor: float = 1.0) -> Motion:
        """Return the equilibrium under the constant loads, times a factor without unit, and weight; at rest."""
        return equilibrium(self.rows, replace(self.state(), v=np.zeros_like(self.layout.drawn)), factor)

    def frequencies(self, motion: Motion | None = None) -> tuple[Array, Array]:
        """Return natural frequencies, rad/s, (q,), and modes (q, q), about a motion at rest (the equilibrium)."""
        return frequencies(self.rows, self.equilibrium() if motion is None else motion)

    def buckling(self) -> Buckling:
        """Return the factors of the given loads at which the drawn equilibrium buckles."""
        return buckling(self.rows, self.drawn())

    def listing(self) -> str:
        """Return a text that says what was understood of the file."""
        return listing(self.layout, self.rows)

    def by_element(self, values: Array) -> dict[int, list[float]]:
        """Return values of deformations (m,), of any unit, by element."""
        index, d = self.layout.e_index, self.description
        return {k: [float(values[index[k, i + 1]] + 0.0) for i in range(d.components(k))] for k in d.elements}

    def by_node(self, values: Array) -> dict[int, list[float]]:
        """Return values of coordinates (n,), of any unit, by node."""
        index, d = self.layout.x_index, self.description
        return {k: [float(values[index[k, i + 1]] + 0.0) for i in range(d.width(k))] for k in d.nodes}

    def names(self, kind: str) -> tuple[str, ...]:
        """Return the names of the coordinates and deformations of a kind, such as ``kinematic``."""
        return names_of(self.layout, kind)


def read_text(text: str, where: str = "model", mass: str = "consistent") -> Spacar:
    """Return the model that a text describes.

    Parameters
    ----------
    text
        A file of either dialect.
    where
        Its name in messages.
    mass
        ``consistent`` or ``lumped``.

    Raises
    ------
    InputError
        With file, line, keyword and reason.
    """
    source = parse(text, where)
    return Spacar(source, lay_out(describe(source), mass))


def read(path: str | Path, mass: str = "consistent") -> Spacar:
    """Return the model that a file describes, in either dialect.

    Parameters
    ----------
    path : str or Path
        Of the file.
    mass : str
        ``consistent`` or ``lumped``: how the mass of beams is spread.

    Raises
    ------
    InputError
        Where the file cannot be read; else with file, line, keyword and reason.
    """
    try:
        with Path(path).open("rb") as file:
            content = file.read(MOST_CHARACTERS + 1)  # more is refused; an endless device is not read on
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    return read_text(content.decode("utf-8-sig", errors="replace"), str(path), mass)
