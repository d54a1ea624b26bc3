"""
A fork that bends, tyres that slip: wobble
==========================================

A rigid bicycle on rigid wheels has no wobble, the fast shaking of the bar that some bicycles show downhill. Two things
bring it: a fork that bends and tyres that need a slip angle before they push sideways. And a third one takes it away:
hands on the bar.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import load_bicycle, load_rider
from singletrack.closed_form import Tyre, tyre_model

bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
tyre = Tyre(cornering=9e3, camber=500.0, relaxation=0.1)  # N/rad, N/rad, m
speeds = np.linspace(2.0, 12.0, 101)


def wobble(stiffness, posture):
    """Return the eigenvalue of the wobble over the speed, 1/s: the pair of three to fifteen hertz."""
    fork = {"fork_bending_stiffness": stiffness, "fork_bending_damping": 0.003 * stiffness}
    soft = bicycle.replace(**fork, fork_hinge_x=0.95, fork_hinge_z=-0.65)
    roots = tyre_model(soft, tyre, tyre, rider, posture).eigenvalues(speeds)
    fast = (roots.imag > 2 * np.pi * 3) & (roots.imag < 2 * np.pi * 15)
    real = np.where(fast, roots.real, -np.inf)
    return np.take_along_axis(roots, real.argmax(axis=-1)[:, None], axis=-1)[:, 0]


cases = {
    (stiffness, posture): wobble(1000.0 * stiffness, posture)
    for stiffness in (20, 5, 2)
    for posture in ("rigid", "leaned")
}
at_6 = int(np.argmin(abs(speeds - 6.0)))
for (stiffness, posture), found in cases.items():
    hands = "hands off " if posture == "rigid" else "on the bar"
    grows = speeds[found.real > 0]
    words = f"grows from {grows[0]:.1f} to {grows[-1]:.1f} m/s" if len(grows) else "dies out at every speed here"
    print(f"{stiffness:2} kN m/rad, {hands}: {found[at_6].imag / (2 * np.pi):4.1f} Hz at 6 m/s; {words}")

# %%
# What is seen
# ------------
# Above zero the wobble grows. A stiff fork (20 kN m/rad) damps it at every speed. One of 5 kN m/rad lets it grow, at 8
# Hz, from 4.2 m/s on, as long as the hands are off the bar (solid); with hands on the bar (dashed), which do nothing
# but hold, it dies out at every speed. What they lend to the bar is mass: no muscle here is tuned, or damped, for that.
#
# A fork of 2 kN m/rad is too soft for hands that only hold: they put the speed at which the wobble begins to grow from
# 2 m/s up to 3, and no more.

figure, (growth, frequency) = plt.subplots(1, 2, figsize=(8.2, 3.9), layout="constrained", sharex=True)
colours = {20: "#000000", 5: "#D55E00", 2: "#0072B2"}
for (stiffness, posture), found in cases.items():
    dashes = "-" if posture == "rigid" else "--"
    words = f"{stiffness} kN m/rad, {'hands off' if posture == 'rigid' else 'on the bar'}"
    growth.plot(speeds, found.real, dashes, color=colours[stiffness], label=words)
    frequency.plot(speeds, found.imag / (2 * np.pi), dashes, color=colours[stiffness])
growth.axhline(0.0, color="black", lw=0.6)
growth.set(xlabel="forward speed v (m/s)", ylabel="growth of the wobble (1/s)", xlim=(2, 12))
frequency.set(xlabel="forward speed v (m/s)", ylabel="frequency (Hz)", ylim=(0, 16))
figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=9)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack eigenvalues stratos --rider rider-a --posture leaned --speeds "4, 6, 8" \
#        --set "fork_bending_stiffness=5 kN*m/rad" --set "fork_bending_damping=15 N*m*s/rad" \
#        --set fork_hinge_x=0.95 --set fork_hinge_z=-0.65 --tyres "9 kN/rad, 500 N/rad, 0.1 m"
