"""The linear model record: indexed, broadcast, concatenated, written and read back, for any number of freedoms."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError, coefficients, load_bicycle
from singletrack.arrays import Fault
from singletrack.model import LinearModel, concatenate

NAMES = ("lean", "steer", "torso lean", "head lean")
SQUARE = ("M", "C1", "K0", "K2", "C0", "S0")


def random_model(n: int = 3, shape: tuple[int, ...] = (), seed: int = 0, inputs: int = 2) -> LinearModel:
    rng = np.random.default_rng(seed)
    root, stiff = rng.normal(size=(2, *shape, n, n))
    other = {name: rng.normal(size=(*shape, n, n)) for name in ("C1", "K2", "C0", "S0")}
    return LinearModel(
        M=root @ np.swapaxes(root, -2, -1) + np.eye(n),
        K0=stiff + np.swapaxes(stiff, -2, -1),
        gravity=np.array(9.81),
        **other,
        B=rng.normal(size=(*shape, n, inputs)),
        coordinates=NAMES[:n],
        inputs=tuple(f"{name} torque" for name in NAMES[:inputs]),
    )


def assert_same(one: LinearModel, other: LinearModel) -> None:
    assert (one.coordinates, one.inputs) == (other.coordinates, other.inputs)
    for name in (*SQUARE, "B", "gravity"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


@given(st.integers(2, 4), st.sampled_from([(), (3,), (2, 3)]), st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_what_is_written_is_read_back(n, shape, seed):
    model = random_model(n, shape, seed, inputs=n)
    assert_same(LinearModel.from_dict(json.loads(json.dumps(model.to_dict()))), model)


def test_keys_of_the_first_version_keep_their_places():
    written = coefficients(load_bicycle("benchmark")).to_dict()
    assert list(written)[:5] == ["M", "C1", "K0", "K2", "gravity"]
    assert written["coordinates"] == ["lean", "steer"]
    assert written["inputs"] == ["lean torque", "steer torque"]


def test_a_file_of_four_matrices_is_a_model():
    benchmark = coefficients(load_bicycle("benchmark"))
    few = {name: np.asarray(getattr(benchmark, name)).tolist() for name in ("M", "C1", "K0", "K2")}
    model = LinearModel.from_dict(few)
    assert model.is_undamped
    assert float(model.gravity) == 9.81
    assert_same(model.broadcast_to(()), benchmark.broadcast_to(()))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"M": None}, "M: missing"),
        ({"mass": 3.0}, "mass is unknown"),
        ({"M": [[1.0, 0.0]]}, r"M: has shape \(1, 2\), must be \(..., 2, 2\)"),
        ({"K2": [[1.0, 0.0], [1.0]]}, "K2 = .*must be numbers"),
        ({"C0": [["a", 0.0], [1.0, 1.0]]}, "C0 = .*must be numbers"),
        ({"C1": [[np.nan, 0.0], [0.0, 0.0]]}, "C1: must be finite"),
        ({"K0": [[1.0, 2.0], [0.0, 1.0]]}, "K0: must be symmetric"),
        ({"M": [[1.0, 2.0], [2.0, 1.0]]}, "M: must be positive definite"),
        ({"gravity": -1.0}, "gravity = -1 m/s"),
        ({"gravity": True}, "gravity = True, must be numbers"),
        ({"coordinates": ["lean", "lean"]}, "coordinates = .*different"),
        ({"coordinates": "lean"}, "coordinates = 'lean', must be a list of names"),
        ({"inputs": []}, r"inputs = \[\], must be a list of names"),
    ],
)
def test_what_no_model_can_be_is_refused_by_name(change, message):
    data = {**random_model(2).to_dict(), **change}
    with pytest.raises(InputError, match=message):
        LinearModel.from_dict({name: value for name, value in data.items() if value is not None})


def test_no_names_at_all_are_refused():
    with pytest.raises(InputError, match="found list"):
        LinearModel.from_dict([1, 2])


def test_designs_of_a_batch_that_are_wrong_become_faults():
    data = random_model(2, (3,)).to_dict()
    data["M"][1] = [[1.0, 2.0], [2.0, 1.0]]
    data["C0"][2][0][0] = np.inf
    model = LinearModel.from_dict(data)
    assert model.valid.tolist() == [True, False, False]
    assert {fault.parameters for fault in model.faults} == {("M",), ("C0",)}


@pytest.mark.parametrize("index", [0, -1, slice(1, None), [2, 0], np.array([True, False, True])])
def test_an_index_picks_designs(index):
    model = random_model(3, (3,))
    for name in (*SQUARE, "B"):
        np.testing.assert_array_equal(getattr(model[index], name), getattr(model, name)[index])


def test_two_axes_are_indexed():
    model = random_model(3, (2, 4))
    assert model[1, 2].shape == ()
    assert model[:, 2].shape == (2,)
    assert model[..., None].shape == (2, 4, 1)
    np.testing.assert_array_equal(model[..., 2].K2, model.K2[:, 2])
    np.testing.assert_array_equal(model[..., 2].K2, model.K2[:, 2])
    np.testing.assert_array_equal(model[..., 2].K2, model.K2[:, 2])
    np.testing.assert_array_equal(model[1, 2].M, model.M[1, 2])


def test_broadcast_gives_every_matrix_the_full_shape():
    model = random_model(3, (4,)).broadcast_to((2, 4))
    assert {np.shape(getattr(model, name)) for name in SQUARE} == {(2, 4, 3, 3)}
    assert model.B.shape == (2, 4, 3, 2)
    assert model.gravity.shape == (2, 4)


def test_what_is_cut_apart_concatenates_to_the_same():
    model = random_model(4, (5,))
    assert_same(concatenate([model[:2], model[2], model[3:]]), model.broadcast_to((5,)))


def test_concatenated_faults_keep_their_designs():
    fault = Fault(np.array([True, False]), "x = {x:g}", {"x": np.array([1.0, 2.0])})
    faulty = LinearModel(*(np.ones((2, 2, 2)) for _ in range(4)), np.array(9.81), (fault,))
    sound = LinearModel(*(np.ones((3, 2, 2)) for _ in range(4)), np.array(9.81))
    joined = concatenate([sound, faulty, sound])
    assert joined.valid.tolist() == [True] * 3 + [False, True] + [True] * 3
    assert joined.faults[0].reason((3,)) == "x = 1"
    assert joined[3].faults[0].reason(()) == "x = 1"


def test_models_of_other_names_do_not_concatenate():
    with pytest.raises(InputError, match="do not concatenate"):
        concatenate([random_model(2, (1,)), random_model(3, (1,))])
    with pytest.raises(InputError, match="no models"):
        concatenate([])


def test_names_and_matrices_fit():
    with pytest.raises(InputError, match=r"M: has shape \(2, 2\)"):
        LinearModel(*(np.eye(2) for _ in range(4)), 9.81, coordinates=NAMES[:3])


def test_labels():
    data = random_model(3, (2,)).to_xarray()
    assert data["S0"].dims == ("design_0", "equation", "coordinate")
    assert data["B"].dims == ("design_0", "equation", "input")
    assert data["coordinate"].values.tolist() == list(NAMES[:3])
    assert data["C0"].attrs["units"] == "N m s"
