"""Draw the figures of files.md: `python docs/draw_measuring.py` writes them to docs/figures."""

from pathlib import Path

import numpy as np
from matplotlib.patches import Arc

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.analysis.uncertainty import eigenvalue_uncertainty
from singletrack.body.skeleton import skeleton
from singletrack.output import write_whole
from singletrack.present.bands import add_bands
from singletrack.present.eigenvalues import draw_eigenvalues
from singletrack.present.style import COLOURS, figure_bytes, new_figure, style

FOLDER = Path(__file__).parent / "figures"
FRAME, FRONT, RIDER = COLOURS["frame"], COLOURS["front"], COLOURS["rider"]


def canvas(width, height, xlim, ylim):
    """Return a figure and axes in metres, x forward, z down."""
    figure = new_figure(width, height)
    axes = figure.add_subplot()
    axes.set(xlim=xlim, ylim=ylim, aspect="equal")
    axes.axis("off")
    return figure, axes


# Where a name stands beside a point: horizontal and vertical alignment, and the step away from it in points.
SIDES = {
    "right": ("left", "center", (4, 0)),
    "left": ("right", "center", (-4, 0)),
    "above": ("center", "bottom", (0, 3)),
    "below": ("center", "top", (0, -3)),
}


def word(axes, point, text, side="right", further=0.0, **style):
    """Write a word beside a point (x, z), some points further than close by."""
    align, height, step = SIDES[side]
    step = tuple(part + further * np.sign(part) for part in step)
    axes.annotate(
        text, point, step, textcoords="offset points", ha=align, va=height, fontsize=8, annotation_clip=False, **style
    )


def measure(axes, start, end, name, offset=(0.0, 0.0), side="right", along=0.5, further=0.0):
    """Draw a dimension line between two points (x, z), moved aside by an offset; its name stands beside it."""
    (x0, z0), (x1, z1) = (np.add(point, offset) for point in (start, end))
    axes.annotate("", (x1, z1), (x0, z0), arrowprops={"arrowstyle": "<->", "lw": 0.8, "shrinkA": 0, "shrinkB": 0})
    axes.plot([x0, x1], [z0, z1], lw=0, gid="dimension")  # where the arrow is, for those who look for room
    for point, moved in ((start, (x0, z0)), (end, (x1, z1))):
        axes.plot(*zip(point, moved, strict=True), color="0.6", lw=0.5, gid="dimension")
    word(axes, (x0 + along * (x1 - x0), z0 + along * (z1 - z0)), name, side, further)


def bicycle():
    """Draw the lengths of a bicycle, to scale, on the Browser."""
    bike = load_bicycle("browser")
    p = skeleton(bike, load_rider("rider-a"))
    at = {n: (float(p[n][0]), float(p[n][2])) for n in range(1, 32)}
    figure, axes = canvas(9.2, 5.3, (-0.86, 1.95), (0.26, -1.24))
    for centre, radius in ((2, bike.rear_wheel_radius), (7, bike.front_wheel_radius)):
        angle = np.linspace(0, 2 * np.pi, 200)
        axes.plot(at[centre][0] + radius * np.cos(angle), at[centre][1] + radius * np.sin(angle), color="0.75", lw=3)
    axes.axhline(0, color="0.5", lw=0.8)
    for a, b, colour in (
        *((2, 5, FRAME), (5, 10, FRAME), (10, 13, FRAME), (2, 10, FRAME), (10, 12, FRAME), (5, 11, FRAME)),
        *((7, 11, FRONT), (11, 16, FRONT), (16, 19, FRONT)),
    ):
        axes.plot(*zip(at[a], at[b], strict=True), color=colour, lw=3, solid_capstyle="round")
    foot = (float(bike.wheel_base + bike.trail), 0.0)
    axes.plot(*zip(at[16], foot, strict=True), color=FRONT, lw=0.8, ls="--")
    measure(axes, at[1], at[6], "wheel_base", (0, 0.17), "below")
    measure(axes, at[6], foot, "trail", (0, 0.06), along=1.0)
    measure(axes, at[2], (0.0, 0.0), "rear_wheel_radius", (-0.42, 0), "left")
    measure(axes, at[7], (at[7][0], 0.0), "front_wheel_radius", (0.42, 0))
    measure(axes, at[2], at[5], "chain_stay_length", (-0.01, 0.07), "below", 0.25, 5)
    measure(axes, at[5], (at[5][0], 0.0), "bottom_bracket_height", (0.02, 0), "right", 0.84)
    measure(axes, at[5], at[10], "seat_tube_length", (0.1, -0.04), "right", 0.72)
    measure(axes, at[10], at[13], "seat_post_length", (-0.09, 0.03), "left")
    measure(axes, at[7], at[11], "fork_length", (0.13, -0.08), along=0.85)
    measure(axes, at[12], at[16], "stem_length", (0.14, -0.06))
    measure(axes, at[16], at[19], "handlebar_length", (0, -0.05), "above")
    axes.add_patch(Arc(at[5], 0.24, 0.24, theta1=180, theta2=180 + 68.5, lw=0.8))
    axes.plot([at[5][0] - 0.17, at[5][0]], [at[5][1]] * 2, color="0.6", lw=0.5)
    inside = (at[5][0] - 0.1, at[5][1] - 0.07)
    beside = (-0.46, at[5][1] - 0.45)
    axes.plot(*zip(beside, inside, strict=True), color="0.6", lw=0.5, gid="dimension")
    word(axes, beside, "seat_tube_angle", "above")
    axes.plot([at[11][0]] * 2, [at[11][1], at[11][1] - 0.42], color="0.6", lw=0.5)
    axes.add_patch(Arc(at[11], 0.6, 0.6, theta1=248.5, theta2=270, lw=0.8))
    word(axes, (at[11][0], at[11][1] - 0.42), "steer_axis_tilt", "above")
    word(axes, at[19], "grip", "left")
    word(axes, at[13], "saddle", "above")
    return figure


