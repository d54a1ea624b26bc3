"""
Proven, for every bicycle in between
====================================

A computed number is a number near the true one, one hopes. A certificate is a theorem: ball arithmetic carries a bound
through every operation, and what comes out holds for the parameters exactly as they were written, or for *every*
bicycle between two. (It needs ``pip install '.[certify]'``.)
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle

bicycle = load_bicycle("benchmark")
model = coefficients(bicycle)
exact = model.critical_speeds(certify=True)
for crossing in exact.crossings:
    print(f"stability {crossing.direction} at {crossing.speed.middle} m/s, +/- {crossing.speed.radius}")
print([(f"{each.unstable} unstable roots", each.words) for each in exact.ranges], exact.status)

# %%
# Now for whole intervals of the trail, each 5 mm wide: one theorem for all designs of an interval.

edges = np.arange(-5, 105, 5)  # mm
proven = {
    (low, low + 5): model.critical_speeds(certify=True, over={"trail": (f"{low} mm", f"{low + 5} mm")})
    for low in edges[:-1].tolist()
}
for (low, high), certificate in proven.items():
    if certificate.status != "certified":
        print(f"trail from {low} to {high} mm: {certificate.status}, after {certificate.boxes} boxes")
wide = proven[55, 60].stable_ranges[0]
print(f"any trail from 55 to 60 mm: stable at all speeds from {wide[0]:.4f} to {wide[1]:.4f} m/s")

# %%
# What is seen
# ------------
# Green is proven: *no* bicycle with a trail within an interval and a speed within the green is unstable, and there are
# no finer places where one would have to look. The bars are the critical speeds of all bicycles of an interval, as wide
# as they truly differ; the lines on which they are strung are those computed in doubles.
#
# Left of zero trail the two come so close that, within 5 mm, the capsize speed of one bicycle is the weave speed of
# another. No theorem is true of all of them there: a part stays undecided (hatched). It says so, and claims nothing.

figure, axes = plt.subplots(figsize=(7.4, 4.8), layout="constrained")
colours = {"pair": "#0072B2", "real": "#D55E00"}
for (low, high), certificate in proven.items():
    for start, stop in certificate.stable_ranges:
        axes.fill_between([low, high], start, stop, color="#DDEFD9", lw=0)
    for crossing in certificate.crossings:
        ball = crossing.speed
        axes.fill_between([low, high], ball.lower, ball.upper, color=colours[crossing.kind], alpha=0.75, lw=0)
    for start, stop in certificate.undecided:
        axes.fill_between([low, high], start, min(stop, 12.0), facecolor="none", edgecolor="0.5", hatch="///", lw=0)
trails = np.linspace(-0.005, 0.1, 211)
critical = coefficients(bicycle.replace(trail=trails)).critical_speeds()
for speeds, name, dashes in ((critical.weave_speeds, "weave", "-"), (critical.capsize_speeds, "capsize", "--")):
    axes.plot(1000 * trails, speeds[:, 0], "k", ls=dashes, lw=1.0, label=f"{name} speed, in doubles")
axes.set(xlabel="trail (mm)", ylabel="forward speed v (m/s)", xlim=(-5, 100), ylim=(2, 7))
axes.legend(frameon=False, loc="upper left")

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack critical-speeds benchmark --certify
#    singletrack critical-speeds benchmark --certify --over "trail=55 mm:60 mm"
