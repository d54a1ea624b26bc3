"""Every standard deviation and interval that is printed is as large as it says: ranks of the truth are uniform."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.stats

from calibration import CASES, chi_square, ranks

#: Draws of each case, as many as cost some seconds.
DRAWS = {
    "period": 200,
    "period, noise with memory": 200,
    "identify": 60,
    "identify, noise with memory": 60,
    "identify, four records": 25,
    "measure": 150,
    "critical speeds": 150,
    "eigenvalues at 6 m/s": 80,
    "compare": 40,
    "catalogue": 400,
}
#: Bins, few enough for the least number of draws.
BINS = 5
#: How likely a calibrated quantity is refused; with some twenty of them, two runs in a thousand with other seeds.
FALSE_ALARM = 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_ranks_of_the_truth_are_uniform(case):
    for places in ranks(case, DRAWS[case], seed=2):
        assert chi_square(places, BINS) > FALSE_ALARM


@pytest.mark.parametrize("factor", [0.6, 1.6])
def test_the_test_finds_deviations_that_are_too_small_or_too_large(factor):
    scores = np.random.default_rng(3).standard_normal(400)
    assert chi_square(scipy.stats.norm.cdf(scores)) > FALSE_ALARM
    assert chi_square(scipy.stats.norm.cdf(scores / factor)) < FALSE_ALARM
