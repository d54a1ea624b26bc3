"""The bicycle with all its mass on the four bodies: Meijaard et al. 2007, appendix A."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from singletrack.arrays import Array, as_arrays, stack, vector

if TYPE_CHECKING:
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

    mass: Array
    x: Array
    z: Array
    xx: Array
    xz: Array
    zz: Array


def matrix2(a11: Array, a12: Array, a21: Array, a22: Array) -> Array:
    """Return matrices (..., 2, 2) of their entries (...)."""
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
    total, front = _total(b), _front_assembly(b)
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


def _total(b: dict[str, Any]) -> _System:
    """Return mass and centre of the whole bicycle, inertia about the rear contact."""
    rear_radius, front_radius, base = b["rear_wheel_radius"], b["front_wheel_radius"], b["wheel_base"]
    bodies = [
        (b["rear_wheel_mass"], 0.0 * base, -rear_radius, *_wheel_inertia(b, "rear")),
        (b["rear_frame_mass"], b["rear_frame_x"], b["rear_frame_z"], *_frame_inertia(b, "rear")),
        (b["front_frame_mass"], b["front_frame_x"], b["front_frame_z"], *_frame_inertia(b, "front")),
        (b["front_wheel_mass"], base, -front_radius, *_wheel_inertia(b, "front")),
    ]
    mass = sum(m for m, *_ in bodies)
    return _System(
        mass,
        sum(m * x for m, x, *_ in bodies) / mass,
        sum(m * z for m, _, z, *_ in bodies) / mass,
        sum(xx + m * z**2 for m, _, z, xx, _, _ in bodies),
        sum(xz - m * x * z for m, x, z, _, xz, _ in bodies),
        sum(zz + m * x**2 for m, x, _, _, _, zz in bodies),
    )


def _front_assembly(b: dict[str, Any]) -> _System:
    """Return mass, centre and central inertia of front frame and front wheel."""
    frame, wheel = b["front_frame_mass"], b["front_wheel_mass"]
    mass = frame + wheel
    x = (frame * b["front_frame_x"] + wheel * b["wheel_base"]) / mass
    z = (frame * b["front_frame_z"] - wheel * b["front_wheel_radius"]) / mass
    dx, dz = b["front_frame_x"] - x, b["front_frame_z"] - z
    wheel_dx, wheel_dz = b["wheel_base"] - x, -b["front_wheel_radius"] - z
    frame_xx, frame_xz, frame_zz = _frame_inertia(b, "front")
    wheel_xx, _, wheel_zz = _wheel_inertia(b, "front")
    return _System(
        mass,
        x,
        z,
        frame_xx + wheel_xx + frame * dz**2 + wheel * wheel_dz**2,
        frame_xz - frame * dx * dz - wheel * wheel_dx * wheel_dz,
        frame_zz + wheel_zz + frame * dx**2 + wheel * wheel_dx**2,
    )


def _frame_inertia(b: dict[str, Any], end: str) -> tuple[Array, Array, Array]:
    return tuple(b[f"{end}_frame_inertia_{axes}"] for axes in ("xx", "xz", "zz"))


def _wheel_inertia(b: dict[str, Any], end: str) -> tuple[Array, Array, Array]:
    xx = b[f"{end}_wheel_inertia_xx"]
    return xx, 0.0 * xx, xx
