"""How a model looks at a prompt and in a notebook: its matrices, or how many designs there are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays import is_concrete
from singletrack.markup import table, told
from singletrack.model.record import UNITS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.model import LinearModel

__all__ = ["lines_of_model", "table_of_model"]


def lines_of_model(model: LinearModel) -> str:
    """Return a line that says what a model is of and, of a single design, a line for each matrix.

    Parameters
    ----------
    model : LinearModel

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> print(lines_of_model(coefficients(load_bicycle("benchmark"))))
    <CoefficientMatrices of lean, steer>
    M  = [[80.8172, 2.31941], [2.31941, 0.297842]] kg m^2
    C1 = [[0, 33.8664], [−0.850356, 1.6854]] kg m
    K0 = [[−80.95, −2.59952], [−2.59952, −0.803295]] kg m
    K2 = [[0, 76.5973], [0, 2.65432]] kg
    gravity = 9.81 m/s^2
    """
    lines = [f"<{type(model).__name__} of {_what(model)}>"]
    if _is_single(model):
        for name in _shown(model):
            entries = "], [".join(", ".join(told(entry) for entry in row) for row in _real(model, name))
            lines.append(f"{name:<2} = [[{entries}]] {UNITS[name]}")
        lines.append(f"gravity = {told(float(np.asarray(model.gravity).real))} m/s^2")
    return "\n".join(lines)


def table_of_model(model: LinearModel) -> str:
    """Return an HTML table of a single design's matrices; of a batch, what it is of.

    Parameters
    ----------
    model : LinearModel
    """
    return table(_rows(model), ["", *model.coordinates] if _is_single(model) else [], f"Model of {_what(model)}")


def _rows(model: LinearModel) -> Iterator[list[str]]:
    if not _is_single(model):
        yield ["designs", " × ".join(map(str, model.shape)) or "traced"]
        return
    for name in _shown(model):
        yield [f"{name} in {UNITS[name]}"]
        for coordinate, row in zip(model.coordinates, _real(model, name), strict=True):
            yield [coordinate, *(told(entry) for entry in row)]
    yield ["gravity", f"{told(float(np.asarray(model.gravity).real))} m/s^2"]


def _what(model: LinearModel) -> str:
    parts = [", ".join(model.coordinates)]
    if model.shape:
        faulty = int(np.sum(~model.valid))
        parts.append(f"designs of shape {model.shape}" + (f", {faulty} faulty" if faulty else ""))
    return "; ".join(parts)


def _is_single(model: LinearModel) -> bool:
    return model.shape == () and is_concrete(model.M)


def _shown(model: LinearModel) -> list[str]:
    sprung = [] if model.is_undamped else ["C0", "S0"]
    return [name for name in ("M", "C0", "C1", "S0", "K0", "K2") if name in {"M", "C1", "K0", "K2", *sprung}]


def _real(model: LinearModel, name: str) -> list[list[float]]:
    entries: list[list[float]] = np.real(np.asarray(getattr(model, name))).tolist()
    return entries
