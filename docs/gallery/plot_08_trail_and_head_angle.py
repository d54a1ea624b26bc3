"""
Trail and head angle: a map
===========================

The two numbers on every geometry sheet, trail and head angle. Which pairs of them make a bicycle that rights itself
with its rider's hands on the bar? Everything takes arrays where it takes numbers, so that a map is one call.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, elbow_angle, load_bicycle, load_rider

bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
head_angles = np.radians(np.linspace(60.0, 80.0, 121))
trails = np.linspace(0.0, 0.12, 121)
designs = bicycle.replace(trail=trails[:, None], steer_axis_tilt=np.pi / 2 - head_angles)  # (trail, head angle)

# %%
# Another head angle moves the grips. ``fit`` lets the rider follow, by leaning as far as leaves the elbows as bent as
# they were; without it, designs whose grips the arms do not reach would have no number (``model.valid`` says which).

elbows = elbow_angle(bicycle, rider)
model = coefficients(designs, rider, posture="leaned", fit=elbows)
critical = model.critical_speeds()

# %%
# The width of the stable range, zero where there is none, is what is coloured. (A range that goes on beyond 15 m/s,
# 54 km/h, is cut off there.)

ranges = np.minimum(np.nan_to_num(critical.ranges, nan=0.0, posinf=15.0), 15.0)
width = np.sum(ranges[..., 1] - ranges[..., 0], axis=-1)
first_weave = critical.weave_speeds[..., 0]
as_it_is = coefficients(bicycle, rider, posture="leaned").critical_speeds().stable_ranges[0]
print(f"{width.size} designs, {np.mean(model.valid):.0%} can be ridden, {np.mean(width > 0):.0%} are stable somewhere")
print(f"the Stratos as it is: stable over {as_it_is[1] - as_it_is[0]:.2f} m/s")

# %%
# What is seen
# ------------
# Trail is what widens the stable range: colours change from the bottom to the top, and hardly from left to right. With
# a steep head angle and hardly any trail nothing is stable (white corners). The Stratos (ring) stands well inside, its
# range 3.6 m/s wide.
#
# Dashed lines are weave speeds, and they cost what the colours promise: up and to the right, towards a bicycle with a
# wide range, one must ride ever faster before anything is stable. Only the two numbers change here, nothing that
# usually goes with them, neither the offset of the fork nor where the masses are. A map like this says which way to go;
# the design search two pages on says how far one can.

figure, axes = plt.subplots(figsize=(7.4, 5.2), layout="constrained")
degrees, millimetres = np.degrees(head_angles), 1000 * trails
shown = np.where(width > 0, width, np.nan)
mesh = axes.pcolormesh(degrees, millimetres, shown, cmap="cividis", shading="gouraud", rasterized=True)
figure.colorbar(mesh, label="width of the stable range (m/s)")
lines = axes.contour(
    degrees, millimetres, first_weave, levels=[5.0, 5.5, 6.0, 6.5, 7.0, 8.0], colors="white", linestyles="--"
)
axes.clabel(lines, fmt="%g m/s", fontsize=8)
axes.plot(
    90 - np.degrees(bicycle.steer_axis_tilt), 1000 * bicycle.trail, "o", color="#D55E00", mfc="none", ms=11, mew=2
)
axes.annotate(
    "Stratos", (90 - np.degrees(bicycle.steer_axis_tilt), 1000 * bicycle.trail), (10, -12), textcoords="offset points"
)
axes.set(xlabel="head angle (deg)", ylabel="trail (mm)")
axes.invert_xaxis()

# %%
# On the command line, one parameter against the speed:
#
# .. code-block:: sh
#
#    singletrack plot stratos --rider rider-a --posture leaned --over trail=20mm:120mm:2 --as map -o map.png
