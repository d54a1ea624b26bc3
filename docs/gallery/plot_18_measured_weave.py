"""
Weave, measured on the road
===========================

Kooijman, Schwab and Meijaard (2008) pushed a riderless bicycle with measuring instruments, let it coast, and fitted the
oscillation of its lean rate: 26 runs, each an eigenvalue that can be laid beside the model's. The runs come with the
package, and so does the bicycle. To show the other half, from a record to an eigenvalue, a record is simulated here.
"""

import matplotlib.pyplot as plt
import numpy as np

from singletrack import coefficients, load_bicycle, ride_for
from singletrack.control import identify_mode
from singletrack.control.agreement import compare_modes
from singletrack.library.measured import load_measured_modes

bicycle = load_bicycle("kooijman-2008")
model = coefficients(bicycle)
runs = load_measured_modes("kooijman-2008")
agreement = compare_modes(model, runs.lowest_speeds, runs.highest_speeds, runs.eigenvalues)
print(f"{len(runs.eigenvalues)} runs: rms difference {agreement.rms:.2f} 1/s")

# %%
# From a record to an eigenvalue: the nonlinear ride of the same bicycle at 4.8 m/s after a push, its lean rate read off
# at 100 Hz by a gyroscope with noise.

rng = np.random.default_rng(0)
ride = ride_for(bicycle, speed=4.8, push=0.2, duration=6.0)
time = ride.data.time.to_numpy()
rate = ride.data.u.sel(coordinate="lean").to_numpy() + rng.normal(0.0, 0.01, time.shape)
found = identify_mode(time, rate, start=0.3)  # until then castering dies out
(low, high), _ = found.interval()
modes = model.modes([4.8])
truth = modes.eigenvalues[0, modes.names.index("weave")]
print(f"found {found.eigenvalue:.3f} 1/s, {low:.3f} to {high:.3f} for its real part; the model has {truth:.3f} 1/s")

# %%
# What is seen
# ------------
# Left, the simulated record and the oscillation that was found in it. Neighbouring errors of real records resemble each
# other, which makes intervals too narrow if one does not say so; the fit estimates that. Its 95 % interval holds the
# model's eigenvalue here, and does so for all forty of forty noises that were tried.
#
# Right, the runs of 2008: each a bar, since the bicycle slowed down during a run. Real parts lie on the curve within
# their scatter; so does the weave speed, which nothing in the model was fitted to. That is the experiment by which the
# model of Whipple, a hundred and nine years old then, came to be trusted.

figure, (record, compared) = plt.subplots(1, 2, figsize=(9.0, 4.2), layout="constrained")
used = time >= found.start
root = found.eigenvalue
shapes = np.exp(root.real * time[used])[:, None] * np.stack(
    [np.cos(root.imag * time[used]), np.sin(root.imag * time[used])], axis=-1
)
columns = np.column_stack([shapes, np.ones(used.sum())])
record.plot(time, rate, ".", color="0.6", ms=3, label="record")
record.plot(time[used], columns @ np.linalg.lstsq(columns, rate[used])[0], color="#0072B2", label="oscillation found")
record.set(xlabel="time (s)", ylabel="lean rate (rad/s)", xlim=(0, 6))
record.legend(frameon=False)

speeds = np.linspace(2.5, 6.5, 201)
modes = model.modes(speeds)
weave = modes.eigenvalues[:, modes.names.index("weave")]
middle = (runs.lowest_speeds + runs.highest_speeds) / 2
half = (runs.highest_speeds - runs.lowest_speeds) / 2
for part, colour, dashes, name in (("real", "#0072B2", "-", "real part"), ("imag", "#D55E00", "--", "imaginary part")):
    compared.plot(speeds, abs(getattr(weave, part)) if part == "imag" else weave.real, dashes, color=colour, label=name)
    values = getattr(runs.eigenvalues, part)
    compared.errorbar(middle, values, xerr=half, fmt="none", ecolor=colour, elinewidth=1.4, alpha=0.7)
compared.axhline(0.0, color="black", lw=0.6)
compared.set(xlabel="forward speed v (m/s)", ylabel="eigenvalue of weave (1/s)", xlim=(2.5, 6.5))
compared.legend(frameon=False)

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack identify run-1.csv run-2.csv --column gyro_x --bicycle kooijman-2008 --speed 4.8 --plot points.pdf
