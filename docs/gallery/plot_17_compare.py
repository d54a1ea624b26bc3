"""
Two bicycles side by side
=========================

A hybrid with a straight bar and a city bicycle with a swept one, the same rider on both, each sitting as it asks for.
What differs, in numbers that one can feel?
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import Design, coefficients, compare, load_bicycle, load_rider
from singletrack.analysis.outline import outline

rider = load_rider("rider-a")
pairs = {"Stratos, leaned": ("stratos", "leaned"), "Browser, upright": ("browser", "upright")}
bicycles = {name: load_bicycle(bicycle) for name, (bicycle, _) in pairs.items()}
designs = [Design.of(bicycles[name], rider, posture, name) for name, (_, posture) in pairs.items()]
found = compare(designs, speeds=[5.0])
print(f"{'':36}" + "".join(f"{title:>18}" for title in pairs))
for measure in found.measures:
    unit = f" ({measure.unit})" if measure.unit else ""
    print(f"{measure.name + unit:36}" + "".join(f"{value:18.4g}" for value in measure.values))

# %%
# What is seen
# ------------
# On the Stratos the rider's shoulders are a quarter of a metre further forward, and nearly straight arms lean on the
# bar; upright on the Browser the elbows are bent. The pictures on the right tell what comes of it: real parts above,
# frequency of the oscillation below. With the Stratos weave decides, and is over at 6 m/s. With the Browser weave is
# well damped from the start, and capsize never ends; it gets slower, to a growth by a factor of e in some two seconds
# at 10 m/s.
#
# One of them is stable and needs a fast rider, the other never is and forgives a slow one.

speeds = np.linspace(0.0, 10.0, 401)
figure, axes = plt.subplot_mosaic("ab;ac", figsize=(8.6, 5.0), layout="constrained", height_ratios=[1.5, 1.0])
looks = [("#0072B2", "-"), ("#D55E00", "--")]
for (name, (_, posture)), (colour, dashes) in zip(pairs.items(), looks, strict=True):
    shape = outline(bicycles[name], rider.on(bicycles[name]))
    for start, end in shape.lines:
        axes["a"].plot([start[0], end[0]], [-start[1], -end[1]], dashes, color=colour, lw=1.3)
    for x, z, radius in shape.circles:
        axes["a"].add_patch(plt.Circle((x, -z), radius, fill=False, ls=dashes, color=colour, lw=1.3))
    axes["a"].plot([], [], dashes, color=colour, label=name)
    roots = coefficients(bicycles[name], rider, posture).eigenvalues(speeds)
    axes["b"].plot(speeds, roots.real, dashes, color=colour, lw=1.3)
    frequency = np.where(roots.imag > 0, roots.imag / (2 * np.pi), np.nan)
    axes["c"].plot(speeds, frequency, dashes, color=colour, lw=1.3)
axes["a"].set(aspect="equal", xlabel="x (m)", ylabel="height (m)", ylim=(-0.08, 1.95))
axes["a"].legend(frameon=False, loc="upper center", ncols=2)
axes["b"].axhline(0.0, color="black", lw=0.6)
axes["b"].set(ylabel="real parts (1/s)", xlim=(0, 10), ylim=(-10, 5))
axes["c"].set(xlabel="forward speed v (m/s)", ylabel="frequency (Hz)", xlim=(0, 10), ylim=(0, 1.2))

# %%
# On the command line (one posture for both):
#
# .. code-block:: sh
#
#    singletrack compare stratos browser --rider rider-a --posture upright --speeds "4, 6" -o both.pdf
