"""
Hands on the bar: figure 4 of the paper
=======================================

Schwab and Kooijman asked what it does to a bicycle's stability that a real rider *holds* the handlebar. Their figure 4
answers for a touring bicycle, the Stratos, and a rider who leans forward on stretched arms. Here it is again, from the
measured bicycle and rider that come with the package.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.present.eigenvalues import draw_eigenvalues

bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
free = coefficients(bicycle, rider, posture="rigid")
held = coefficients(bicycle, rider, posture="leaned")

# %%
# Two entries of the matrices tell the story. The arms and the twisting torso move with the steer, so that the inertia
# about the steer axis, M[1, 1], grows from 0.25 to 0.65 kg m². And the torso's weight rests on the hands, which changes
# the stiffness g K0[1, 1] from -6.8 to -9.7 N m/rad.

for name, model in {"hands free": free, "hands on the bar": held}.items():
    ((low, high),) = model.critical_speeds().stable_ranges
    inertia, stiffness = model.M[1, 1], model.gravity * model.K0[1, 1]
    print(f"{name:17}: {inertia:.3f} kg m², {stiffness:+.3f} N m/rad, stable from {low:.2f} to {high:.2f} m/s")

# %%
# What is seen
# ------------
# Real parts are solid, imaginary parts dashed; where all real parts are below zero (shaded) the bicycle rights itself.
# *Weave* is the swaying motion: it grows at low speed and dies out above the weave speed. *Capsize* is the slow fall to
# one side, which the bicycle itself prevents up to the capsize speed.
#
# With hands on the bar nothing changes its kind, and the range moves up, from 4.66 to 7.87 m/s (hands free) to 5.99 to
# 9.59 m/s; weave is slower throughout. More inertia at the bar makes the steer answer a lean later, which is why more
# speed is needed; the more negative stiffness, with which a bar that is turned turns further, holds off capsize.

speeds = np.linspace(0.0, 10.0, 401)
figure, axes = plt.subplots(1, 2, figsize=(9.0, 4.2), layout="constrained")
for ax, model, title in zip(axes, (free, held), ("(a) rigid rider, hands free", "(b) hands on the bar"), strict=True):
    draw_eigenvalues(ax, model.modes(speeds), model.critical_speeds())
    ax.set_title(title, loc="left", fontsize=11)

# %%
# On the command line, with every number of the paper beside what was computed in the second line's report:
#
# .. code-block:: sh
#
#    singletrack eigenvalues stratos --rider rider-a --posture leaned --speeds 0:10:101 --csv
#    singletrack reproduce
