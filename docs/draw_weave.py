"""Draw the picture that moves: `python docs/draw_weave.py` writes docs/figures/weave.gif, one swing of weave.

The Stratos at its weave speed, hands on the bar, where weave neither grows nor dies out, so that the swing closes. The
ride is the nonlinear one, begun in the eigenmotion.
"""

import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.multibody import bicycle_model, ride, simulate
from singletrack.multibody.bicycle.drawn import drawn_lines, placed
from singletrack.output import write_whole
from singletrack.present.style import COLOURS

FILE = Path(__file__).parent / "figures" / "weave.gif"
LEAN = np.radians(7.0)
FRAMES, COLOURS_IN_FILE = 36, 48
AZIMUTH, ELEVATION = np.radians(28.0), np.radians(14.0)
PARTS = {"wheel": ("#222222", 2.0), "frame": (COLOURS["frame"], 2.2), "front": (COLOURS["front"], 2.2)}
RIDER = ("#0072B2", 4.0)


@dataclass(frozen=True, eq=False)
class Swing:
    """One swing of weave: times (t,), s; lean and steer (t,), rad; lines with places (t, k, 3), m, forward on average.

    ``contacts`` (t, 2, 2), m, are those of the rear and the front wheel, ``way`` what is ridden in one ``period``.
    """

    times: np.ndarray
    period: float
    lean: np.ndarray
    steer: np.ndarray
    lines: tuple
    places: list
    contacts: np.ndarray
    way: float


def one_swing():
    """Return the ride that begins in the eigenmotion, at the weave speed."""
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    small = coefficients(bicycle, rider, "leaned")
    speed = small.critical_speeds().weave[0]
    modes = small.modes([speed])
    upper = int(np.argmax(modes.eigenvalues[0].imag))
    root, motion = modes.eigenvalues[0, upper], modes.eigenmotions[0, upper]
    lean, steer = motion * LEAN / motion[0]
    model = bicycle_model(bicycle, rider, "leaned")
    start = ride(
        model,
        speed,
        {"lean": lean.real, "steer": steer.real},
        {"lean": (root * lean).real, "steer": (root * steer).real},
    )
    times = np.linspace(0.0, 2 * np.pi / root.imag, FRAMES + 1)
    run = simulate(start, times, rtol=1e-8, atol=1e-9)
    contacts = run.contact.to_numpy()[..., :2]
    forward, aside = contacts[-1, 0] - contacts[0, 0]
    way = np.hypot(forward, aside)
    turned = np.array([[forward, aside], [-aside, forward]]) / way  # the mean direction is forward
    lines = drawn_lines(bicycle, rider, "leaned")
    places = placed(model, lines, run.q.to_numpy())
    return Swing(
        times,
        times[-1],
        *(run.q.sel(coordinate=name).to_numpy() for name in ("lean", "steer")),
        lines,
        [np.concatenate([place[..., :2] @ turned.T, place[..., 2:]], axis=-1) for place in places],
        contacts @ turned.T,
        way,
    )


def seen(points, origin):
    """Return places (..., 3) on the picture (..., 2): from behind, the right and above, about a point (2,)."""
    x, y, z = points[..., 0] - origin[0], points[..., 1] - origin[1], points[..., 2]
    right = x * np.sin(AZIMUTH) + y * np.cos(AZIMUTH)
    away = x * np.cos(AZIMUTH) - y * np.sin(AZIMUTH)
    return np.stack([right, -z * np.cos(ELEVATION) + away * np.sin(ELEVATION)], axis=-1)


def draw_road(axes, swing, index, origin):
    """Draw the road's edge lines and what both wheels have written on it."""
    stripe = swing.way / 6  # so that stripes come again after each swing
    for side in (-0.55, 0.55):
        for k in range(-4, 8):
            begin = (np.floor(origin[0] / stripe) + k) * stripe
            ends = np.array([[begin, side, 0.0], [begin + stripe / 2, side, 0.0]])
            axes.plot(*seen(ends, origin).T, color="#C8C8C8", lw=2.0, zorder=0)
    for wheel, colour in ((1, "#56B4E9"), (0, "#E69F00")):
        path = swing.contacts[:, wheel]
        before = path[:-1] - np.array([swing.way, 0.0])
        past = np.concatenate([before, path])[: len(before) + index + 1]
        behind = past[past[:, 0] > origin[0] - 3.0]
        axes.plot(*seen(np.column_stack([behind, np.zeros(len(behind))]), origin).T, color=colour, lw=1.4, zorder=1)


def draw_frame(swing, index):
    """Return one picture, as an image of all colours."""
    figure = Figure(figsize=(6.4, 3.2), dpi=100, facecolor="white")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 0.56, 1.0))
    axes.set(xlim=(-1.15, 1.55), ylim=(-0.62, 2.08))
    axes.set_aspect("equal")
    axes.axis("off")
    origin = np.array([swing.contacts[0, 0, 0] + swing.way * index / FRAMES, 0.0])  # goes on evenly
    draw_road(axes, swing, index, origin)
    for line, place in zip(swing.lines, swing.places, strict=True):
        points = seen(place[index], origin)
        if line.part == "rider" and len(points) > 3:  # the head
            axes.plot(*points.mean(axis=0), "o", color=RIDER[0], ms=17, zorder=4)
        elif len(points) > 3 or line.part != "wheel":
            colour, width = PARTS.get(line.part, RIDER)
            axes.plot(*points.T, color=colour, lw=width, solid_capstyle="round", zorder=3)
    beside = figure.add_axes((0.65, 0.17, 0.33, 0.66))
    for values, colour, dashes, name in ((swing.lean, "#D55E00", "-", "lean"), (swing.steer, "#0072B2", "--", "steer")):
        beside.plot(swing.times, np.degrees(values), dashes, color=colour, lw=1.6, label=name)
        beside.plot(swing.times[index], np.degrees(values[index]), "o", color=colour, ms=6)
    beside.axhline(0.0, color="black", lw=0.6)
    beside.set(xlim=(0, swing.period), ylim=(-10, 10))
    beside.set_xlabel("time (s)", fontsize=9)
    beside.set_ylabel("to the right (deg)", fontsize=9)
    beside.tick_params(labelsize=8)
    beside.spines[["top", "right"]].set_visible(False)
    beside.legend(frameon=False, fontsize=9, ncols=2, loc="lower left", bbox_to_anchor=(0.0, 1.0))
    content = io.BytesIO()
    canvas.print_png(content)
    return Image.open(content).convert("RGB")


def main():
    """Write the picture."""
    swing = one_swing()
    frames = [draw_frame(swing, index) for index in range(FRAMES)]
    palette = frames[0].quantize(COLOURS_IN_FILE, dither=Image.Dither.NONE)
    colours = np.array(palette.getpalette()).reshape(-1, 3)
    colours[colours.min(axis=1) > 245] = 255  # the ground stays white
    palette.putpalette(colours.ravel().tolist())
    small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    content = io.BytesIO()
    # GIFs count in hundredths of a second.
    pause = 10 * round(100 * swing.period / FRAMES)
    small[0].save(content, "gif", save_all=True, append_images=small[1:], duration=pause, loop=0, optimize=True)
    write_whole(FILE, content.getvalue())


if __name__ == "__main__":
    main()
