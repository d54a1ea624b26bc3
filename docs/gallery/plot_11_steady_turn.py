"""
Once around: the steady turn
============================

Eigenvalues are about small motions near straight running. A turn is not small. The multibody engine finds the steady
turn exactly, lean, steer, the torque in the rider's hands and the forces on the tyres, and follows it from nearly
straight running to where it ends.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import load_bicycle, load_rider, turn, turn_family

bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
corner = turn(bicycle, rider, "upright", speed=5.0, radius=10.0)
print(f"10 m at 5 m/s: lean {np.degrees(corner.lean):.1f} deg, steer {np.degrees(corner.steer):.1f} deg,")
print(f"{corner.hand_torque:.2f} N m in the hands, friction of at least {corner.friction:.2f} on the road")

families = {speed: turn_family(bicycle, rider, "upright", speed=speed) for speed in (4.0, 5.0, 6.0)}
for speed, family in families.items():
    last = family.turns[-1]
    print(f"{speed:g} m/s: to {np.degrees(last.lean):.1f} deg of lean, {last.radius:.1f} m; {family.end}")

# %%
# What is seen
# ------------
# Left, the torque that holds the turn. It is positive, into the turn: the arms would turn the bar straight, so that the
# hands have to keep it in, and who lets go of it falls to the inside. It grows more than in proportion, because the
# arms, one stretched, one folded, resist ever more.
#
# All three curves end for one reason: at 22 degrees of steer the left hand, the outer one, is at the end of its reach.
# On the way there the limit is the road: the friction that the tyres must give (right) passes 0.8, dry asphalt, at 36
# degrees of lean at 5 m/s. Below a friction of 0.3, a wet road, no turn leans more than some 16 degrees.

figure, (torque, friction) = plt.subplots(1, 2, figsize=(8.2, 3.9), layout="constrained")
looks = [("#0072B2", "-"), ("#D55E00", "--"), ("#009E73", "-.")]
for (speed, family), (colour, dashes) in zip(families.items(), looks, strict=True):
    lean = np.degrees([one.lean for one in family.turns])
    for axes, name in ((torque, "hand_torque"), (friction, "friction")):
        values = [getattr(one, name) for one in family.turns]
        axes.plot(lean, values, dashes, color=colour, label=f"{speed:g} m/s")
        axes.plot(lean[-1], values[-1], "o", color=colour, ms=5)
torque.set(xlabel="lean (deg)", ylabel="steer torque in the hands (N m)", xlim=(0, 50), ylim=(0, 8))
friction.set(xlabel="lean (deg)", ylabel="friction demanded of the tyres", xlim=(0, 50), ylim=(0, 1.6))
friction.axhline(0.8, color="black", lw=0.8, ls=":")
friction.annotate("dry asphalt", (1, 0.82), fontsize=9)
torque.legend(frameon=False)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack turn browser --rider rider-a --posture upright --speed "18 km/h" --radius "10 m" --plot turn.pdf
