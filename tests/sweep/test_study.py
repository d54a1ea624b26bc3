"""Study files: what they may say, and one message for each thing that is wrong."""

from __future__ import annotations

from math import radians
from typing import TYPE_CHECKING

import numpy as np
import pytest

from singletrack import InputError
from singletrack.sweep import load_study
from singletrack.sweep.designs import Variation, make_designs

if TYPE_CHECKING:
    from pathlib import Path

GOOD = """
kind = "study"
name = "trail"
bicycle = "browser"
rider = "rider-a"
posture = "upright"
speeds = "0:10:11"
keep = ["eigenvalues"]

[sampling]
method = "grid"

[vary]
trail = { from = "50 mm", to = "60 mm", count = 3 }
rider_mass = ["60 kg", 72, "80 kg"]
"""


def study_file(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text)
    return path


def message(folder: Path, old: str, new: str) -> str:
    assert old in GOOD
    with pytest.raises(InputError) as caught:
        load_study(study_file(folder, GOOD.replace(old, new)))
    return str(caught.value)


def test_a_study_is_read_with_units(tmp_path: Path) -> None:
    study = load_study(study_file(tmp_path, GOOD))
    assert (study.name, study.posture, study.keep) == ("trail", "upright", ("eigenvalues",))
    assert study.rider is not None
    assert study.rider.forward_lean_angle == pytest.approx(radians(82.9))
    assert study.designs.count == 9
    np.testing.assert_allclose(study.designs.rows(2, 5), [[0.05, 80.0], [0.055, 60.0], [0.055, 72.0]])
    np.testing.assert_array_equal(study.speeds, np.arange(11.0))


def test_bicycles_beside_the_study_file(tmp_path: Path) -> None:
    from singletrack.library import shipped

    (tmp_path / "mine.toml").write_text(shipped("bicycle")["browser"].read_text())
    text = GOOD.replace('"browser"', '"mine.toml"').replace("[vary]", '[vary]\nforward_lean_angle = ["80 deg"]')
    assert load_study(study_file(tmp_path, text)).bicycle.name == "browser"


def test_the_fingerprint_is_that_of_the_results(tmp_path: Path) -> None:
    one = load_study(study_file(tmp_path, GOOD)).fingerprint
    assert load_study(study_file(tmp_path, GOOD + "# a remark\n")).fingerprint == one
    assert load_study(study_file(tmp_path, GOOD.replace("50 mm", "51 mm"))).fingerprint != one
    assert load_study(study_file(tmp_path, GOOD.replace("0:10:11", "0:10:12"))).fingerprint != one


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ('posture = "upright"', 'posture = "sideways"', ["line 6", "posture", "'sideways'", "'upright'"]),
        ('bicycle = "browser"\n', "", ["lacks bicycle"]),
        ('bicycle = "browser"', 'bicycle = "brouser"', ["'brouser'", "did you mean browser?"]),
        ('name = "trail"', 'nme = "trail"', ["line 3", "'nme'", "did you mean name?"]),
        ('rider = "rider-a"\n', "", ["posture = 'upright' needs a rider"]),
        ('"0:10:11"', '"10:0:11"', ["line 7", "speeds = '10:0:11'", "START:STOP:COUNT"]),
        ('"0:10:11"', "[1.0, -2.0]", ["line 7", "speeds", "-2.0", "zero or more"]),
        ('"0:10:11"', '["fast"]', ["speeds", "'fast'"]),
        ('["eigenvalues"]', '["eigenvalue"]', ["line 8", "keep", "'eigenvalue'", "'eigenvalues'"]),
        ('["eigenvalues"]', "[]", ["keep", "at least 1"]),
        ('"grid"', '"grit"', ["line 11", "sampling.method", "'grit'", "'latin-hypercube'"]),
        ('"grid"', '"grid"\nsamples = 3', ["sampling.samples", "must be left out"]),
        ('"grid"', '"grid"\nseed = -1', ["sampling.seed", "'-1'", "greater than or equal to 0"]),
        ('"grid"', '"sobol"\nsamples = 8', ["vary.trail is values", "must be a distribution"]),
        ('"grid"', '"list"', ["trail 3, rider_mass 3"]),
        ("trail = {", "trial = {", ["line 14", "'trial'", "did you mean trail?"]),
        ('"50 mm"', '"50 kg"', ["line 14", "vary.trail.from", "'50 kg'", "no length"]),
        ('"50 mm"', '"70 mm"', ["line 14", "vary.trail", "from less than to"]),
        ("count = 3", "count = 1", ["vary.trail.count = 1", "whole number from 2"]),
        ("count = 3", "steps = 3", ["vary.trail", "'steps'"]),
        (', to = "60 mm"', "", ["vary.trail lacks to"]),
        ('"60 kg", 72', '"nan kg", 72', ["line 15", "vary.rider_mass[0]", "'nan kg'", "finite"]),
        ('["60 kg", 72, "80 kg"]', "true", ["vary.rider_mass = True", "a list of values"]),
        ('["60 kg", 72, "80 kg"]', '{ distribution = "gamma" }', ["'gamma'", "known: uniform, normal"]),
        ("[vary]", "[vary", ["is not valid TOML"]),
    ],
)
def test_each_error_has_a_message(tmp_path: Path, old: str, new: str, parts: list[str]) -> None:
    if new == '"list"':
        old, new = GOOD, GOOD.replace('"grid"', '"list"').replace(', "80 kg"', "")
        parts = ["trail 3, rider_mass 2", "equally many"]
    text = message(tmp_path, old, new)
    for part in ["study.toml" if "brouser" not in new else "brouser", *parts]:
        assert part in text, text


