"""Tables: for people (rich), for programs (CSV)."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

from rich.console import Group
from rich.table import Table

from singletrack.present.terminal import Words

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np

    from singletrack.linear import CriticalSpeeds, Modes
    from singletrack.model import LinearModel

__all__ = [
    "coefficients_table",
    "critical_speeds_text",
    "eigenvalues_csv",
    "eigenvalues_table",
    "format_root",
    "write_csv",
]

_UNITS = {"M": "kg m²", "C1": "kg m", "K0": "kg m", "K2": "kg"}
_WORDS = {"M": "mass", "C1": "damping-like, times v", "K0": "stiffness, times g", "K2": "stiffness, times v²"}


def write_csv(header: Iterable[str], rows: Iterable[Iterable[Any]]) -> str:
    r"""Return CSV text; numbers in full double precision.

    >>> write_csv(["speed", "root"], [[0.1, -1.0]])
    'speed,root\n0.1,-1.0\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue()


def coefficients_table(model: LinearModel, title: str) -> Group:
    """Return M, C1, K0 and K2 of a single design for reading."""
    table = _table(title)
    note = f"M q'' + v C1 q' + (g K0 + v² K2) q = f, with q = (lean, steer), g = {float(model.gravity):g} m/s²"
    for heading in ("", "equation", "lean", "steer", "unit"):
        table.add_column(heading, justify="right" if heading in ("lean", "steer") else "left")
    for name, unit in _UNITS.items():
        matrix = getattr(model, name)
        table.add_row(f"{name} {_WORDS[name]}", "lean", _number(matrix[0, 0]), _number(matrix[0, 1]), unit)
        table.add_row("", "steer", _number(matrix[1, 0]), _number(matrix[1, 1]), unit, end_section=True)
    return Group(table, note)


def _table(title: str) -> Table:
    return Table(title=title, title_justify="left", title_style="bold")


def _number(value: float) -> str:
    return f"{float(value) + 0.0:.6f}"


def format_root(first: complex, second: complex | None = None) -> str:
    """Return one root, or two (a pair, or two real ones), for reading.

    >>> format_root(-0.5 + 2j, -0.5 - 2j), format_root(1.0 + 0j), format_root(1.0 + 0j, 2.0 + 0j)
    ('-0.500 ± 2.000i', '1.000', '1.000, 2.000')
    """
    if second is not None and first.imag != 0 and second == first.conjugate():
        return f"{first.real:.3f} ± {abs(first.imag):.3f}i"
    roots = [first] if second is None else [first, second]
    return ", ".join(f"{r.real:.3f}" if r.imag == 0 else f"{r.real:.3f} {r.imag:+.3f}i" for r in roots)


def eigenvalues_table(modes: Modes, title: str) -> Group:
    """Return the eigenvalues of a single design for reading, unstable ones in red, stable speeds marked."""
    table = _table(title)
    note = "eigenvalues in 1/s; red grows; in parentheses: the name does not describe the motion at this speed"
    for heading in ("v (m/s)", "weave", "capsize", "castering", ""):
        table.add_column(heading, justify="left" if not heading else "right", no_wrap=True)
    for speed, roots, applies in zip(modes.speeds, modes.eigenvalues, modes.applies, strict=True):
        cells = [
            _root_cell(roots[:2], format_root(roots[0], roots[1]), bool(applies[:2].all())),
            _root_cell(roots[2:3], format_root(roots[2]), bool(applies[2])),
            _root_cell(roots[3:], format_root(roots[3]), bool(applies[3])),
        ]
        table.add_row(f"{speed:.3f}", *cells, "stable" if (roots.real < 0).all() else "")
    return Group(table, note)


def _root_cell(roots: np.ndarray, text: str, applies: bool) -> Words:
    return Words(text if applies else f"({text})", style="red" if (roots.real > 0).any() else "")


def eigenvalues_csv(modes: Modes) -> str:
    """Return the eigenvalues of a single design as CSV: speed, then real and imaginary part of each mode."""
    names = ["weave_1", "weave_2", "capsize", "castering"]
    header = ["speed", *(f"{name}_{part}" for name in names for part in ("real", "imag"))]
    rows = (
        [float(speed), *(float(part) for root in roots for part in (root.real, root.imag))]
        for speed, roots in zip(modes.speeds, modes.eigenvalues, strict=True)
    )
    return write_csv(header, rows)


def critical_speeds_text(speeds: CriticalSpeeds) -> str:
    """Return critical speeds and stable ranges of a single design in words.

    >>> from singletrack import coefficients, load_bicycle
    >>> print(critical_speeds_text(coefficients(load_bicycle("benchmark")).critical_speeds()))
    weave speed     4.292 m/s
    capsize speed   6.024 m/s
    stable          4.292 to 6.024 m/s
    """
    ranges = [
        f"{low:.3f} to {high:.3f} m/s" if high != float("inf") else f"above {low:.3f} m/s"
        for low, high in speeds.stable_ranges
    ]
    lines = {
        "weave speed": ", ".join(f"{speed:.3f} m/s" for speed in speeds.weave) or "never",
        "capsize speed": ", ".join(f"{speed:.3f} m/s" for speed in speeds.capsize) or "never",
        "stable": ", ".join(ranges) or "never",
    }
    return "\n".join(f"{name:<16}{value}" for name, value in lines.items())
