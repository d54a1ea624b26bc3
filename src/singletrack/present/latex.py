"""The table of a model as LaTeX."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.model.record import UNITS

if TYPE_CHECKING:
    from singletrack.arrays import Number
    from singletrack.linear import CriticalSpeeds
    from singletrack.model import LinearModel

__all__ = ["escaped", "latex_table"]

_SYMBOLS = {"M": "M", "C0": "C_0", "C1": "C_1", "S0": "S_0", "K0": "K_0", "K2": "K_2"}
_ESCAPES = {c: f"\\{c}" for c in "&%$#_{}"} | {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
}


def escaped(text: str) -> str:
    r"""Return a text with the characters that LaTeX takes for its own written out.

    Parameters
    ----------
    text : str

    Examples
    --------
    >>> escaped("5 % of rider_a")
    '5 \\% of rider\\_a'
    """
    return "".join(_ESCAPES.get(character, character) for character in text)


def latex_table(model: LinearModel, critical: CriticalSpeeds, caption: str = "", digits: int = 5) -> str:
    r"""Return the matrices and critical speeds of a single design as a table of plain LaTeX with booktabs.

    Parameters
    ----------
    model : LinearModel
    critical : CriticalSpeeds
    caption : str
        Plain text; empty for none.
    digits : int
        Significant digits.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> print(latex_table(model, model.critical_speeds()).splitlines()[6])
    $\mathbf{M}$ (kg\,m$^2$) & lean & 80.817 & 2.3194 \\
    """
    lines = [r"\begin{table}", r"\centering"] + ([rf"\caption{{{escaped(caption)}}}"] if caption else [])
    lines += [rf"\begin{{tabular}}{{ll{'r' * model.freedoms}}}", r"\toprule"]
    lines += [" & ".join(["", "", *map(escaped, model.coordinates)]) + r" \\", r"\midrule"]
    for name, symbol in _SYMBOLS.items():
        matrix = np.real(np.asarray(getattr(model, name)))
        if name in {"C0", "S0"} and not matrix.any():
            continue
        heading = rf"$\mathbf{{{symbol}}}$ ({_unit(UNITS[name])})"
        for k, (coordinate, row) in enumerate(zip(model.coordinates, matrix, strict=True)):
            cells = [heading if k == 0 else "", escaped(coordinate), *(_number(entry, digits) for entry in row)]
            lines.append(" & ".join(cells) + r" \\")
    wide = rf"\multicolumn{{{model.freedoms + 2}}}{{l}}"
    lines += [r"\midrule", rf"{wide}{{$g = {_bare(model.gravity, digits)}$ m/s$^2$}} \\"]
    for crossing in critical.crossings:
        words = f"{escaped(crossing.mode)} speed {_bare(crossing.speed, digits)} m/s"
        lines.append(rf"{wide}{{{words}}} \\")
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", r"\end{table}", ""])


def _unit(unit: str) -> str:
    return unit.replace("^2", "$^2$").replace(" ", r"\,")


def _bare(value: Number, digits: int) -> str:
    return f"{float(np.asarray(value).real):.{digits}g}"


def _number(value: float, digits: int) -> str:
    mantissa, _, exponent = _bare(value, digits).partition("e")
    minus = mantissa.startswith("-") or exponent.startswith("-")
    if exponent:
        return rf"${mantissa}\times 10^{{{int(exponent)}}}$"
    return f"${mantissa}$" if minus else mantissa
