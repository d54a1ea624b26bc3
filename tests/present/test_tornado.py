"""Tornado figures: no word over another, and every bar where the number is."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from matplotlib.text import Text

from singletrack import load_bicycle, load_rider
from singletrack.analysis.designs import Design
from singletrack.analysis.sensitivity import sensitivity
from singletrack.present.tornado import sensitivity_rows, tornado_figure


@pytest.mark.parametrize("posture", ["none", "leaned", "upright"])
def test_words_are_clear_and_bars_true(posture):
    rider = None if posture == "none" else load_rider("rider-a")
    bicycle = load_bicycle("browser" if posture != "leaned" else "stratos")
    found = sensitivity(Design.of(bicycle, rider, "rigid" if rider is None else posture))
    if not found.results:
        return
    result = found.results[0]
    figure = tornado_figure(found, result, title="a title")
    figure.canvas.draw()
    words = [text for text in figure.findobj(Text) if text.get_text().strip() and text.get_visible()]
    boxes = [(text.get_text(), text.get_window_extent()) for text in words]
    assert [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2) if one.overlaps(other)] == []
    row = found.row(result)
    for bar in figure.axes[0].patches:
        end = bar.get_x() + bar.get_width()
        base = found.values[row]
        ends = found.ends[row][found.ranked(result)[:12]]
        assert np.nanmin(abs(ends - end)) < 1e-12
        assert bar.get_x() == base


def test_rows_speak_in_units_that_people_change():
    found = sensitivity(Design.of(load_bicycle("browser")), names=["front_wheel_mass", "steer_axis_tilt"])
    rows = sensitivity_rows(found, "weave speed")
    assert rows[0][0] == "front_wheel_mass"
    assert "ceases at" in rows[0][3]
    assert "m/s per deg" in rows[1][1]
