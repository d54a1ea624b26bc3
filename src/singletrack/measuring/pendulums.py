"""What pendulums and plumb lines say of a body: centre of mass and moments. Kernels; complex steps pass through.

Kooijman, Schwab and Meijaard (2008), Multibody System Dynamics 19:115-132; Moore (2012), Human control of a bicycle,
chapter 3. A calibration rod of known inertia gives the stiffness of the torsional pendulum; torsional periods give
moments about the vertical, in three or more orientations the tensor; a swing about the axle gives the moment about y;
plumb lines through the hanging point cross at the centre of mass.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from singletrack.measuring.quantities import orientations
from singletrack.mechanics.rigid import PlanarBody

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["CENTRE_FITS", "hung_body", "rod_stiffness", "swung_wheel"]

#: How the centre of mass follows from plumb lines that do not quite cross in one point.
CENTRE_FITS = {
    "perpendicular": "least squares of the distances from the lines, which are what was measured",
    "vertical": "least squares of the vertical distances from the lines (reproduces Table 2 of Schwab and Kooijman)",
    "intersections": "mean of the lines' intersections, two by two (reproduces BicycleParameters)",
}


def rod_stiffness(m: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the stiffness (k,) in N m/rad of the torsional pendulum, from measurements ``m`` (k,) of a solid rod."""
    inertia = m["mP"] / 12 * (3 * (m["dP"] / 2) ** 2 + m["lP"] ** 2)  # about a diameter through its middle
    stiffness: np.ndarray = inertia * (2 * math.pi / m["TtP1"]) ** 2
    return stiffness


def swung_wheel(m: Mapping[str, np.ndarray], wheel: str, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the moments of a wheel about a diameter and about its axle, each (k,), in kg m^2.

    Parameters
    ----------
    m : mapping of str to array, shape (k,)
        Measurements.
    wheel : {"R", "F"}
    stiffness : array, shape (k,)
        Of the torsional pendulum.
    """
    across = _torsional(stiffness, m[f"Tt{wheel}1"])
    return across, _compound(m[f"m{wheel}"], m["g"], m[f"l{wheel}"], m[f"Tc{wheel}1"])


def hung_body(
    m: Mapping[str, np.ndarray],
    letter: str,
    reference: tuple[np.ndarray, np.ndarray],
    tilt: np.ndarray,
    stiffness: np.ndarray,
    centre_fit: str,
) -> tuple[PlanarBody, np.ndarray]:
    """Return a body that was hung in several orientations, and its plumb lines.

    Parameters
    ----------
    m : mapping of str to array, shape (k,)
        Measurements, in the units of :data:`singletrack.measuring.quantities.MEASURED_QUANTITIES`.
    letter : str
        Of the body in their names.
    reference : tuple of array, shape (k,)
        (x, z) in m of the point that distances to the plumb lines are measured from, about which it also swings.
    tilt : array, shape (k,)
        Of the steer axis in rad.
    stiffness : array, shape (k,)
        Of the torsional pendulum in N m/rad.
    centre_fit : str
        A key of :data:`CENTRE_FITS`.

    Returns
    -------
    PlanarBody
        Entries of shape (k,).
    array, shape (n, k, 3)
        The n plumb lines (s, c, d): s x + c z = d, in m.
    """
    numbers = orientations(m, letter)
    beta = np.stack([tilt - m[f"alpha{letter}{i}"] * (math.pi / 180) for i in numbers])
    sin, cos = np.sin(beta), np.cos(beta)
    distance = np.stack([-m[f"a{letter}{i}"] for i in numbers])
    x, z = _centre(sin, cos, distance, centre_fit)
    mass = m[f"m{letter}"]
    sideways = _compound(mass, m["g"], np.sqrt(x * x + z * z), m[f"Tc{letter}1"])
    moments = np.stack([_torsional(stiffness, m[f"Tt{letter}{i}"]) for i in numbers])
    xx, xz, zz = _least_squares(np.stack([cos * cos, -2 * sin * cos, sin * sin], axis=-1), moments)
    lines = np.stack([sin, cos, distance + sin * reference[0] + cos * reference[1]], axis=-1)
    return PlanarBody(mass, reference[0] + x, reference[1] + z, xx, sideways, zz, xz), lines


def _torsional(stiffness: np.ndarray, period: np.ndarray) -> np.ndarray:
    moment: np.ndarray = stiffness * (period / (2 * math.pi)) ** 2
    return moment


def _compound(mass: np.ndarray, gravity: np.ndarray, length: np.ndarray, period: np.ndarray) -> np.ndarray:
    """Return the central moment of a body that swings about an axis at a distance ``length`` from its centre."""
    moment: np.ndarray = (period / (2 * math.pi)) ** 2 * mass * gravity * length - mass * length**2
    return moment


def _least_squares(columns: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Solve columns (n, k, p) x = right (n, k) for x (p, k), without conjugation (complex steps)."""
    normal = np.einsum("ksi,ksj->sij", columns, columns)
    rhs = np.einsum("ksi,ks->si", columns, right)
    if not np.isfinite(normal).all() or np.linalg.cond(normal[0].real) > 1e8:
        return np.full((columns.shape[-1], columns.shape[1]), np.nan + 0j)
    solution: np.ndarray = np.linalg.solve(normal, rhs[..., None])[..., 0].T
    return solution


def _centre(sin: np.ndarray, cos: np.ndarray, distance: np.ndarray, fit: str) -> np.ndarray:
    """Return the point (x, z), shape (2, k), nearest to the lines sin x + cos z = distance, relative to the hub."""
    columns = np.stack([sin, cos], axis=-1)
    if fit == "perpendicular":
        return _least_squares(columns, distance)
    if fit == "vertical":
        return _least_squares(columns / cos[..., None], distance / cos)
    pairs = [(i, j) for j in range(len(sin)) for i in range(j)]
    crossings = [_least_squares(columns[[i, j]], distance[[i, j]]) for i, j in pairs]
    mean: np.ndarray = np.stack(crossings).sum(axis=0) / len(pairs)
    return mean
