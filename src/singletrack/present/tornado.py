"""Tornado figures and tables: which parameter matters most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.parameters.steps import step_of
from singletrack.present.plotting import MILLIMETRES, set_title
from singletrack.present.style import new_figure, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.analysis.sensitivity import Sensitivity
    from singletrack.analysis.sobol import SobolIndices

__all__ = ["effect_words", "sensitivity_rows", "sobol_rows", "tornado_figure"]

# Dark and light: told apart in grey; the light one has an edge.
_DOWN: Any = {"facecolor": "#0072B2"}
_UP: Any = {"facecolor": "#F5C77E", "edgecolor": "#B26A00", "linewidth": 0.6}


def tornado_figure(found: Sensitivity, result: str, most: int = 12, width: float = 120.0, title: str = "") -> Figure:
    """Return one result after changes of each parameter down and up, the one that matters most on top.

    Parameters
    ----------
    found : Sensitivity
    result : str
        One of its results.
    most : int
        Parameters shown.
    width : float
        In mm.
    title : str
        Empty for none.
    """
    row, order = found.row(result), found.ranked(result)[:most]
    words = [_row_words(found, row, k) for k in order]
    heights = np.array([1.0 + text.count("\n") for text in words])
    places = np.cumsum(heights) - heights / 2
    with style():
        figure = new_figure(width * MILLIMETRES, (24 + 5.2 * heights.sum()) * MILLIMETRES)
        axes = figure.add_subplot()
        set_title(axes, title)
        base = float(found.values[row])
        for place, k in zip(places, order, strict=True):
            for side, look in ((0, _DOWN), (1, _UP)):
                end = found.ends[row, k, side]
                if np.isfinite(end):
                    axes.barh(place, end - base, left=base, height=0.62, **look)
        axes.axvline(base, color="black", lw=0.8)
        axes.set_yticks(places, words, fontsize=8)
        axes.set_ylim(heights.sum() + 0.1, -0.1)
        axes.set_xlabel(f"{result} ({found.result_units[row]})")
        axes.spines["left"].set_visible(False)
        axes.tick_params(axis="y", length=0)
        axes.margins(x=0.04)
        _key(axes)
    return figure


def _row_words(found: Sensitivity, row: int, k: int) -> str:
    step = step_of(found.units[k])
    words = f"{found.parameters[k].replace('_', ' ')} ± {found.changes[k] * step.factor:.3g} {step.unit}"
    ends = [fold for fold in found.folds[row, k] if np.isfinite(fold)]
    for fold in ends:
        words += f"\nceases at {fold * step.factor:+.3g} {step.unit}"
    for side, word in ((0, "less"), (1, "more")):
        words += f"\n{word} cannot be" if found.impossible[k, side] else ""
    return words


def _key(axes: Axes) -> None:
    from matplotlib.patches import Patch  # lazy: heavy

    handles = [Patch(**_DOWN, label="less"), Patch(**_UP, label="more")]
    figure = axes.get_figure(root=True)
    assert figure is not None  # noqa: S101  # drawn axes belong to a figure
    figure.legend(handles=handles, loc="outside lower right", ncols=2, frameon=False, fontsize=8)


def effect_words(found: Sensitivity, row: int, k: int, side: int) -> str:
    """Return what a change does to a result: a signed difference, or that it ceases to exist and where.

    Parameters
    ----------
    found : Sensitivity
    row, k : int
        Places of the result and of the parameter.
    side : {0, 1}
        Down or up.
    """
    if found.impossible[k, side]:
        return "cannot be"
    if np.isfinite(found.folds[row, k, side]):
        step = step_of(found.units[k])
        return f"ceases at {found.folds[row, k, side] * step.factor:+.3g} {step.unit}"
    return f"{found.ends[row, k, side] - found.values[row]:+.4g}"


def sensitivity_rows(found: Sensitivity, result: str, most: int = 12) -> list[list[str]]:
    """Return a table's rows: parameter, derivative in units that people change, the change, what it does.

    Parameters
    ----------
    found : Sensitivity
    result : str
        One of its results.
    most : int
        Rows at most.
    """
    row = found.row(result)
    rows = []
    for k in found.ranked(result)[:most]:
        step = step_of(found.units[k])
        derivative = f"{found.derivatives[row, k] / step.factor:+.4g} {found.result_units[row]} per {step.unit}"
        change = f"{found.changes[k] * step.factor:.3g} {step.unit}"
        rows.append([found.parameters[k], derivative, change, *(effect_words(found, row, k, side) for side in (0, 1))])
    return rows


def sobol_rows(found: SobolIndices, result: str) -> list[list[str]]:
    """Return a table's rows: parameter, share of the variance alone, and with interactions, the greatest first.

    Parameters
    ----------
    found : SobolIndices
    result : str
        One of its results.
    """
    r = found.results.index(result)
    order = np.argsort(-found.total[r])
    return [
        [
            found.parameters[k],
            f"{found.first[r, k]:.3f} ± {found.first_confidence[r, k]:.3f}",
            f"{found.total[r, k]:.3f} ± {found.total_confidence[r, k]:.3f}",
        ]
        for k in order
    ]
