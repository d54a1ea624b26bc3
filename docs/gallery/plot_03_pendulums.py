"""
From pendulum periods to parameters
===================================

Nobody can look at a bicycle and see a moment of inertia. It is swung, and a stopwatch tells: as a compound pendulum, on
a torsion rod in three orientations, hung up with a plumb line (Kooijman, Schwab and Meijaard 2008; Moore 2012).

Here a city bicycle whose parameters are known, the Browser, is *measured on paper*: its pendulums are computed
forwards, read off with the errors of a careful afternoon, and given to
:func:`~singletrack.measuring.measurement.measure`. So what comes out can be compared with the truth.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import load_bicycle, measure
from singletrack.measuring.oscillation import fit_oscillation

truth = load_bicycle("browser")
rng = np.random.default_rng(4)
gravity, tilt = truth.gravity, truth.steer_axis_tilt
rod = {"mP": 5.56, "lP": 1.05, "dP": 0.03}  # a steel bar: its inertia follows from mass, length and diameter
rod_inertia = rod["mP"] / 12 * (3 * (rod["dP"] / 2) ** 2 + rod["lP"] ** 2)
stiffness = 5.01  # N m/rad, of the torsion rod; the bar's own period tells it


def twisting(inertia):
    """Return the period on the torsion rod."""
    return 2 * np.pi * np.sqrt(inertia / stiffness)


def swinging(inertia, mass, length):
    """Return the period of a compound pendulum."""
    return 2 * np.pi * np.sqrt((inertia + mass * length**2) / (mass * gravity * length))


# %%
# The forty-two numbers of the protocol: tape and scale first, then periods. Frames hang in three orientations, told by
# the angle of the steer axis, ``alpha``; ``a`` is how far the plumb line passes from the wheel's centre.

raw = {**rod, "TtP1": twisting(rod_inertia), "w": truth.wheel_base, "g": gravity, "gamma": 90 - np.degrees(tilt)}
raw["f"] = truth.front_wheel_radius * np.sin(tilt) - truth.trail * np.cos(tilt)
for end, letter in (("rear", "R"), ("front", "F")):
    mass, radius, across, about = (
        getattr(truth, f"{end}_wheel_{name}") for name in ("mass", "radius", "inertia_xx", "inertia_yy")
    )
    raw |= {f"n{letter}": 13, f"d{letter}": 26 * np.pi * radius, f"m{letter}": mass, f"l{letter}": 0.29}
    raw |= {f"Tt{letter}1": twisting(across), f"Tc{letter}1": swinging(about, mass, 0.29)}
hubs = {"rear": (0.0, -truth.rear_wheel_radius), "front": (truth.wheel_base, -truth.front_wheel_radius)}
for end, letter, angles in (("rear", "B", (3, 140, 230)), ("front", "H", (347, 28, 287))):
    mass, x, z, xx, yy, zz, xz = (
        getattr(truth, f"{end}_frame_{name}")
        for name in ("mass", "x", "z", "inertia_xx", "inertia_yy", "inertia_zz", "inertia_xz")
    )
    x, z = x - hubs[end][0], z - hubs[end][1]
    raw |= {f"m{letter}": mass, f"Tc{letter}1": swinging(yy, mass, np.hypot(x, z))}
    for i, alpha in enumerate(angles, start=1):
        turn = tilt - np.radians(alpha)
        down = np.array([np.cos(turn), -np.sin(turn)])  # the vertical, in the hanging frame
        raw |= {f"alpha{letter}{i}": alpha, f"a{letter}{i}": -(np.sin(turn) * x + np.cos(turn) * z)}
        raw[f"Tt{letter}{i}"] = twisting(down @ np.array([[xx, xz], [xz, zz]]) @ down)

# %%
# Periods come out of a recording: a rate gyro, 30 s, some noise. The fit says how well it knows the period. (The period
# of the rear frame, first orientation, as an example.)

time = np.arange(0.0, 30.0, 0.01)
swing = np.exp(-0.02 * time) * np.cos(2 * np.pi * time / raw["TtB1"]) + rng.normal(0.0, 0.05, time.shape)
fit = fit_oscillation(time, swing)
print(f"period {fit.period:.5f} +/- {fit.period_deviation:.5f} s, truly {raw['TtB1']:.5f} s")

# %%
# The errors of the afternoon, one standard deviation each; everything is read off with them.

errors = {"w": 0.002, "f": 0.001, "gamma": 0.2, "dP": 1e-4, "lP": 1e-3, "lR": 1e-3, "lF": 1e-3, "dR": 0.01, "dF": 0.01}
errors |= {name: 0.02 for name in raw if name.startswith("m")}
errors |= {name: 0.2 if name.startswith("alpha") else 0.003 for name in raw if name.startswith("a")}
errors |= {name: 2e-4 for name in raw if name.startswith("T")}
read = {name: value + rng.normal(0.0, errors.get(name, 0.0)) for name, value in raw.items()}
found = measure(read, errors, name="browser, measured on paper")
values, deviations = found.bicycle.values(), found.bicycle.standard_deviations
names = [name for name in found.names if deviations.get(name)]
off = np.array([(values[name] - truth.values()[name]) / deviations[name] for name in names])
print(f"{len(names)} parameters, {np.mean(abs(off) < 2):.0%} within two standard deviations of the truth")

# %%
# What is seen
# ------------
# Left, where the plumb lines of both frames pass: three lines never cross in one point, and the point nearest to all
# three is taken for the centre of mass (circle; the truth is the cross). Right, how far each parameter came out from
# the truth, in its own standard deviations: if the uncertainties are honest, nineteen of twenty stay within two. An
# inertia that is a small difference of large numbers, such as the frame's about y (a swing, less m l²), has a large
# deviation of its own, and is no worse on this scale.

figure, (hanging, apart) = plt.subplots(1, 2, figsize=(9.0, 4.8), layout="constrained")
for end, colour in (("rear_frame", "#0072B2"), ("front_frame", "#D55E00")):
    x, z = (getattr(found.bicycle, f"{end}_{axis}") for axis in "xz")
    for s, c, d in found.lines[end]:
        along = np.array([-0.25, 0.25])
        foot = np.array([x, z]) - (s * x + c * z - d) * np.array([s, c])
        hanging.plot(foot[0] + c * along, -(foot[1] - s * along), color=colour, lw=1)
    hanging.plot(x, -z, "o", color=colour, mfc="none", ms=9, label=f"{end.replace('_', ' ')}, measured")
    hanging.plot(getattr(truth, f"{end}_x"), -getattr(truth, f"{end}_z"), "+", color="black", ms=11)
hanging.set(xlabel="x, forward of the rear contact (m)", ylabel="height (m)", aspect="equal")
hanging.legend(frameon=False, fontsize=9, loc="upper center", bbox_to_anchor=(0.5, 1.14), ncols=2)
apart.axvspan(-2, 2, color="#DDEFD9")
apart.plot(off, np.arange(len(off)), "o", color="#0072B2", ms=5)
apart.set_yticks(np.arange(len(off)), [name.replace("_", " ") for name in names], fontsize=8)
apart.set(xlim=(-4, 4), xlabel="measured less true (standard deviations)")
apart.invert_yaxis()

# %%
# On the command line, from files:
#
# .. code-block:: sh
#
#    singletrack template measurements > mine.txt
#    singletrack period swing.csv --plot swing.png
#    singletrack measure mine.txt --output mine.toml
