"""Labels on curves: each beside its own curve, over nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Curve", "label_curves"]


@dataclass(frozen=True, eq=False)
class Curve:
    """A drawn curve: its points in data coordinates, NaN between pieces, and its label ("" for none).

    With ``on_points`` nothing is drawn: the points are the places where the label may stand.
    """

    x: np.ndarray
    y: np.ndarray
    label: str
    colour: str
    on_points: bool = False


#: Points per curve that the search for a place looks at.
_MOST_POINTS = 160
#: Gap in pixels below which a label would cover something.
_COVERS = -1.0


def label_curves(axes: Axes, curves: list[Curve], vertical: list[float], size: float = 8.0) -> list[str]:
    """Write each curve's label beside it, where it is farthest from all other curves, lines and labels.

    A label for which there is no room is left out.

    Parameters
    ----------
    axes : Axes
        With its limits set.
    curves : list of Curve
    vertical : list of float
        Positions of vertical lines, which labels keep away from.
    size : float
        Font size in points.

    Returns
    -------
    list of str
        The labels that were left out.
    """
    figure = axes.get_figure(root=True)
    assert figure is not None  # noqa: S101  # drawn axes belong to a figure
    figure.canvas.draw()
    box = axes.get_window_extent()
    points = [_pixels(axes, curve) for curve in curves]
    lines = np.array([axes.transData.transform((x, 0.0))[0] for x in vertical])
    per_point = figure.dpi / 72
    taken: list[tuple[float, float, float, float]] = []
    left_out: list[str] = []
    for index, curve in enumerate(curves):
        if not curve.label or len(points[index]) == 0:
            left_out += [curve.label] if curve.label else []
            continue
        text = axes.text(0, 0, curve.label, color=curve.colour, fontsize=size, ha="center", va="center")
        half = np.asarray(text.get_window_extent().size) / 2 + 0.12 * size * per_point
        centres = points[index] if curve.on_points else _candidates(points[index], half, per_point)
        drawn = [cloud for cloud, other in zip(points, curves, strict=True) if not other.on_points]
        own = points[index] if not curve.on_points else np.empty((0, 2))
        clearance = _clearance(centres, half, drawn, own, lines, taken, box)
        best = int(np.argmax(clearance))
        if clearance[best] < _COVERS:
            text.remove()  # no room: the colour has to say it
            left_out.append(curve.label)
            continue
        x, y = axes.transData.inverted().transform(centres[best])
        text.set_position((float(x), float(y)))
        taken.append((*centres[best], *half))
    return left_out


def _pixels(axes: Axes, curve: Curve) -> np.ndarray:
    xy = np.stack([curve.x, curve.y], axis=-1)
    inside = np.isfinite(xy).all(axis=-1)
    low, high = axes.get_ylim()
    inside &= (curve.y >= low) & (curve.y <= high)
    pixels: np.ndarray = axes.transData.transform(xy[inside])
    return pixels[:: max(1, len(pixels) // _MOST_POINTS)]


def _candidates(own: np.ndarray, half: np.ndarray, per_point: float) -> np.ndarray:
    """Return centres of label boxes beside points of the curve, above and below it."""
    some = own[:: max(1, len(own) // 90)]
    gap = half[1] + 4 * per_point
    aside = half[0] + 6 * per_point
    offsets = np.array([(0, gap), (0, -gap), *((side, up) for side in (aside, -aside) for up in (gap / 2, -gap / 2))])
    centres: np.ndarray = (some[:, None, :] + offsets).reshape(-1, 2)
    return centres


def _clearance(
    centres: np.ndarray,
    half: np.ndarray,
    points: list[np.ndarray],
    own: np.ndarray,
    lines: np.ndarray,
    taken: list[tuple[float, float, float, float]],
    box: object,
) -> np.ndarray:
    """Return the gap of each place to the nearest thing in pixels, negative where the label would cover it."""
    x0, y0, x1, y1 = box.extents  # type: ignore[attr-defined]
    edge = np.minimum.reduce(
        [
            centres[:, 0] - half[0] - x0,
            x1 - centres[:, 0] - half[0],
            centres[:, 1] - half[1] - y0,
            y1 - centres[:, 1] - half[1],
        ]
    )
    best = np.where(edge < 2, edge - 1000, 60.0)
    for cloud in points:
        if len(cloud) == 0:
            continue
        gap = _gap(centres[:, None, :] - cloud, half).min(axis=1)
        best = np.minimum(best, np.where(gap > 2, 60.0, gap - 500) if cloud is own else gap)
    for x in lines:
        best = np.minimum(best, np.abs(centres[:, 0] - x) - half[0])
    for x, y, half_x, half_y in taken:
        gap = _gap(centres - np.array([x, y]), half + np.array([half_x, half_y]))
        best = np.minimum(best, gap)
    return best


def _gap(offsets: np.ndarray, half: np.ndarray) -> np.ndarray:
    """Return the distance of points from a box around the origin, negative inside."""
    x, y = np.abs(offsets[..., 0]) - half[0], np.abs(offsets[..., 1]) - half[1]
    outside = np.hypot(np.maximum(x, 0.0), np.maximum(y, 0.0))
    gap: np.ndarray = np.where((x < 0) & (y < 0), np.maximum(x, y), outside)
    return gap
