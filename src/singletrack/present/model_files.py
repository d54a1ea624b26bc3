"""A model in the formats of other tools."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from singletrack.model.record import UNITS
from singletrack.present.tables import write_csv

if TYPE_CHECKING:
    from singletrack.model import LinearModel

__all__ = ["model_csv", "model_mat"]


def model_mat(model: LinearModel) -> bytes:
    """Return the matrices, gravity and names as a MAT-file (level 5), which Matlab, Octave and scipy read.

    Parameters
    ----------
    model : LinearModel
        Of shape (...): matrices keep leading batch dimensions.
    """
    from scipy.io import savemat  # lazy: slow to import

    content = io.BytesIO()
    data = {name: np.asarray(getattr(model, name), dtype=float) for name in UNITS}
    names = {word: np.array(getattr(model, word), dtype=object) for word in ("coordinates", "inputs")}
    savemat(content, {**data, "gravity": np.asarray(model.gravity, dtype=float), **names}, do_compression=False)
    # The header's text has the date of the day in it; the same model is the same bytes.
    text = b"MATLAB 5.0 MAT-file, written by singletrack"
    return text.ljust(116) + content.getvalue()[116:]


def model_csv(model: LinearModel) -> str:
    """Return the entries of a single design's matrices as CSV in full precision: matrix, row, column, value, unit.

    Parameters
    ----------
    model : LinearModel
    """
    rows: list[list[object]] = []
    for name, unit in UNITS.items():
        columns = model.inputs if name == "B" else model.coordinates
        for i, row in enumerate(np.asarray(getattr(model, name), dtype=float)):
            rows += [
                [name, model.coordinates[i], column, float(value), unit]
                for column, value in zip(columns, row, strict=True)
            ]
    rows.append(["gravity", "", "", float(np.asarray(model.gravity)), "m/s^2"])
    return write_csv(["matrix", "equation", "coordinate", "value", "unit"], rows)
