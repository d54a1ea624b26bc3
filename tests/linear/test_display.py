"""Modes and critical speeds at a prompt and in a notebook."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle, load_rider

MODEL = coefficients(load_bicycle("benchmark"))


def test_critical_speeds_in_one_line_and_in_a_table():
    speeds = MODEL.critical_speeds()
    assert repr(speeds) == (
        f"<CriticalSpeeds: weave {speeds.weave[0]:.6g} m/s, capsize {speeds.capsize[0]:.6g} m/s, "
        f"stable {speeds.weave[0]:.6g} to {speeds.capsize[0]:.6g} m/s>"
    )
    assert f"<td>{speeds.weave[0]:.6g} m/s</td>" in speeds._repr_html_()


def test_never_and_no_end_are_words():
    upright = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright").critical_speeds()
    for low, high in upright.stable_ranges:
        words = f"{low:.6g} to {high:.6g} m/s" if np.isfinite(high) else f"above {low:.6g} m/s"
        assert words in repr(upright)
    if not upright.weave:
        assert "weave never" in repr(upright)
    assert "inf" not in repr(upright)
    assert "nan" not in repr(upright)


def test_batches_say_how_many():
    batch = coefficients(load_bicycle("benchmark").replace(trail=np.array([0.04, 0.06, 0.08])))
    speeds, modes = batch.critical_speeds(), batch.modes([1.0, 5.0])
    assert repr(speeds) == "<CriticalSpeeds of designs of shape (3,)>"
    assert "<td>3</td>" in speeds._repr_html_()
    assert repr(modes).startswith("<Modes designs of shape (3,), weave, weave, capsize")
    assert "designs of shape (3,)" in modes._repr_html_()


@pytest.mark.parametrize("count", [1, 2, 60, 61, 1001])
def test_a_table_of_modes_has_a_row_for_each_speed_it_shows(count):
    modes = MODEL.modes(np.linspace(0.0, 10.0, count))
    page = modes._repr_html_()
    rows = page.count("<tr>") - 1
    assert rows == (count if count <= 60 else 61)
    if count > 60:
        assert f"{count - 60} more speeds" in page
    assert f"at {count} speed" in repr(modes)


def test_roots_read_back():
    (roots,), page = MODEL.modes(5.0).eigenvalues, MODEL.modes(5.0)._repr_html_()
    for root in roots:
        assert f"{root.real:.5g}".replace("-", "−") in page
        assert f"{abs(root.imag):.5g}i" in page or root.imag == 0