def rider():
    """Draw the lengths of a rider, to scale, on the Browser."""
    bike, person = load_bicycle("browser"), load_rider("rider-a")
    p = skeleton(bike, person)
    at = {n: (float(p[n][0]), float(p[n][2])) for n in range(1, 32)}
    figure, axes = canvas(5.6, 5.6, (-0.35, 1.15), (-0.2, -1.72))
    for a, b in ((10, 13), (5, 10), (12, 16), (16, 19)):
        axes.plot(*zip(at[a], at[b], strict=True), color="0.75", lw=3)
    for a, b in ((13, 15), (21, 23), (23, 19), (13, 14), (14, 5)):
        axes.plot(*zip(at[a], at[b], strict=True), color=RIDER, lw=4, solid_capstyle="round")
    angle, radius = np.linspace(0, 2 * np.pi, 100), float(person.head_circumference) / (2 * np.pi)
    axes.plot(at[25][0] + radius * np.cos(angle), at[25][1] + radius * np.sin(angle), color=RIDER, lw=3)
    measure(axes, at[13], at[15], "torso_length", (-0.13, 0), "left")
    measure(axes, at[21], at[23], "upper_arm_length", (0.12, -0.03))
    measure(axes, at[23], at[19], "lower_arm_length", (-0.03, 0.06), "below", 1.0, 3)
    measure(axes, at[13], at[14], "upper_leg_length", (-0.05, 0.09), "left", 0.25, 3)
    measure(axes, at[14], at[5], "lower_leg_length", (0.1, 0))
    word(axes, (at[25][0] + radius, at[25][1]), "head_circumference")
    axes.add_patch(Arc(at[13], 0.24, 0.24, theta1=-82.9, theta2=0, lw=0.8))
    axes.plot([at[13][0], at[13][0] + 0.17], [at[13][1]] * 2, color="0.6", lw=0.5)
    inside, beside = (at[13][0] + 0.06, at[13][1] - 0.06), (at[13][0] - 0.28, at[13][1] - 0.06)
    axes.plot(*zip(beside, inside, strict=True), color="0.6", lw=0.5, gid="dimension")
    word(axes, beside, "forward_lean_angle", "left")
    return figure


