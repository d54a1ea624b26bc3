"""Samples are drawn with the seed that is given, with zero if none is, and of the size that is asked for."""

from __future__ import annotations

import numpy as np

from singletrack import load_bicycle
from singletrack.analysis.sampling import sample_designs
from singletrack.analysis.uncertainty import eigenvalue_uncertainty

#: Of a trail so uncertain that eigenvalues at low speeds, where two real ones meet, are not linear in it.
BICYCLE = load_bicycle("stratos").replace(standard_deviations={"trail": 0.02})
SPEEDS = np.linspace(0.2, 3.0, 8)


def test_the_default_seed_is_zero_and_the_default_size_two_thousand() -> None:
    default = sample_designs(BICYCLE)
    assert default.drawn == 2000
    np.testing.assert_array_equal(default.model.M, sample_designs(BICYCLE, samples=2000, seed=0).model.M)
    assert not np.array_equal(default.model.M, sample_designs(BICYCLE, seed=1).model.M)


def test_uncertain_eigenvalues_are_those_of_the_seed_and_size() -> None:
    default = eigenvalue_uncertainty(BICYCLE, speeds=SPEEDS)
    assert not default.linear.all()

    def deviations(**options: int) -> np.ndarray:
        return eigenvalue_uncertainty(BICYCLE, speeds=SPEEDS, **options).real_deviation

    np.testing.assert_array_equal(default.real_deviation, deviations(seed=0, samples=2000))
    for options in ({"seed": 1}, {"samples": 1999}):
        other = deviations(**options)
        assert np.array_equal(default.real_deviation[default.linear], other[default.linear])
        assert not np.array_equal(default.real_deviation[~default.linear], other[~default.linear])
