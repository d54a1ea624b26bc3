"""Figures: labels beside their curves and over nothing else."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.text import Text

from designs import COMBINATIONS, shipped_model
from linear.torso import with_torso
from singletrack import linear, load_bicycle
from singletrack.present.eigenvalues import draw_eigenvalues, eigenvalue_figure
from singletrack.present.phasors import phasor_figure
from singletrack.present.style import figure_bytes
from singletrack.present.tables import eigenvalues_csv, eigenvalues_table


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


def words_overlap(figure):
    """Return pairs of words in a figure that cover one another."""
    figure.canvas.draw()
    words = [
        text
        for text in figure.findobj(Text)
        if text.get_text().strip() and text.get_visible() and text.get_alpha() != 0
    ]
    boxes = [(text.get_text(), text.get_window_extent()) for text in words]
    return [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2) if one.overlaps(other)]


@pytest.mark.parametrize("layout", ["constrained", "tight", None])
@pytest.mark.parametrize("size", [(8, 6), (11, 8)], ids=str)
def test_axes_of_ones_own_in_any_size(layout, size):
    figure = Figure(figsize=size, layout=layout)
    FigureCanvasAgg(figure)
    grid = figure.subplots(2, 2)
    if layout is None:
        figure.subplots_adjust(hspace=0.55, wspace=0.35)
    cases = [("stratos", "rigid"), ("stratos", "leaned"), ("browser", "upright"), ("benchmark", None)]
    for axes, (bicycle, posture) in zip(grid.flat, cases, strict=True):
        model = shipped_model(bicycle, posture)
        if posture == "leaned":
            axes.set_title("a title set before")
        draw_eigenvalues(axes, model.modes(np.linspace(0, 10, 201)), model.critical_speeds())
        if posture == "rigid":
            axes.set_title("a title set after")
    assert words_overlap(figure) == []


@pytest.mark.parametrize("bicycle", ["stratos", "browser"])
@pytest.mark.parametrize("speed", [2.0, 5.0, 8.0])
def test_phasors_point_their_way_and_their_words_are_clear(bicycle, speed):
    rows = [(posture, shipped_model(bicycle, posture).modes([speed])) for posture in ("rigid", "leaned", "upright")]
    figure = phasor_figure(rows, 0, "title")
    assert words_overlap(figure) == []
    for row, (_, modes) in enumerate(rows):
        for place, column in enumerate((0, 2, 3)):
            axes = figure.axes[3 * row + place]
            motion = modes.eigenmotions[0, column] / np.abs(modes.eigenmotions[0, column]).max()
            heads = [patch.get_xy() for patch in axes.patches if isinstance(patch, Polygon)]
            for head, phasor in zip(heads, motion, strict=True):
                tip, foot = head[0], (head[1] + head[2]) / 2
                np.testing.assert_allclose(tip, [phasor.real, phasor.imag], atol=1e-12)
                assert np.dot(tip - foot, tip) > 0  # away from the origin, however short
                assert np.linalg.norm(tip - foot) <= max(np.linalg.norm(tip), 1e-12)
            boxes = {text.get_text(): text.get_window_extent() for text in axes.texts}
            for word, box in boxes.items():
                for phasor in motion:
                    line = axes.transData.transform(np.linspace(0, 1, 60)[:, None] * [phasor.real, phasor.imag])
                    assert not any(box.contains(*point) for point in line), (word, column)


def test_figures_show_in_notebooks():
    model = shipped_model("stratos", "rigid")
    figure = eigenvalue_figure(model.modes([0.0, 5.0, 10.0]), model.critical_speeds(), "title")
    assert figure._repr_png_().startswith(b"\x89PNG")


def test_portable_documents_are_the_same_bytes_each_time():
    model = shipped_model("stratos", "rigid")
    modes, critical = model.modes([0.0, 5.0, 10.0]), model.critical_speeds()
    one, two = (figure_bytes(eigenvalue_figure(modes, critical, "title"), "pdf") for _ in range(2))
    assert one == two


def test_a_further_freedom_has_its_own_curves_and_columns():
    """Torso lean in the table, the CSV and the figure beside the bicycle's own modes."""
    model = with_torso(load_bicycle("stratos"), spring=500.0, damper=30.0)
    modes, critical = linear.modes(model, np.linspace(0.0, 10.0, 41)), linear.critical_speeds(model)
    figure = eigenvalue_figure(modes, critical, "torso")
    colours = {line.get_color() for line in figure.axes[0].lines}
    assert len(colours) >= 5
    header, first = eigenvalues_csv(modes).splitlines()[:2]
    assert header.endswith("torso_lean_1_real,torso_lean_1_imag,torso_lean_2_real,torso_lean_2_imag")
    assert len(first.split(",")) == 13
    columns = eigenvalues_table(modes, "title").renderables[0].columns
    assert columns[-2].header.text == "torso lean"
