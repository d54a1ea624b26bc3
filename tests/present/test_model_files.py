"""A model in files of other tools comes back whole."""

from __future__ import annotations

import csv
import io
import json

import numpy as np
import pytest
import scipy.io

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.commands.door import run
from singletrack.errors import InputError
from singletrack.present.model_files import model_csv, model_mat

NAMES = ("M", "C0", "C1", "S0", "K0", "K2", "B")


def models():
    yield coefficients(load_bicycle("benchmark"))
    lean = {"torso_lean": True, "springs": {"torso lean": 100.0}}
    yield coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned", **lean)


@pytest.mark.parametrize("model", list(models()), ids=str)
def test_mat_and_csv_come_back(model):
    data = scipy.io.loadmat(io.BytesIO(model_mat(model)), simplify_cells=True)
    rows = list(csv.DictReader(io.StringIO(model_csv(model))))
    for name in NAMES:
        np.testing.assert_array_equal(data[name], np.asarray(getattr(model, name)))
        values = [float(row["value"]) for row in rows if row["matrix"] == name]
        np.testing.assert_array_equal(values, np.ravel(getattr(model, name)))
    assert list(data["coordinates"]) == list(model.coordinates)
    assert data["gravity"] == model.gravity
    assert model_mat(model) == model_mat(model)


@pytest.mark.parametrize("suffix", [".mat", ".csv", ".json", ".tex"])
def test_the_suffix_decides(suffix, tmp_path):
    file = tmp_path / f"model{suffix}"
    assert run(["coefficients", "benchmark", "-o", str(file)]) == 0
    assert file.stat().st_size > 200
    if suffix == ".json":
        assert json.loads(file.read_text())["M"] == np.asarray(coefficients(load_bicycle("benchmark")).M).tolist()


def test_another_suffix_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"unknown suffix '\.xls'"):
        run(["coefficients", "benchmark", "-o", str(tmp_path / "model.xls")])
    assert list(tmp_path.iterdir()) == []
