"""A frame and a fork that bend: both derivations agree, infinite stiffness is the rigid bicycle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.closed_form import coefficients as closed_form
from singletrack.files.toml_write import write_toml
from singletrack.multibody import coefficients as multibody
from singletrack.parameters.flexible import soft_hinges
from singletrack.posture import Options, steer_axis
from singletrack.posture.shipped import load_posture

FORK = {"fork_bending_stiffness": 2e3, "fork_bending_damping": 3.0, "fork_hinge_x": 0.95, "fork_hinge_z": -0.65}
FRAME = {"frame_torsion_stiffness": 5e3, "frame_hinge_x": 0.6, "frame_hinge_z": -0.5, "frame_hinge_tilt": 0.4}
SOFT = {"fork": FORK, "frame": FRAME, "both": FORK | FRAME}
MATRICES = ("M", "C0", "C1", "S0", "K0", "K2")


def assert_equal(one, other):
    assert one.coordinates == other.coordinates
    assert one.inputs == other.inputs
    for name in MATRICES:
        scale = max(np.max(abs(getattr(one, name))), 1e-300)
        np.testing.assert_allclose(getattr(other, name), getattr(one, name), rtol=0, atol=1e-10 * scale, err_msg=name)


@pytest.mark.parametrize("soft", SOFT)
@pytest.mark.parametrize("name", ["benchmark", "stratos", "browser"])
def test_both_derivations_agree(name, soft):
    bicycle = load_bicycle(name).replace(**SOFT[soft])
    assert_equal(coefficients(bicycle), multibody(bicycle))


@pytest.mark.parametrize(
    ("soft", "options"),
    [
        ("fork", Options("leaned")),
        ("fork", Options("upright")),
        ("fork", Options("leaned", torso_lean=True, springs={"torso lean": 100.0, "steer": 2.0})),
        ("both", Options("rigid", torso_lean=True, dampers={"torso lean": 10.0})),
        ("frame", Options("rigid")),
        ("both", Options("leaned")),
        ("frame", Options("leaned", arms="bent")),
        ("both", Options("upright")),
        ("both", Options("leaned", torso_lean=True, springs={"torso lean": 100.0}, dampers={"steer": 0.5})),
    ],
    ids=lambda value: value if isinstance(value, str) else value.title,
)
def test_both_derivations_agree_with_riders(soft, options):
    bicycle, rider = load_bicycle("stratos").replace(**SOFT[soft]), load_rider("rider-a")
    assert_equal(closed_form(bicycle, rider, options), multibody(bicycle, rider, options))


@pytest.mark.parametrize("to", ["frame", "handlebar"])
@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_directions_bound_to_a_twisting_handlebar(name, to):
    """Moore's arms, whose upper arms are kept level against the frame, or here against the handlebar."""
    mechanism = load_posture("moore-2012")
    loops = tuple(replace(loop, to=to) if loop.perpendicular else loop for loop in mechanism.loops)
    bicycle, rider = load_bicycle(name).replace(**FRAME), load_rider("rider-a")
    options = Options(replace(mechanism, loops=loops))
    assert_equal(closed_form(bicycle, rider, options), multibody(bicycle, rider, options))


def test_the_rest_of_the_matrices_is_the_rigid_bicycle():
    rigid, soft = (coefficients(b) for b in (load_bicycle("stratos"), load_bicycle("stratos").replace(**FORK, **FRAME)))
    assert soft.coordinates == ("lean", "steer", "frame torsion", "fork bending")
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(soft, name)[:2, :2], getattr(rigid, name), rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(soft.S0, np.diag([0, 0, 5e3, 2e3]))
    np.testing.assert_array_equal(soft.C0, np.diag([0, 0, 0, 3.0]))


@pytest.mark.parametrize("soft", ["fork", "frame"])
def test_infinite_stiffness_is_the_rigid_bicycle_at_rate_one_over_k(soft):
    stiff = 10.0 ** np.arange(4, 8)
    key = next(name for name in SOFT[soft] if name.endswith("stiffness"))
    model = coefficients(load_bicycle("benchmark").replace(**SOFT[soft] | {key: stiff}))
    rigid = coefficients(load_bicycle("benchmark")).eigenvalues(np.array([5.0]))[0]
    weave = rigid[np.argmax(rigid.imag)]
    found = model.eigenvalues(np.array([5.0]))[:, 0]
    errors = np.min(abs(found - weave), axis=-1)
    np.testing.assert_allclose(errors[:-1] / errors[1:], 10.0, rtol=0.1)


