"""Designs side by side: what differs, critical speeds, modes at given speeds, handling measures, with uncertainties."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.quantities import QUANTITIES, quantity
from singletrack.errors import InputError
from singletrack.linear import CriticalSpeeds, critical_speeds, modes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.analysis.designs import Design
    from singletrack.arrays import ArrayLike

__all__ = ["Comparison", "Measure", "compare"]


@dataclass(frozen=True)
class Measure:
    """One number of each of the designs.

    Attributes
    ----------
    name, unit : str
    values : tuple of float
        One for each design; NaN where it does not exist.
    deviations : tuple of float
        Their standard deviations; NaN where no parameter has one.
    difference_deviations : tuple of float
        Of the differences from the first design: what both have from the same rider cancels.
    source : str
        Who defines it.
    """

    name: str
    unit: str
    values: tuple[float, ...]
    deviations: tuple[float, ...] = ()
    difference_deviations: tuple[float, ...] = ()
    source: str = ""


@dataclass(frozen=True, eq=False)
class Comparison:
    """What two or more designs have that the others have not.

    Attributes
    ----------
    titles : tuple of str
    parameters : tuple of Measure
        Those that differ.
    critical : tuple of CriticalSpeeds
    measures : tuple of Measure
    """

    titles: tuple[str, ...]
    parameters: tuple[Measure, ...]
    critical: tuple[CriticalSpeeds, ...]
    measures: tuple[Measure, ...]

    def to_dict(self) -> dict[str, Any]:
        """Return everything in SI for JSON; what does not exist is None."""

        def listed(measure: Measure) -> dict[str, Any]:
            fields = ("values", "deviations", "difference_deviations")
            numbers = {f: [x if np.isfinite(x) else None for x in getattr(measure, f)] for f in fields}
            return {"name": measure.name, "unit": measure.unit, "source": measure.source, **numbers}

        return {
            "designs": list(self.titles),
            "parameters": [listed(one) for one in self.parameters],
            "critical_speeds": [one.to_dict() for one in self.critical],
            "measures": [listed(one) for one in self.measures],
        }


def compare(designs: Sequence[Design], speeds: ArrayLike = (5.0,)) -> Comparison:
    """Return designs side by side.

    Parameters
    ----------
    designs : sequence of Design
        Two or more, single ones.
    speeds : array, shape (s,)
        At which modes and handling measures are told, m/s.

    Raises
    ------
    InputError
        For fewer than two designs.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.designs import Design
    >>> found = compare([Design.of(load_bicycle(name)) for name in ("stratos", "browser")])
    >>> [measure.name for measure in found.measures][:3]
    ['weave speed', 'capsize speed', 'Re weave at 5 m/s']
    """
    if len(designs) < 2:
        raise InputError(f"compare: found {len(designs)} design, must be two or more")
    v = np.atleast_1d(np.asarray(speeds, dtype=float))
    rows = [_Uncertain(design) for design in designs]
    measures = [*_critical_measures(rows), *(m for speed in v for m in _mode_measures(rows, float(speed)))]
    measures += [m for speed in v for m in _handling_measures(rows, float(speed))]
    measures += _geometry_measures(designs)
    short = [design.bicycle.name or design.title for design in designs]
    return Comparison(
        tuple(short if len(set(short)) == len(short) else (design.title for design in designs)),
        tuple(_differing(designs)),
        tuple(row.critical for row in rows),
        tuple(measures),
    )


class _Uncertain:
    """A design with its derivatives with respect to the parameters that have standard deviations."""

    def __init__(self, design: Design) -> None:
        own = design.values()
        self.of_bicycle = {n: float(s) for n, s in design.bicycle.standard_deviations.items() if n in own and s > 0}
        theirs = {} if design.rider is None else design.rider.standard_deviations
        self.of_rider = {n: float(s) for n, s in theirs.items() if n in own and s > 0}
        self.design = design
        self.slopes = derivatives_of(design, (*self.of_bicycle, *self.of_rider))
        self.model = self.slopes.model
        self.critical = critical_speeds(self.model)

    @property
    def deviations(self) -> np.ndarray:
        return np.array([*self.of_bicycle.values(), *self.of_rider.values()])

    def scaled(self, gradient: np.ndarray) -> np.ndarray:
        """Return what each parameter's standard deviation does (k,)."""
        effects: np.ndarray = gradient * self.deviations
        return effects


def _measure(name: str, unit: str, rows: Sequence[_Uncertain], found: Sequence[Any], source: str = "") -> Measure:
    """Return a measure from value and effects of the deviations (k,), of each design; None where there is none."""
    values = tuple(float("nan") if one is None else float(one[0]) for one in found)
    known = all(len(row.deviations) for row in rows)
    if not known:
        return Measure(name, unit, values, (float("nan"),) * len(rows), (float("nan"),) * len(rows), source)
    deviations = tuple(float("nan") if one is None else float(np.linalg.norm(one[1])) for one in found)
    apart = tuple(_apart(rows[0], found[0], row, one) for row, one in zip(rows, found, strict=True))
    return Measure(name, unit, values, deviations, apart, source)


