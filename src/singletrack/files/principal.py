"""The principal parameter set (Moore and Hubbard 2019): radii of gyration and angles of the principal axes.

Bodies: D rear frame, P rider, H front frame, R and F wheels. A principal inertia diag(m kaa², m kyy², m kbb²), turned
by alpha about y, has Ixx = m (kaa² cos² + kbb² sin²), Izz = m (kaa² sin² + kbb² cos²), Ixz = -m (kaa² - kbb²) sin cos.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError
from singletrack.mechanics.rigid import PlanarBody, combine, principal_in_plane
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.bodies import bicycle_bodies, frame_parameters
from singletrack.parameters.symbols import NAMES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Number
    from singletrack.files.named_values import NamedValues

__all__ = ["bicycle_from_principal", "principal_values"]

_SAME = ("c", "g", "lam", "w", "rF", "rR", "mF", "mR", "mH", "xH", "zH")
_OWN = (
    *("mD", "xD", "zD", "alphaD", "kDaa", "kDbb", "kDyy"),
    *("mP", "xP", "zP", "alphaP", "kPaa", "kPbb", "kPyy", "lP", "wP"),
    *("alphaH", "kHaa", "kHbb", "kHyy", "kFaa", "kFyy", "kRaa", "kRyy"),
)
_DEPENDENT = ("alphaF", "alphaR", "kFbb", "kRbb", "yD", "yF", "yH", "yP", "yR", "xR", "xF", "zR", "zF")
_POSITIVE = ("mD",)
_NOT_NEGATIVE = ("mP", *(name for name in _OWN if name.startswith("k")), "lP", "wP")


def bicycle_from_principal(given: NamedValues, source: str) -> Bicycle:
    """Return the bicycle of a principal set, its rider lumped into the rear frame.

    The set's own values are kept in ``extras``, so that they can be written back to the digit.

    Parameters
    ----------
    given : NamedValues
    source : str
        Where the numbers come from.

    Raises
    ------
    InputError
        For symbols that are unknown or missing, and values that are not allowed; names file, line and symbol.
    """
    given.require_known([*_SAME, *_OWN, *_DEPENDENT, "v"], "symbol")
    given.require([*_SAME, *_OWN], "the principal parameter set")
    values = given.values()
    for names, least in ((_POSITIVE, "greater than zero"), (_NOT_NEGATIVE, "zero or more")):
        for name in names:
            if values[name] < 0 or (least != "zero or more" and values[name] == 0):
                raise InputError(f"{given.place(name)}: {name} = {values[name]:g}, must be {least}")
    for name, deviation in given.deviations().items():
        raise InputError(f"{given.place(name)}: {name} has a standard deviation ({deviation:g}), must have none here")
    given.require_equal(_dependent(values))
    own = {name: values[name] for name in (*_OWN, *_DEPENDENT, "v") if name in values}
    symbols = {NAMES[symbol]: symbol for symbol in _SAME}
    for end, letter in (("rear", "D"), ("front", "H")):
        axes = {"xx": "aa", "yy": "yy", "zz": "bb", "xz": "aa"}
        symbols |= {f"{end}_frame_{part}": f"{part[0]}{letter}" for part in ("mass", "x", "z")}
        symbols |= {f"{end}_frame_inertia_{axis}": f"k{letter}{radius}" for axis, radius in axes.items()}
    for end, letter in (("rear", "R"), ("front", "F")):
        symbols |= {f"{end}_wheel_inertia_{axis}": f"k{letter}{r}" for axis, r in (("xx", "aa"), ("yy", "yy"))}
    return given.build(
        lambda: Bicycle(
            name=given.name, description=given.description, source=source, extras=own, **_benchmark(values)
        ),
        symbols,
    )


def _dependent(p: Mapping[str, float]) -> dict[str, float]:
    zero = dict.fromkeys(("alphaF", "alphaR", "yD", "yF", "yH", "yP", "yR", "xR"), 0.0)
    return {**zero, "kFbb": p["kFaa"], "kRbb": p["kRaa"], "xF": p["w"], "zR": -p["rR"], "zF": -p["rF"]}


def _benchmark(p: Mapping[str, float]) -> dict[str, Any]:
    """Return our parameters from those of a principal set."""
    # Masses and radii near the largest double overflow; the record then refuses what is not finite.
    with np.errstate(all="ignore"):
        rear = PlanarBody.of(combine([_body(p, "D").body(), _body(p, "P").body()]))
    found: dict[str, float] = {NAMES[symbol]: p[symbol] for symbol in _SAME}
    found |= frame_parameters("rear", rear) | frame_parameters("front", _body(p, "H"))
    for end, letter in (("rear", "R"), ("front", "F")):
        for axes, radius in (("xx", "aa"), ("yy", "yy")):
            found[f"{end}_wheel_inertia_{axes}"] = p[f"m{letter}"] * p[f"k{letter}{radius}"] * p[f"k{letter}{radius}"]
    return found


def _body(p: Mapping[str, float], letter: str) -> PlanarBody:
    mass, alpha = p[f"m{letter}"], p[f"alpha{letter}"]
    sin, cos = math.sin(alpha), math.cos(alpha)
    aa, bb, yy = (mass * p[f"k{letter}{axes}"] * p[f"k{letter}{axes}"] for axes in ("aa", "bb", "yy"))
    return PlanarBody(
        mass=mass,
        x=p[f"x{letter}"],
        z=p[f"z{letter}"],
        xx=aa * cos * cos + bb * sin * sin,
        yy=yy,
        zz=aa * sin * sin + bb * cos * cos,
        xz=(bb - aa) * sin * cos,
    )


def principal_values(bicycle: Bicycle) -> dict[str, float]:
    """Return a bicycle as a principal set: to the digit as it was read, if it was; else all mass in D, no rider; SI.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> round(principal_values(load_bicycle("stratos"))["kFyy"], 6)
    0.216907
    """
    same = {symbol: float(getattr(bicycle, NAMES[symbol])) for symbol in _SAME}
    read = {name: value for name, value in bicycle.extras.items() if name in (*_OWN, *_DEPENDENT)} | same
    if all(name in read for name in _OWN):
        derived = _benchmark(read)
        if all(getattr(bicycle, name) == value for name, value in derived.items()):
            return read
    bodies = bicycle_bodies(bicycle)
    values = {**same, **_principal(bodies["rear frame"], "D"), **_principal(bodies["front frame"], "H")}
    for letter, wheel in (("R", bodies["rear wheel"]), ("F", bodies["front wheel"])):
        values |= {f"k{letter}{axes}": _gyration(i, wheel.mass) for axes, i in (("aa", wheel.xx), ("yy", wheel.yy))}
    rider = dict.fromkeys(("mP", "alphaP", "kPaa", "kPbb", "kPyy", "lP", "wP"), 0.0)
    values |= {**rider, "xP": values["xD"], "zP": values["zD"]}
    return {**values, **_dependent(values)}


def _principal(body: PlanarBody, letter: str) -> dict[str, float]:
    larger, smaller, angle = principal_in_plane(body.xx, body.zz, body.xz)
    return {
        f"m{letter}": float(body.mass),
        f"x{letter}": float(body.x),
        f"z{letter}": float(body.z),
        f"alpha{letter}": float(angle),
        f"k{letter}aa": _gyration(larger, body.mass),
        f"k{letter}bb": _gyration(smaller, body.mass),
        f"k{letter}yy": _gyration(body.yy, body.mass),
    }


def _gyration(moment: Number, mass: Number) -> float:
    """Return a radius of gyration: zero for a massless wheel, and for a moment of a rod that rounds to below zero."""
    return math.sqrt(max(float(moment), 0.0) / float(mass)) if mass else 0.0
