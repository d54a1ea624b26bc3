"""
Where to put five kilograms
===========================

A basket at the handlebar, a bag on the rear carrier, a battery in the frame: the same five kilograms, at another place.
A geometry sheet lists what is mounted, and the place may vary like any other entry of it.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import catalogue, load_rider
from singletrack.analysis.sheet_designs import SheetDesign
from singletrack.linear import critical_speeds

sheet = {"head_angle": "69 deg", "fork_offset": "50 mm", "wheel_size": "37-622", "wheel_base": "1.10 m"}
sheet |= {"stack": "0.62 m", "saddle_height": "0.70 m", "bar": "city"}
luggage = {"name": "luggage", "mass": "5 kg", "x": "0.9 m", "z": "-0.9 m"}  # forward of the rear contact, and down
rider = load_rider("rider-a").replace(forward_lean_angle=np.radians(75.0))
places = np.linspace(-0.3, 1.4, 171)  # m, forward of the rear contact

ranges = {}
for on in ("rear frame", "front frame"):
    loaded = catalogue.expected(**sheet, loads=[luggage | {"on": on}])
    design = SheetDesign.of_sheet(loaded, rider, "rigid")
    ranges[on] = critical_speeds(design.changed({"luggage x": places}).model()).ranges[:, 0]
    stable = np.isfinite(ranges[on][:, 0])
    print(f"on the {on}: stable at some speed from {places[stable][0]:.2f} to {places[stable][-1]:.2f} m", end="; ")
    print(f"from {np.nanmin(ranges[on]):.2f} m/s on at best")
bare = critical_speeds(SheetDesign.of_sheet(catalogue.expected(**sheet), rider, "rigid").model()).stable_ranges[0]
print(f"without luggage: stable from {bare[0]:.2f} to {bare[1]:.2f} m/s")

# %%
# Where the steer axis passes at the height of the luggage:

own = design.bicycle
axis = own.wheel_base + own.trail - 0.9 * np.tan(own.steer_axis_tilt)
print(f"{axis:.2f} m forward of the rear contact")

# %%
# What is seen
# ------------
# Shaded is where the bicycle with this rider, hands free, rights itself; dashed lines are the range without luggage. On
# the frame (left) it hardly matters where the five kilograms are: from behind the saddle to above the front wheel the
# range moves by some tenths of a metre per second.
#
# On the bar (right) everything depends on it. When the bicycle leans, luggage ahead of the steer axis pulls the bar
# into the fall, as it should go, and luggage behind the axis pulls it out: a quarter of a metre behind there is no
# stable speed left. Further ahead the range is wide, and begins ever later, over the front hub at 7 m/s. A basket
# belongs close to the steer axis or, better, on the frame.

figure, axes = plt.subplots(1, 2, figsize=(8.6, 4.1), layout="constrained", sharey=True)
for ax, (on, found) in zip(axes, ranges.items(), strict=True):
    ax.fill_between(places, *found.T, color="#DDEFD9")
    ax.plot(places, found[:, 0], color="#0072B2", lw=1.8, label="stable from")
    ax.plot(places, found[:, 1], color="#D55E00", lw=1.8, ls="-.", label="stable to")
    for speed in bare:
        ax.axhline(speed, color="black", lw=0.9, ls="--")
    for place, name in ((0.0, "rear hub"), (own.wheel_base, "front hub")):
        ax.axvline(place, color="0.6", lw=0.8, ls=":")
        ax.annotate(name, (place, 4.2), (3, 0), textcoords="offset points", fontsize=8, color="0.4")
    ax.set_title(f"5 kg on the {on}", loc="left", fontsize=11)
    ax.set(xlabel="luggage, forward of the rear contact (m)", xlim=(-0.3, 1.4), ylim=(4, 13))
axes[0].set_ylabel("forward speed v (m/s)")
axes[1].axvline(axis, color="#CC79A7", lw=1.4)
axes[1].annotate(
    "steer axis", (axis, 11.8), (-4, 0), textcoords="offset points", ha="right", fontsize=8, color="#8A3B68"
)
axes[0].legend(frameon=False, loc="upper left", bbox_to_anchor=(0.18, 0.9))

# %%
# On the command line, for a sheet with a table ``[[loads]]``:
#
# .. code-block:: sh
#
#    singletrack sensitivity sheet.toml
#    singletrack design sheet.toml --aim widest --vary "luggage x=0 m:1.2 m" -o found.toml
