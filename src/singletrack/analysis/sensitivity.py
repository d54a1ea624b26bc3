"""Which parameter matters: exact derivatives of results, and what a change that one can make does to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.analysis.derivatives import Derivatives, derivatives_of
from singletrack.analysis.ends import critical_ends
from singletrack.errors import InputError, unknown_name
from singletrack.linear import critical_speeds, modes
from singletrack.model.record import UNITS
from singletrack.parameters.steps import step_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.analysis.designs import Design
    from singletrack.arrays import ArrayLike
    from singletrack.model import LinearModel

__all__ = ["CHANGES", "KINDS", "Sensitivity", "sensitivity"]

#: What results can be asked about, and by which changes parameters are ranked.
KINDS = ("critical speeds", "eigenvalues", "matrices")
CHANGES = ("step", "deviation", "percent")


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """How q results of a design depend on k parameters.

    Attributes
    ----------
    parameters, units : tuple of str
        The k parameters and their SI units.
    changes : array, shape (k,)
        The change of each that it is ranked by, SI.
    results, result_units : tuple of str
        The q results, such as "weave speed", and their units.
    values : array, shape (q,)
        Of the results.
    derivatives : array, shape (q, k)
        Exact, per SI unit.
    ends : array, shape (q, k, 2)
        The results after the change down and up, computed anew; NaN where a critical speed has ceased to exist, or
        where no such design can.
    folds : array, shape (q, k, 2)
        The change at which a critical speed ceases to exist; NaN where it does not.
    impossible : bool array, shape (k, 2)
        Where the changed design cannot exist.
    """

    parameters: tuple[str, ...]
    units: tuple[str, ...]
    changes: np.ndarray
    results: tuple[str, ...]
    result_units: tuple[str, ...]
    values: np.ndarray
    derivatives: np.ndarray
    ends: np.ndarray
    folds: np.ndarray
    impossible: np.ndarray

    def ranked(self, result: str) -> np.ndarray:
        """Return the places (k,) of the parameters, the one whose change matters most first.

        A parameter whose change makes the result cease to exist comes before all others.

        Parameters
        ----------
        result : str
            One of :attr:`results`.

        Raises
        ------
        InputError
            If there is no such result.
        """
        row = self.row(result)
        effect = np.abs(self.derivatives[row] * self.changes)
        moved = np.nanmax(np.abs(self.ends[row] - self.values[row]), axis=-1, initial=0.0)
        size = np.fmax(effect, moved)
        ceases = np.isfinite(self.folds[row]).any(axis=-1)
        return np.lexsort((-size, ~ceases))

    def row(self, result: str) -> int:
        """Return the place of a result.

        Parameters
        ----------
        result : str

        Raises
        ------
        InputError
            If there is no such result.
        """
        if result not in self.results:
            raise InputError(unknown_name("result", result, self.results))
        return self.results.index(result)

    def to_dict(self) -> dict[str, Any]:
        """Return everything in SI for JSON; what does not exist is None."""

        def listed(values: np.ndarray) -> Any:
            return np.where(np.isfinite(values), values.astype(object), np.array(None)).tolist()

        return {
            "parameters": list(self.parameters),
            "units": list(self.units),
            "changes": self.changes.tolist(),
            "results": list(self.results),
            "result_units": list(self.result_units),
            "values": self.values.tolist(),
            "derivatives": listed(self.derivatives),
            "ends": listed(self.ends),
            "folds": listed(self.folds),
        }


def sensitivity(
    design: Design,
    kinds: Sequence[str] = ("critical speeds",),
    speeds: ArrayLike = (),
    names: Sequence[str] = (),
    by: str = "step",
) -> Sensitivity:
    """Return how results of a design depend on its parameters.

    Parameters
    ----------
    design : Design
        A single one.
    kinds : sequence of {"critical speeds", "eigenvalues", "matrices"}
    speeds : array, shape (s,)
        At which eigenvalues are asked for, m/s.
    names : sequence of str
        Parameters; by default all of bicycle, rider and posture.
    by : {"step", "deviation", "percent"}
        The change that parameters are ranked by: one that can be made (10 mm, 1 deg, 1 kg, ...), their standard
        deviation, or a hundredth of their value.

    Raises
    ------
    InputError
        For an unknown name, or if no parameter has a standard deviation.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> from singletrack.analysis.designs import Design
    >>> found = sensitivity(Design.of(load_bicycle("benchmark")), names=["trail", "steer_axis_tilt"])
    >>> found.results, found.derivatives.round(2).tolist()
    (('weave speed', 'capsize speed'), [[11.48, 4.18], [28.89, 4.31]])
    """
    for kind in kinds:
        if kind not in KINDS:
            raise InputError(unknown_name("kind of result", kind, KINDS))
    changes = _changes(design, tuple(names), by)
    parameters = tuple(changes)
    sizes = np.array(list(changes.values()))
    slopes = derivatives_of(design, parameters)
    parts = []
    if "critical speeds" in kinds:
        parts.append(_of_critical_speeds(design, slopes, sizes))
    if "eigenvalues" in kinds:
        parts.append(_of_eigenvalues(design, slopes, sizes, np.atleast_1d(np.asarray(speeds, dtype=float))))
    if "matrices" in kinds:
        parts.append(_of_matrices(design, slopes, sizes))
    units = design.units()
    results, result_units = (tuple(name for part in parts for name in part[i]) for i in (0, 1))
    values, rows, ends, folds = (np.concatenate([part[i] for part in parts]) for i in (2, 3, 4, 5))
    impossible = _impossible(design, parameters, sizes)
    return Sensitivity(
        parameters,
        tuple(units[name] for name in parameters),
        sizes,
        results,
        result_units,
        values,
        rows,
        ends,
        folds,
        impossible,
    )


def _changes(design: Design, names: tuple[str, ...], by: str) -> dict[str, float]:
    """Return the parameters and the change of each."""
    if by not in CHANGES:
        raise InputError(unknown_name("change", by, CHANGES))
    values, units = design.values(), design.units()
    for name in names:
        design.unit(name)
    wanted = names or tuple(values)
    if by == "step":  # springs and dampers no softer than none
        sizes = {name: step_of(units[name]).size for name in wanted}
        sprung = {name for name in wanted if name.startswith(("spring at ", "damper at "))}
        return {name: min(size, float(values[name])) if name in sprung else size for name, size in sizes.items()}
    if by == "percent":
        return {name: 0.01 * abs(float(values[name])) for name in wanted if values[name] != 0}
    deviations = design.deviations()
    found = {name: deviations[name] for name in wanted if deviations.get(name, 0) > 0}
    if not found:
        raise InputError("by deviation: no parameter has a standard deviation; rank by step or percent")
    return found


def _both_ways(design: Design, names: tuple[str, ...], changes: np.ndarray) -> LinearModel:
    """Return the models (2 k,) of each parameter changed down and up."""
    shifts = np.repeat(np.diag(changes), 2, axis=0) * np.tile([-1.0, 1.0], len(names))[:, None]
    return design.shifted(names, shifts).model().broadcast_to((2 * len(names),))


def _impossible(design: Design, names: tuple[str, ...], changes: np.ndarray) -> np.ndarray:
    result: np.ndarray = ~_both_ways(design, names, changes).valid.reshape(-1, 2)
    return result


_Part = tuple[list[str], list[str], np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def _of_critical_speeds(design: Design, slopes: Derivatives, changes: np.ndarray) -> _Part:
    found = critical_speeds(slopes.model)
    names: list[str] = []
    values, rows = [], []
    for kind, speeds, words in (
        ("weave", found.weave_speeds, found.weave_modes),
        ("capsize", found.capsize_speeds, found.capsize_modes),
    ):
        there = np.isfinite(speeds)
        for word in words[there]:
            count = sum(name.startswith(f"{word} speed") for name in names)
            names.append(f"{word} speed" + (f" {count + 1}" if count else ""))
        values.append(speeds[there])
        rows.append(slopes.critical_speeds(speeds[there], kind))
    ends = critical_ends(design, slopes.names, changes)
    return names, ["m/s"] * len(names), np.concatenate(values), np.concatenate(rows), ends.speeds, ends.folds


def _of_eigenvalues(design: Design, slopes: Derivatives, changes: np.ndarray, speeds: np.ndarray) -> _Part:
    if not len(speeds):
        raise InputError("eigenvalues: at which speeds? Give at least one")
    own = modes(slopes.model, speeds)
    rows = slopes.eigenvalues(own.speeds[:, None], own.eigenvalues)  # (s, 2 n, k)
    moved = modes(_both_ways(design, slopes.names, changes), speeds).eigenvalues  # (2 k, s, 2 n)
    names, values, gradients, ends = [], [], [], []
    for j, column in ((j, c) for j in range(len(speeds)) for c in range(len(own.names))):
        root, mode = own.eigenvalues[j, column], own.names[column]
        if root.imag < 0:
            continue  # the conjugate of the one before
        twin = column > 0 and own.names[column - 1] == mode
        for part, take in (("Re", np.real), ("Im", np.imag)):
            if part == "Im" and root.imag == 0:
                continue
            names.append(f"{part} {mode}{' 2' if twin else ''} at {speeds[j]:g} m/s")
            values.append(take(root))
            gradients.append(take(rows[j, column]))
            ends.append(take(moved[:, j, column]).reshape(-1, 2))
    never = np.full((len(names), len(changes), 2), np.nan)
    return names, ["1/s"] * len(names), np.array(values), np.array(gradients), np.array(ends), never


def _of_matrices(design: Design, slopes: Derivatives, changes: np.ndarray) -> _Part:
    moved = _both_ways(design, slopes.names, changes)
    names, units, values, rows, ends = [], [], [], [], []
    coordinates = slopes.model.coordinates
    for name, slope in slopes.matrices.items():
        for i, first in enumerate(coordinates):
            for j, second in enumerate(coordinates):
                names.append(f"{name} {first}, {second}")
                units.append(UNITS[name])
                values.append(float(np.real(np.asarray(getattr(slopes.model, name))[i, j])))
                rows.append(slope[:, i, j])
                ends.append(np.asarray(getattr(moved, name))[:, i, j].reshape(-1, 2))
    never = np.full((len(names), len(changes), 2), np.nan)
    return names, units, np.array(values), np.array(rows), np.array(ends), never
