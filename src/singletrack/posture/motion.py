"""How the rider's segments move with the steer angle, to second order.

Let the steer angle turn at the constant rate one, so that d/dδ is a time derivative. Then the first-order motion of a
chain of hinges is a matter of velocities, the second-order motion one of accelerations: with joint rates s' and s'',

    ω_i = ω_{i-1} + s'_i a_i                       v_i = v_{i-1} + ω_{i-1} x d_i
    α_i = α_{i-1} + s''_i a_i + ω_{i-1} x s'_i a_i   b_i = b_{i-1} + α_{i-1} x d_i + ω_{i-1} x (ω_{i-1} x d_i)

where a_i is the axis and d_i the arm from joint i-1 to joint i. Each hand stays on its grip, which turns about the
steer axis; both orders lead to linear equations with the same matrix, the Jacobian of the loops.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from singletrack.arrays import Array, as_arrays, cross, is_concrete, is_jax, namespace, stack, vector
from singletrack.arrays.faults import Fault, refuse_single
from singletrack.errors import PostureError

if TYPE_CHECKING:
    from singletrack.parameters import Bicycle
    from singletrack.posture.postures import Posture

__all__ = ["SlavedBodies", "joint_motion", "slaved_bodies", "steer_axis", "steered_skeleton"]

#: Loops whose matrix (of sines of angles, arms scaled to their mean) is closer to singular than this cannot move.
_SINGULAR = 1e-6


@dataclass(frozen=True, eq=False)
class SlavedBodies:
    """Bodies that move with the steer angle δ relative to the rear frame; n bodies on the axis before the last.

    A body's centre moves by J δ + H δ²/2, its first-order rotation is w δ.

    Attributes
    ----------
    mass : array, shape (..., n)
        In kg.
    centre : array, shape (..., n, 3)
        At zero steer, in m, in the bicycle's frame.
    inertia : array, shape (..., n, 3, 3)
        About the centre, in kg m^2.
    rotation : array, shape (..., n, 3)
        w, in rad per rad of steer.
    displacement, curvature : array, shape (..., n, 3)
        J in m per rad, H in m per rad^2.
    faults : tuple of Fault
        Designs of a batch that cannot sit or steer.
    """

    mass: Array
    centre: Array
    inertia: Array
    rotation: Array
    displacement: Array
    curvature: Array
    faults: tuple[Fault, ...] = ()


def steer_axis(bicycle: Bicycle) -> tuple[Array, Array]:
    """Return a point (..., 3) on the steer axis, at the ground, in m, and its unit vector (..., 3), pointing down.

    >>> from singletrack import load_bicycle
    >>> point, axis = steer_axis(load_bicycle("benchmark"))
    >>> point.round(6).tolist(), axis.round(6).tolist()
    ([1.1, 0.0, 0.0], [0.309017, 0.0, 0.951057])
    """
    xp, (reach, tilt) = as_arrays(bicycle.wheel_base + bicycle.trail, bicycle.steer_axis_tilt)
    return vector(reach, 0.0, 0.0), vector(xp.sin(tilt), 0.0, xp.cos(tilt))


@dataclass(frozen=True, eq=False)
class _Link:
    """Velocities and accelerations of a link, at a point on it."""

    point: Array
    omega: Array
    alpha: Array
    velocity: Array
    acceleration: Array

    def at(self, point: Array) -> tuple[Array, Array]:
        """Return velocity and acceleration (..., 3) of another point of the link."""
        arm = point - self.point
        velocity = self.velocity + cross(self.omega, arm)
        return velocity, self.acceleration + cross(self.alpha, arm) + cross(self.omega, velocity - self.velocity)


def _links(
    posture: Posture, rates: dict[str, Array], accelerations: dict[str, Array] | None = None
) -> dict[str, _Link]:
    """Return the motion of every link by its joint; without accelerations, the part that the rates alone cause."""
    links: dict[str, _Link] = {}
    for joint in posture.joints:
        spin = rates[joint.name][..., None] * joint.axis
        turn = 0.0 * spin if accelerations is None else accelerations[joint.name][..., None] * joint.axis
        if joint.parent:
            parent = links[joint.parent]
            at_parent = joint.point is parent.point
            velocity, acceleration = (parent.velocity, parent.acceleration) if at_parent else parent.at(joint.point)
            alpha = parent.alpha + cross(parent.omega, spin) + turn
            links[joint.name] = _Link(joint.point, parent.omega + spin, alpha, velocity, acceleration)
        else:
            links[joint.name] = _Link(joint.point, spin, turn, 0.0 * spin, 0.0 * spin)
    return links


def _loop_matrix(posture: Posture) -> Array:
    """Return the Jacobian (..., 3 loops, joints) of the hands' positions with respect to the joint angles."""
    rows = []
    for loop in posture.loops:
        moving = {joint.name for joint in posture.chain(loop.joint)}
        columns = [
            cross(joint.axis, loop.point - joint.point) if joint.name in moving else 0.0 * loop.point
            for joint in posture.joints
        ]
        rows.append(stack(columns, -1))
    return namespace(*rows).concat(rows, axis=-2)


