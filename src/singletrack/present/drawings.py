"""Drawings of bicycle and rider from the skeleton points: side and top view, as in the paper's Figures 2, 3 and 6."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.present.style import COLOURS, new_figure, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.patches import Polygon

    from singletrack.analysis.outline import Turned
    from singletrack.parameters import Bicycle
    from singletrack.posture import Posture

__all__ = ["posture_figure"]

#: Tubes between skeleton points: rear frame, front frame (which turns with the steer).
_REAR_TUBES = ((2, 5), (5, 10), (10, 13), (10, 12), (5, 11), (2, 10))
_FRONT_TUBES = ((7, 11), (11, 12), (12, 16), (16, 17), (16, 18), (17, 19), (18, 20))
#: Limbs between skeleton points, with the parts that each draws.
_LIMBS = {
    "right_upper_leg": (30, 28),
    "right_lower_leg": (28, 26),
    "left_upper_leg": (31, 29),
    "left_lower_leg": (29, 27),
    "right_upper_arm": (21, 23),
    "right_lower_arm": (23, 19),
    "left_upper_arm": (22, 24),
    "left_lower_arm": (24, 20),
}
_STRAIGHT_ARMS = {"right_arm": (21, 19), "left_arm": (22, 20)}


def posture_figure(bicycle: Bicycle, posture: Posture, title: str, turned: Turned | None = None) -> Figure:
    """Return a drawing of a single bicycle and rider: side view, and top view also with the handlebar turned.

    Parameters
    ----------
    bicycle : Bicycle
    posture : Posture
    title : str
    turned : Turned, optional
        The same with the handlebar turned, to draw as well.
    """
    with style():
        figure = new_figure(5.6, 7.8)
        points = _numbered(posture.skeleton.points)
        height = 0.15 - points[25, 2] + float(posture.segments["head"].radius)
        side, top = figure.subplots(2, 1, gridspec_kw={"height_ratios": [height, 0.84]})
        ends = -float(bicycle.rear_wheel_radius) - 0.1, points[7, 0] + float(bicycle.front_wheel_radius) + 0.1
        side.set(xlim=ends, ylim=(-0.06, height - 0.06))
        top.set(xlim=ends, ylim=(-0.42, 0.42))
        _side_view(side, bicycle, posture, points)
        note = "top view"
        if turned is not None:
            moved = _numbered(turned.points)
            _top_view(top, bicycle, posture, moved, COLOURS["moved"], 0.55, steer=turned.steer)
            note += f"; blue: steered {np.degrees(turned.steer):.0f}° to the right"
        if posture.loops:
            side.set_xlabel("circles: hinges, squares: hands on the grips", fontsize=8)
        top.set_title(note, loc="left", fontsize=9)
        _top_view(top, bicycle, posture, points, COLOURS["rider"], 0.6)
        side.set_title(title, loc="left", fontsize=10)
        side.set_ylabel("height above ground (m)")
        top.set_ylabel("to the right, y (m)")
        top.set_xlabel("forward of the rear contact, x (m)")
        top.invert_yaxis()
    return figure


def _numbered(points: np.ndarray) -> np.ndarray:
    """Return points (32, 3) with a dummy first row, so that the table's numbers are indices."""
    return np.concatenate([np.full((1, 3), np.nan), np.asarray(points, dtype=float)])


def _side_view(axes: Axes, bicycle: Bicycle, posture: Posture, points: np.ndarray) -> None:
    from matplotlib.patches import Circle  # lazy: heavy

    axes.set_aspect("equal")
    axes.axhline(0.0, color="black", lw=0.8)
    for hub, radius in ((2, bicycle.rear_wheel_radius), (7, bicycle.front_wheel_radius)):
        axes.add_patch(Circle((points[hub, 0], -points[hub, 2]), float(radius), fill=False, lw=2, ec=COLOURS["frame"]))
    _steer_axis_line(axes, bicycle, points)
    for tubes, colour in ((_REAR_TUBES, COLOURS["frame"]), (_FRONT_TUBES, COLOURS["front"])):
        for start, end in tubes:
            axes.plot(points[[start, end], 0], -points[[start, end], 2], color=colour, lw=2.4, solid_capstyle="round")
    heights = points * np.array([1.0, 1.0, -1.0])
    _draw_rider(axes, posture, heights, (0, 2), COLOURS["rider"], 0.6)
    for joint in posture.joints:
        at = np.asarray(joint.point)
        axes.plot(at[0], -at[2], "o", ms=4, mfc="white", mec="black", mew=0.8, zorder=6)
    for loop in posture.loops:
        at = np.asarray(loop.point)
        axes.plot(at[0], -at[2], "s", ms=4, mfc="white", mec="black", mew=0.8, zorder=6)


