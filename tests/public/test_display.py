"""Models at a prompt and in a notebook."""

from __future__ import annotations

import numpy as np

from singletrack import coefficients, load_bicycle, load_rider

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")


def test_a_single_model_shows_its_matrices():
    model = coefficients(STRATOS)
    text, page = repr(model), model._repr_html_()
    for name in ("M", "C1", "K0", "K2"):
        assert f"\n{name:<2} = [[" in text
        for entry in np.ravel(getattr(model, name)):
            assert f"{entry:.6g}".replace("-", "−") in text
            assert f"<td>{entry:.6g}</td>".replace("-", "−") in page
    assert "C0" not in text + page


def test_springs_and_dampers_show():
    model = coefficients(STRATOS, RIDER, "upright", springs={"steer": 3.0}, dampers={"steer": 0.5})
    assert "S0 = [[0, 0], [0, 3]] N m" in repr(model)
    assert "<td>0.5</td>" in model._repr_html_()


def test_a_batch_says_how_many_are_faulty():
    model = coefficients(STRATOS.replace(trail=np.array([0.05, np.nan, 0.06])))
    assert repr(model) == "<CoefficientMatrices of lean, steer; designs of shape (3,), 1 faulty>"
    assert "<td>3</td>" in model._repr_html_()
