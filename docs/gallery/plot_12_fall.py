"""
A fall, and how to prevent it
=============================

Upright, with hands on the bar, the Browser is stable at no speed. What that looks like is shown by the nonlinear ride:
a knock from the side at 4 m/s, hands that hold the bar and do nothing. And then the same knock once more, with hands
that steer into the fall.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import load_bicycle, load_rider, ride_for
from singletrack.parameters import Feedback

bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
knock = {"speed": 4.0, "push": 0.3, "duration": 5.0}  # m/s; rad/s of lean to the right; s
still = ride_for(bicycle, rider, "upright", **knock)
print(f"hands still: {still.end}, after {still.end_time:.2f} s")

gains = {("steer torque", "lean"): 5.0, ("steer torque", "lean rate"): 5.0}  # N m/rad, N m s/rad
steering = Feedback(gains, limit=20.0)  # N m
caught = ride_for(bicycle, rider, "upright", **knock, feedback=steering)
lean = np.degrees(caught.coordinate("lean"))
print(f"steering into the fall: {caught.end}, lean {lean.max():.1f} deg at most and {lean[-1]:.2f} deg after 5 s")

# %%
# What is seen
# ------------
# Hands that hold still do not prevent the bar from turning, but too little and too late: the lean grows by a factor of
# e every 0.6 s (linear theory: 1.74 1/s at 4 m/s), and after 1.5 s rider and bicycle are on the ground.
#
# Steering into the fall brings the wheels back under the rider: 5 N m for each rad of lean and each rad/s of lean rate
# are enough here. The lean comes to 4.8 degrees and dies out, swinging; the bicycle goes on in another direction than
# before, since nothing tells the hands where it came from. More is not better: with four times the gain on the rate,
# what swings at this speed grows, and the outer hand loses the bar after three seconds.


def seen(points):
    """Return points (..., 3) as seen from behind, the right and above, (..., 2)."""
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([0.42 * x + 0.91 * y, 0.19 * x - 0.09 * y - 0.98 * z], axis=-1)


colours = {"wheel": "#000000", "frame": "#555555", "front": "#CC79A7", "rider": "#D55E00"}
figure, axes = plt.subplot_mosaic("aa;bc", figsize=(8.2, 5.0), layout="constrained", height_ratios=[0.95, 1.0])
places = still.places()
for frame, time in enumerate(np.linspace(0.0, still.end_time - 0.01, 6)):
    index = int(np.argmin(abs(still.data.time.to_numpy() - time)))
    contact = still.data.contact.sel(wheel="rear wheel").to_numpy()[index]
    for line, place in zip(still.lines, places, strict=True):
        across, up = seen(place[index] - contact).T
        axes["a"].plot(across + 1.75 * frame, up, color=colours[line.part], lw=2.2 if line.part == "rider" else 1.4)
    axes["a"].annotate(f"{time:.1f} s", (1.75 * frame + 0.2, -0.35), ha="center")
axes["a"].set(aspect="equal", ylim=(-0.45, 2.1))
axes["a"].set_axis_off()
for ride, colour, dashes, name in ((still, "#D55E00", "-", "hands still"), (caught, "#0072B2", "--", "steering")):
    time = ride.data.time.to_numpy()
    axes["b"].plot(time, np.degrees(ride.coordinate("lean")), dashes, color=colour, label=name)
    path = ride.data.contact.sel(wheel="rear wheel").to_numpy()
    axes["c"].plot(path[:, 0], path[:, 1], dashes, color=colour)
axes["b"].set(xlabel="time (s)", ylabel="lean to the right (deg)", xlim=(0, 5), ylim=(-5, 90))
axes["b"].legend(frameon=False)
axes["c"].set(xlabel="forward (m)", ylabel="to the right (m)")

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack ride browser --rider rider-a --posture upright --speed 4 --push 0.3 --animate fall.gif
#    singletrack ride browser --rider rider-a --posture upright --speed 4 --push 0.3 \
#        --for 5 --feedback "steer torque: lean=5" --feedback "steer torque: lean rate=5"