def _apart(first: _Uncertain, a: Any, second: _Uncertain, b: Any) -> float:
    """Return the standard deviation of a difference; the parameters of a rider are those of one and the same rider."""
    if a is None or b is None:
        return float("nan")
    if first is second:
        return 0.0
    n, m = len(first.of_bicycle), len(second.of_bicycle)
    same = first.design.rider is not None and second.design.rider is not None
    same = same and first.design.rider.name == second.design.rider.name  # type: ignore[union-attr]
    own = np.concatenate([a[1][:n], b[1][:m]])
    if not same:
        return float(np.linalg.norm(np.concatenate([own, a[1][n:], b[1][m:]])))
    effects = dict.fromkeys((*first.of_rider, *second.of_rider), 0.0)
    for name, effect in zip(first.of_rider, a[1][n:], strict=True):
        effects[name] += float(effect)
    for name, effect in zip(second.of_rider, b[1][m:], strict=True):
        effects[name] -= float(effect)
    return float(np.linalg.norm([*own, *effects.values()]))


def _critical_measures(rows: Sequence[_Uncertain]) -> list[Measure]:
    measures = []
    for kind in ("weave", "capsize"):
        speeds = [np.asarray(getattr(row.critical, kind)) for row in rows]
        for k in range(max(map(len, speeds))):
            found = [
                (v[k], row.scaled(row.slopes.critical_speeds(v[k : k + 1], kind)[0])) if k < len(v) else None
                for row, v in zip(rows, speeds, strict=True)
            ]
            measures.append(_measure(f"{kind} speed{f' {k + 1}' if k else ''}", "m/s", rows, found))
    return measures


def _mode_measures(rows: Sequence[_Uncertain], speed: float) -> list[Measure]:
    """Return real parts of all modes, and frequency and damping ratio of weave."""
    found: dict[tuple[str, str], list[Any]] = {}
    for place, row in enumerate(rows):
        own = modes(row.model, speed)
        roots = own.eigenvalues[0]
        gradients = row.slopes.eigenvalues(speed, roots)
        for column, mode in enumerate(own.names):
            s, ds = roots[column], gradients[column]
            if s.imag < 0 or (column and own.names[column - 1] == mode and roots[column - 1].imag != 0):
                continue
            second = " 2" if column and own.names[column - 1] == mode else ""
            entries = {(f"Re {mode}{second} at {speed:g} m/s", "1/s"): (s.real, row.scaled(ds.real))}
            if s.imag > 0:
                size = abs(s)
                growth = (s.conjugate() * ds).real / size
                entries[f"frequency of {mode} at {speed:g} m/s", "Hz"] = (
                    s.imag / (2 * np.pi),
                    row.scaled(ds.imag) / (2 * np.pi),
                )
                ratio = -ds.real / size + s.real * growth / size**2
                entries[f"damping ratio of {mode} at {speed:g} m/s", ""] = (-s.real / size, row.scaled(ratio))
            for key, entry in entries.items():
                found.setdefault(key, [None] * len(rows))[place] = entry
    return [_measure(*key, rows, entries) for key, entries in found.items()]


def _handling_measures(rows: Sequence[_Uncertain], speed: float) -> list[Measure]:
    """Return what the hands feel in a slow steady turn, from the linear equations."""
    found = []
    for row in rows:
        bicycle = row.design.bicycle
        K = np.asarray(row.model.stiffness(speed))
        others = [i for i in range(row.model.freedoms) if i != 1]
        # Per steer angle: lean (and further coordinates) from the equations that nobody works on, torque from steer.
        motion = np.linalg.solve(K[np.ix_(others, others)], -K[others, 1])
        torque = K[1, 1] + K[1, others] @ motion
        acceleration = speed**2 * np.cos(float(bicycle.steer_axis_tilt)) / float(bicycle.wheel_base)
        found.append(torque / acceleration)
    values = tuple(float(value) for value in found)
    none = (float("nan"),) * len(rows)
    return [
        Measure(
            f"acceleration index at {speed:g} m/s",
            "N m/(m/s²)",
            values,
            none,
            none,
            "Cossalter, Motorcycle Dynamics (2006): steer torque over lateral acceleration in a steady turn",
        )
    ]


def _geometry_measures(designs: Sequence[Design]) -> list[Measure]:
    none = (float("nan"),) * len(designs)
    measures = []
    for name, (unit, meaning, _) in QUANTITIES.items():
        bare = name in {"fork_offset", "mechanical_trail", "head_angle"}
        if bare or not any(design.bicycle.missing_geometry() for design in designs):
            values = tuple(float(np.real(quantity(design, name))) for design in designs)
            measures.append(Measure(name, unit, values, none, none, meaning))
    return measures


def _differing(designs: Sequence[Design]) -> list[Measure]:
    """Return the parameters that are not alike in all designs."""
    names = dict.fromkeys(name for design in designs for name in design.values())
    differing = []
    for name in names:
        values = tuple(float(design.values().get(name, np.nan)) for design in designs)
        if not np.allclose(values, values[0], rtol=1e-12, atol=0.0, equal_nan=True):
            unit = next(design.units()[name] for design in designs if name in design.units())
            deviations = tuple(_deviation(design, name) for design in designs)
            differing.append(Measure(name, unit, values, deviations))
    return differing


def _deviation(design: Design, name: str) -> float:
    for record in (design.bicycle, design.rider):
        if record is not None and name in record.standard_deviations:
            return float(record.standard_deviations[name])
    return float("nan")