def pendulums():
    """Draw the four measurements of a frame: rolling, torsional and compound pendulum, plumb lines."""
    figure, axes = canvas(9.0, 3.4, (-0.2, 4.4), (1.35, -0.25))
    angle = np.linspace(0, 2 * np.pi, 100)
    titles = ("1  roll: d, n", "2  swing: Tc, l", "3  twist: Tt (three orientations)", "4  hang: alpha, a (same three)")
    for title, x in zip(titles, (0.35, 1.3, 2.3, 3.55), strict=True):
        axes.text(x, 1.28, title, fontsize=8, ha="center")
    for x in (0.1, 0.6):
        axes.plot(x + 0.25 * np.cos(angle), 0.75 + 0.25 * np.sin(angle), color="0.7", lw=2)
    axes.plot([-0.15, 0.9], [1.0, 1.0], color="0.4")
    measure(axes, (0.1, 1.0), (0.6, 1.0), "d", (0, 0.1), "below")
    axes.plot([1.0, 1.6], [0, 0], color="0.4", lw=3)
    axes.plot([1.3, 1.25, 1.35, 1.3], [0.0, 0.06, 0.06, 0.0], color="0.2")
    axes.plot(1.3 + 0.3 * np.cos(angle), 0.35 + 0.3 * np.sin(angle), color="0.7", lw=2)
    axes.plot(1.3, 0.35, "o", color="0.2")
    measure(axes, (1.3, 0.03), (1.3, 0.35), "l", (0.12, 0))
    axes.add_patch(Arc((1.3, 0.0), 1.5, 1.5, theta1=70, theta2=110, lw=0.8))
    axes.text(1.3, 0.85, "Tc", fontsize=8, ha="center")
    frame = np.array([[-0.35, 0.1], [0.0, 0.2], [-0.1, -0.2], [-0.35, 0.1], [0.0, 0.2], [0.3, -0.2], [-0.1, -0.2]])
    for x, turn in ((2.3, 0.2), (3.55, 0.5)):
        cos, sin = np.cos(turn), np.sin(turn)
        body = frame @ np.array([[cos, sin], [-sin, cos]]) + [x, 0.8]
        axes.plot([x - 0.3, x + 0.3], [0, 0], color="0.4", lw=3)
        axes.plot([x, x], [0, 0.55], color="0.2", lw=1.2)
        axes.plot([x, body[6, 0]], [0.55, body[6, 1]], color="0.2", lw=0.8, ls=":")
        axes.plot(*body.T, color=FRAME, lw=3, solid_capstyle="round")
        axes.plot(*body[0], "o", color="0.2")
    axes.add_patch(Arc((2.3, 0.45), 0.25, 0.08, theta1=20, theta2=340, lw=0.8))
    axes.text(2.45, 0.45, "Tt", fontsize=8)
    axes.plot([3.55, 3.55], [0.55, 1.2], color=COLOURS["weave"], lw=1, ls="--")
    axes.text(3.58, 1.18, "plumb line", fontsize=8, color=COLOURS["weave"])
    cos, sin = np.cos(0.5), np.sin(0.5)
    hub = frame[0] @ np.array([[cos, sin], [-sin, cos]]) + [3.55, 0.8]
    measure(axes, tuple(hub), (3.55, hub[1]), "a", (0, 0.42), "below")
    head = frame[5] @ np.array([[cos, sin], [-sin, cos]]) + [3.55, 0.8]
    axes.text(head[0] + 0.05, head[1], "head tube: alpha\nfrom the horizontal", fontsize=8, va="center")
    return figure


def bands():
    """Draw the Stratos' eigenvalues with bands, for deviations such as a tape measure held by hand leaves."""
    deviations = {
        **dict.fromkeys(("wheel_base", "trail"), 0.005),
        **dict.fromkeys(("rear_frame_x", "rear_frame_z", "front_frame_x", "front_frame_z"), 0.010),
        "steer_axis_tilt": np.radians(0.5),
    }
    bike = load_bicycle("stratos").replace(standard_deviations=deviations)
    speeds = np.linspace(0, 10, 401)
    model = coefficients(bike)
    figure = new_figure(6.4, 4.6)
    axes = figure.add_subplot()
    draw_eigenvalues(axes, model.modes(speeds), model.critical_speeds())
    add_bands(axes, eigenvalue_uncertainty(bike, speeds=speeds))
    return figure


def main():
    """Write all figures."""
    drawings = {"measuring-bicycle": bicycle, "measuring-rider": rider, "measuring-pendulums": pendulums}
    with style():
        for name, draw in {**drawings, "uncertainty-bands": bands}.items():
            write_whole(FOLDER / f"{name}.png", figure_bytes(draw(), "png"))


if __name__ == "__main__":
    main()
