"""
A machine that steers into the fall
===================================

A rider, or a motor in the head tube, that steers to where the bicycle falls, harder the slower it goes, makes nearly
anything stable. A loop that is closed is a linear model again, so that everything one asks of a bicycle can be asked of
it: eigenvalues, named modes, critical speeds.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle
from singletrack.control import closed_loop, lqr_schedule

# %%
# One line closes a loop. The gain from the lean rate falls with the speed, g (6 - v), so that the machine helps where
# help is needed and lets go at 6 m/s.

bare = coefficients(load_bicycle("kooijman-2008"))
helped = {
    gain: closed_loop(bare, {("steer torque", "lean rate"): [6.0 * gain, -gain]}) for gain in (0.0, 2.0, 4.0, 8.0)
}
for gain, model in helped.items():
    ranges = ", ".join(f"{low:.2f} to {high:.2f}" for low, high in model.critical_speeds().stable_ranges)
    print(f"gain {gain:g} N s²/rad: stable {ranges} m/s")

# %%
# How large must a gain be? The best compromise between motion and torque is known at each speed (the linear quadratic
# regulator); it shows what to aim for.

speeds = np.linspace(1.0, 8.0, 141)
best = lqr_schedule(bare, speeds)
print("best gains at 3 m/s, from lean, steer, lean rate, steer rate:", (-best[40]).round(1), "N m/rad and N m s/rad")

# %%
# What is seen
# ------------
# Left, the fastest growth of any motion of the instrumented bicycle of 2008 without rider. Alone (black) it rights
# itself from 3.99 m/s on. A gain of 2 N s²/rad, which is 6 N m for each rad/s of lean at 3 m/s, takes that down to 1.65
# m/s, walking pace. More gain gains little below and loses above: beyond 6 m/s, where the law turns its sign, the
# machine steers out of the fall, and with 4 N s²/rad or more brings it about.
#
# Right, what the best linear controller would do: torque mostly by lean and lean rate, steeply less with speed. It has
# to know all four; the law with one gain makes do with one gyroscope.

figure, (growth, gains) = plt.subplots(1, 2, figsize=(8.2, 3.9), layout="constrained")
looks = zip(helped.items(), ["#000000", "#0072B2", "#009E73", "#D55E00"], ["-", "--", "-.", ":"], strict=True)
for (gain, model), colour, dashes in looks:
    fastest = model.eigenvalues(speeds).real.max(axis=-1)
    growth.plot(speeds, fastest, dashes, color=colour, label=f"{gain:g} N s²/rad" if gain else "no machine")
growth.axhline(0.0, color="black", lw=0.6)
growth.set(xlabel="forward speed v (m/s)", ylabel="fastest growth (1/s)", xlim=(1, 8), ylim=(-1.5, 4))
growth.legend(frameon=False, fontsize=9)
names = {"lean (N m/rad)": "-", "steer (N m/rad)": "--", "lean rate (N m s/rad)": "-.", "steer rate (N m s/rad)": ":"}
for column, ((name, dashes), colour) in enumerate(
    zip(names.items(), ["#0072B2", "#D55E00", "#009E73", "#000000"], strict=True)
):
    gains.plot(speeds, -best[:, column], dashes, color=colour, label=f"from {name}")
gains.set(xlabel="forward speed v (m/s)", ylabel="gain of the steer torque", xlim=(1, 8), ylim=(-100, 300))
gains.legend(frameon=False, fontsize=9)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack critical-speeds kooijman-2008 --feedback "steer torque: lean rate=6"
#    singletrack ride kooijman-2008 --speed 3 --push 0.3 --feedback "steer torque: lean rate=6" --plot ride.pdf
