"""
Where steering, or leaning, loses its grip
==========================================

Can the rider bring the bicycle back by the handlebar alone, by leaning alone? At almost every speed: yes. At a few
speeds one motion cannot be reached by an input at all, and near them it is reached badly. Those speeds are roots of a
polynomial, as eigenvalues are, so that none is missed; the journal version of the paper prints them in its tables.
"""

import numpy as np

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.control import control_summary, uncontrollable_speeds
from singletrack.present.control import angles_figure

bicycle = load_bicycle("stratos-2012")
rider = load_rider("rider-a").replace(torso_width=0.40)
model = coefficients(bicycle, rider, "leaned", torso_lean=True)
for lost in uncontrollable_speeds(model, ["steer torque", "torso torque"]):
    print(f"{lost.input:12} {lost.speed:7.4f} m/s  {lost.mode:10} {lost.eigenvalue.real:+.3f} 1/s")

# %%
# What is seen
# ------------
# The angle between a mode and an input says how well one reaches the other: 90 degrees is out of reach, and every speed
# of the table is a touch of that line. The steer torque loses the falling torso (7.8 1/s, a motion that grows) at one
# speed, 1.77 m/s: whoever rides that slowly without a stiff back cannot be saved by the handlebar. The torque of the
# torso reaches all growing motions at every speed above walking pace, and none of them well.
#
# Angles depend on the units of the state (here rad and rad/s), so compare them along a curve and between inputs; do not
# read a single one.

found = control_summary(model, np.linspace(0.2, 8.0, 157), ["steer torque", "torso torque"], efforts=False)
figure = angles_figure(found, "Stratos, leaned rider with torso lean")

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack control stratos-2012 --rider rider-a --posture leaned --torso-lean --set torso_width=0.40 \
#        --plot angles.pdf
