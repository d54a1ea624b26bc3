"""
A machine of one's own: the four-bar
====================================

The engine under the riders knows nothing of bicycles. It takes bodies, joints and loops: a crank, a coupler and a
rocker here, closed by a pin. It says how many freedoms are left, simulates the machine without letting the loop open,
and tells the forces in the pin.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack.multibody import GROUND, Body, System, assemble, build, close_point, move, revolute, simulate

Y = (0, 1, 0)  # all hinges; x is forward, z down
four_bar = System(
    bodies=[
        Body("crank", 1.0, (0.5, 0, 0), (0.0, 0.08, 0.08)),  # mass, centre, moments of inertia
        Body("coupler", 3.0, (2.5, 0, 0), (0.0, 2.2, 2.2)),
        Body("rocker", 2.5, (4.75, 0, 0), (0.0, 1.3, 1.3)),
    ],
    joints=[
        revolute("crank", GROUND, "crank", (0, 0, 0), Y),
        revolute("coupler", "crank", "coupler", (1, 0, 0), Y),
        revolute("rocker", GROUND, "rocker", (3.5, 0, 0), Y),
    ],
    # drawn flat, where the loop does not close: the coupler's end and the rocker's are brought together
    closures=[close_point("pin", "coupler", "rocker", (4, 0, 0), second_point=(6, 0, 0), normal=Y)],
)
state = assemble(build(four_bar), {"crank": -1.0}, guess={"rocker": -1.5})
print(state.summary())

run = simulate(move(state, {"crank": 8.0}), np.linspace(0.0, 3.0, 1501))
drift = np.ptp(run.energy.to_numpy()) / np.ptp(run.kinetic_energy.to_numpy())
print(f"energy kept to {drift:.0e} of what is exchanged, the loop closed to {abs(run.residual).max().item():.0e} m")
pin = np.linalg.norm(run.loop_force.sel(loop="pin"), axis=-1)
print(f"the pin bears up to {pin.max():.0f} N, at {run.time[pin.argmax()].item():.2f} s")

# %%
# What is seen
# ------------
# Left, the machine at twelve moments of a turn of the crank, and the curve on which the middle of the coupler runs.
# Nothing drives it: its weight and its momentum carry it round. Right, the speed of the crank and the force in the pin:
# both are largest once a turn, for a tenth of a second, where the rocker turns back.
#
# The same closure holds a rider's hands on the grips, and the same linearisation about a state gives the bicycle's
# matrices. That is the second derivation against which the closed form is tested.

crank, coupler, rocker = (run.q.sel(coordinate=name).to_numpy() for name in ("crank", "coupler", "rocker"))


def along(length, angle):
    """Return a vector in the plane, forward and up, turned about y."""
    return np.stack([length * np.cos(angle), length * np.sin(angle)], axis=-1)


knee = along(1.0, crank)
end = knee + along(3.0, crank + coupler)
middle = knee + along(1.5, crank + coupler)
support = np.array([3.5, 0.0])
figure, (machine, over_time) = plt.subplots(1, 2, figsize=(8.6, 4.0), layout="constrained", width_ratios=[1.2, 1.0])
turn = int(np.argmax(abs(crank - crank[0]) > 2 * np.pi))
for index in np.linspace(0, turn, 12, endpoint=False).astype(int):
    points = np.stack([np.zeros(2), knee[index], end[index], support])
    machine.plot(*points.T, "o-", color="#0072B2", alpha=0.2 + 0.6 * index / turn, ms=3, lw=1.2)
machine.plot(*middle[: turn + 1].T, color="#D55E00", lw=2)
machine.set(aspect="equal", xlabel="forward (m)", ylabel="up (m)")
over_time.plot(run.time, run.u.sel(coordinate="crank"), color="#0072B2")
over_time.set(xlabel="time (s)", xlim=(0, 3))
over_time.set_ylabel("speed of the crank (rad/s)", color="#0072B2")
force = over_time.twinx()
force.plot(run.time, pin, "--", color="#D55E00")
force.set_ylabel("force in the pin (N)", color="#D55E00")
