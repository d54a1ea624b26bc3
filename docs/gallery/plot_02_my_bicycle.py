"""
My bicycle, with error bands
============================

Every measured number is uncertain, and so is all that follows from it. A file of one's own can say so: ``56 +/- 3 mm``.
The figure then shows what the measurements leave open, and a table which of them to repeat with more care.

The file of this page is :download:`my-bicycle.toml </gallery/my-bicycle.toml>`; ``singletrack template bicycle`` prints
one to fill in.
"""

import numpy as np

from singletrack import Design, coefficients, load_bicycle, sensitivity
from singletrack.analysis.uncertainty import eigenvalue_uncertainty, linear_uncertainty

mine = load_bicycle("my-bicycle.toml")
speeds = linear_uncertainty(mine).critical_speeds()
for name in ("weave", "capsize"):
    value, deviation = getattr(speeds, name)[0], getattr(speeds, f"{name}_deviation")[0]
    print(f"{name} speed {value:.2f} +/- {deviation:.2f} m/s")

# %%
# Which number is to blame? Derivatives are exact, so that each parameter's share of the variance can be told.

ranked = sensitivity(Design.of(mine), by="deviation")
effects = ranked.derivatives[ranked.row("weave speed")] * ranked.changes
for place in ranked.ranked("weave speed")[:4]:
    share = effects[place] ** 2 / np.sum(effects**2)
    print(f"{ranked.parameters[place]:22} {effects[place]:+.3f} m/s, {share:4.0%} of the variance")

# %%
# What is seen
# ------------
# The bands hold the central 95 % of what the measurements allow. They are drawn where the eigenvalues are, so that the
# weave speed, at which the blue curve goes through zero, is uncertain by as much as the band is wide there.
#
# Two thirds of the weave speed's variance come from two numbers, the tilt of the steer axis and where the mass of the
# front frame is: measure those two again, and leave the rest. The capsize speed is twice as uncertain although its band
# is thin, because the curve crosses zero at a shallow angle.
#
# To first order the spread follows from derivatives. Where two real roots become a pair (left) that fails, because the
# roots move with the square root of a change; a seeded sample of designs takes its place there by itself.

bands = eigenvalue_uncertainty(mine, speeds=np.linspace(0.0, 10.0, 101), samples=500)
figure = coefficients(mine).plot(width=150.0, title="my bicycle, without rider", uncertainty=bands)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack template bicycle > mine.toml
#    singletrack plot mine.toml --bands -o mine.pdf
#    singletrack sensitivity mine.toml --by deviation
