"""Tables in HTML for notebooks; whatever is put in is text, never markup."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

__all__ = ["table", "told"]


def told(value: float, digits: int = 6) -> str:
    """Return a number in words for a table: so many significant digits, a real minus sign.

    Parameters
    ----------
    value : float
    digits : int

    Examples
    --------
    >>> told(-0.05630001, 4), told(float("inf"))
    ('−0.0563', '∞')
    """
    return f"{value:.{digits}g}".replace("-", "−").replace("inf", "∞")


def table(rows: Iterable[Sequence[str]], header: Sequence[str] = (), caption: str = "") -> str:
    """Return an HTML table; every cell is escaped.

    Parameters
    ----------
    rows : iterable of sequences of str
        The cells; the first of each row names it. A row of one cell is a heading for those that follow.
    header : sequence of str, optional
        Names of the columns.
    caption : str, optional

    Examples
    --------
    >>> table([["a<b", "1"]])
    '<table><tbody><tr><th style="text-align:left">a&lt;b</th><td>1</td></tr></tbody></table>'
    """
    rows = [list(row) for row in rows]
    width = max([len(header), *(len(row) for row in rows)], default=1)
    parts = ["<table>"]
    if caption:
        parts.append(f'<caption style="text-align:left">{html.escape(caption)}</caption>')
    if header:
        cells = "".join(f"<th>{html.escape(cell)}</th>" for cell in header)
        parts.append(f"<thead><tr>{cells}</tr></thead>")
    body = "".join(_row(row, width) for row in rows)
    return "".join([*parts, f"<tbody>{body}</tbody></table>"])


def _row(row: Sequence[str], width: int) -> str:
    first, *others = (html.escape(cell) for cell in row)
    if not others and width > 1:
        return f'<tr><th colspan="{width}" style="text-align:left">{first}</th></tr>'
    cells = "".join(f"<td>{cell}</td>" for cell in others)
    return f'<tr><th style="text-align:left">{first}</th>{cells}</tr>'
