"""From raw measurements to the 25 parameters with their uncertainties."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError, unknown_name
from singletrack.measuring.geometry import handlebar_reference, seat_geometry, steer_geometry, wheel_radius
from singletrack.measuring.pendulums import CENTRE_FITS, hung_body, rod_stiffness, swung_wheel
from singletrack.measuring.quantities import check_measurements, is_split
from singletrack.mechanics.rigid import PlanarBody, combine
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.split_fork import SPLIT_SYMBOLS
from singletrack.parameters.symbols import GEOMETRY_SYMBOLS, MODEL_SYMBOLS, NAMES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Number

__all__ = ["Measurement", "measure"]

_STEP = 1e-30
_ENTRIES = ("m{}", "x{}", "z{}", "I{}xx", "I{}yy", "I{}zz", "I{}xz")
#: What the bodies are called in words, for their plumb lines.
_BODIES = {"B": "rear_frame", "H": "front_frame", "G": "handlebar", "S": "fork"}


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
        For ``rear_frame`` and ``front_frame`` (of a split fork ``handlebar`` and ``fork``) the plumb lines (s, c, d):
        s x + c z = d, in m.
    """

    bicycle: Bicycle
    names: tuple[str, ...]
    covariance: np.ndarray
    lines: dict[str, np.ndarray]


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
        Every measurement by its name, in the units of
        :data:`singletrack.measuring.quantities.MEASURED_QUANTITIES`.
    deviations : mapping of str to float, optional
        Standard deviations of measurements, in the same units.
    centre_fit : {"perpendicular", "vertical", "intersections"}
        How the centres of mass follow from the plumb lines (:data:`singletrack.measuring.pendulums.CENTRE_FITS`).
    name, source : str
        Of the bicycle.

    Raises
    ------
    InputError
        For an unknown fit, measurements that are unknown, missing or not allowed, or that no bicycle has; the error's
        parameters are the measurements, or the bicycle's parameters that came out wrong.

    Notes
    -----
    Standard deviations are propagated with exact first derivatives (a complex step of 1e-30 in every measurement).
    """
    if centre_fit not in CENTRE_FITS:
        raise InputError(unknown_name("centre_fit", centre_fit, CENTRE_FITS))
    deviations = deviations or {}
    check_measurements(raw, deviations)
    values, covariance, lines = _propagated(raw, deviations, centre_fit)
    symbols = list(values)
    spread = dict(zip(symbols, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    names = tuple(NAMES[symbol] for symbol in symbols if symbol in NAMES)
    parameters: dict[str, Any] = {NAMES[symbol]: value for symbol, value in values.items() if symbol in NAMES}
    bicycle = Bicycle(
        name=name,
        description=f"Measured ({centre_fit} fit of the plumb lines)",
        source=source,
        standard_deviations={NAMES.get(symbol, symbol): s for symbol, s in spread.items() if s > 0},
        extras={symbol: value for symbol, value in values.items() if symbol in SPLIT_SYMBOLS},
        **parameters,
    )
    own = len(names)
    return Measurement(bicycle, names, covariance[:own, :own], lines)


def _propagated(
    raw: Mapping[str, float], deviations: Mapping[str, float], centre_fit: str
) -> tuple[dict[str, float], np.ndarray, dict[str, np.ndarray]]:
    """Return values by symbol (parameters first), their covariance, and plumb lines by the body's name."""
    uncertain = [name for name, deviation in deviations.items() if deviation > 0]
    # One row for the value, one with an imaginary step in each uncertain measurement.
    stepped = {name: np.full(len(uncertain) + 1, value, dtype=complex) for name, value in raw.items()}
    for row, name in enumerate(uncertain, start=1):
        stepped[name][row] += 1j * _STEP
    with np.errstate(all="ignore"):
        found, lines = _by_symbol(stepped, centre_fit)
    symbols = [s for s in (*MODEL_SYMBOLS, *GEOMETRY_SYMBOLS, *SPLIT_SYMBOLS) if s in found]
    table = np.stack([np.broadcast_to(found[symbol], len(uncertain) + 1) for symbol in symbols])
    scaled = table[:, 1:].imag / _STEP * np.array([deviations[name] for name in uncertain])
    values = dict(zip(symbols, table[:, 0].real.tolist(), strict=True))
    return values, scaled @ scaled.T, {_BODIES[letter]: line[:, 0].real for letter, line in lines.items()}


def _by_symbol(m: Mapping[str, np.ndarray], centre_fit: str) -> tuple[dict[str, Number], dict[str, np.ndarray]]:
    """Return parameters by symbol from measurements by name, both (k,) over the steps, and plumb lines by body."""
    rear, front = wheel_radius(m, "R"), wheel_radius(m, "F")
    base, tilt, trail = steer_geometry(m, rear, front)
    p: dict[str, Number] = {"w": base, "c": trail, "lam": tilt, "g": m["g"], "rR": rear, "rF": front}
    stiffness = rod_stiffness(m)
    for wheel in "RF":
        p[f"m{wheel}"] = m[f"m{wheel}"]
        p[f"I{wheel}xx"], p[f"I{wheel}yy"] = swung_wheel(m, wheel, stiffness)
    references = {"B": (0.0 * base, -rear)}
    if is_split(m):
        x, z = handlebar_reference(m, tilt)
        references |= {"G": (base + x, z - front), "S": (base, -front)}
    else:
        references["H"] = (base, -front)
    bodies: dict[str, PlanarBody] = {}
    lines: dict[str, np.ndarray] = {}
    for letter, reference in references.items():
        bodies[letter], lines[letter] = hung_body(m, letter, reference, tilt, stiffness, centre_fit)
    if "G" in bodies:
        bodies["H"] = PlanarBody.of(combine([bodies["G"].body(), bodies["S"].body()]))
    for letter, body in bodies.items():
        p |= {name.format(letter): entry for name, entry in zip(_ENTRIES, body, strict=True)}
    return {**p, **seat_geometry(m, p)}, lines
