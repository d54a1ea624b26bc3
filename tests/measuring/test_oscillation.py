"""Periods from signals: known oscillations are found, and the standard deviations are honest."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError
from singletrack.files.signals import read_signal
from singletrack.measuring.oscillation import fit_oscillation


def oscillation(t, period, decay, phase=0.3, offset=0.0, amplitude=1.0):
    return offset + amplitude * np.exp(-decay * t) * np.cos(2 * np.pi * t / period + phase)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.3, 4.0), st.floats(0.0, 0.1), st.floats(-3, 3), st.floats(-10, 10), st.floats(1e-3, 1e3))
def test_clean_oscillations_are_found_exactly(period, decay, phase, offset, amplitude):
    t = np.linspace(2.0, 22.0, 1001)
    fit = fit_oscillation(t, oscillation(t - 2.0, period, decay, phase, offset, amplitude))
    assert fit.period == pytest.approx(period, rel=1e-6)
    assert fit.decay == pytest.approx(decay, abs=1e-5)
    np.testing.assert_allclose(fit.at(t), fit.signal, atol=1e-5 * amplitude)


def test_standard_deviations_are_those_of_repeated_recordings():
    t = np.linspace(0, 15, 600)
    rng = np.random.default_rng(3)
    fits = [fit_oscillation(t, oscillation(t, 1.6, 0.03) + rng.normal(0, 0.05, t.shape)) for _ in range(200)]
    scores = np.array([(fit.period - 1.6) / fit.period_deviation for fit in fits])
    assert abs(scores.mean()) < 0.25
    assert 0.85 < scores.std() < 1.15
    assert np.mean([fit.residual_deviation for fit in fits]) == pytest.approx(0.05, rel=0.02)


def test_correlated_residuals_enlarge_the_standard_deviation():
    t = np.linspace(0, 15, 3000)
    rng = np.random.default_rng(4)
    scores = []
    for _ in range(100):
        noise = np.convolve(rng.normal(0, 0.05, len(t) + 19), np.ones(20) / 20**0.5, "valid")
        fit = fit_oscillation(t, oscillation(t, 1.6, 0.03) + noise)
        scores.append((fit.period - 1.6) / fit.period_deviation)
    assert 0.6 < np.std(scores) < 1.3  # without the correction: above 3


def test_the_undamped_period_is_shorter():
    t = np.linspace(0, 20, 2000)
    natural, decay = 1.5, 0.4
    damped = 2 * np.pi / np.sqrt((2 * np.pi / natural) ** 2 - decay**2)
    fit = fit_oscillation(t, oscillation(t, damped, decay))
    assert fit.natural_period == pytest.approx(natural, rel=1e-6)
    assert fit.natural_period < fit.period


def test_uneven_samples_are_fine():
    rng = np.random.default_rng(1)
    t = np.sort(rng.uniform(0, 20, 400))
    assert fit_oscillation(t, oscillation(t, 1.1, 0.02)).period == pytest.approx(1.1, rel=1e-6)


@pytest.mark.parametrize(
    ("time", "signal", "says"),
    [
        (np.arange(5.0), np.arange(5.0), "must have as many, 20 to"),
        (np.zeros(50), np.sin(np.arange(50.0)), "time does not increase after 0 s"),
        (np.arange(50.0), np.ones(50), "does not change"),
        (np.arange(50.0), np.full(50, np.nan), "not finite"),
        (np.linspace(0, 1, 50), np.linspace(0, 1, 50) ** 2, "periods|explains"),
        (np.arange(400.0), np.random.default_rng(0).normal(size=400), "explains"),
    ],
)
def test_what_is_no_oscillation_is_refused(time, signal, says):
    with pytest.raises(InputError, match=rf"^swing\.csv: .*({says})"):
        fit_oscillation(time, signal, "swing.csv")


@pytest.mark.parametrize("separator", [",", ";", "\t", " ", ", "])
def test_signals_are_read_with_any_separator(separator):
    text = f"time{separator}rate\n# a comment\n0{separator}1.5\n\n0.1{separator}-2e-1\n"
    time, signal = read_signal(text, "a.csv")
    assert time.tolist() == [0.0, 0.1]
    assert signal.tolist() == [1.5, -0.2]


@pytest.mark.parametrize("line", ["0.2", "0.2,nan", "a,b", "1,2,3"])
def test_odd_lines_of_signals_are_refused(line):
    with pytest.raises(InputError, match=r"a\.csv, line 3: found"):
        read_signal(f"0,1\n0.1,2\n{line}\n", "a.csv")
