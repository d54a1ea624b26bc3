"""
To and from other tools
=======================

A bicycle goes on living in other programs, a paper, a control course. Files of BicycleParameters are read and written,
matrices go to Matlab and LaTeX, systems to python-control. A figure that another library draws is the proof.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np

import control
from singletrack import coefficients, load_bicycle
from singletrack.control import save_mat

bicycle = load_bicycle("benchmark")
model = coefficients(bicycle)
print(model.to_latex("The benchmark bicycle", digits=5))

# %%
# Labelled arrays, for xarray and pandas; state spaces, for Matlab.

modes = model.modes(np.linspace(0.0, 10.0, 101)).to_xarray()
print(modes)
with TemporaryDirectory() as folder:
    file = Path(folder) / "benchmark.mat"
    save_mat(model.state_space(5.0), file)
    print(f"{file.name}: {file.stat().st_size} bytes")

# %%
# What is seen
# ------------
# The answer of the lean to a sine of steer torque, drawn by python-control from our state spaces at three speeds within
# the stable range (4.29 to 6.02 m/s). Close to the weave speed the bicycle resonates: a hand that moves at weave's own
# frequency leans it five times as far as at half of it. At 5.8 m/s, close to the capsize speed, there is no such peak:
# what leans it most is a slow torque, because capsize hardly comes back. (Outside of the range there would be a curve,
# too, and nothing to measure it by: what grows by itself drowns the answer.)

figure, axes = plt.subplots(2, 1, figsize=(7.4, 5.0), layout="constrained", sharex=True)
frequencies = np.geomspace(0.1, 10.0, 400)  # Hz
for speed, colour, dashes in ((4.4, "#D55E00", "--"), (5.0, "#0072B2", "-"), (5.8, "#009E73", "-.")):
    system = model.state_space(speed).to_control()
    answer = control.frequency_response(system["lean", "steer torque"], 2 * np.pi * frequencies)
    axes[0].loglog(frequencies, np.degrees(answer.magnitude), dashes, color=colour, label=f"{speed:g} m/s")
    axes[1].semilogx(frequencies, np.degrees(np.unwrap(answer.phase)), dashes, color=colour)
axes[0].set_ylabel("lean per steer torque (deg/(N m))")
axes[0].legend(frameon=False)
axes[1].set(xlabel="frequency (Hz)", ylabel="phase (deg)", xlim=(0.1, 10))

# %%
# On the command line:
#
# .. code-block:: sh
#
#    singletrack list
#    singletrack show benchmark
#    singletrack convert benchmark benchmark.yml
#    singletrack coefficients benchmark -o benchmark.mat
#    singletrack schema bicycle > bicycle.json
#    singletrack page benchmark
