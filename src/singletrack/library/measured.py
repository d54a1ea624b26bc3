"""Eigenvalues that were measured on the road, shipped with the package."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from importlib import resources

import numpy as np

from singletrack.errors import InputError, unknown_name

__all__ = ["MeasuredModes", "load_measured_modes"]


@dataclass(frozen=True, eq=False)
class MeasuredModes:
    """One oscillation in n runs of a coasting bicycle.

    Attributes
    ----------
    name : str
        Of the bicycle.
    lowest_speeds, highest_speeds : array, shape (n,)
        The forward speed fell from the highest to the lowest during a run, in m/s.
    eigenvalues : complex array, shape (n,)
        Fitted to the record of each run, with a positive imaginary part, in 1/s.
    """

    name: str
    lowest_speeds: np.ndarray
    highest_speeds: np.ndarray
    eigenvalues: np.ndarray


def load_measured_modes(name: str) -> MeasuredModes:
    """Return a shipped set of measured weave eigenvalues.

    Parameters
    ----------
    name : str
        Of the bicycle, such as ``kooijman-2008``.

    Raises
    ------
    InputError
        If nothing was measured on a bicycle of this name.

    Examples
    --------
    >>> len(load_measured_modes("kooijman-2008").eigenvalues)
    26
    """
    folder = resources.files("singletrack") / "data" / "measured"
    known = {file.name.removesuffix(".csv"): file for file in folder.iterdir() if file.name.endswith(".csv")}
    if name not in known:
        raise InputError(unknown_name("set of measured eigenvalues", name, sorted(known)))
    lines = [line for line in known[name].read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    lowest, highest, real, imaginary = np.array(list(csv.reader(lines[1:])), dtype=float).T
    return MeasuredModes(name, lowest, highest, real + 1j * imaginary)
