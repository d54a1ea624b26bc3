"""
A rider who leans in the hips
=============================

In the journal version of the paper (2012) the upper body may lean sideways about the hips: one more coordinate,
``torso lean``, and one more input, the torque of the back muscles, ``torso torque``. How stiff must a back be before it
is as good as rigid?
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle, load_rider

bicycle, rider = load_bicycle("stratos-2012"), load_rider("rider-a")


def leaning(stiffness, damping):
    """Return the model of the leaned rider with a spring and a damper at the hips, in N m/rad and N m s/rad."""
    at_hips = {"springs": {"torso lean": stiffness}, "dampers": {"torso lean": damping}}
    return coefficients(bicycle, rider, "leaned", torso_lean=True, **at_hips)


models = {
    "rigid back": coefficients(bicycle, rider, "leaned"),
    "1000 N m/rad": leaning(1000.0, 30.0),
    "400 N m/rad": leaning(400.0, 20.0),
    "100 N m/rad": leaning(100.0, 10.0),
    "no stiffness": leaning(0.0, 0.0),
}
for name, model in models.items():
    ranges = ", ".join(f"{low:.2f} to {high:.2f} m/s" for low, high in model.critical_speeds().stable_ranges)
    print(f"{name:13} stable {ranges or 'never'}")

# %%
# What is seen
# ------------
# Each row of dots is a mode of the bicycle at 7 m/s. Without any stiffness the torso is a pendulum that stands on its
# head, falls at 6.7 1/s, and no speed is stable: a rider needs the back. With 400 N m/rad the torso oscillates fast and
# is well damped, and what is left of the bicycle, weave and capsize, is hardly changed: stable from 5.96 to 9.84 m/s
# where the rigid back gives 6.12 to 9.60.
#
# In between lies trouble. Gravity takes 126 N m/rad of stiffness from the torso, a spring of 100 gives less than that:
# the motion of the torso is slow, mixes with capsize, and the pair of them grows. Whether the rider is *able* to stop
# it by leaning is the question of controllability, on the next page.

figure, axes = plt.subplots(figsize=(8.0, 4.6), layout="constrained")
colours = {"weave": "#0072B2", "capsize": "#D55E00", "castering": "#009E73", "torso lean": "#CC79A7"}
markers = {"weave": "o", "capsize": "s", "castering": "^", "torso lean": "D"}
for row, model in enumerate(models.values()):
    modes = model.modes([7.0])
    for mode, root in zip(modes.names, modes.eigenvalues[0], strict=True):
        label = mode if row == 1 and mode not in axes.get_legend_handles_labels()[1] else None
        axes.plot(root.real, -row, markers[mode], color=colours[mode], ms=8, label=label)
        if root.imag > 0:
            words = f"{root.imag / (2 * np.pi):.2f} Hz"
            above = 9 if mode == "weave" or root.real < -3.0 else -17
            axes.annotate(words, (root.real, -row), (0, above), textcoords="offset points", ha="center", fontsize=8)
axes.axvspan(0, 8, color="#F3E3DC", zorder=0)
axes.annotate("grows", (7.8, 0.45), ha="right", fontsize=9)
axes.axvline(0.0, color="black", lw=0.8)
axes.set_yticks([-row for row in range(len(models))], list(models))
axes.set(xlabel="real part of the eigenvalue at 7 m/s (1/s)", xlim=(-14, 8), ylim=(-4.5, 0.8))
axes.legend(frameon=False, fontsize=9, ncols=4, loc="upper center", bbox_to_anchor=(0.5, 1.12))

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack coefficients stratos-2012 --rider rider-a --posture leaned --torso-lean
#    singletrack critical-speeds stratos-2012 --rider rider-a --posture leaned --torso-lean \
#        --spring "torso lean=400 N*m/rad" --damper "torso lean=20 N*m*s/rad"
