"""Values from Python: computed in double, copied, bounded, or refused by name."""

from __future__ import annotations

import copy
import pickle
import re
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from singletrack import Bicycle, InputError, Rider, coefficients, load_bicycle, load_rider
from singletrack.arrays import complex_steps
from singletrack.parameters.description import BOUNDS

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")
RECORDS = {name: record for record in (STRATOS, RIDER) for name in record.descriptions()}


@pytest.mark.parametrize("dtype", ["float16", "float32", "longdouble", "int64", "uint8"])
def test_other_precisions_are_computed_in_double(dtype):
    for value in (np.ones(3, dtype), np.ones((), dtype), np.dtype(dtype).type(1)):
        model = coefficients(STRATOS.replace(wheel_base=value))
        exact = coefficients(STRATOS.replace(wheel_base=np.asarray(value, dtype=float)))
        for name in ("M", "C1", "K0", "K2"):
            found = getattr(model, name)
            assert found.dtype == np.float64
            np.testing.assert_array_equal(found, getattr(exact, name))


class Metres:
    """A quantity of a library of units."""

    magnitude = 0.05


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ("0.05", "'0.05' is text"),
        (b"0.05", "is text"),
        (True, "True is a truth value"),
        (np.True_, "is a truth value"),
        (np.array([True]), "is a truth value"),
        ([0.05, True], "holds truth values"),
        ([0.05, "0.06"], "is not a number"),
        ([[0.05], [0.05, 0.06]], "is not an array of numbers"),
        (np.array([0.05, None]), "is not a number"),
        (Decimal("0.05"), "is not a number"),
        (Fraction(1, 20), "is not a number"),
        (np.ma.masked_array([0.05, 0.06], mask=[0, 1]), "masked array"),
        (0.05 + 0j, "is complex"),
        (np.complex128(0.05), "is complex"),
        (np.array([0.05 + 1j]), "is complex"),
        (Metres(), "has a unit of its own"),
        (10**400, "too large"),
        (np.datetime64("2026-01-01"), "is not a number"),
        ({}, "is not a number"),
        (None, "is missing"),
    ],
    ids=lambda value: str(value)[:40] if not isinstance(value, Metres) else "a number with a unit",
)
def test_what_is_no_number_is_refused_by_name(value, says):
    with pytest.raises(InputError, match=says) as caught:
        STRATOS.replace(trail=value)
    assert str(caught.value).startswith("stratos: trail")
    assert caught.value.parameters == ("trail",)


def test_wrong_types_are_told_together():
    with pytest.raises(InputError) as caught:
        STRATOS.replace(trail="0.05", wheel_base=True)
    assert [part.parameters for part in caught.value.parts] == [("wheel_base",), ("trail",)]


def test_complex_steps_have_their_own_door():
    with complex_steps():
        moved = STRATOS.replace(trail=complex(STRATOS.trail, 1e-30))
    slope = np.imag(coefficients(moved).M[1, 1]) / 1e-30
    apart = [coefficients(STRATOS.replace(trail=STRATOS.trail + h)).M[1, 1] for h in (-1e-5, 1e-5)]
    assert slope == pytest.approx((apart[1] - apart[0]) / 2e-5, rel=1e-8)
    with pytest.raises(InputError, match="is complex"):
        STRATOS.replace(trail=complex(STRATOS.trail, 1e-30))


@given(hnp.arrays(float, st.integers(1, 5), elements=st.floats(0.01, 0.1)))
def test_a_record_keeps_copies_that_nobody_can_change(trails):
    record = STRATOS.replace(trail=trails)
    before = trails.copy()
    trails[:] = np.nan
    np.testing.assert_array_equal(record.trail, before)
    with pytest.raises(ValueError, match="read-only"):
        record.trail[0] = 1.0


def test_mappings_are_copies_that_nobody_can_change():
    deviations, angles = {"trail": 0.001}, {"stratos": 1.0}
    bicycle, rider = STRATOS.replace(standard_deviations=deviations), RIDER.replace(forward_lean_angles=angles)
    deviations["trail"], angles["stratos"] = 5.0, 0.1
    assert bicycle.standard_deviations == {"trail": 0.001}
    assert rider.on(STRATOS).forward_lean_angle == 1.0
    for change in (
        lambda: bicycle.standard_deviations.update(trail=1.0),
        lambda: rider.forward_lean_angles.pop("stratos"),
        rider.forward_lean_angles.clear,
    ):
        with pytest.raises(TypeError, match="frozen record"):
            change()
    for other in (pickle.loads(pickle.dumps(bicycle)), copy.deepcopy(bicycle)):  # noqa: S301  # our own bytes
        assert other.standard_deviations == {"trail": 0.001}
        assert other.values() == bicycle.values()


@pytest.mark.parametrize("name", RECORDS)
def test_beyond_all_bounds_is_an_error(name):
    record, description = RECORDS[name], RECORDS[name].descriptions()[name]
    least, most = description.bounds
    sign = -1 if description.allowed == "above ground" else 1
    if most < np.inf:
        record = record.replace(**{name: sign * 0.1}) if description.allowed == "fraction" else record
        with pytest.raises(InputError, match=f"{name} = .* must be ") as caught:
            record.replace(**{name: sign * most * 1.1})
        assert name in caught.value.parameters
        batch = record.replace(**{name: np.array([float(getattr(record, name) or sign * 0.3), sign * most * 1.1])})
        assert any(fault.bad.tolist() == [False, True] for fault in batch.standing_faults)
    if least > 0:
        with pytest.raises(InputError, match=f"{name} = .* must be between {least:g} and {re.escape(f'{most:g}')}"):
            record.replace(**{name: least / 2})


