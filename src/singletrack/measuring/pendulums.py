"""From raw measurements to the 25 parameters with their uncertainties.

Kooijman, Schwab and Meijaard (2008), Multibody System Dynamics 19:115-132; Moore (2012), Human control of a bicycle,
chapter 3. A calibration rod of known inertia gives the stiffness of the torsional pendulum; torsional periods give
moments about the vertical, in three or more orientations the tensor; a swing about the axle gives the moment about y;
plumb lines through the hanging point cross at the centre of mass.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array
from singletrack.errors import InputError, unknown_name
from singletrack.measuring.raw import orientations
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.symbols import GEOMETRY_SYMBOLS, MODEL_SYMBOLS, NAMES

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["CENTRE_FITS", "Measurement", "measure"]

#: How the centre of mass follows from plumb lines that do not quite cross in one point.
CENTRE_FITS = {
    "perpendicular": "least squares of the distances from the lines, which are what was measured",
    "vertical": "least squares of the vertical distances from the lines (reproduces Table 2 of Schwab and Kooijman)",
    "intersections": "mean of the lines' intersections, two by two (reproduces BicycleParameters)",
}
_STEP = 1e-30


@dataclass(frozen=True, eq=False)
class Measurement:
    """A measured bicycle.

    Attributes
    ----------
    bicycle : Bicycle
        With a standard deviation for every parameter that has one.
    names : tuple of str
        The parameters, in the order of the covariance.
    covariance : array, shape (n, n)
        Of the parameters, SI: they share measurements (the rod, gravity, the head angle), so that they correlate.
    lines : dict of str to array, shape (k, 3)
        For ``rear_frame`` and ``front_frame`` the plumb lines (s, c, d): s x + c z = d, in m.
    """

    bicycle: Bicycle
    names: tuple[str, ...]
    covariance: Array
    lines: dict[str, Array]


def measure(
    raw: Mapping[str, float],
    deviations: Mapping[str, float] | None = None,
    centre_fit: str = "perpendicular",
    *,
    name: str = "",
    source: str = "",
) -> Measurement:
    """Return a bicycle from raw measurements.

    Parameters
    ----------
    raw : mapping of str to float
        Every measurement by its name, in the units of :data:`singletrack.measuring.raw.RAW`.
    deviations : mapping of str to float, optional
        Standard deviations of measurements, in the same units.
    centre_fit : {"perpendicular", "vertical", "intersections"}
        How the centres of mass follow from the plumb lines (:data:`CENTRE_FITS`).
    name, source : str
        Of the bicycle.

    Raises
    ------
    InputError
        For an unknown fit, or measurements that no bicycle has.

    Notes
    -----
    Standard deviations are propagated with exact first derivatives (a complex step of 1e-30 in every measurement).
    """
    if centre_fit not in CENTRE_FITS:
        raise InputError(unknown_name("centre_fit", centre_fit, CENTRE_FITS))
    import numpy as np

    deviations = deviations or {}
    uncertain = [name for name, deviation in deviations.items() if deviation > 0]
    # One row for the value, one with an imaginary step in each uncertain measurement.
    stepped: dict[str, Any] = {name: np.full(len(uncertain) + 1, value, dtype=complex) for name, value in raw.items()}
    for row, measurement in enumerate(uncertain, start=1):
        stepped[measurement][row] += 1j * _STEP
    with np.errstate(all="ignore"):
        found, lines = _parameters(stepped, {letter: orientations(raw, letter) for letter in "BH"}, centre_fit)
    names = tuple(NAMES[symbol] for symbol in (*MODEL_SYMBOLS, *GEOMETRY_SYMBOLS) if symbol in found)
    table = np.stack([np.broadcast_to(found[symbol], len(uncertain) + 1) for symbol in found])
    order = [list(found).index(symbol) for symbol in (*MODEL_SYMBOLS, *GEOMETRY_SYMBOLS) if symbol in found]
    values, jacobian = table[order, 0].real, table[order, 1:].imag / _STEP
    scaled = jacobian * np.array([deviations[name] for name in uncertain])
    covariance = scaled @ scaled.T
    spread = np.sqrt(np.diag(covariance))
    fields: dict[str, Any] = dict(zip(names, map(float, values), strict=True))
    bicycle = Bicycle(
        name=name,
        description=f"Measured ({centre_fit} fit of the plumb lines)",
        source=source,
        standard_deviations={parameter: float(s) for parameter, s in zip(names, spread, strict=True) if s > 0},
        **fields,
    )
    return Measurement(bicycle, names, covariance, {name: line[:, 0].real for name, line in lines.items()})


def _parameters(
    m: dict[str, Any], hung: dict[str, list[str]], centre_fit: str
) -> tuple[dict[str, Any], dict[str, Array]]:
    """Return parameters by symbol from measurements by name, both as arrays over the steps."""
    import numpy as np

    p = {letter: m[letter] for letter in ("w", "g", "mR", "mF", "mB", "mH")}
    p["rR"], p["rF"] = (m[f"d{wheel}"] / (2 * math.pi * m[f"n{wheel}"]) for wheel in "RF")
    p["lam"] = math.pi / 2 - m["gamma"] * (math.pi / 180)
    p["c"] = (p["rF"] * np.sin(p["lam"]) - m["f"]) / np.cos(p["lam"])
    stiffness = _rod_inertia(m) * (2 * math.pi / m["TtP1"]) ** 2
    lines = {}
    for wheel in "RF":
        p[f"I{wheel}xx"] = _torsional(stiffness, m[f"Tt{wheel}1"])
        p[f"I{wheel}yy"] = _compound(m[f"m{wheel}"], m["g"], m[f"l{wheel}"], m[f"Tc{wheel}1"])
    hubs = {"B": (0.0 * p["w"], -p["rR"]), "H": (p["w"], -p["rF"])}
    for body, numbers in hung.items():
        beta = np.stack([p["lam"] - m[f"alpha{body}{i}"] * (math.pi / 180) for i in numbers])
        sin, cos = np.sin(beta), np.cos(beta)
        distance = np.stack([-m[f"a{body}{i}"] for i in numbers])
        x, z = _centre(sin, cos, distance, centre_fit)
        hub_x, hub_z = hubs[body]
        p[f"x{body}"], p[f"z{body}"] = hub_x + x, hub_z + z
        p[f"I{body}yy"] = _compound(m[f"m{body}"], m["g"], np.sqrt(x * x + z * z), m[f"Tc{body}1"])
        moments = np.stack([_torsional(stiffness, m[f"Tt{body}{i}"]) for i in numbers])
        columns = np.stack([cos * cos, -2 * sin * cos, sin * sin], axis=-1)
        tensor = _least_squares(columns, moments)
        p[f"I{body}xx"], p[f"I{body}xz"], p[f"I{body}zz"] = tensor
        line = np.stack([sin, cos, distance + sin * hub_x + cos * hub_z], axis=-1)
        lines["rear_frame" if body == "B" else "front_frame"] = line
    return {**p, **_geometry(m, p)}, lines


def _rod_inertia(m: dict[str, Any]) -> Any:
    """Return the moment of a solid rod about a diameter through its middle."""
    return m["mP"] / 12 * (3 * (m["dP"] / 2) ** 2 + m["lP"] ** 2)


def _torsional(stiffness: Any, period: Any) -> Any:
    return stiffness * (period / (2 * math.pi)) ** 2


def _compound(mass: Any, gravity: Any, length: Any, period: Any) -> Any:
    """Return the central moment of a body that swings about an axis at a distance ``length`` from its centre."""
    return (period / (2 * math.pi)) ** 2 * mass * gravity * length - mass * length**2


def _least_squares(columns: Any, right: Any) -> Any:
    """Solve columns (k, steps, n) x = right (k, steps) for x (n, steps), without conjugation (complex steps)."""
    import numpy as np

    normal = np.einsum("ksi,ksj->sij", columns, columns)
    rhs = np.einsum("ksi,ks->si", columns, right)
    if np.linalg.cond(normal[0].real) > 1e8:
        return np.full((columns.shape[-1], columns.shape[1]), np.nan + 0j)
    return np.linalg.solve(normal, rhs[..., None])[..., 0].T


def _centre(sin: Any, cos: Any, distance: Any, fit: str) -> Any:
    """Return the point (x, z) nearest to the lines sin x + cos z = distance, relative to the hub."""
    import numpy as np

    columns = np.stack([sin, cos], axis=-1)
    if fit == "perpendicular":
        return _least_squares(columns, distance)
    if fit == "vertical":
        return _least_squares(columns / cos[..., None], distance / cos)
    pairs = [(i, j) for j in range(len(sin)) for i in range(j)]
    return sum(_least_squares(columns[[i, j]], distance[[i, j]]) for i, j in pairs) / len(pairs)


def _geometry(m: dict[str, Any], p: dict[str, Any]) -> dict[str, Any]:
    """Return the frame geometry that seats a rider, as far as it was measured."""
    import numpy as np

    found: dict[str, Any] = {
        name: m[name] for name in ("hbb", "lcs", "lsp", "lst", "lamst", "lf", "wfh", "wrh") if name in m
    }
    if any(name not in m for name in ("whb", "LhbR", "LhbF", "hbb", "lst", "lamst")):
        return found
    # The grip, in the x-z plane, is where two circles about the hubs cross, above the wheels.
    half = m["whb"] / 2
    rear_square, front_square = m["LhbR"] ** 2 - half**2, m["LhbF"] ** 2 - half**2
    dx, dz = p["w"], p["rR"] - p["rF"]
    span = np.sqrt(dx**2 + dz**2)
    along = (span**2 + rear_square - front_square) / (2 * span)
    up = np.sqrt(rear_square - along**2)
    x, z = (along * dx + up * dz) / span, -p["rR"] + (along * dz - up * dx) / span
    top = -m["hbb"] - m["lst"] * np.sin(m["lamst"])
    # The steer axis at the height of the seat tube's top, where the stem begins (point 12 of the skeleton).
    axis_x = p["w"] + p["c"] + top * np.tan(p["lam"])
    stem = (top - z) / np.cos(p["lam"])
    found["ls"] = stem
    found["lhb"] = axis_x - stem * np.sin(p["lam"]) - x
    return found