def test_a_batch_is_its_designs():
    stiffness, tilt = np.array([1e3, 3e3, 9e3]), np.array([0.1, 0.2, 0.3])
    base = load_bicycle("browser").replace(**FRAME)
    batch = coefficients(base.replace(frame_torsion_stiffness=stiffness, frame_hinge_tilt=tilt), load_rider("rider-a"))
    for i in range(3):
        one = base.replace(frame_torsion_stiffness=stiffness[i], frame_hinge_tilt=tilt[i])
        for name in MATRICES:
            whole = np.broadcast_to(getattr(batch, name), (3, 3, 3))
            np.testing.assert_allclose(whole[i], getattr(coefficients(one, load_rider("rider-a")), name), rtol=1e-13)


def test_one_line_is_enough():
    """A stiffness alone: the hinge goes through the fork's crown, on the steer axis, a wheel's radius above the hub."""
    bicycle = load_bicycle("benchmark")
    (hinge,) = soft_hinges(bicycle.replace(fork_bending_stiffness=4e3))
    foot, axis = steer_axis(bicycle)
    assert np.linalg.norm(np.cross(hinge.point - foot, axis)) < 1e-12
    hub = np.array([bicycle.wheel_base, 0.0, -bicycle.front_wheel_radius])
    assert (hub - hinge.point) @ axis == pytest.approx(bicycle.front_wheel_radius)
    assert hinge.axis @ axis == pytest.approx(0.0, abs=1e-12)
    soft = bicycle.replace(fork_bending_stiffness=4e3, frame_torsion_stiffness=4e3)
    assert_equal(coefficients(soft), multibody(soft))


def test_the_potential_is_symmetric_and_mass_positive():
    model = coefficients(load_bicycle("stratos").replace(**FORK, **FRAME))
    np.testing.assert_allclose(model.K0, model.K0.T, rtol=1e-12)
    np.testing.assert_allclose(model.M, model.M.T, rtol=1e-12)
    assert np.linalg.eigvalsh(model.M)[0] > 0


def test_a_hinge_needs_a_whole_place():
    with pytest.raises(InputError, match="fork_hinge_z needs fork_hinge_x too"):
        load_bicycle("benchmark").replace(fork_bending_stiffness=2e3, fork_hinge_z=-0.6)
    with pytest.raises(InputError, match="greater than zero"):
        load_bicycle("benchmark").replace(**FORK | {"fork_bending_stiffness": 0.0})


def test_a_file_says_it_in_one_line_and_comes_back(tmp_path):
    soft = load_bicycle("stratos").replace(**FORK, **FRAME)
    path = tmp_path / "soft.toml"
    path.write_text(write_toml(soft))
    assert "fork_bending_stiffness =" in path.read_text()
    assert load_bicycle(str(path)).values() == pytest.approx(soft.values())


def test_hinges_anywhere_agree():
    """Random hinges on random bicycles, both derivations."""
    rng = np.random.default_rng(1015)
    for name in ("benchmark", "stratos", "browser") * 2:
        hinges = {
            f"{part}_hinge_{what}": float(rng.uniform(*span))
            for part in ("frame", "fork")
            for what, span in (("x", (0.0, 1.2)), ("z", (-1.0, 0.1)), ("tilt", (-1.2, 1.2)))
        }
        stiffness = {"frame_torsion_stiffness": 3e3, "fork_bending_stiffness": 1e3, "fork_bending_damping": 2.0}
        geometry = {"trail": float(rng.uniform(-0.05, 0.1)), "steer_axis_tilt": float(rng.uniform(-0.3, 0.6))}
        bicycle = load_bicycle(name).replace(**hinges, **stiffness, **geometry)
        assert_equal(coefficients(bicycle), multibody(bicycle))
