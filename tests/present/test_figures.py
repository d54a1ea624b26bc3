"""Figures: labels beside their curves and over nothing else."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from conftest import COMBINATIONS, shipped_model
from singletrack.present.eigenvalues import eigenvalue_figure
from singletrack.present.style import figure_bytes


def shown_texts(figure):
    (axes,) = figure.axes
    return [text for text in axes.texts if text.get_text()]


@pytest.mark.parametrize(("bicycle", "posture"), COMBINATIONS)
def test_labels_overlap_nothing(bicycle, posture):
    model = shipped_model(bicycle, posture)
    figure = eigenvalue_figure(model.modes(np.linspace(0, 10, 401)), model.critical_speeds(), "title")
    figure.canvas.draw()
    (axes,) = figure.axes
    boxes = [text.get_window_extent() for text in shown_texts(figure)]
    for one, other in itertools.combinations(boxes, 2):
        assert not one.overlaps(other)
    inside = axes.get_window_extent()
    for text, box in zip(shown_texts(figure), boxes, strict=True):
        if "speed" in text.get_text() and "m/s" in text.get_text():
            continue  # above the axes
        assert inside.contains(box.x0, box.y0)
        assert inside.contains(box.x1, box.y1)
        for line in axes.lines:
            xy = axes.transData.transform(np.column_stack([line.get_xdata(), line.get_ydata()]).astype(float))
            xy = xy[np.isfinite(xy).all(axis=1)]
            if len(xy) > 2:
                covered = (xy[:, 0] > box.x0) & (xy[:, 0] < box.x1) & (xy[:, 1] > box.y0 + 1) & (xy[:, 1] < box.y1 - 1)
                assert not covered.any(), (text.get_text(), bicycle, posture)


def test_every_mode_in_view_is_labelled():
    model = shipped_model("stratos", "rigid")
    figure = eigenvalue_figure(model.modes(np.linspace(0, 10, 401)), model.critical_speeds(), "title")
    labels = {text.get_text() for text in shown_texts(figure)}
    assert {"Re weave", "Im weave", "Re capsize", "Re castering", "stable"} <= labels
    assert {"weave speed 4.66 m/s", "capsize speed 7.87 m/s"} <= labels


def test_files_are_the_same_bytes_each_time():
    model = shipped_model("stratos", "rigid")
    for kind in ("png", "svg"):
        contents = {
            figure_bytes(eigenvalue_figure(model.modes([0.0, 5.0, 10.0]), model.critical_speeds(), "title"), kind)
            for _ in range(2)
        }
        assert len(contents) == 1
