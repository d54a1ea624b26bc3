"""Tyres that slip sideways, instead of wheels that roll without: linear side forces with relaxation.

The side force Y of a tyre follows its slip angle a and camber c with a delay over the relaxation length s:

    s Y' / v + Y = -C a + D c

with the cornering stiffness C and the camber stiffness D. The bicycle then keeps its sideways velocity u (of the rear
contact, across the rear frame) and yaw rate r as motions of their own. For C to infinity rolling comes back.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import Array
from singletrack.closed_form.coefficients import coefficients
from singletrack.closed_form.hinged import Moving, moving_bodies
from singletrack.errors import InputError

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = ["Tyre", "TyreModel", "tyre_model"]


@dataclass(frozen=True)
class Tyre:
    """Side force of a tyre.

    Attributes
    ----------
    cornering
        Cornering stiffness at its load, N/rad.
    camber
        Camber stiffness at its load, N/rad: about the load itself for a thin tyre.
    relaxation
        Relaxation length, m; zero: the force follows at once.

    Raises
    ------
    InputError
        For a number that is not allowed.

    Examples
    --------
    >>> Tyre(cornering=9e3, camber=800.0, relaxation=0.1).relaxation
    0.1
    """

    cornering: float
    camber: float = 0.0
    relaxation: float = 0.0

    def __post_init__(self) -> None:
        for name, least in (("cornering", 1e-9), ("camber", 0.0), ("relaxation", 0.0)):
            value = getattr(self, name)
            if not (isinstance(value, (int, float)) and np.isfinite(value) and value >= least):
                allowed = "a finite number greater than zero" if least else "a finite number, zero or more"
                raise InputError(f"tyre: {name} = {value!r}, must be {allowed}", parameters=(name,), found=value)


@dataclass(frozen=True, eq=False)
class TyreModel:
    """A bicycle on tyres: ``M s' + (C0 + v C1) s + (S0 + g K0) q = forces``, s = (u, r, q'), q = (lean, steer, ...).

    Attributes
    ----------
    M, C0, C1
        Matrices (n + 2, n + 2).
    S0, K0, gravity
        Springs, gravity's stiffness over g (n, n), and g in m/s^2.
    front_contact
        Sideways velocity of the front contact by s, (n + 2,).
    heading, camber
        Of the front wheel by q, (n,).
    front, rear
        The tyres.
    coordinates
        Names of q.
    """

    M: Array
    C0: Array
    C1: Array
    S0: Array
    K0: Array
    gravity: float
    front_contact: Array
    heading: Array
    camber: Array
    front: Tyre
    rear: Tyre
    coordinates: tuple[str, ...]

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states of :meth:`state_matrix`."""
        rates = tuple(f"{name} rate" for name in self.coordinates)
        forces = [f"{end} side force" for end, tyre in (("rear", self.rear), ("front", self.front)) if tyre.relaxation]
        return (*self.coordinates, "sideways velocity", "yaw rate", *rates, *forces)

    def state_matrix(self, speeds: Array) -> Array:
        """Return the matrices (k, m, m) of the first-order system at speeds (k,) above zero, m/s.

        Raises
        ------
        InputError
            For a speed of zero or less: slip is a ratio to the speed.
        """
        v = np.atleast_1d(np.asarray(speeds, dtype=float))
        if not np.all(np.isfinite(v)) or np.any(v <= 0):
            wrong = v[~(np.isfinite(v) & (v > 0))][0]
            raise InputError(
                f"speeds: found {wrong:g} m/s, must be finite and greater than zero on tyres", parameters=("speeds",)
            )
        n, m = len(self.coordinates), len(self.states)
        A = np.zeros((len(v), m, m))
        A[:, :n, n + 2 : 2 * n + 2] = np.eye(n)
        moving = slice(n, 2 * n + 2)
        rates = -(self.C0 + v[:, None, None] * self.C1)
        places = np.zeros((n + 2, n))
        places[2:] = -(self.S0 + self.gravity * self.K0)
        A[:, moving, moving], A[:, moving, :n] = rates, places
        self._add_tyres(A, v)
        A[:, moving] = np.linalg.solve(np.broadcast_to(self.M, (len(v), n + 2, n + 2)), A[:, moving])
        return A

    def _add_tyres(self, A: Array, v: Array) -> None:
        """Add the side forces, or their rates where they relax, to the equations before division by the mass."""
        n = len(self.coordinates)
        rear = np.eye(n + 2)[0]
        place = 2 * n + 2
        for tyre, contact, heading, camber in (
            (self.rear, rear, np.zeros(n), np.eye(n)[0]),
            (self.front, self.front_contact, self.heading, self.camber),
        ):
            # Y_steady = slip of s and of q; slip angle = contact velocity / v - heading.
            by_s = -tyre.cornering / v[:, None] * contact
            by_q = tyre.cornering * heading + tyre.camber * camber
            if tyre.relaxation:
                A[:, n : 2 * n + 2, place] += contact
                ratio = v[:, None] / tyre.relaxation
                A[:, place, n : 2 * n + 2], A[:, place, :n] = ratio * by_s, ratio * by_q
                A[:, place, place] = -ratio[:, 0]
                place += 1
            else:
                A[:, n : 2 * n + 2, n : 2 * n + 2] += contact[:, None] * by_s[:, None, :]
                A[:, n : 2 * n + 2, :n] += contact[:, None] * by_q

    def eigenvalues(self, speeds: Array) -> Array:
        """Return the eigenvalues (k, m), 1/s, sorted by real, then imaginary part.

        Parameters
        ----------
        speeds : array, shape (k,)
            In m/s.
        """
        return np.sort_complex(np.linalg.eigvals(self.state_matrix(speeds)))


