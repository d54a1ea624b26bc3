"""Bands on an eigenvalue figure, drawings in characters, the figure of a fit."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from singletrack import load_bicycle, load_rider
from singletrack.analysis.outline import outline
from singletrack.analysis.uncertainty import eigenvalue_uncertainty
from singletrack.present.bands import add_bands
from singletrack.present.sketch import side_view

SPEEDS = np.linspace(0, 10, 41)


@pytest.fixture(scope="module")
def result():
    bicycle = load_bicycle("stratos").replace(standard_deviations={"trail": 0.002, "steer_axis_tilt": 0.0035})
    return eigenvalue_uncertainty(bicycle, speeds=SPEEDS, samples=200)


def test_bands_surround_the_eigenvalues(result):
    ax = Figure().subplots()
    drawn = add_bands(ax, result, parts=("real",))
    castering = drawn[-1].get_paths()[0].vertices
    for speed, root in zip(SPEEDS[20:], result.eigenvalues[20:, 3].real, strict=True):
        heights = castering[np.isclose(castering[:, 0], speed), 1]
        assert heights.min() <= root <= heights.max()


def test_bands_leave_the_limits_of_a_figure_alone(result):
    ax = Figure().subplots()
    ax.set(xlim=(0, 10), ylim=(-10, 10))
    add_bands(ax, result)
    assert (ax.get_xlim(), ax.get_ylim()) == ((0, 10), (-10, 10))


def test_colours_are_the_callers(result):
    ax = Figure().subplots()
    drawn = add_bands(ax, result, parts=("real",), colours={"castering": "red"})
    np.testing.assert_allclose(drawn[-1].get_facecolor()[0, :3], (1, 0, 0))


@pytest.mark.parametrize(("name", "rider"), [("benchmark", None), ("stratos", "rider-a"), ("browser", "rider-a")])
def test_side_views_are_to_scale(name, rider):
    bicycle = load_bicycle(name)
    lines = side_view(outline(bicycle, None if rider is None else load_rider(rider)), width=80).splitlines()
    rear, front = (next(line.index(letter) for line in lines if letter in line) for letter in "RF")
    span = float(bicycle.wheel_base + bicycle.rear_wheel_radius + bicycle.front_wheel_radius) + 0.04
    assert (front - rear) * span / 80 == pytest.approx(float(bicycle.wheel_base), abs=0.05)
    assert max(map(len, lines)) <= 80
