"""Labels on curves: each beside its own curve, over nothing else."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Curve", "label_curves"]


@dataclass(frozen=True, eq=False)
class Curve:
    """A drawn curve: its points in data coordinates, NaN between pieces, and its label ("" for none).

    With ``on_points`` nothing is drawn: the points are the places where the label may stand. ``also`` is the height of
    another curve of the same name, drawn by itself, which the label may stand beside instead.
    """

    x: np.ndarray
    y: np.ndarray
    label: str
    colour: str
    on_points: bool = False
    also: np.ndarray | None = None


#: Points per curve that the search for a place looks at.
_MOST_POINTS = 160
#: Gap in pixels below which a label would cover something.
_COVERS = -1.0
#: Orders of the labels that are tried until all find room.
_TRIES = 40


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
    texts = {
        index: axes.text(0, 0, curve.label, color=curve.colour, fontsize=size, ha="center", va="center")
        for index, curve in enumerate(curves)
        if curve.label and len(points[index])
    }
    halves = {
        index: np.asarray(text.get_window_extent().size) / 2 + 0.12 * size * per_point for index, text in texts.items()
    }
    places = {
        index: points[index] if curves[index].on_points else _beside(axes, curves[index], half, per_point)
        for index, half in halves.items()
    }
    drawn = [cloud for cloud, other in zip(points, curves, strict=True) if not other.on_points]

    nothing = np.empty((0, 2))
    owns = {index: nothing if curves[index].on_points else points[index] for index in texts}
    clear = {index: _clearance(places[index], halves[index], drawn, owns[index], lines, box) for index in texts}
    best = _most_placed(places, halves, clear)
    for index, text in texts.items():
        if index in best:
            x, y = axes.transData.inverted().transform(best[index])
            text.set_position((float(x), float(y)))
        else:
            text.remove()  # no room: the colour has to say it
    return [curve.label for index, curve in enumerate(curves) if curve.label and index not in best]


def _most_placed(
    places: dict[int, np.ndarray], halves: dict[int, np.ndarray], clear: dict[int, np.ndarray]
) -> dict[int, np.ndarray]:
    """Return the centres of labels that find room: each takes its clearest place, in the order that seats most.

    Parameters
    ----------
    places : dict of int to array, shape (k, 2)
        Centres where a label may stand, in pixels.
    halves : dict of int to array, shape (2,)
        Half its size.
    clear : dict of int to array, shape (k,)
        How far each place is from all that is drawn.
    """
    shuffled, order = np.random.default_rng(0), list(places)
    best: dict[int, np.ndarray] = {}
    for _ in range(_TRIES):
        found: dict[int, np.ndarray] = {}
        for index in order:
            room = clear[index]
            for other, centre in found.items():
                room = np.minimum(room, _gap(places[index] - centre, halves[index] + halves[other]))
            if len(room) and room.max() >= _COVERS:
                found[index] = places[index][int(np.argmax(room))]
        best = found if len(found) > len(best) else best
        if len(best) == len(places):
            break
        # Whoever found no room goes first; the rest in another order.
        again: list[int] = shuffled.permutation(list(places)).tolist()
        order = [index for index in again if index not in found] + [index for index in again if index in found]
    return best


def _pixels(axes: Axes, curve: Curve) -> np.ndarray:
    xy = np.stack([curve.x, curve.y], axis=-1)
    inside = np.isfinite(xy).all(axis=-1)
    low, high = axes.get_ylim()
    inside &= (curve.y >= low) & (curve.y <= high)
    pixels: np.ndarray = axes.transData.transform(xy[inside])
    return pixels[:: max(1, len(pixels) // _MOST_POINTS)]


def _beside(axes: Axes, curve: Curve, half: np.ndarray, per_point: float) -> np.ndarray:
    """Return centres of label boxes beside a curve and beside the other of its name."""
    own = _candidates(_pixels(axes, curve), half, per_point)
    if curve.also is None:
        return own
    other = _pixels(axes, replace(curve, y=curve.also))
    return np.concatenate([own, _candidates(other, half, per_point)]) if len(other) else own


def _candidates(own: np.ndarray, half: np.ndarray, per_point: float) -> np.ndarray:
    """Return centres of label boxes beside points of the curve, above and below it."""
    some = own[:: max(1, len(own) // 90)]
    gap = half[1] + 4 * per_point
    aside = half[0] + 6 * per_point
    far = gap + 5 * per_point  # from the higher end of a curve that slopes
    beside = [(side, up) for side in (aside, -aside) for up in (gap / 2, -gap / 2)]
    offsets = np.array([(0, gap), (0, -gap), *beside, (0, far), (0, -far)])
    centres: np.ndarray = (some[:, None, :] + offsets).reshape(-1, 2)
    return centres


def _clearance(
    centres: np.ndarray,
    half: np.ndarray,
    points: list[np.ndarray],
    own: np.ndarray,
    lines: np.ndarray,
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
    return best


def _gap(offsets: np.ndarray, half: np.ndarray) -> np.ndarray:
    """Return the distance of points from a box around the origin, negative inside."""
    x, y = np.abs(offsets[..., 0]) - half[0], np.abs(offsets[..., 1]) - half[1]
    outside = np.hypot(np.maximum(x, 0.0), np.maximum(y, 0.0))
    gap: np.ndarray = np.where((x < 0) & (y < 0), np.maximum(x, y), outside)
    return gap