def test_a_rider_parameter_needs_a_rider(tmp_path: Path) -> None:
    text = message(tmp_path, 'rider = "rider-a"\nposture = "upright"\n', "")
    assert "vary.rider_mass is a rider's parameter" in text


def test_a_file_that_is_not_there() -> None:
    with pytest.raises(InputError, match="no such study file"):
        load_study("nowhere.toml")


UNIFORM = Variation("trail", "bicycle", "m", "uniform", (0.02, 0.08))
NORMAL = Variation("rider_mass", "rider", "kg", "normal", (72.0, 5.0))


@pytest.mark.parametrize("method", ["random", "latin-hypercube", "sobol"])
def test_rows_do_not_depend_on_how_they_are_asked_for(method: str) -> None:
    designs = make_designs([UNIFORM, NORMAL], method, 16384, seed=3)
    whole = designs.rows(0, 16384)
    pieces = [designs.rows(start, min(start + 5000, 16384)) for start in range(0, 16384, 5000)]
    np.testing.assert_array_equal(np.concatenate(pieces), whole)
    again = make_designs([UNIFORM, NORMAL], method, 16384, seed=3)
    np.testing.assert_array_equal(again.rows(7000, 7100), whole[7000:7100])
    other = make_designs([UNIFORM, NORMAL], method, 16384, seed=4)
    assert (other.rows(0, 100) != whole[:100]).all()


@pytest.mark.parametrize("method", ["random", "latin-hypercube", "sobol"])
def test_distributions_have_their_moments(method: str) -> None:
    rows = make_designs([UNIFORM, NORMAL], method, 16384, seed=1).rows(0, 16384)
    assert 0.02 <= rows[:, 0].min() < rows[:, 0].max() <= 0.08
    # Five standard errors of independent draws; the other methods are closer.
    np.testing.assert_allclose(rows.mean(axis=0), [0.05, 72.0], atol=5 * np.array([0.0174, 5.0]).max() / 128)
    np.testing.assert_allclose(rows.std(axis=0), [0.06 / np.sqrt(12), 5.0], rtol=5 / np.sqrt(2 * 16384))


@pytest.mark.parametrize("method", ["latin-hypercube", "sobol"])
def test_strata_are_filled_evenly(method: str) -> None:
    rows = make_designs([UNIFORM, NORMAL], method, 1024, seed=2).rows(0, 1024)
    strata = np.floor((rows[:, 0] - 0.02) / 0.06 * 1024).astype(int)
    assert len(np.unique(strata)) == 1024


def test_sobol_needs_a_power_of_two() -> None:
    with pytest.raises(InputError, match=r"samples = 1000, must be a power of two .* such as 512 or 1024"):
        make_designs([UNIFORM], "sobol", 1000)


def test_distributions_need_a_number_of_samples() -> None:
    with pytest.raises(InputError, match=r"sampling.samples with method = 'random' must be given"):
        make_designs([UNIFORM], "random")


def test_a_list_goes_side_by_side() -> None:
    pair = [Variation(name, "bicycle", "m", "values", (0.1, 0.2, 0.3)) for name in ("trail", "wheel_base")]
    assert make_designs(pair, "list").rows(1, 3).tolist() == [[0.2, 0.2], [0.3, 0.3]]
