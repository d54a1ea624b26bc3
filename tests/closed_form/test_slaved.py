"""The two closed forms against each other: a front frame is a body slaved to the steer."""

from __future__ import annotations

import numpy as np
import pytest

from designs import random_bicycle
from singletrack import coefficients, load_bicycle, load_rider
from singletrack.arrays import cross
from singletrack.body import rider_segments, skeleton
from singletrack.closed_form.slaved import slaved_matrices
from singletrack.closed_form.whipple import whipple_matrices
from singletrack.mechanics import combine
from singletrack.posture import SlavedMass, steer_axis


def inertia(xx, yy, zz, xz):
    tensor = np.zeros((*np.shape(xx), 3, 3))
    tensor[..., 0, 0], tensor[..., 1, 1], tensor[..., 2, 2] = xx, yy, zz
    tensor[..., 0, 2] = tensor[..., 2, 0] = xz
    return tensor


def all_bodies_slaved(b):
    """Rear wheel and rear frame stay with the frame, front frame and front wheel turn about the steer axis."""
    zero = 0.0 * b.wheel_base
    wheels = [(getattr(b, f"{e}_wheel_inertia_xx"), getattr(b, f"{e}_wheel_inertia_yy")) for e in ("rear", "front")]
    frames = [[getattr(b, f"{e}_frame_inertia_{axes}") for axes in ("xx", "yy", "zz", "xz")] for e in ("rear", "front")]
    at = [
        (b.rear_wheel_mass, (zero, -b.rear_wheel_radius), inertia(wheels[0][0], wheels[0][1], wheels[0][0], zero)),
        (b.rear_frame_mass, (b.rear_frame_x, b.rear_frame_z), inertia(*frames[0])),
        (b.front_frame_mass, (b.front_frame_x, b.front_frame_z), inertia(*frames[1])),
        (
            b.front_wheel_mass,
            (b.wheel_base, -b.front_wheel_radius),
            inertia(wheels[1][0], wheels[1][1], wheels[1][0], zero),
        ),
    ]
    foot, axis = steer_axis(b)
    mass = np.stack([m for m, _, _ in at], axis=-1)
    centre = np.stack([np.stack([x, zero, z], axis=-1) for _, (x, z), _ in at], axis=-2)
    turns = np.array([0.0, 0.0, 1.0, 1.0])[:, None]
    rotation = turns * axis[..., None, :]
    first = turns * cross(axis[..., None, :], centre - foot[..., None, :])
    second = cross(axis[..., None, :], first)
    return mass, centre, np.stack([i for _, _, i in at], axis=-3), rotation, first, second


def summed(mass, centre, inertia, rotation, first, second, order=slice(None)):
    """Sums over bodies (..., n) that turn by w and move by J and H with the steer, by the definitions."""
    mass, centre, inertia = mass[..., order], centre[..., order, :], inertia[..., order, :, :]
    rotation, first, second = (part[..., order, :] for part in (rotation, first, second))
    about = inertia + mass[..., None, None] * (
        (centre**2).sum(-1)[..., None, None] * np.eye(3) - centre[..., :, None] * centre[..., None, :]
    )
    tensor = about.sum(axis=-3)
    momentum = mass[..., None] * first
    spin = np.einsum("...nij,...nj->...ni", inertia, rotation)
    about_contact = (cross(centre, momentum) + spin).sum(axis=-2)
    return SlavedMass(
        (mass * centre[..., 0]).sum(-1),
        (mass * centre[..., 2]).sum(-1),
        tensor[..., 0, 0],
        tensor[..., 0, 2],
        tensor[..., 2, 2],
        spin_x=[about_contact[..., 0]],
        spin_z=[about_contact[..., 2]],
        lateral=[momentum[..., 1].sum(-1)],
        inner=[(first * momentum + rotation * spin).sum((-1, -2))],
        sinking=[(mass * second[..., 2]).sum(-1)],
    )