def joint_motion(posture: Posture, bicycle: Bicycle) -> tuple[dict[str, Array], dict[str, Array], tuple[Fault, ...]]:
    """Return the joint angles' first and second derivatives with respect to the steer angle.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle

    Returns
    -------
    first, second : dict of str to array, shape (...)
        s' and s'' of every joint.
    faults : tuple of Fault
        Designs of a batch whose loops cannot follow the steer.

    Raises
    ------
    PostureError
        If the loops of a single design cannot follow the steer (an arm stretched or folded in its own plane).

    Examples
    --------
    The leaned rider's torso twists with the steer, and pitches only to second order:

    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("stratos")
    >>> first, second, _ = joint_motion(seat(bicycle, load_rider("rider-a"), "leaned"), bicycle)
    >>> bool(abs(first["torso pitch"]) < 1e-12), bool(abs(second["torso pitch"]) > 0.01)
    (True, True)
    """
    if not posture.loops:
        return {}, {}, ()
    foot, axis = steer_axis(bicycle)
    inverse, faults = _inverse(_loop_matrix(posture), posture)
    turning = [cross(axis, loop.point - foot) for loop in posture.loops]
    first = _by_joint(posture, _apply(inverse, turning))
    links = _links(posture, first)
    residual = [
        cross(axis, velocity) - links[loop.joint].at(loop.point)[1]
        for loop, velocity in zip(posture.loops, turning, strict=True)
    ]
    return first, _by_joint(posture, _apply(inverse, residual)), faults


def _apply(inverse: Array, parts: list[Array]) -> Array:
    xp, right_sides = as_arrays(*parts)
    right = xp.concat(xp.broadcast_arrays(*right_sides), axis=-1)
    return xp.matmul(inverse, right[..., None])[..., 0]


def _by_joint(posture: Posture, values: Array) -> dict[str, Array]:
    return {joint.name: values[..., i] for i, joint in enumerate(posture.joints)}


def _inverse(matrix: Array, posture: Posture) -> tuple[Array, tuple[Fault, ...]]:
    """Return the inverse of the loops' matrix, NaN where the loops cannot move, and these faults."""
    xp = namespace(matrix)
    if not is_concrete(matrix):
        return xp.linalg.inv(matrix), ()
    import numpy as np

    numbers = np.asarray(matrix)
    try:
        inverse = np.linalg.inv(numbers)
        # |A| |A⁻¹| (Frobenius) is at least σmax / σmin: enough to clear nearly all, at a tenth of the cost.
        condition = np.linalg.norm(numbers, axis=(-2, -1)) * np.linalg.norm(inverse, axis=(-2, -1))
    except np.linalg.LinAlgError:  # one of them is singular to the last bit
        condition = np.full(numbers.shape[:-2], np.inf)
    finite = np.isfinite(numbers).all(axis=(-2, -1))
    suspect = finite & ~(condition * _SINGULAR < 1)
    bad = np.zeros(finite.shape, dtype=bool)
    if suspect.any():
        singular_values = np.linalg.svd(numbers[suspect], compute_uv=False)
        bad[suspect] = singular_values[..., -1] < _SINGULAR * singular_values[..., 0]
    text = (
        f"posture {posture.name}: the hands cannot follow the grips when steering, because the loops through the arms "
        "are singular (an arm is stretched straight, or its axes line up)"
    )
    faults = refuse_single([Fault(bad, text, error=PostureError, parameters=("posture",))])
    if is_jax(matrix) or suspect.any():
        inverse = xp.linalg.inv(xp.where(xp.asarray(bad)[..., None, None], xp.nan, matrix))
    return inverse, faults


