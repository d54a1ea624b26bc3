"""A rigid rider of the BicycleParameters package: one body, lumped into a bicycle's rear frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.files.format import Format
from singletrack.files.text_lines import read_values
from singletrack.mechanics.rigid import PlanarBody, principal_in_plane
from singletrack.parameters.bicycle import FLATNESS_TOLERANCE

if TYPE_CHECKING:
    from singletrack.files.format import Clues
    from singletrack.files.named_values import NamedValues

__all__ = ["FORMAT", "read_rigid_rider"]

#: A rider and what he sits on stay well within what a bicycle may weigh.
_LARGEST = {"m": 500.0, "I": 1e4, "x": 10.0, "z": 10.0}
_SYMBOLS = ("mB", "xB", "yB", "zB", "IBxx", "IByy", "IBzz", "IBxz")


def _recognises(clues: Clues) -> bool:
    return "mB" in clues.values and set(clues.values) <= set(_SYMBOLS)


FORMAT = Format(
    name="rigid rider",
    description="a rigid rider or a lone body of BicycleParameters",
    recognises=_recognises,
    used_by="`singletrack convert BICYCLE OUTPUT --rigid-rider FILE` puts it on one",
)


def read_rigid_rider(text: str, where: str) -> PlanarBody:
    """Return the rigid rider that a file of the symbols ``mB, xB, zB, IBxx, IByy, IBzz, IBxz`` describes.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        For symbols that are unknown or missing, and values that no body has; names file, line and symbol.
    """
    given = read_values(text, where)
    given.require_known(sorted(_SYMBOLS), "symbol of a rigid rider")
    given.require(sorted(set(_SYMBOLS) - {"yB"}), "the rigid rider")
    values = given.values()
    given.require_equal({"yB": 0.0})
    for name in ("mB", "IBxx", "IByy", "IBzz"):
        if not values[name] > 0:
            raise _wrong(given, name, f"{values[name]:g}, must be greater than zero")
    for name, value in values.items():
        if name != "yB" and not abs(value) < _LARGEST[name[0]]:
            raise _wrong(given, name, f"{value:g}, must be less than {_LARGEST[name[0]]:g}")
    if values["zB"] >= 0:
        raise _wrong(given, "zB", f"{values['zB']:g} m, must be less than zero (z points down)")
    if values["IBxz"] ** 2 >= values["IBxx"] * values["IBzz"]:
        raise _wrong(given, "IBxz", f"{values['IBxz']:g} kg*m^2 is no body's: its square must be less than IBxx IBzz")
    larger, smaller, _ = principal_in_plane(values["IBxx"], values["IBzz"], values["IBxz"])
    slack = 1 + FLATNESS_TOLERANCE
    if values["IByy"] > slack * (larger + smaller) or larger > slack * (values["IByy"] + smaller):
        moments = f"({smaller:.6g}, {values['IByy']:.6g}, {larger:.6g} kg*m^2)"
        raise _wrong(
            given,
            "IByy",
            f"{values['IByy']:g} kg*m^2 is no body's: of the principal moments {moments} none may exceed the sum "
            f"of the other two by more than {FLATNESS_TOLERANCE:.0%}",
        )
    return PlanarBody(*(values[name] for name in ("mB", "xB", "zB", "IBxx", "IByy", "IBzz", "IBxz")))


def _wrong(given: NamedValues, name: str, reason: str) -> InputError:
    return InputError(f"{name} = {reason}", parameters=(name,), found=given.values()[name], place=given.place(name))
