"""
A city bicycle that rights itself
=================================

The Browser, a city bicycle, with its rider upright and hands on the bar, is stable at no speed at all. Can it be made
stable, by changes that a frame builder can make? The program searches: for the widest stable range, with trail, tilt of
the steer axis and the sweep of the bar free within usual limits, and a wheel that clears the crank.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import Design, load_bicycle, load_rider, search
from singletrack.analysis.aims import LowestWeave, WidestRange
from singletrack.analysis.outline import outline
from singletrack.analysis.problem import Keep, Problem
from singletrack.linear import critical_speeds, eigenvalues

design = Design.of(load_bicycle("browser"), load_rider("rider-a"), "upright")
limits = {
    "trail": (0.030, 0.100),
    "steer_axis_tilt": (np.radians(15.0), np.radians(30.0)),
    "handlebar_length": (0.100, 0.300),  # how far the grips are swept back behind the stem
}
kept = (Keep("fork_offset", 0.020), Keep("front_clearance", 0.300))

designs = {"as it is": design}
for name, aim in {"widest range": WidestRange(), "lowest speed": LowestWeave()}.items():
    problem = Problem(design, aim, limits, kept)
    best = search(problem, starts=3)[0]
    designs[name] = problem.at(best.x)
    print(f"{name}: held back by {', '.join(best.binding)}")
for name, one in designs.items():
    own = one.values()
    ranges = [f"{low:.2f} to {high:.2f} m/s" for low, high in critical_speeds(one.model()).stable_ranges]
    print(
        f"{name:13} trail {1000 * own['trail']:.0f} mm, head angle {90 - np.degrees(own['steer_axis_tilt']):.1f} deg, "
        f"grips {1000 * own['handlebar_length']:.0f} mm back: stable {', '.join(ranges) or 'never'}"
    )

# %%
# What is seen
# ------------
# Yes, it can. The curves are the fastest growth of any motion; below zero (thick) the bicycle with its rider rights
# itself. With all three limits exhausted, 100 mm of trail, a head angle of 60 degrees and grips 300 mm behind the
# stem, it does so from 6.9 to 10.3 m/s. Asked for the lowest speed instead, the search stops at a head angle of 67.7
# degrees, and the range begins at 4.7 m/s, 17 km/h.
#
# What does it? Flexed arms give the steer a stiffness that holds it straight, where a bicycle that catches itself must
# steer into the fall. Grips further back bend the elbows more and turn that stiffness around. The rider keeps the lean
# of the torso here; a rider who follows the grips needs another cure (see the page on design tools).

speeds = np.linspace(0.0, 12.0, 241)
figure, (drawing, curves) = plt.subplots(1, 2, figsize=(9.0, 4.2), layout="constrained", width_ratios=[1, 1.15])
looks = dict(zip(designs, [("#000000", "-"), ("#D55E00", "--"), ("#0072B2", "-.")], strict=True))
for name, one in designs.items():
    colour, dashes = looks[name]
    growth = eigenvalues(one.model(), speeds).real.max(axis=-1)
    curves.plot(speeds, growth, dashes, color=colour, lw=1.2, label=name)
    curves.plot(speeds, np.where(growth < 0, growth, np.nan), color=colour, lw=3.5, solid_capstyle="butt")
    shape = outline(one.bicycle, one.rider)
    for start, end in shape.lines:
        drawing.plot([start[0], end[0]], [-start[1], -end[1]], dashes, color=colour, lw=1.2)
    for x, z, radius in shape.circles:
        drawing.add_patch(plt.Circle((x, -z), radius, fill=False, ls=dashes, color=colour, lw=1.2))
curves.axhline(0.0, color="black", lw=0.6)
curves.set(xlabel="forward speed v (m/s)", ylabel="fastest growth (1/s)", xlim=(0, 12), ylim=(-1.0, 4.0))
curves.legend(frameon=False)
drawing.set(aspect="equal", xlabel="x (m)", ylabel="height (m)")
drawing.autoscale_view()

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack design browser --rider rider-a --posture upright --aim widest --vary trail=30mm:100mm \
#        --vary steer_axis_tilt=15deg:30deg --vary handlebar_length=100mm:300mm \
#        --keep fork_offset=20mm: --keep front_clearance=300mm: -o found.toml
