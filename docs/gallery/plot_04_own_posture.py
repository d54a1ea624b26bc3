"""
A posture of one's own
======================

How a rider sits is data: hinges in a tree, loops where hands hold the bar, and which part of the body hangs on which
hinge. A new posture is a new file. This one gives the upright rider of the Browser a *waist*: the torso turns about its
own length against the stiffness of the back, and the arms with it.

The file is :download:`waist.toml </gallery/waist.toml>`. Its one new joint is ``free``, because no loop determines it:
it becomes a coordinate of the model, beside lean and steer.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle, load_rider

bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
model = coefficients(bicycle, rider, posture="waist.toml")
print(model.coordinates, model.inputs, sep="\n")

# %%
# Springs and dampers of a mechanism can be changed without touching its file, so that one can go from a stiff back to
# none at all. They may be arrays, as every parameter may: a hundred backs are one call.

DAMPING = 3.0  # N m s/rad
speeds = np.linspace(0.0, 10.0, 201)
stiffnesses = np.array([0.0, 10.0, 30.0, 100.0, 1000.0])  # N m/rad
waists = coefficients(bicycle, rider, "waist.toml", springs={"waist": stiffnesses}, dampers={"waist": DAMPING})
upright = coefficients(bicycle, rider, "upright")
growth = waists.eigenvalues(speeds).real.max(axis=-1)  # (stiffness, speed)
without = upright.eigenvalues(speeds).real.max(axis=-1)
at_6 = np.searchsorted(speeds, 6.0)
for stiffness, fastest in zip(stiffnesses, growth[:, at_6], strict=True):
    print(f"waist of {stiffness:6.0f} N m/rad: fastest growth at 6 m/s {fastest:.3f} 1/s")
print(f"no waist:               fastest growth at 6 m/s {without[at_6]:.3f} 1/s")

# %%
# What is seen
# ------------
# Left, the fastest growth over speed. Upright, with hands on the bar, the bicycle is stable at no speed: at 6 m/s it
# leans over at 1.02 1/s, since the flexed arms hold the steer against the turn into the fall. A waist lets go of some
# of that (0.81 1/s without any stiffness), never of enough, and one of 1000 N m/rad is as good as locked: its curve
# lies on that of the shipped upright posture (dashed).
#
# Right, the motion that the waist brings, torso against bar: one hertz with a slack back, faster with a stiff one, and
# hardly dependent on how fast one rides.

figure, (left, right) = plt.subplots(1, 2, figsize=(8.2, 3.9), layout="constrained")
for curve, stiffness, colour in zip(
    growth, stiffnesses, plt.colormaps["cividis"](np.linspace(0.85, 0.0, len(stiffnesses))), strict=True
):
    left.plot(speeds, curve, color=colour, label=f"waist {stiffness:.0f} N m/rad")
left.plot(speeds, without, "--", color="#D55E00", lw=1.3, label="upright, no waist")
left.set(xlabel="forward speed v (m/s)", ylabel="fastest growth (1/s)", xlim=(0, 10), ylim=(0, None))
left.legend(frameon=False, fontsize=9)

finer = np.linspace(0.0, 400.0, 101)
many = coefficients(bicycle, rider, "waist.toml", springs={"waist": finer}, dampers={"waist": DAMPING})
modes = many.modes([2.0, 6.0, 10.0])
waist = modes.eigenvalues[..., modes.names.index("waist")]  # (stiffness, speed)
for column, (speed, style) in enumerate(zip(modes.speeds, ("-", "--", ":"), strict=True)):
    right.plot(finer, abs(waist[:, column].imag) / (2 * np.pi), style, color="#0072B2", label=f"at {speed:g} m/s")
right.set(xlabel="stiffness of the waist (N m/rad)", ylabel="frequency of its mode (Hz)", ylim=(0, None))
right.legend(frameon=False, fontsize=9)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack template posture > waist.toml
#    singletrack show waist.toml
#    singletrack critical-speeds browser --rider rider-a --posture waist.toml --spring "waist=10 N*m/rad"
