"""The instrumented bicycle of Kooijman, Schwab and Meijaard (2008): printed matrices, speeds, and 26 recorded runs."""

from __future__ import annotations

import json
from math import radians
from pathlib import Path

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle
from singletrack.library.measured import load_measured_modes

PRINTED = json.loads((Path(__file__).parent / "kooijman2008.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def model():
    return coefficients(load_bicycle("kooijman-2008"))


def test_shipped_parameters_are_the_published_ones():
    published, found = dict(PRINTED["bicycle"]), load_bicycle("kooijman-2008").values()
    published["steer_axis_tilt"] = radians(published.pop("steer_axis_tilt_deg"))
    assert found == pytest.approx(published, rel=1e-15)


@pytest.mark.parametrize(("name", "factor"), [("M", 1.0), ("C1", 1.0), ("K0", 9.81), ("K2", 1.0)])
def test_matrices_to_all_printed_digits(model, name, factor):
    printed = np.array(PRINTED["printed"]["gK0" if name == "K0" else name])
    np.testing.assert_allclose(factor * getattr(model, name), printed, rtol=0, atol=0.5e-5 * (1 + 1e-9))


def test_critical_speeds(model):
    critical = model.critical_speeds()
    assert critical.weave == pytest.approx([PRINTED["printed"]["weave_speed"]], abs=0.05)
    assert critical.capsize == pytest.approx([PRINTED["printed"]["capsize_speed"]], abs=0.05)


def test_shipped_runs_are_the_published_ones():
    runs = load_measured_modes("kooijman-2008")
    table = np.column_stack([runs.lowest_speeds, runs.highest_speeds, runs.eigenvalues.real, runs.eigenvalues.imag])
    np.testing.assert_array_equal(table, PRINTED["measured_weave"]["rows"])


def test_recorded_runs_agree_with_the_model(model):
    """The paper's conclusion: measured weave lies on the computed curves, within the spread of speed in a run."""
    runs = load_measured_modes("kooijman-2008")
    computed = model.modes((runs.lowest_speeds + runs.highest_speeds) / 2).eigenvalues[:, 0]
    assert np.corrcoef(runs.eigenvalues.imag, computed.imag)[0, 1] > 0.98
    assert np.corrcoef(runs.eigenvalues.real, computed.real)[0, 1] > 0.95
    # Both parts change sign, or pass 3 1/s, where the model says: less than the spread of speed in a run away.
    spread = np.median(runs.highest_speeds - runs.lowest_speeds)
    middle = (runs.lowest_speeds + runs.highest_speeds) / 2
    zero = np.interp(0.0, -np.polyval(np.polyfit(middle, runs.eigenvalues.real, 1), v := np.linspace(3, 6, 301)), v)
    assert zero == pytest.approx(model.critical_speeds().weave[0], abs=spread)
