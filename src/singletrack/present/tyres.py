"""Eigenvalues without names, such as those of a bicycle on tyres: a table, CSV and plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from rich.table import Table

from singletrack.present.tables import format_root, write_csv

if TYPE_CHECKING:
    from singletrack.arrays import Array

__all__ = ["roots_csv", "roots_dict", "roots_table"]


def roots_table(speeds: Array, roots: Array, title: str) -> Table:
    """Return a table of eigenvalues (k, m), 1/s, at speeds (k,), m/s, the one that grows fastest first.

    Parameters
    ----------
    speeds, roots
        Speeds and eigenvalues.
    title
        Heading.
    """
    table = Table(title=title)
    table.add_column("speed m/s", justify="right")
    ordered = _upper(roots)
    for k in range(max(map(len, ordered), default=0)):
        table.add_column(f"root {k + 1}", justify="right")
    for speed, row in zip(speeds, ordered, strict=True):
        table.add_row(f"{speed:.3f}", *(format_root(root, root.conjugate() if root.imag else None) for root in row))
    return table


def roots_csv(speeds: Array, roots: Array) -> str:
    r"""Return CSV: speed, then real and imaginary part of every eigenvalue.

    Parameters
    ----------
    speeds : array, shape (k,)
        In m/s.
    roots : array, shape (k, m)
        In 1/s.

    Examples
    --------
    >>> roots_csv(np.array([5.0]), np.array([[-1.0 + 2.0j]]))
    'speed,root 1 real,root 1 imag\n5.0,-1.0,2.0\n'
    """
    header = ["speed", *(f"root {k + 1} {part}" for k in range(roots.shape[1]) for part in ("real", "imag"))]
    parts = np.stack([roots.real, roots.imag], axis=-1).reshape(len(roots), -1)
    return write_csv(header, ([speed, *row] for speed, row in zip(speeds.tolist(), parts.tolist(), strict=True)))


def roots_dict(speeds: Array, roots: Array) -> dict[str, Any]:
    """Return speeds and eigenvalues as [k][m][re, im], for JSON.

    Parameters
    ----------
    speeds : array, shape (k,)
        In m/s.
    roots : array, shape (k, m)
        In 1/s.
    """
    return {"speeds": speeds.tolist(), "eigenvalues": np.stack([roots.real, roots.imag], axis=-1).tolist()}


def _upper(roots: Array) -> list[list[complex]]:
    """Return the eigenvalues without the lower ones of pairs, by falling real part."""
    return [sorted((root for root in row.tolist() if root.imag >= 0), key=lambda root: -root.real) for row in roots]