@pytest.mark.parametrize(
    ("record", "changes", "says"),
    [
        (STRATOS, {"wheel_base": 1037.0}, 'wheel_base = 1037 m, must be between .*is it in mm[?] Say "1037 mm"'),
        (STRATOS, {"rear_frame_mass": 11200.0}, 'between 1e-06 and 1000 kg .is it in g[?] Say "11200 g"'),
        (RIDER, {"head_mass_fraction": 0.9}, "head_mass_fraction = 0.9, must be at most 0.5"),
        (STRATOS, {"trail": 1e308}, "trail = 1e[+]308 m, must be at most 100 m"),
    ],
)
def test_mistakes_of_units_are_told(record, changes, says):
    with pytest.raises(InputError, match=says):
        record.replace(**changes)


def test_bounds_are_far_from_all_that_is_ridden():
    for record in (STRATOS, RIDER, load_bicycle("browser"), load_bicycle("benchmark")):
        for name, value in record.values().items():
            least, most = BOUNDS.get(record.descriptions()[name].unit, (0.0, np.inf))
            assert 30 * least < abs(value) < most / 5 or not np.isfinite(most), name


VALUES = st.one_of(
    st.floats(),
    st.integers(),
    st.booleans(),
    st.text(max_size=5),
    st.none(),
    st.complex_numbers(),
    st.lists(st.one_of(st.floats(), st.text(max_size=2), st.booleans(), st.none()), max_size=3),
    hnp.arrays(st.one_of(hnp.floating_dtypes(), hnp.integer_dtypes(), hnp.boolean_dtypes()), hnp.array_shapes()),
)


@given(st.dictionaries(st.sampled_from(list(Bicycle.descriptions())), VALUES, min_size=1, max_size=3))
def test_anything_given_as_a_parameter_is_used_or_refused(changes: dict[str, Any]):
    """No other exception, no silent NaN: a design that is not flagged has finite matrices."""
    try:
        bicycle = STRATOS.replace(**changes)
        model = coefficients(bicycle)
    except InputError as error:
        named = error.parameters
    else:
        named = ()
    if named:
        return
    assert bicycle.shape == np.broadcast_shapes(*(np.shape(v) for v in changes.values() if v is not None))
    for name in ("M", "C1", "K0", "K2"):
        finite = np.isfinite(getattr(model, name)).all(axis=(-2, -1))
        assert np.broadcast_to(finite, model.shape)[np.broadcast_to(model.valid, model.shape)].all(), name


@given(st.sampled_from(list(Rider.descriptions())), VALUES)
def test_anything_given_as_a_rider_is_used_or_refused(name: str, value: Any):
    try:
        rider = RIDER.replace(**{name: value})
    except InputError as error:
        named = error.parameters
    else:
        named = ()
    if named:
        return
    good = np.broadcast_to(True, rider.shape).copy()  # noqa: FBT003
    for fault in rider.standing_faults:
        good &= ~fault.bad
    kept = getattr(rider, name)
    if kept is not None:
        assert np.isfinite(np.broadcast_to(kept, rider.shape)[good]).all()


def test_shapes_that_do_not_fit_are_told():
    with pytest.raises(InputError, match=r"wheel_base has shape \(2,\), trail has shape \(3,\), must broadcast"):
        STRATOS.replace(trail=np.full(3, 0.05), wheel_base=np.ones(2))


@pytest.mark.parametrize(("field", "value"), [("name", 5), ("description", None), ("standard_deviations", [0.1])])
def test_texts_and_mappings_are_such(field, value):
    with pytest.raises(InputError, match=f"{field} = .*, must be"):
        STRATOS.replace(**{field: value})


@pytest.mark.parametrize(
    ("record", "changes", "says"),
    [
        (STRATOS, {"standard_deviations": {"trail": -0.001}}, "must be finite and zero or more"),
        (STRATOS, {"standard_deviations": {"trail": np.nan}}, "must be finite and zero or more"),
        (STRATOS, {"standard_deviations": {"trail": [0.001, -0.001]}}, "must be finite and zero or more"),
        (STRATOS, {"standard_deviations": {"trail": "0.001"}}, "standard_deviations.'trail'. = '0.001' is text"),
        (STRATOS, {"standard_deviations": {"trial": 0.001}}, "standard_deviations: unknown .* did you mean trail"),
        (STRATOS, {"standard_deviations": {5: 0.001}}, "standard_deviations: unknown bicycle parameter '5'"),
        (STRATOS, {"extras": {"v": "fast"}}, "extras.'v'. = 'fast' is text"),
        (RIDER, {"shapes": {"torso": 5}}, "shapes.'torso'. = 5, must be a SegmentShape"),
        (RIDER, {"shapes": {"tail": 5}}, "shapes: unknown segment 'tail'"),
        (RIDER, {"forward_lean_angles": {"stratos": "63 deg"}}, "forward_lean_angle = '63 deg' is text"),
    ],
    ids=str,
)
def test_what_mappings_hold_is_checked(record, changes, says):
    make = (lambda: record.replace(**changes).on(STRATOS)) if record is RIDER else (lambda: record.replace(**changes))
    with pytest.raises(InputError, match=says):
        make()


def test_constructors_tell_what_is_missing_and_what_is_unknown():
    with pytest.raises(InputError, match=r"trail, steer_axis_tilt, .* are missing") as caught:
        Bicycle(wheel_base=1.0)
    assert "wheel_base" not in caught.value.parameters
    with pytest.raises(InputError, match="steer_axis_tilt = 90 deg - head angle"):
        Bicycle(head_angle=1.2)
    with pytest.raises(InputError, match="Rider takes its parameters by name"):
        Rider(1.0)  # type: ignore[misc]
    with pytest.raises(InputError, match=r"""must be a Bicycle; type load_bicycle\("stratos"\)"""):
        RIDER.on("stratos")  # type: ignore[arg-type]