def tyre_model(
    bicycle: Bicycle,
    front: Tyre,
    rear: Tyre,
    rider: Rider | None = None,
    options: Options | str = "rigid",
) -> TyreModel:
    """Return the linear model of a bicycle on tyres, rigid or with a soft frame and fork, with or without rider.

    Parameters
    ----------
    bicycle, rider, options
        As for :func:`coefficients`; one design.
    front, rear
        The tyres.

    Raises
    ------
    InputError, PostureError
        As :func:`coefficients`; for a batch of designs.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> model = tyre_model(load_bicycle("benchmark"), Tyre(9e3, 300.0, 0.1), Tyre(9e3, 600.0, 0.1))
    >>> model.states
    ('lean', 'steer', 'sideways velocity', 'yaw rate', 'lean rate', 'steer rate', 'rear side force', 'front side force')
    >>> model.eigenvalues(5.0).shape
    (1, 8)
    """
    rolling = coefficients(bicycle, rider, options)
    if rolling.shape:
        raise InputError("tyres take one design at a time, numbers are needed", parameters=("bicycle",))
    n = len(rolling.coordinates)
    parts = moving_bodies(bicycle, rider, options, rolling.coordinates[1:])
    M, C1 = _free(parts, n)
    C0 = np.zeros_like(M)
    C0[2:, 2:] = rolling.C0
    contact = np.array([1.0, float(parts.base), 0.0, *parts.eta])
    heading, lean = np.array([0.0, *parts.heading]), np.array([1.0, *parts.camber])
    return TyreModel(
        M,
        C0,
        C1,
        np.asarray(rolling.S0),
        np.asarray(rolling.K0),
        float(rolling.gravity),
        contact,
        heading,
        lean,
        front,
        rear,
        rolling.coordinates,
    )


def _free(parts: Moving, n: int) -> tuple[Array, Array]:
    """Return M and C1 (n + 2, n + 2) of the bicycle that nothing holds sideways: sideways, yaw, lean, freedoms."""
    # parts.pairs: lean, freedoms, yaw. Reordered, with sideways motion before them.
    order = [n, *range(n)]
    momenta = np.array([parts.moment_x, *parts.lateral])
    M = np.zeros((n + 2, n + 2))
    M[0, 0], M[0, 1:], M[1:, 0] = parts.mass, momenta, momenta
    M[1:, 1:] = parts.pairs[np.ix_(order, order)]
    C1 = np.zeros_like(M)
    C1[:, 1] = M[:, 0]  # the sideways acceleration is u' + v r
    for spin, turns in parts.spins:
        turn = np.concatenate([[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]], turns])
        C1 += spin * (np.outer(turn[:, 0], turn[:, 2]) - np.outer(turn[:, 2], turn[:, 0]))
    return M, C1
