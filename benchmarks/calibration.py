"""Simulation-based calibration of all that is printed with an uncertainty; as a program it draws docs' figure of it.

Again and again a truth is drawn, data are made from it with the noise that is said, and estimated from. Where standard
deviations are what they claim, the truth's place in the estimate's distribution, a number between 0 and 1, is uniform
(Talts et al. 2018, arXiv:1804.06788).
"""

from __future__ import annotations

import argparse
import dataclasses
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.signal
import scipy.stats

from singletrack import OddityWarning, closed_form, load_bicycle, load_rider
from singletrack.analysis.compare import compare
from singletrack.analysis.designs import Design
from singletrack.analysis.summary import measured_speeds
from singletrack.analysis.uncertainty import eigenvalue_uncertainty, linear_uncertainty
from singletrack.catalogue import sample as catalogue_sample
from singletrack.catalogue.estimate import summary
from singletrack.control import combine_modes, identify_mode
from singletrack.linear import critical_speeds, modes
from singletrack.measuring.measurement import measure
from singletrack.measuring.oscillation import fit_oscillation

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CASES", "chi_square", "ranks"]

ROOT = Path(__file__).parents[1]
FIGURE = ROOT / "docs" / "figures" / "calibration.png"
#: Bins of the histograms.
BINS = 10
#: Standard deviations of a careful measurement, as those of the files of others.
DEVIATIONS = {
    "wheel_base": 0.002,
    "trail": 0.0016,
    "steer_axis_tilt": 0.0035,
    "rear_frame_x": 0.004,
    "rear_frame_z": 0.004,
    "rear_frame_mass": 0.02,
    "front_frame_x": 0.003,
    "front_frame_z": 0.004,
    "front_frame_mass": 0.02,
    "front_wheel_inertia_yy": 0.001,
    "front_frame_inertia_zz": 0.001,
}
_SHEET = {"head_angle": "69 deg", "fork_offset": "50 mm", "wheel_size": "37-622", "wheel_base": "1.1 m"}
Random = np.random.Generator


def coloured(random: Random, count: int, correlation: float) -> np.ndarray:
    """Return noise (count,) of deviation one whose neighbours correlate."""
    white = random.standard_normal(count + 300)
    return np.asarray(scipy.signal.lfilter([np.sqrt(1 - correlation**2)], [1.0, -correlation], white)[300:])


def normal(truth: float, estimate: float, deviation: float) -> float:
    """Return the truth's place in a normal distribution about the estimate."""
    return float(scipy.stats.norm.cdf((truth - estimate) / deviation))


def period(random: Random, correlation: float = 0.0) -> list[float]:
    """Period and decay of a pendulum's recorded rate."""
    t = np.linspace(0.0, 15.0, 600)
    true, decay, phase = random.uniform(0.8, 2.5), random.uniform(0.01, 0.08), random.uniform(0, 6)
    signal = np.exp(-decay * t) * np.cos(2 * np.pi * t / true + phase)
    fit = fit_oscillation(t, signal + 0.05 * coloured(random, len(t), correlation))
    return [normal(true, fit.period, fit.period_deviation), normal(decay, fit.decay, fit.decay_deviation)]


def _identified(random: Random, root: complex, correlation: float) -> Any:
    t = np.arange(300) * 0.02
    signal = np.exp(root.real * (t - 6.0 * (root.real > 0))) * np.sin(root.imag * t + random.uniform(0, 6))
    return identify_mode(t, signal + 0.05 * coloured(random, len(t), correlation), start=0.0)


def _in_mode(root: complex, found: Any) -> list[float]:
    parts = zip((root.real, root.imag), (found.eigenvalue.real, found.eigenvalue.imag), found.deviations, strict=True)
    return [float(scipy.stats.t.cdf((true - value) / sd, found.freedom)) for true, value, sd in parts]


def identify(random: Random, correlation: float = 0.0) -> list[float]:
    """Real and imaginary part of an eigenvalue in a record."""
    root = complex(random.uniform(-0.9, 0.3), random.uniform(3, 7))
    return _in_mode(root, _identified(random, root, correlation))


