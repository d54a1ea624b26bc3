"""
Which parameter matters most?
=============================

A bicycle has twenty-five parameters and its rider some twenty more. Before one changes, or measures, any of them: which
moves the weave speed, and by how much? Derivatives are exact here (no differences), and each parameter is ranked by a
change that one can make: 10 mm, 1 degree, 1 kg.
"""

from singletrack import Design, Options, elbow_angle, load_bicycle, load_rider, sensitivity
from singletrack.present.tornado import tornado_figure

bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
sitting = Options("leaned", fit=elbow_angle(bicycle, rider))  # when the grips move, the rider leans after them
design = Design.of(bicycle, rider, sitting, "Stratos, Rider A, leaned")
found = sensitivity(design)
weave = found.row("weave speed")
print(f"weave speed {found.values[weave]:.3f} m/s")
for place in found.ranked("weave speed")[:5]:
    less, more = found.ends[weave, place] - found.values[weave]
    print(f"{found.parameters[place]:24} {found.derivatives[weave, place]:+8.3f} per SI unit: {less:+.3f}, {more:+.3f}")

# %%
# What is seen
# ------------
# Each bar runs from the weave speed after the change down to the one after the change up, both computed anew, so that
# what is not straight shows as a lopsided bar. Trail and steer axis, which stand on every geometry sheet, are in the
# middle of the list: 10 mm and one degree do about the same, 0.1 m/s.
#
# Above them are numbers that no sheet has. With hands on the bar the rider's arms are a part of the steering: one
# hundredth more of the body's mass in them raises the weave speed by 0.15 m/s. The front wheel's inertia about its
# axle, its gyroscopic effect, works the other way.

figure = tornado_figure(found, "weave speed", most=10, width=160.0, title=design.title)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack sensitivity stratos --rider rider-a --posture leaned -o tornado.pdf
