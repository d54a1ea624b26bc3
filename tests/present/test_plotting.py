"""Figures of many bicycles: no word over another, whatever the bicycle, and what is drawn is what was computed."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from matplotlib.text import Text

from designs import shipped_model
from singletrack import coefficients, load_bicycle, load_rider
from singletrack.analysis.designs import Design
from singletrack.analysis.family import family, stability_map
from singletrack.linear import critical_speeds, modes
from singletrack.present.latex import escaped, latex_table
from singletrack.present.maps import map_figure, parameter_figure
from singletrack.present.plotting import Drawn, overlay_figure, single_figure
from singletrack.present.style import LINES, figure_bytes
from singletrack.present.words import KILOMETRES

SPEEDS = np.linspace(0, 10, 161)


def random_bicycle(seed):
    """Return a shipped bicycle with every length, mass and inertia changed by up to a fifth."""
    rng = np.random.default_rng(seed)
    bicycle = load_bicycle(["benchmark", "stratos", "browser"][seed % 3])
    names = ("wheel_base", "trail", "steer_axis_tilt", "rear_frame_x", "rear_frame_z", "front_frame_x", "front_frame_z")
    more = ("rear_wheel_inertia_yy", "front_wheel_inertia_yy")
    factors = dict(zip((*names, *more), rng.uniform(0.8, 1.2, len(names) + 2), strict=True))
    for wheel in ("rear", "front"):  # the flat wheel stays flat
        factors[f"{wheel}_wheel_inertia_xx"] = factors[f"{wheel}_wheel_inertia_yy"]
    return bicycle.replace(**{name: getattr(bicycle, name) * factor for name, factor in factors.items()})


def drawn(model, label=""):
    return Drawn(label, modes(model, SPEEDS), critical_speeds(model))


def words_of(figure):
    figure.canvas.draw()
    words = [text for text in figure.findobj(Text) if text.get_text().strip() and text.get_visible()]
    return [(text.get_text(), text.get_window_extent()) for text in words if text.get_alpha() != 0]


def assert_clear(figure):
    """No word covers another; none leaves the figure."""
    boxes = words_of(figure)
    assert [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2) if one.overlaps(other)] == []
    whole = figure.bbox
    for word, box in boxes:
        if word.isdigit():
            continue  # ticks beyond the ends of an axis, which are not drawn
        assert box.x0 >= whole.x0 - 1, word
        assert box.x1 <= whole.x1 + 1, word
        assert box.y1 <= whole.y1 + 1, word


@pytest.mark.parametrize("seed", range(40))
def test_no_words_overlap_on_random_bicycles(seed):
    model = coefficients(random_bicycle(seed))
    assert_clear(single_figure(drawn(model), 84.0, unit=KILOMETRES) if seed % 2 else single_figure(drawn(model)))


@pytest.mark.parametrize("seed", range(0, 40, 5))
def test_no_words_overlap_on_maps_and_overlays(seed):
    design = Design.of(random_bicycle(seed))
    found = stability_map(design, "trail", np.linspace(0.02, 0.12, 31))
    assert_clear(map_figure(found, 1e3, "trail (mm)", 10.0))
    some = family(design, "steer_axis_tilt", np.linspace(0.2, 0.5, 3))
    labels = ["a bicycle with a long name", "another", "steer axis tilt 28.65 deg"]
    assert_clear(overlay_figure([drawn(some.model[i], label) for i, label in enumerate(labels)], 84.0))
    assert_clear(parameter_figure(some.values, some.modes([5.0]), "steer axis tilt (rad)"))


def test_more_freedoms_and_many_designs():
    rider = load_rider("rider-a")
    soft = coefficients(load_bicycle("stratos"), rider, "leaned", torso_lean=True, springs={"torso lean": 100.0})
    figure = single_figure(drawn(soft))
    assert_clear(figure)
    words = " ".join(word for word, _ in words_of(figure))
    assert all(mode in words for mode in soft.modes([5.0]).names)  # beside its curve or in the legend
    many = family(Design.of(load_bicycle("benchmark")), "trail", np.linspace(0.02, 0.1, 9))
    values = (many.values * 1e3).tolist()
    figure = overlay_figure([drawn(many.model[i], "") for i in range(9)], scale=("trail (mm)", values))
    assert_clear(figure)


@pytest.mark.parametrize(
    ("name", "posture", "spring", "width"),
    [("stratos", "leaned", 0.0, 84.0), ("browser", "upright", 300.0, 60.0), ("stratos", "leaned", 100.0, 84.0)],
)
def test_every_mode_is_named_beside_its_curve_in_narrow_figures(name, posture, spring, width):
    """With a torso that leans too: no legend is needed to tell castering."""
    rider = load_rider("rider-a")
    springs = {"torso lean": spring} if spring else {}
    model = coefficients(load_bicycle(name), rider, posture, torso_lean=True, springs=springs)
    figure = single_figure(drawn(model), width)
    assert_clear(figure)
    assert figure.legends == []
    named = {word[3:] for word, _ in words_of(figure) if word.startswith(("Re ", "Im "))}
    assert {"castering", "capsize", "torso lean", "weave"} <= named


def test_lines_are_told_apart_in_grey_and_by_dashes():
    assert len({str(dashes) for _, dashes in LINES}) == len(LINES)
    assert len({colour for colour, _ in LINES}) == len(LINES)


def test_critical_speeds_on_the_map_are_those_of_each_design():
    design = Design.of(load_bicycle("benchmark"))
    found = stability_map(design, "trail", np.linspace(0.02, 0.12, 11))
    figure = map_figure(found, 1.0, "trail (m)", 10.0)
    weave = next(line for line in figure.axes[0].lines if len(line.get_xdata()) == 11)
    for speed, trail in zip(*np.asarray(weave.get_data()), strict=True):
        own = critical_speeds(design.changed({"trail": trail}).model())
        assert own.weave == pytest.approx([speed], rel=1e-12)


def test_a_fold_is_found_to_the_last_digits_and_drawn_as_one_curve():
    # A steered bicycle whose weave speeds meet and vanish: less wheel, more trail.
    design = Design.of(load_bicycle("browser"), load_rider("rider-a"), "rigid")
    found = stability_map(design, "front_frame_x", np.linspace(0.6, 1.1, 41))
    assert len(found.folds) >= 1
    for value in found.folds:
        around = [critical_speeds(design.changed({"front_frame_x": value + d}).model()) for d in (-1e-8, 1e-8)]
        assert len(around[0].weave + around[0].capsize) != len(around[1].weave + around[1].capsize)


def test_dashes_are_not_drawn_over_one_another():
    figure = overlay_figure([drawn(shipped_model("stratos", None), "a"), drawn(shipped_model("browser", None), "b")])
    real = figure.axes[0]
    curves = [np.round(line.get_ydata().astype(float), 9) for line in real.lines if len(line.get_xdata()) > 2]
    for one, other in itertools.combinations(curves, 2):
        both = np.isfinite(one) & np.isfinite(other)
        assert (one[both] == other[both]).mean() < 0.02 if both.any() else True


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_every_format_has_the_width_asked_for(kind):
    content = figure_bytes(single_figure(drawn(shipped_model("benchmark", None)), 84.0), kind, 300)
    if kind == "png":
        assert abs(int.from_bytes(content[16:20]) - 84 / 25.4 * 300) <= 1
    elif kind == "svg":
        assert b'width="238.11' in content  # points
    else:
        assert b"/MediaBox [ 0 0 238.11" in content
        assert b"/FontFile2" in content  # whole fonts are in it


def test_latex_says_every_entry_and_escapes():
    model = shipped_model("benchmark", None)
    text = latex_table(model, critical_speeds(model), "100 % of bicycle_a", digits=8)
    assert r"100 \% of bicycle\_a" in text
    for name in ("M", "C1", "K0", "K2"):
        for entry in np.asarray(getattr(model, name)).ravel():
            assert f"{entry:.8g}" in text
    assert text.count(r"\begin{") == text.count(r"\end{")
    assert escaped("a~b") == r"a\textasciitilde{}b"


def test_models_plot_themselves():
    one = coefficients(load_bicycle("benchmark"))
    assert "weave speed 15.45 km/h" in [word for word, _ in words_of(one.plot(kmh=True))]
    batch = coefficients(load_bicycle("benchmark").replace(trail=np.linspace(0.04, 0.08, 3)))
    assert len(batch.plot().axes) == 2
    with pytest.raises(ValueError, match="lowest and the highest"):
        one.plot([3.0])