def repeated(random: Random) -> list[float]:
    """The same from four records of one eigenvalue."""
    root = complex(random.uniform(-0.9, 0.3), random.uniform(3, 7))
    return _in_mode(root, combine_modes([_identified(random, root, 0.5) for _ in range(4)]))


def _raw() -> tuple[dict[str, float], dict[str, float]]:
    raw, deviations = {}, {}
    text = (ROOT / "tests" / "catalogue" / "measured" / "PistaMeasured.txt").read_text(encoding="utf-8")
    for line in text.splitlines():
        name, equals, rest = line.partition("=")
        if equals and not line.startswith("#"):
            value, _, spread = rest.partition("+/-")
            raw[name.strip()] = float(value)
            deviations[name.strip()] = float(spread or 0)
    return raw, deviations


def measured(random: Random) -> list[float]:
    """One of the parameters from pendulums, plumb lines and a scale (another each time), and the weave speed."""
    raw, deviations = _raw()
    true = measure(raw, deviations)
    found = measure({name: x + deviations[name] * random.standard_normal() for name, x in raw.items()}, deviations)
    uncertain = [k for k, name in enumerate(found.names) if found.covariance[k, k] > 0 and name != "gravity"]
    k = int(random.choice(uncertain))
    name, spread = found.names[k], float(np.sqrt(found.covariance[k, k]))
    speeds = measured_speeds(found)
    own = critical_speeds(closed_form.coefficients(true.bicycle)).capsize[-1]
    capsize = normal(own, speeds.critical.capsize[-1], speeds.speed_deviations["capsize"][-1])
    return [normal(getattr(true.bicycle, name), getattr(found.bicycle, name), spread), capsize]


def _observed(random: Random, name: str) -> tuple[Any, Any]:
    true = load_bicycle(name)
    shifted = {key: getattr(true, key) + sd * random.standard_normal() for key, sd in DEVIATIONS.items()}
    return true, dataclasses.replace(true.replace(**shifted), standard_deviations=DEVIATIONS)


def speeds(random: Random) -> list[float]:
    """Weave and capsize speed of a bicycle whose parameters have standard deviations."""
    true, seen = _observed(random, "stratos")
    spread, own = linear_uncertainty(seen).critical_speeds(), critical_speeds(closed_form.coefficients(true))
    return [
        normal(own.weave[0], spread.weave[0], spread.weave_deviation[0]),
        normal(own.capsize[0], spread.capsize[0], spread.capsize_deviation[0]),
    ]


def roots(random: Random) -> list[float]:
    """Real and imaginary part of weave at 6 m/s."""
    true, seen = _observed(random, "stratos")
    found = eigenvalue_uncertainty(seen, speeds=[6.0], samples=200)
    own = modes(closed_form.coefficients(true), 6.0)
    k, j = (list(one.names).index("weave") for one in (found, own))
    root, value = own.eigenvalues[0, j], found.eigenvalues[0, k]
    sign = 1.0 if root.imag * value.imag > 0 else -1.0
    return [
        normal(root.real, value.real, found.real_deviation[0, k]),
        normal(sign * root.imag, value.imag, found.imaginary_deviation[0, k]),
    ]


def compared(random: Random) -> list[float]:
    """The difference of two bicycles' weave speeds, with one rider."""
    # With longer arms than rider A's, who just reaches the bar of one.
    rider = load_rider("rider-a").replace(upper_arm_length=0.36, standard_deviations={"rider_mass": 1.0})
    riders = rider, rider.replace(rider_mass=rider.rider_mass + random.standard_normal())
    pairs = [_observed(random, name) for name in ("stratos", "browser")]
    true, seen = (compare([Design.of(pair[k], riders[k]) for pair in pairs]) for k in (0, 1))
    before, after = (next(one for one in found.measures if one.name == "weave speed") for found in (true, seen))
    difference, estimate = (one.values[1] - one.values[0] for one in (before, after))
    return [normal(difference, estimate, after.difference_deviations[1])]


