"""Errors say in parts what their messages say: parameters, found, allowed, place."""

from __future__ import annotations

import pickle
import shlex

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import InputError, PostureError, SingletrackError, coefficients, load_bicycle, load_rider
from singletrack.arrays import Fault, refuse_single
from singletrack.errors import install_hint
from singletrack.files.toml_read import parse_record
from singletrack.library.load import override

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")
TEXTS = st.text(min_size=1, max_size=20)


def test_a_refused_value_is_told_in_parts():
    with pytest.raises(InputError) as caught:
        STRATOS.replace(wheel_base=-1.0)
    error = caught.value
    assert (error.parameters, error.found, error.allowed) == (("wheel_base",), -1.0, "greater than zero")
    assert error.place == "stratos"
    assert str(error) == "stratos: wheel_base = -1 m, must be greater than zero"


def test_several_faults_keep_their_own_parts():
    with pytest.raises(InputError) as caught:
        STRATOS.replace(wheel_base=-1.0, trail=np.inf)
    error = caught.value
    assert error.parameters == ("wheel_base", "trail")
    assert [part.parameters for part in error.parts] == [("wheel_base",), ("trail",)]
    placed = error.located(lambda names: {"wheel_base": "line 3", "trail": "line 4"}[names[0]])
    assert str(placed).startswith("line 3: wheel_base = -1 m")
    assert "; line 4: trail = inf m" in str(placed)


def test_a_fault_of_several_parameters_gives_each_value():
    with pytest.raises(InputError) as caught:
        STRATOS.replace(rear_frame_inertia_yy=3.0)
    error = caught.value
    assert error.parameters == tuple(f"rear_frame_inertia_{axes}" for axes in ("xx", "yy", "zz", "xz"))
    assert error.found["rear_frame_inertia_yy"] == 3.0


def test_limbs_that_do_not_reach_name_their_lengths():
    with pytest.raises(PostureError) as caught:
        coefficients(STRATOS, RIDER.replace(upper_arm_length=0.1), "upright")
    assert caught.value.parameters == ("upper_arm_length", "lower_arm_length")
    assert caught.value.place == "rider-a on stratos"


def test_the_command_line_and_files_put_their_place_instead():
    with pytest.raises(InputError) as caught:
        override(STRATOS, {"trail": "inf m"})
    assert str(caught.value) == "--set: trail = inf m, must be a finite number"
    text = 'kind = "bicycle"\n[parameters]\n' + "\n".join(
        f"{name} = {-1.0 if name == 'wheel_base' else float(value)}" for name, value in STRATOS.values().items()
    )
    with pytest.raises(InputError) as caught:
        parse_record(type(STRATOS), text, "mine.toml")
    assert str(caught.value) == "mine.toml, line 3: wheel_base = -1 m, must be greater than zero"
    assert caught.value.parameters == ("wheel_base",)


def test_a_value_that_is_no_number_names_parameter_found_and_allowed():
    with pytest.raises(InputError) as caught:
        parse_record(type(STRATOS), '[parameters]\ntrail = "wide"', "mine.toml")
    error = caught.value
    assert (error.parameters, error.found, error.place) == (("trail",), "wide", "mine.toml, line 2")
    assert error.allowed == "a number in m, or one with a unit that converts to m"


def test_names_that_are_not_known():
    with pytest.raises(InputError) as caught:
        STRATOS.replace(wheelbase=1.0)
    assert caught.value.parameters == ("wheelbase",)
    assert "wheel_base" in caught.value.allowed


@given(TEXTS, TEXTS, st.lists(TEXTS, max_size=3))
def test_errors_keep_their_parts_through_pickling_and_placing(reason, place, names):
    error = InputError(reason, parameters=names, found=3, allowed="less").at(place)
    assert str(error) == f"{place}: {reason}"
    again = pickle.loads(pickle.dumps(error))  # noqa: S301  # our own bytes
    assert type(again) is InputError
    for one in (again, error.at("elsewhere").at(place)):
        assert (one.reason, one.parameters, one.found, one.allowed) == (reason, tuple(names), 3, "less")
        assert str(one) == str(error)


@given(st.lists(st.tuples(TEXTS, TEXTS), min_size=2, max_size=4))
def test_errors_together_are_flat_and_of_the_first_class(pairs):
    errors = [PostureError(reason, parameters=[name]) for reason, name in pairs]
    nested = SingletrackError.of_all([SingletrackError.of_all(errors[:2]), *errors[2:]])
    assert isinstance(nested, PostureError)
    assert [part.reason for part in nested.parts] == [reason for reason, _ in pairs]
    assert str(nested) == "; ".join(reason for reason, _ in pairs)


@given(st.lists(st.booleans(), min_size=1, max_size=5))
def test_faults_of_a_batch_are_those_that_hit(bad):
    values = np.arange(len(bad), dtype=float)
    fault = Fault(np.array(bad), "mass = {mass:g} kg", {"mass": values}, InputError, ("mass",), "more")
    assert len(refuse_single([fault])) == any(bad)
    for i in np.flatnonzero(bad):
        error = fault.at((int(i),))
        assert (error.reason, error.parameters, error.found) == (f"mass = {i} kg", ("mass",), i)
    assert fault.kind == "mass = <mass> kg"


def test_hints_install_from_the_checkout_or_by_name(tmp_path, monkeypatch):
    checkout = tmp_path / "it's mine"
    module = checkout / "src" / "singletrack" / "errors.py"
    monkeypatch.setattr("singletrack.errors.__file__", str(module))
    assert install_hint("sweep") == "pip install 'singletrack[sweep]'"
    checkout.mkdir()
    (checkout / "pyproject.toml").touch()
    assert shlex.split(install_hint("sweep")) == ["pip", "install", f"{checkout.resolve()}[sweep]"]