def slaved_bodies(posture: Posture, bicycle: Bicycle) -> SlavedBodies:
    """Return the rider's segments and how they move with the steer.

    Parameters
    ----------
    posture : Posture
    bicycle : Bicycle

    Raises
    ------
    PostureError
        As in :func:`joint_motion`.

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("browser")
    >>> slaved_bodies(seat(bicycle, load_rider("rider-a"), "upright"), bicycle).displacement.shape
    (10, 3)
    """
    first, second, faults = joint_motion(posture, bicycle)
    links = _links(posture, first, second)
    columns = []
    for name, segment in posture.segments.items():
        joint = (posture.carried_by or {}).get(name)
        zero = 0.0 * segment.centre
        if joint:
            columns.append((segment, links[joint].omega, *links[joint].at(segment.centre)))
        else:
            columns.append((segment, zero, zero, zero))
    bodies, rotations, displacements, curvatures = zip(*columns, strict=True)
    return SlavedBodies(
        mass=stack([body.mass for body in bodies], -1),
        centre=stack([body.centre for body in bodies], -2),
        inertia=stack([body.inertia for body in bodies], -3),
        rotation=stack(rotations, -2),
        displacement=stack(displacements, -2),
        curvature=stack(curvatures, -2),
        faults=posture.skeleton.faults + faults,
    )


def steered_skeleton(posture: Posture, bicycle: Bicycle, steer: Array) -> Array:
    """Return the skeleton points (..., 31, 3) in m at a steer angle (...) in rad, exact to second order.

    Points of the rider's moving segments follow their joints, points of the front frame turn about the steer axis.

    Examples
    --------
    A hand stays on its grip, up to terms of third order:

    >>> import numpy as np
    >>> from singletrack import load_bicycle, load_rider
    >>> from singletrack.posture import seat
    >>> bicycle = load_bicycle("browser")
    >>> steered_skeleton(seat(bicycle, load_rider("rider-a"), "upright"), bicycle, np.array(0.1)).shape
    (31, 3)
    """
    first, second, _ = joint_motion(posture, bicycle)
    links = _links(posture, first, second)
    foot, axis = steer_axis(bicycle)
    _, (steer,) = as_arrays(steer)
    carried = posture.carried_by or {}
    link_of = {point: carried.get(segment, "") for point, segment in _SEGMENT_OF_POINT.items()}
    moved = []
    for number in range(1, 32):
        point = posture.skeleton[number]
        velocity = acceleration = 0.0 * point
        if number in _FRONT_POINTS:
            velocity = cross(axis, point - foot)
            acceleration = cross(axis, velocity)
        elif link_of.get(number):
            velocity, acceleration = links[link_of[number]].at(point)
        moved.append(point + steer[..., None] * velocity + steer[..., None] ** 2 / 2 * acceleration)
    return stack(moved, -2)


#: Points of the front frame, and the segment on which each of the rider's points lies.
_FRONT_POINTS = (6, 7, 8, 9, 11, 12, 16, 17, 18, 19, 20)
_SEGMENT_OF_POINT = {
    15: "torso",
    21: "torso",
    22: "torso",
    25: "head",
    23: "right_upper_arm",
    24: "left_upper_arm",
}