def catalogue(random: Random) -> list[float]:
    """One of the parameters estimated from a geometry sheet (another each time), the truth from the stated prior."""
    sheet: dict[str, Any] = dict(_SHEET)
    if "catalogue" not in _KEPT:
        seed = catalogue_sample._SEED  # noqa: SLF001  # of the estimate; the truths are other draws
        try:
            estimate = summary(catalogue_sample.draw(2000, **sheet))
            catalogue_sample._SEED = seed + 1  # type: ignore[misc]  # noqa: SLF001
            truths = summary(catalogue_sample.draw(2000, **sheet))
        finally:
            catalogue_sample._SEED = seed  # type: ignore[misc]  # noqa: SLF001
        _KEPT["catalogue"] = estimate, truths
    estimate, truths = _KEPT["catalogue"]
    name = str(random.choice(estimate.names))
    true = getattr(truths.sample, name)[random.integers(2000)]
    return [normal(true, getattr(estimate.bicycle, name), estimate.bicycle.standard_deviations[name])]


_KEPT: dict[str, Any] = {}
#: What is calibrated: title, names of the quantities, one draw.
CASES: dict[str, tuple[tuple[str, ...], Callable[[Random], list[float]]]] = {
    "period": (("period", "decay"), period),
    "period, noise with memory": (("period", "decay"), lambda random: period(random, 0.7)),
    "identify": (("real part", "imaginary part"), identify),
    "identify, noise with memory": (("real part", "imaginary part"), lambda random: identify(random, 0.7)),
    "identify, four records": (("real part", "imaginary part"), repeated),
    "measure": (("a parameter", "capsize speed"), measured),
    "critical speeds": (("weave", "capsize"), speeds),
    "eigenvalues at 6 m/s": (("real part", "imaginary part"), roots),
    "compare": (("weave speeds apart",), compared),
    "catalogue": (("a parameter",), catalogue),
}


def ranks(case: str, count: int, seed: int) -> np.ndarray:
    """Return the truth's places (quantities, count) in so many estimates."""
    random = np.random.default_rng(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OddityWarning)
        return np.array([CASES[case][1](random) for _ in range(count)]).T


def chi_square(places: np.ndarray, bins: int = BINS) -> float:
    """Return how likely a histogram as uneven as that of places (count,), or more, is if they are uniform."""
    return float(scipy.stats.chisquare(np.histogram(places, bins, (0, 1))[0]).pvalue)


def main() -> None:
    """Print a table and draw the figure."""
    from singletrack.present.style import COLOURS, figure_bytes, new_figure, style

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    with style():
        figure = new_figure(6.85, 6.2)
        figure.set_layout_engine("tight")
        band = scipy.stats.binom.interval(0.99, asked.count, 1 / BINS)
        for k, (case, (names, _)) in enumerate(CASES.items()):
            found = ranks(case, asked.count, asked.seed)
            axes = figure.add_subplot(4, 3, k + 1)
            axes.axhspan(*band, color="0.88", lw=0)
            for places, name, colour in zip(found, names, (COLOURS["frame"], COLOURS["front"]), strict=False):
                counts, edges = np.histogram(places, BINS, (0, 1))
                axes.stairs(counts, edges, baseline=None, color=colour, label=name)
                inside = np.mean((places > 0.025) & (places < 0.975))
                print(f"| {case} | {name} | {chi_square(places):.2g} | {100 * inside:.1f} % |", flush=True)  # noqa: T201
            axes.set_title(case, fontsize=8)
            axes.tick_params(labelsize=7)
            axes.set(xlim=(0, 1), ylim=(0, 2.0 * asked.count / BINS), xticks=[0, 0.5, 1])
            axes.legend(loc="lower center", ncols=2, frameon=False, fontsize=6, handlelength=1)
        FIGURE.write_bytes(figure_bytes(figure, "png"))


if __name__ == "__main__":
    main()