@pytest.mark.parametrize("name", ["benchmark", "stratos", "browser"])
def test_slaved_form_contains_the_published_one(name):
    """All of appendix A but the gyroscopic terms, for 100 random bicycles: M, C1, K0 and K2, entry by entry."""
    bicycle = random_bicycle(load_bicycle(name), np.random.default_rng(3), 100)
    slaved = slaved_matrices(summed(*all_bodies_slaved(bicycle)), bicycle)
    published = whipple_matrices(bicycle)
    # Wheels that do not spin: what appendix A gives as the spin of the wheels goes to nothing.
    cos, sin = np.cos(bicycle.steer_axis_tilt), np.sin(bicycle.steer_axis_tilt)
    front = bicycle.front_wheel_inertia_yy / bicycle.front_wheel_radius
    total = bicycle.rear_wheel_inertia_yy / bicycle.rear_wheel_radius + front
    mu = bicycle.trail * cos / bicycle.wheel_base
    C1, K2 = published.C1.copy(), published.K2.copy()
    C1[:, 0, 1] -= mu * total + front * cos
    C1[:, 1, 0] += mu * total + front * cos
    K2[:, 0, 1] -= total * cos / bicycle.wheel_base
    K2[:, 1, 1] -= front * sin * cos / bicycle.wheel_base
    for computed, expected in zip(slaved, (published.M, C1, published.K0, K2), strict=True):
        np.testing.assert_allclose(computed, expected, rtol=1e-10, atol=1e-11)


@pytest.mark.parametrize("name", ["stratos", "browser"])
def test_rigid_rider_is_mass_added_to_the_rear_frame(name):
    """Whipple: the rider's segments as one body with the rear frame, in appendix A."""
    bicycle, rider = load_bicycle(name), load_rider("rider-a")
    segments = rider_segments(rider, skeleton(bicycle, rider))
    frame = type(next(iter(segments.values()))).__mro__[1](
        np.array(bicycle.rear_frame_mass),
        np.array([bicycle.rear_frame_x, 0.0, bicycle.rear_frame_z]),
        inertia(*(getattr(bicycle, f"rear_frame_inertia_{axes}") for axes in ("xx", "yy", "zz", "xz"))),
    )
    both = combine([frame, *segments.values()])
    assert abs(both.centre[1]) < 1e-15
    lumped = bicycle.replace(
        rear_frame_mass=both.mass,
        rear_frame_x=both.centre[0],
        rear_frame_z=both.centre[2],
        rear_frame_inertia_xx=both.inertia[0, 0],
        rear_frame_inertia_yy=both.inertia[1, 1],
        rear_frame_inertia_zz=both.inertia[2, 2],
        rear_frame_inertia_xz=both.inertia[0, 2],
    )
    expected, computed = coefficients(lumped), coefficients(bicycle, rider, "rigid")
    for matrix in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(computed, matrix), getattr(expected, matrix), rtol=1e-12, atol=1e-13)


def test_matrices_have_their_symmetries(combination):
    for matrix in (combination.M, combination.K0):
        np.testing.assert_allclose(matrix, np.swapaxes(matrix, -1, -2), rtol=1e-14)
    assert (np.linalg.eigvalsh(combination.M) > 0).all()
    assert combination.C1[0, 0] == 0.0
    assert (combination.K2[:, 0] == 0.0).all()


def test_order_of_bodies_does_not_matter():
    bicycle = load_bicycle("stratos")
    bodies = all_bodies_slaved(bicycle)
    plain, shuffled = summed(*bodies), summed(*bodies, order=[2, 0, 3, 1])
    for one, other in zip(slaved_matrices(plain, bicycle), slaved_matrices(shuffled, bicycle), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13, atol=1e-14)


def test_gravity_scales_the_static_stiffness_only():
    model = coefficients(load_bicycle("stratos"))
    moon = coefficients(load_bicycle("stratos").replace(gravity=1.62))
    np.testing.assert_array_equal(model.K0, moon.K0)
    np.testing.assert_allclose(model.stiffness(0.0) / 9.81, moon.stiffness(0.0) / 1.62, rtol=1e-14)
