"""
A million designs
=================

One upright city bicycle is stable with hands on the bar at no speed. Of a million of them, with other trails, head
angles, bars, riders and elbows, how many are? And what do those have that the others have not? Arrays go wherever
numbers go; a million designs are twenty calls.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle, load_rider

bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
rng = np.random.default_rng(1)
MILLION, CHUNK = 1_000_000, 50_000
limits = {
    "trail": (0.03, 0.10),
    "steer_axis_tilt": (np.radians(15.0), np.radians(30.0)),
    "handlebar_length": (0.10, 0.30),
    "stem_length": (0.20, 0.30),
}

elbows, tilts, low, high, told = [], [], [], [], []
for _ in range(MILLION // CHUNK):
    drawn = {name: rng.uniform(*ends, CHUNK) for name, ends in limits.items()}
    riders = rider.replace(rider_mass=rng.uniform(50.0, 100.0, CHUNK))
    elbow = rng.uniform(np.radians(90.0), np.radians(170.0), CHUNK)  # the rider leans until elbows are as bent as this
    model = coefficients(bicycle.replace(**drawn), riders, "upright", fit=elbow)
    first = model.critical_speeds().ranges[:, 0]  # the first stable range of each, NaN where there is none
    elbows.append(np.degrees(elbow))
    tilts.append(90.0 - np.degrees(drawn["steer_axis_tilt"]))
    told.append(model.valid)
    low.append(first[:, 0])
    high.append(first[:, 1])
elbows, head_angles, told, low, high = (np.concatenate(parts) for parts in (elbows, tilts, told, low, high))
stable = np.isfinite(low)
print(f"{told.sum()} of {len(told)} riders reach their bar, {stable.sum()} designs are stable at some speed")
print(f"half of these are so from {np.median(low[stable]):.1f} m/s on")

# %%
# What is seen
# ------------
# Each cell is some seven hundred designs, and its colour the share of them that is stable at some speed. Two numbers
# decide, and the edge between all and none is sharp: how far the elbows are bent, and the head angle. At the head angle
# of the Browser, 67 degrees, elbows bent to 110 degrees make nearly every design stable and those of 142, which our
# rider has on it, none. Each degree less of head angle allows some three more at the elbows.
#
# The reason is that of the city bicycle that rights itself: the further the elbows are bent, the less the arms hold the
# bar straight. Where it is stable, half of the designs are so from 5.5 m/s, 20 km/h, on (right).
#
# For more than fits into memory, or should survive a power cut, ``singletrack sweep`` takes a study file, uses all
# cores, and goes on where it was stopped.

bins = (np.linspace(90.0, 170.0, 41), np.linspace(60.0, 75.0, 31))
made = np.histogram2d(elbows[told], head_angles[told], bins)[0]
good = np.histogram2d(elbows[stable], head_angles[stable], bins)[0]
share = np.divide(good, made, out=np.full_like(made, np.nan), where=made > 20)

figure, (map_, count) = plt.subplots(1, 2, figsize=(8.6, 4.1), layout="constrained", width_ratios=[1.25, 1.0])
mesh = map_.pcolormesh(*bins, 100 * share.T, cmap="cividis", vmin=0, vmax=100, rasterized=True)
figure.colorbar(mesh, ax=map_, label="stable at some speed (%)")
map_.set(xlabel="bend of the elbows (deg; 180: stretched)", ylabel="head angle (deg)")
edges = np.linspace(2.0, 15.0, 53)
count.hist(low[stable], edges, color="#0072B2", label="from", histtype="step", lw=1.8)
count.hist(high[stable & np.isfinite(high)], edges, color="#D55E00", label="to", histtype="step", lw=1.8, ls="--")
count.set(xlabel="speed (m/s)", ylabel="designs", xlim=(2, 15))
count.legend(title="stable", frameon=False)

# %%
# On the command line, ``study.toml`` as in the how-to on sweeps:
#
# .. code-block:: sh
#
#    singletrack sweep study.toml
