"""What inertias no body has, and what masses no wheel: on floats and on batches alike.

Only operators are used, which work on both; comparisons with NaN are false, and products, unlike powers of floats,
overflow to infinity instead of raising.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from singletrack.arrays.faults import Fault
from singletrack.errors import InputError
from singletrack.parameters.values import real_numbers

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.arrays import Number

__all__ = ["FLATNESS_TOLERANCE", "inertia_faults", "skate_faults", "tyre_faults"]

#: A flat body has Iyy = Ixx + Izz; bicycle frames are nearly flat, so that measured ones end up a little on either side
#: (the paper's Browser: 2.4 % above). Beyond this relative excess no measurement explains it.
FLATNESS_TOLERANCE = 0.05

_ROUNDING = 1e-12


def inertia_faults(body: str, axes: tuple[str, ...], xx: Number, yy: Number, zz: Number, xz: Number) -> Iterator[Fault]:
    """Yield faults of an inertia tensor that is symmetric about the x-z plane: what no distribution of mass has.

    Parameters
    ----------
    body : str
        Name of the body, for the names of its parameters: ``rear_frame``, ...
    axes : tuple of str
        The entries that the body has as parameters, of ``xx, yy, zz, xz`` in this order.
    xx, yy, zz, xz : array, shape (...)
        In kg m^2, about the centre of mass.
    """
    entries = real_numbers(xx, yy, zz, xz)
    if entries is None:
        return
    xx, yy, zz, xz = entries
    mean, lopsided = (xx + zz) / 2, (xx - zz) / 2
    half = (lopsided * lopsided + xz * xz) ** 0.5
    smallest, largest = mean - half, mean + half
    usable = (xx >= 0) & (yy >= 0) & (zz >= 0) & (xx < inf) & (yy < inf) & (zz < inf)
    negative = usable & (smallest < -_ROUNDING * largest)
    slack = 1 + FLATNESS_TOLERANCE
    excess = (yy > slack * (smallest + largest)) | (largest > slack * (yy + smallest))
    excess = usable & excess & (smallest >= -_ROUNDING * largest)
    if negative is False and excess is False:
        return
    parameters = tuple(f"{body}_inertia_{axis}" for axis in axes)
    found = {"xx": xx, "yy": yy, "zz": zz, "xz": xz, "small": smallest, "large": largest}
    found |= dict(zip(parameters, entries, strict=False))
    tensor = f"{body}_inertia (xx {{xx:.6g}}, yy {{yy:.6g}}, zz {{zz:.6g}}, xz {{xz:.6g}}) kg*m**2 is no body's: "
    principal = "the moment about a principal axis in the x-z plane is {small:.6g}, must be zero or more"
    triangle = (
        "no principal moment ({small:.6g}, {yy:.6g}, {large:.6g}) may exceed the sum of the other two "
        f"by more than {FLATNESS_TOLERANCE:.0%} (room for measurement errors of flat bodies)"
    )
    yield Fault(negative, tensor + principal, found, InputError, parameters, "the inertia of a body")
    yield Fault(excess, tensor + triangle, found, InputError, parameters, "the inertia of a body")


def skate_faults(wheel: str, radius: Number, mass: Number, xx: Number, yy: Number) -> Iterator[Fault]:
    """Yield faults of a wheel without radius or mass: a skate's, which has no inertia either.

    Parameters
    ----------
    wheel : str
        ``rear_wheel`` or ``front_wheel``.
    radius, mass, xx, yy : array, shape (...)
        In m, kg and kg m^2.
    """
    numbers = real_numbers(radius, mass, xx, yy)
    if numbers is None:
        return
    radius, mass, xx, yy = numbers
    spinning, weightless = (radius == 0) & (yy > 0), (mass == 0) & ((xx > 0) | (yy > 0))
    if spinning is False and weightless is False:
        return
    names = (f"{wheel}_radius", f"{wheel}_inertia_yy")
    yield Fault(
        spinning,
        f"{names[0]} = 0 m with {names[1]} = {{{names[1]}:.6g}} kg*m**2 would spin infinitely fast, "
        f"must be greater than zero unless {names[1]} is zero",
        dict(zip(names, (radius, yy), strict=True)),
        InputError,
        names,
        "greater than zero",
    )
    parts = (f"{wheel}_mass", f"{wheel}_inertia_xx", f"{wheel}_inertia_yy")
    yield Fault(
        weightless,
        f"{parts[0]} = 0 kg with {parts[1]} = {{{parts[1]}:.6g}} and {parts[2]} = {{{parts[2]}:.6g}} kg*m**2, "
        "must be greater than zero unless the wheel has no inertia",
        dict(zip(parts, (mass, xx, yy), strict=True)),
        InputError,
        parts,
        "greater than zero",
    )


def tyre_faults(wheel: str, radius: Number, tyre: Number | None) -> Iterator[Fault]:
    """Yield the fault of a tyre that is rounder than its wheel is large.

    Parameters
    ----------
    wheel : str
        ``rear_wheel`` or ``front_wheel``.
    radius : array, shape (...)
        Of the wheel, m.
    tyre : array, shape (...), optional
        Of the tyre's cross-section, m.
    """
    numbers = None if tyre is None else real_numbers(radius, tyre)
    if numbers is None:
        return
    radius, tyre = numbers
    larger = tyre > radius
    if larger is False:
        return
    names = (f"{wheel.replace('wheel', 'tyre')}_radius", f"{wheel}_radius")
    yield Fault(
        larger,
        f"{names[0]} = {{{names[0]}:.6g}} m is the radius of the tyre's cross-section, "
        f"must not exceed {names[1]} = {{{names[1]}:.6g}} m",
        dict(zip(names, (tyre, radius), strict=True)),
        InputError,
        names,
        "at most the wheel's radius",
    )
