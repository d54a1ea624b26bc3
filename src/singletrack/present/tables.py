"""Tables: for people (rich), for programs (CSV)."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Group
from rich.table import Table

from singletrack.present.terminal import Words
from singletrack.present.words import critical_speed_lines

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from singletrack.linear import AlwaysUnstable, CriticalSpeeds, Modes
    from singletrack.model import LinearModel

__all__ = [
    "coefficients_table",
    "critical_speeds_text",
    "eigenvalues_csv",
    "eigenvalues_table",
    "format_root",
    "rows_table",
    "write_csv",
]

_UNITS = {"M": "kg m²", "C0": "N m s", "C1": "kg m", "S0": "N m", "K0": "kg m", "K2": "kg"}
_WORDS = {
    "M": "mass",
    "C0": "dampers",
    "C1": "damping-like, times v",
    "S0": "springs",
    "K0": "stiffness, times g",
    "K2": "stiffness, times v²",
}


def write_csv(header: Iterable[str], rows: Iterable[Iterable[Any]]) -> str:
    r"""Return CSV text; numbers in full double precision.

    Parameters
    ----------
    header : iterable of str
        Names of the columns.
    rows : iterable of iterables
        Values of each line, numbers or text.

    Examples
    --------
    >>> write_csv(["speed", "root"], [[0.1, -1.0]])
    'speed,root\n0.1,-1.0\n'
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return text.getvalue()


def rows_table(title: str, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    """Return a table for reading, its first column to the left.

    Parameters
    ----------
    title : str
    headings : sequence of str
        Of the columns.
    rows : iterable of sequences of str
    """
    table = _table(title)
    for place, heading in enumerate(headings):
        table.add_column(Words(heading, whole=True), justify="right" if place else "left")
    for row in rows:
        table.add_row(*(Words(cell, whole=True) for cell in row))
    return table


def coefficients_table(model: LinearModel, title: str, deviations: Mapping[str, np.ndarray] | None = None) -> Group:
    """Return the matrices of a single design for reading.

    Parameters
    ----------
    model : LinearModel
        With n coordinates.
    title : str
    deviations : mapping of str to array, shape (n, n), optional
        Standard deviations of the entries, by matrix, in SI units.
    """
    table = _table(title)
    for heading in ("", "equation", *model.coordinates, "unit"):
        table.add_column(heading, justify="right" if heading in model.coordinates else "left")
    sprung = () if model.is_undamped else ("C0", "S0")
    for name in (name for name in _WORDS if name not in {"C0", "S0"} or name in sprung):
        entries = np.asarray(getattr(model, name), dtype=float)
        spread = (deviations or {}).get(name)
        for i, coordinate in enumerate(model.coordinates):
            cells = [_entry(entries, spread, i, j) for j in range(model.freedoms)]
            word = f"{name} {_WORDS[name]}" if i == 0 else ""
            table.add_row(word, coordinate, *cells, _UNITS[name], end_section=i == model.freedoms - 1)
    damping, stiffness = ("(C0 + v C1)", "(S0 + g K0 + v² K2)") if sprung else ("v C1", "(g K0 + v² K2)")
    coordinates = ", ".join(model.coordinates)
    note = f"M q'' + {damping} q' + {stiffness} q = f, with q = ({coordinates}), g = {float(model.gravity):g} m/s²"
    return Group(table, note)


def _entry(entries: np.ndarray, spread: np.ndarray | None, i: int, j: int) -> str:
    return f"{entries[i, j] + 0.0:.6f}" + ("" if spread is None else f" ± {spread[i, j]:.2g}")


def _table(title: str) -> Table:
    return Table(title=title, title_justify="left", title_style="bold")


def format_root(first: complex, second: complex | None = None) -> str:
    """Return one root, or two (a pair, or two real ones), for reading.

    Parameters
    ----------
    first, second : complex
        In 1/s.

    Examples
    --------
    >>> format_root(-0.5 + 2j, -0.5 - 2j), format_root(1.0 + 0j), format_root(1.0 + 0j, 2.0 + 0j)
    ('-0.500 ± 2.000i', '1.000', '1.000, 2.000')
    """
    if second is not None and first.imag != 0 and second == first.conjugate():
        return f"{first.real:.3f} ± {abs(first.imag):.3f}i"
    roots = [first] if second is None else [first, second]
    return ", ".join(f"{r.real:.3f}" if r.imag == 0 else f"{r.real:.3f} {r.imag:+.3f}i" for r in roots)


def eigenvalues_table(modes: Modes, title: str) -> Group:
    """Return the eigenvalues of a single design for reading, unstable ones in red, stable speeds marked.

    Parameters
    ----------
    modes : Modes
        Columns of one name stand together.
    title : str
    """
    table = _table(title)
    note = "eigenvalues in 1/s; red grows; in parentheses: the name does not describe the motion at this speed"
    columns = {name: [i for i, other in enumerate(modes.names) if other == name] for name in modes.names}
    for heading in ("v (m/s)", *columns, ""):
        table.add_column(Words(heading, whole=True), justify="left" if not heading else "right", no_wrap=True)
    for speed, roots, applies in zip(modes.speeds, modes.eigenvalues, modes.applies, strict=True):
        cells = [_root_cell(roots[places], bool(applies[places].all())) for places in columns.values()]
        table.add_row(f"{speed:.3f}", *cells, "stable" if (roots.real < 0).all() else "")
    return Group(table, note)


def _root_cell(roots: np.ndarray, applies: bool) -> Words:
    text = format_root(*roots[:2]) if len(roots) <= 2 else ", ".join(format_root(root) for root in roots)
    return Words(text if applies else f"({text})", "red" if (roots.real > 0).any() else "", whole=True)


def eigenvalues_csv(modes: Modes) -> str:
    """Return the eigenvalues of a single design as CSV: speed, then real and imaginary part of each mode.

    Parameters
    ----------
    modes : Modes
        Columns of one name are numbered.
    """
    names = [name.replace(" ", "_") for name in modes.names]
    numbered = [
        name if names.count(name) == 1 else f"{name}_{names[: i + 1].count(name)}" for i, name in enumerate(names)
    ]
    header = ["speed", *(f"{name}_{part}" for name in numbered for part in ("real", "imag"))]
    rows = (
        [float(speed), *(float(part) for root in roots for part in (root.real, root.imag))]
        for speed, roots in zip(modes.speeds, modes.eigenvalues, strict=True)
    )
    return write_csv(header, rows)


def critical_speeds_text(
    critical: CriticalSpeeds,
    deviations: Mapping[str, Sequence[float]] | None = None,
    unstable: Sequence[AlwaysUnstable] = (),
) -> str:
    """Return critical speeds and stable ranges of a single design in words.

    Parameters
    ----------
    critical : CriticalSpeeds
    deviations : mapping of "weave", "capsize" to sequences of float, optional
        Standard deviations of the speeds in m/s.
    unstable : sequence of AlwaysUnstable, optional
        What is unstable where no speed is stable.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> print(critical_speeds_text(coefficients(load_bicycle("benchmark")).critical_speeds()))
    weave speed     4.292 m/s
    capsize speed   6.024 m/s
    stable          4.292 to 6.024 m/s
    """
    lines = critical_speed_lines(critical, deviations, unstable)
    return "\n".join(f"{name:<16}{value}" for name, value in lines.items())
