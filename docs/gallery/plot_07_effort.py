"""
What riding costs: the postures compared
========================================

The founding paper ends with a question: how do the postures compare for a rider who *does* steer? Effort answers. After
a small push, 0.1 rad/s of lean, how much torque must at least be spent to bring the bicycle back, and how large is the
largest torque of a good controller?
"""

import numpy as np

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.control import effort
from singletrack.present.control import effort_figure

rider = load_rider("rider-a")
speeds = np.linspace(1.0, 10.0, 91)
cases = {"Stratos, hands free": ("stratos", "rigid"), "Stratos, leaned": ("stratos", "leaned")}
cases |= {"Browser, hands free": ("browser", "rigid"), "Browser, upright": ("browser", "upright")}
costs = {
    name: effort(coefficients(load_bicycle(bicycle), rider, posture), speeds)
    for name, (bicycle, posture) in cases.items()
}
for name, cost in costs.items():
    energy, torque = (np.interp([1.0, 3.0, 5.0], speeds, values) for values in (cost.least_energy, cost.largest_torque))
    print(f"{name:20} energy {energy.round(3)} N² m² s, torque {torque.round(1)} N m at 1, 3, 5 m/s")

# %%
# What is seen
# ------------
# Where a bicycle is stable it comes back by itself and the least energy is zero (the curve ends, and begins again
# beyond the capsize speed). The leaned rider pays most at walking pace, 10 N² m² s against 2.7 with free hands: arms
# and torso have to be moved, too.
#
# The upright rider is stable at no speed, and is the cheapest of the four at walking pace (2.0): the motion that has to
# be held is slow, and slow things are cheap to hold. Self-stability and ease of riding are two things. Above 4 m/s all
# of it is next to nothing.

figure = effort_figure(costs, "after a push of 0.1 rad/s, by the steer torque alone")

# %%
# On the command line (``--json`` has everything):
#
# .. code-block:: sh
#
#    singletrack control browser --rider rider-a --posture upright --speeds 1:10:10
