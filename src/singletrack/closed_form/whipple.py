"""The bicycle with all its mass on the four bodies: Meijaard et al. 2007, appendix A."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from singletrack.arrays import Array, Number, as_arrays, stack, vector
from singletrack.parameters.bodies import bodies_of_values

if TYPE_CHECKING:
    from singletrack.mechanics import PlanarBody
    from singletrack.parameters import Bicycle

__all__ = ["Matrices", "matrix2", "whipple_matrices"]


class Matrices(NamedTuple):
    """M, C1, K0 and K2, each of shape (..., 2, 2); coordinates lean and steer."""

    M: Array
    C1: Array
    K0: Array
    K2: Array


class _System(NamedTuple):
    """Mass, centre and inertia of bodies taken together, about the rear contact or their own centre."""

    mass: Number
    x: Number
    z: Number
    xx: Number
    xz: Number
    zz: Number


def matrix2(a11: Number, a12: Number, a21: Number, a22: Number) -> Array:
    """Return matrices (..., 2, 2) of their entries (...).

    Parameters
    ----------
    a11, a12, a21, a22 : array, shape (...)
        Row, then column.
    """
    return stack([vector(a11, a12), vector(a21, a22)], -2)


def whipple_matrices(bicycle: Bicycle) -> Matrices:
    """Return the coefficient matrices of a bicycle without rider (or with one lumped into the rear frame).

    Parameters
    ----------
    bicycle : Bicycle
        Parameters of any broadcastable shapes (...).

    Returns
    -------
    Matrices
        In SI units per radian; K0 without gravity: ``M q'' + v C1 q' + (g K0 + v^2 K2) q = f`` with q = (lean, steer).

    Notes
    -----
    Meijaard, Papadopoulos, Ruina, Schwab (2007), Proc. R. Soc. A 463:1955-1982, equations (A 1) to (A 28).

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> whipple_matrices(load_bicycle("benchmark")).M.round(8).tolist()
    [[80.81722, 2.31941332], [2.31941332, 0.29784188]]
    """
    values = {name: value for name, value in bicycle.values().items() if "geometry" not in name}
    xp, arrays = as_arrays(*values.values())
    b = dict(zip(values, arrays, strict=True))
    sin, cos = xp.sin(b["steer_axis_tilt"]), xp.cos(b["steer_axis_tilt"])
    rear_frame, front_frame, rear_wheel, front_wheel = bodies_of_values(b).values()
    total = _taken_together([rear_wheel, rear_frame, front_frame, front_wheel])
    front = _about_centre([front_frame, front_wheel])
    # Distance of the front assembly's centre ahead of the steer axis, and its moments about that axis.
    ahead = (front.x - b["wheel_base"] - b["trail"]) * cos - front.z * sin
    steer_steer = front.mass * ahead**2 + front.xx * sin**2 + 2 * front.xz * sin * cos + front.zz * cos**2
    steer_x = -front.mass * ahead * front.z + front.xx * sin + front.xz * cos
    steer_z = front.mass * ahead * front.x + front.xz * sin + front.zz * cos

    mu, kappa = b["trail"] * cos / b["wheel_base"], cos / b["wheel_base"]
    front_spin = _spin(xp, b, "front")
    spin = _spin(xp, b, "rear") + front_spin
    moment = front.mass * ahead + mu * total.mass * total.x
    height_moment = total.mass * total.z

    lean_steer = steer_x + mu * total.xz
    gyroscopic = mu * spin + front_spin * cos
    return Matrices(
        matrix2(total.xx, lean_steer, lean_steer, steer_steer + 2 * mu * steer_z + mu**2 * total.zz),
        matrix2(
            0.0,
            gyroscopic + kappa * total.xz - mu * height_moment,
            -gyroscopic,
            kappa * steer_z + mu * (moment + kappa * total.zz),
        ),
        matrix2(height_moment, -moment, -moment, -moment * sin),
        matrix2(0.0, kappa * (spin - height_moment), 0.0, kappa * (moment + front_spin * sin)),
    )


def _spin(xp: Any, b: dict[str, Any], end: str) -> Array:
    """Return a wheel's angular momentum over the speed: zero for a skate, without radius and inertia."""
    radius = b[f"{end}_wheel_radius"]
    return b[f"{end}_wheel_inertia_yy"] / xp.where(radius == 0, 1.0, radius)


def _taken_together(bodies: list[PlanarBody]) -> _System:
    """Return mass and centre of bodies and their inertia about the rear contact."""
    mass = sum(body.mass for body in bodies)
    return _System(
        mass,
        sum(body.mass * body.x for body in bodies) / mass,
        sum(body.mass * body.z for body in bodies) / mass,
        sum(body.xx + body.mass * body.z**2 for body in bodies),
        sum(body.xz - body.mass * body.x * body.z for body in bodies),
        sum(body.zz + body.mass * body.x**2 for body in bodies),
    )


def _about_centre(bodies: list[PlanarBody]) -> _System:
    """Return mass and centre of bodies and their inertia about their own centre."""
    mass = sum(body.mass for body in bodies)
    x = sum(body.mass * body.x for body in bodies) / mass
    z = sum(body.mass * body.z for body in bodies) / mass
    return _System(
        mass,
        x,
        z,
        sum([*(body.xx for body in bodies), *(body.mass * (body.z - z) ** 2 for body in bodies)]),
        sum([*(body.xz for body in bodies), *(-body.mass * (body.x - x) * (body.z - z) for body in bodies)]),
        sum([*(body.zz for body in bodies), *(body.mass * (body.x - x) ** 2 for body in bodies)]),
    )
