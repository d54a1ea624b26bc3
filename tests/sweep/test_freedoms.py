"""Sweeps of models with more freedoms, springs and dampers: as computed one by one, in arrays of the model's size."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.closed_form import coefficients
from singletrack.linear import critical_speeds, eigenvalues
from singletrack.posture import Options
from singletrack.sweep import chunks, designs_to_dicts, open_sweep, run_sweep
from sweep_helpers import chunks_of, files_of, small_study

pytest.importorskip("zarr")

if TYPE_CHECKING:
    from pathlib import Path

TEXT = """
bicycle = "stratos"
rider = "rider-a"
posture = "leaned"
arms = "bent"
torso_lean = true
springs = { "torso lean" = "400 N*m/rad", steer = 2 }
dampers = { "torso lean" = "40 N*m*s/rad" }
speeds = [0, 3, 6]
keep = ["matrices", "eigenvalues", "critical_speeds", "stable_ranges"]
[vary]
trail = ["35 mm", "60 mm"]
rider_mass = [60, 72, 80]
"""


def test_three_freedoms_with_springs_and_dampers(tmp_path: Path) -> None:
    study = small_study(tmp_path, TEXT)
    with chunks_of(4):
        run_sweep(study, tmp_path / "out.zarr", workers=1)
    found = open_sweep(tmp_path / "out.zarr")
    assert found.coordinate.values.tolist() == ["lean", "steer", "torso lean"]
    assert found.eigenvalues.dims == ("trail", "rider_mass", "speed", "root")
    assert found.eigenvalues.sizes["root"] == 6
    options = Options(
        "leaned",
        None,
        "bent",
        torso_lean=True,
        springs={"torso lean": 400.0, "steer": 2.0},
        dampers={"torso lean": 40.0},
    )
    told = iter(designs_to_dicts(found))
    for trail in (0.035, 0.06):
        for mass in (60.0, 72.0, 80.0):
            rider = load_rider("rider-a").on(load_bicycle("stratos")).replace(rider_mass=mass)
            model = coefficients(load_bicycle("stratos").replace(trail=trail), rider, options)
            one = found.sel(trail=trail, rider_mass=mass)
            for name in ("M", "C0", "C1", "S0", "K0", "K2"):
                np.testing.assert_allclose(one[name].values, getattr(model, name), rtol=1e-12, atol=1e-13)
            np.testing.assert_allclose(one.eigenvalues.values, eigenvalues(model, study.speeds), rtol=1e-8)
            critical = critical_speeds(model)
            design = next(told)
            np.testing.assert_allclose(design["weave_speeds"], critical.weave, rtol=1e-8)
            np.testing.assert_allclose(design["capsize_speeds"], critical.capsize, rtol=1e-8)
            assert len(design["stable_ranges"]) == len(critical.stable_ranges)


def test_more_answers_than_there_is_room_for_are_a_fault(tmp_path: Path, monkeypatch: Any) -> None:
    study = small_study(tmp_path, TEXT)
    wide = chunks._of_width

    monkeypatch.setattr(chunks, "_of_width", lambda values, _width: wide(values, 0))
    run_sweep(study, tmp_path / "out.zarr", workers=1)
    found = open_sweep(tmp_path / "out.zarr")
    assert found.attrs["fault_kinds"] == ["there are more critical speeds than a sweep has room for"]
    assert set(found.status.values.ravel()) == {2}
    assert np.isnan(found.M.values).all()


def test_what_cannot_be_told_is_neither_never_nor_faulty(tmp_path: Path, monkeypatch: Any) -> None:
    study = small_study(
        tmp_path, TEXT.replace("torso_lean = true", "").partition("springs")[0] + TEXT[TEXT.index("speeds") :]
    )

    def untold(model: Any) -> Any:
        found = critical_speeds(model)
        told = np.arange(len(found.told)) % 2 == 0
        speeds = np.where(told[:, None], found.weave_speeds, np.nan)
        return dataclasses.replace(found, weave_speeds=speeds, told=told)

    monkeypatch.setattr("singletrack.linear.critical_speeds", untold)
    run_sweep(study, tmp_path / "out.zarr", workers=1)
    found = open_sweep(tmp_path / "out.zarr")
    assert found.weave_status.values.ravel()[1::2].tolist() == [4, 4, 4]
    assert [design["weave_speeds"] for design in designs_to_dicts(found)][1::2] == [None] * 3
    assert set(found.status.values.ravel()) == {1}
    assert len(files_of(tmp_path / "out.zarr")) > 20
