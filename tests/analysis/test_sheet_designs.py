"""Geometry sheets as designs: exact derivatives, masses that follow, and searches whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, catalogue, load_rider
from singletrack.analysis.aims import LowestWeave, TargetMatrices, WidestRange
from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.problem import Keep, Problem
from singletrack.analysis.quantities import quantities_with_gradients, quantity
from singletrack.analysis.search import search
from singletrack.analysis.sheet_designs import SheetDesign
from singletrack.arrays import complex_steps
from singletrack.catalogue import expected
from singletrack.catalogue.geometry import resolve
from singletrack.catalogue.points import points_of
from singletrack.catalogue.sheet import Sheet

SHEET = {
    "head_angle": "69 deg",
    "fork_offset": "50 mm",
    "wheel_size": "37-622",
    "wheel_base": "1.10 m",
    "total_mass": "19 kg",
    "loads": [{"name": "battery", "mass": "2.8 kg", "x": "0.1 m", "z": "-0.75 m"}],
}
VARIED = ("stem_length", "stack", "bar_width")


@pytest.fixture(scope="module")
def sheet():
    return expected(VARIED, count=300, **SHEET)


def test_the_sheet_itself_is_the_estimated_bicycle(sheet):
    own, same = sheet.estimate.bicycle.values(), sheet.parameters({})
    assert {name: float(same[name]) for name in own} == pytest.approx({n: float(v) for n, v in own.items()}, abs=1e-15)
    whole = catalogue.bicycle(**SHEET).values()
    assert float(own["trail"]) == pytest.approx(float(whole["trail"]), abs=1e-12)


def test_derivatives_of_every_parameter_to_every_entry_against_differences(sheet):
    names, h = list(sheet.values), 1e-5
    with complex_steps():
        steps = {n: sheet.values[n] + 1e-30j * row for n, row in zip(names, np.eye(len(names)), strict=True)}
        exact = sheet.parameters(steps)
    for i, name in enumerate(names):
        up, down = (sheet.parameters({name: np.array([sheet.values[name] + step])}) for step in (h, -h))
        for parameter, value in exact.items():
            slope = float(np.imag(np.broadcast_to(value, len(names))[i]) / 1e-30)
            numeric = float((up[parameter] - down[parameter])[0]) / (2 * h)
            assert slope == pytest.approx(numeric, rel=1e-6, abs=1e-7), (parameter, name)


def test_tubes_weigh_as_their_length(sheet):
    """The frame's mass follows from the tubes' lengths between their ends, each with the mass per metre that it has."""
    changes = {"chain_stay_length": 0.48, "stack": 0.55}
    drawn = sheet.drawn
    before, after = (
        points_of(resolve(Sheet.of(SHEET | {n: sheet.values[n] for n in VARIED} | c), lambda: np.zeros(1)))
        for c in ({}, changes)
    )
    more = 0.0
    for row, mass in zip(drawn.collection.rows, drawn.masses.mean(0), strict=True):
        if row.tube is not None:
            old, new = (np.linalg.norm(p[row.form["to"]] - p[row.form["from"]]) for p in (before, after))
            more += mass * (new / old - 1)
    longer, own = sheet.parameters(changes), sheet.parameters({})
    assert abs(more) > 0.01
    assert float(longer["rear_frame_mass"] - own["rear_frame_mass"]) == pytest.approx(more, rel=1e-9)
    assert float(longer["chain_stay_length"]) == pytest.approx(0.48)


def test_what_is_weighed_and_mounted_adds_up(sheet):
    own, heavier = sheet.parameters({}), sheet.parameters({"total_mass": 20.0})
    bodies = [f"{end}_{body}_mass" for end in ("rear", "front") for body in ("frame", "wheel")]
    assert sum(float(heavier[n] - own[n]) for n in bodies) == pytest.approx(1.0, abs=1e-12)
    back = sheet.parameters({"battery x": 0.0})
    mass = float(own["rear_frame_mass"])
    assert float(back["rear_frame_x"] - own["rear_frame_x"]) == pytest.approx(-0.1 * 2.8 / mass, rel=1e-3)
    higher = sheet.parameters({"battery mass": 3.8})
    assert float(higher["rear_frame_mass"]) - mass == pytest.approx(1.0, abs=1e-12)


def test_models_differentiate_through_the_sheet(sheet):
    design = SheetDesign.of_sheet(sheet, load_rider("rider-a").replace(forward_lean_angle=np.radians(65.0)), "upright")
    names = ("head_angle", "fork_offset", "chain_stay_length", "stem_length", "torso_length")
    slopes = derivatives_of(design, names)
    h = 1e-5
    for i, name in enumerate(names):
        ends = [design.changed({name: float(design.values()[name]) + step}).model() for step in (h, -h)]
        for matrix in ("M", "C1", "K0", "K2"):
            numeric = (np.asarray(getattr(ends[0], matrix)) - np.asarray(getattr(ends[1], matrix))) / (2 * h)
            np.testing.assert_allclose(slopes.matrices[matrix][i], numeric, rtol=2e-6, atol=2e-6)
    values, rows = quantities_with_gradients(design, ("front_clearance", "reach", "ride_height"), names)
    assert rows.shape == (3, 5)
    assert values[2] == pytest.approx(float(design.bicycle.bottom_bracket_height))
    assert rows[0, 2] < 0  # a longer chain stay with the same wheel base: toes come closer to the tyre


def test_a_sheet_is_found_again_from_its_matrices(sheet):
    design = SheetDesign.of_sheet(sheet)
    wanted = {"head_angle": np.radians(71.0), "fork_offset": 0.043, "battery x": -0.1}
    bounds = {"head_angle": (1.0, 1.4), "fork_offset": (0.02, 0.08), "battery x": (-0.3, 0.4)}
    problem = Problem(design, TargetMatrices(design.changed(wanted).model()), bounds)
    best = search(problem, 2)[0]
    own = problem.at(best.x).values()
    assert {name: float(own[name]) for name in wanted} == pytest.approx(wanted, rel=1e-4)


def test_toe_overlap_holds_a_search_back(sheet):
    design = SheetDesign.of_sheet(sheet)
    bounds = {"head_angle": (1.1, 1.3), "wheel_base": (0.98, 1.15)}
    free = search(Problem(design, LowestWeave(), bounds), 2)[0]
    kept = search(Problem(design, LowestWeave(), bounds, (Keep("front_clearance", 0.31),)), 2)[0]
    assert kept.feasible
    assert float(quantity(Problem(design, LowestWeave(), bounds).at(kept.x), "front_clearance")) >= 0.31 - 1e-7
    assert kept.value >= free.value - 1e-9


def test_a_batch_keeps_the_frames_that_can_be(sheet):
    found = sheet.parameters({"chain_stay_length": np.array([0.04, 0.445])})  # shorter than the bracket is low
    assert np.isnan(found["rear_frame_x"][0])
    assert np.isfinite(found["rear_frame_x"][1])
    with pytest.raises(InputError, match="no such triangle"):
        sheet.parameters({"chain_stay_length": 0.04})


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        (("trail",), "trail: cannot vary, it follows .from steer axis, fork_offset"),
        (("steer_axis_tilt",), "cannot vary, it follows .90 deg - head_angle"),
        (("heads_angle",), "did you mean head_angle"),
        (("reach",), "the sheet does not give it"),
    ],
)
def test_what_cannot_vary_is_told(vary, words):
    with pytest.raises(InputError, match=words):
        expected(vary, count=50, **SHEET)


def test_unknown_entries_and_problems_are_told(sheet):
    with pytest.raises(InputError, match="unknown entry of the sheet 'trial'"):
        sheet.parameters({"trial": 0.05})
    design = SheetDesign.of_sheet(sheet)
    with pytest.raises(InputError, match="unknown parameter 'rear_frame_x'"):
        Problem(design, WidestRange(), {"rear_frame_x": (0.2, 0.4)})
