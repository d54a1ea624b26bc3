"""A ride as a figure and as an animation; the rider moves."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError
from singletrack.present.style import COLOURS, new_figure, style

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from singletrack.arrays import Array

__all__ = ["animation_bytes", "ride_figure"]

_PART_COLOURS = {"wheel": "#000000", "frame": COLOURS["frame"], "front": COLOURS["front"], "rider": COLOURS["rider"]}
_AZIMUTH, _ELEVATION = np.radians(25.0), np.radians(12.0)


def ride_figure(time: Array, lean: Array, steer: Array, path: Array, title: str, end: str) -> Figure:
    """Return lean and steer over time, and the path of the rear wheel from above.

    Parameters
    ----------
    time, lean, steer : array, shape (t,)
        s and deg.
    path : array, shape (t, 2)
        Forward and to the right, m.
    title, end : str
        What it is, and how it ended.
    """
    with style():
        figure = new_figure(7.2, 3.6)
        figure.suptitle(title, x=0.01, ha="left", fontsize=10)
        over_time, from_above = figure.subplots(1, 2)
        over_time.axhline(0.0, color="black", lw=0.6)
        over_time.plot(time, lean, color=COLOURS["weave"], label="lean")
        over_time.plot(time, steer, color=COLOURS["capsize"], label="steer")
        over_time.set_xlabel("time (s)")
        over_time.set_ylabel("angle to the right (deg)")
        over_time.legend(frameon=False, fontsize=8)
        over_time.annotate(end, (1.0, 1.02), xycoords="axes fraction", ha="right", fontsize=8)
        from_above.plot(path[:, 1], path[:, 0], color=COLOURS["frame"])
        from_above.plot(path[-1, 1], path[-1, 0], "o", color=COLOURS["capsize"], ms=4)
        from_above.set_xlabel("to the right (m)")
        from_above.set_ylabel("forward (m)")
        from_above.set_aspect("equal", adjustable="datalim")
    return figure


def _seen(points: Array, around: Array) -> Array:
    """Return places (..., 3) on the screen (..., 2), seen obliquely from behind, around a point that is followed."""
    apart = points - around
    right = -apart[..., 0] * np.sin(_AZIMUTH) * -1.0 + apart[..., 1] * np.cos(_AZIMUTH)
    away = apart[..., 0] * np.cos(_AZIMUTH) - apart[..., 1] * np.sin(_AZIMUTH)
    return np.stack([right, -apart[..., 2] * np.cos(_ELEVATION) + away * np.sin(_ELEVATION)], axis=-1)


def animation_bytes(
    parts: Sequence[str],
    places: Sequence[Array],
    path: Array,
    times: Array,
    title: str,
    suffix: str,
    progress: Callable[[int], object] | None = None,
) -> bytes:
    """Return a ride as an animation.

    Parameters
    ----------
    parts : sequence of str
        What each line belongs to: wheel, frame, front, rider.
    places : sequence of array, shape (t, k, 3)
        The points of each line over time, m.
    path : array, shape (t, 2)
        Of the rear wheel, m.
    times : array, shape (t,)
        Evenly spaced, s.
    title, suffix : str
        ``.gif`` or ``.mp4``.
    progress : callable, optional
        Called with the number of each frame.

    Raises
    ------
    InputError
        For another suffix, or ``.mp4`` where there is no ffmpeg.
    """
    from matplotlib import animation  # lazy: heavy

    writers: dict[str, Any] = {".gif": animation.PillowWriter, ".mp4": animation.FFMpegWriter}
    if suffix not in writers:
        raise InputError(f"animation: unknown suffix {suffix!r}, must be one of {', '.join(writers)}")
    if not writers[suffix].isAvailable():
        raise InputError(f"animation: {suffix} needs ffmpeg, which is not there; .gif needs nothing")
    writer: Any = writers[suffix](fps=round(1.0 / float(times[1] - times[0])))
    with style(), tempfile.TemporaryDirectory() as folder:
        figure = new_figure(5.6, 3.6)
        axes = figure.add_subplot()
        ground, lines, clock = _stage(axes, parts, title)
        file = Path(folder) / f"ride{suffix}"
        with writer.saving(figure, str(file), dpi=80):
            for i, t in enumerate(times):
                around = np.array([path[i, 0], path[i, 1], 0.0])
                track = np.column_stack([path[: i + 1], np.zeros(i + 1)])
                ground.set_data(*_seen(track, around).T)
                for line, place in zip(lines, places, strict=True):
                    line.set_data(*_seen(place[i], around).T)
                clock.set_text(f"{t:.2f} s")
                writer.grab_frame()
                if progress is not None:
                    progress(i)
        return file.read_bytes()


def _stage(axes: Axes, parts: Sequence[str], title: str) -> tuple[Any, list[Any], Any]:
    axes.set_title(title, loc="left", fontsize=9)
    axes.set_xlim(-1.6, 2.2)
    axes.set_ylim(-0.35, 2.1)
    axes.set_aspect("equal")
    axes.set_axis_off()
    (ground,) = axes.plot([], [], color="#999999", lw=1.0)
    lines = [axes.plot([], [], color=_PART_COLOURS[part], lw=2.4 if part == "rider" else 1.6)[0] for part in parts]
    clock = axes.annotate("", (0.99, 0.97), xycoords="axes fraction", ha="right", va="top", fontsize=9)
    return ground, lines, clock