def _steer_axis_line(axes: Axes, bicycle: Bicycle, points: np.ndarray) -> None:
    """Draw the steer axis to the ground, and the trail on the ground."""
    foot = float(bicycle.wheel_base + bicycle.trail)
    axes.plot([points[16, 0], foot], [-points[16, 2], 0.0], color=COLOURS["front"], lw=0.9, ls=(0, (6, 2, 1, 2)))
    axes.plot([points[6, 0], foot], [0.0, 0.0], color=COLOURS["front"], lw=3, solid_capstyle="butt", zorder=4)


def _draw_rider(
    axes: Axes, posture: Posture, points: np.ndarray, plane: tuple[int, int], colour: str, alpha: float
) -> None:
    """Draw limbs and torso as capsules of their own width, the head as a circle, seen along one axis."""
    from matplotlib.patches import Circle

    where = list(plane)
    for name, (start, end) in (_LIMBS | _STRAIGHT_ARMS).items():
        if name not in posture.segments:
            continue
        radius = float(posture.segments[name].radius)
        axes.add_patch(_capsule(points[start, where], points[end, where], radius, colour, alpha))
    if plane == (0, 2):
        axes.add_patch(_capsule(points[13, where], points[15, where], 0.09, colour, alpha))
    else:
        corners = [points[i, where] for i in (30, 21, 22, 31)]
        axes.fill(*np.array(corners).T, color=colour, alpha=alpha, lw=1.0, ec=colour)
    head = float(posture.segments["head"].radius)
    axes.add_patch(Circle(tuple(points[25, where]), head, fc=colour, ec="black", lw=0.6, alpha=min(1.0, alpha + 0.2)))


def _capsule(start: np.ndarray, end: np.ndarray, radius: float, colour: str, alpha: float) -> Polygon:
    from matplotlib.patches import Polygon

    along = end - start
    angle = np.arctan2(along[1], along[0])
    half = np.linspace(-np.pi / 2, np.pi / 2, 16)
    circle = radius * np.stack([np.cos(half + angle), np.sin(half + angle)], axis=-1)
    outline = np.concatenate([end + circle, start - circle])
    return Polygon(outline, closed=True, fc=colour, ec="black", lw=0.5, alpha=alpha)


def _top_view(
    axes: Axes,
    bicycle: Bicycle,
    posture: Posture,
    points: np.ndarray,
    colour: str,
    alpha: float,
    steer: float = 0.0,
) -> None:
    axes.set_aspect("equal")
    radius = float(bicycle.rear_wheel_radius)
    if not steer:
        axes.plot([-radius, radius], [0.0, 0.0], color=COLOURS["frame"], lw=4, solid_capstyle="round")
        for start, end in _REAR_TUBES:
            axes.plot(points[[start, end], 0], points[[start, end], 1], color=COLOURS["frame"], lw=2)
    front = float(bicycle.front_wheel_radius)
    # The wheel's heading seen from above: the ground track of a wheel that turns about the tilted axis.
    heading = steer * np.cos(float(bicycle.steer_axis_tilt))
    ends = points[7, :2] + np.outer([-front, front], [np.cos(heading), np.sin(heading)])
    axes.plot(*ends.T, color=colour if steer else COLOURS["frame"], lw=4, solid_capstyle="round")
    for start, end in _FRONT_TUBES:
        pair = points[[start, end], :2].T
        axes.plot(*pair, color=colour if steer else COLOURS["front"], lw=2, solid_capstyle="round")
    _draw_rider(axes, posture, points, (0, 1), colour, alpha)
