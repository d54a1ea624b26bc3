"""From the statements of a file to what they describe; every keyword works, or is refused by name, line and reason."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.errors import InputError, nearest
from singletrack.multibody.spacar.kinds import KINDS, WIDTHS
from singletrack.multibody.spacar.properties import (
    add_force,
    add_line_mass,
    add_mass,
    add_port,
    add_torque,
    constants,
    set_gravity,
    set_steps,
    set_tolerance,
)
from singletrack.multibody.spacar.reader import Reader
from singletrack.multibody.spacar.shape import (
    add_element,
    draw,
    initial_value,
    line_freedom,
    mark,
    pair_slip,
    prescribe,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.multibody.spacar.description import Description
    from singletrack.multibody.spacar.statements import Source

__all__ = ["KEYWORDS", "REFUSED", "describe"]

MOST_COORDINATES = 2_000

#: Keywords that work.
KEYWORDS: dict[str, Callable[[Reader], None]] = {
    **dict.fromkeys(KINDS, add_element),
    **dict.fromkeys(("X", "XY", "XYZ", "BETA", "LAMBDA"), draw),
    "FIX": mark("x", "fixed"),
    "RLSE": mark("e", "calculated"),
    "DYNE": mark("e", "dynamic"),
    "DYNX": mark("x", "dynamic"),
    "KINE": mark("e", "kinematic"),
    "KINX": mark("x", "kinematic"),
    "INPUTE": prescribe("e"),
    "INPUTX": prescribe("x"),
    "LINE": line_freedom,
    "ENHC": pair_slip,
    "XD": initial_value("x", 1),
    "XDD": initial_value("x", 2),
    "E": initial_value("e", 0),
    "ED": initial_value("e", 1),
    "EDD": initial_value("e", 2),
    **dict.fromkeys(("MASS", "XM"), add_mass),
    **dict.fromkeys(("EMASS", "EM"), add_line_mass),
    "ESTIFF": constants("stiffness"),
    **dict.fromkeys(("EDAMP", "EDAMPP"), constants("damping")),
    **dict.fromkeys(("FORCE", "XF"), add_force),
    "TORQUEL": add_torque,
    "GRAVITY": set_gravity,
    "INPUTS": add_port("e", "input"),
    "INPUTF": add_port("x", "input"),
    "OUTE": add_port("e", "output"),
    "OUTEP": add_port("ed", "output"),
    "OUTX": add_port("x", "output"),
    "OUTXP": add_port("xd", "output"),
    "TIMESTEP": set_steps,
    **dict.fromkeys(("EPSKIN", "EPSINT", "EPSIND", "HMAX"), set_tolerance),
}

#: Keywords that are known and refused, and why.
REFUSED = {
    "PLBELT": "a belt between two pulleys is not among the elements here; a geared PLHINGE pair cannot replace it",
    "SURFACE": "the ground is a plane (z = 0, in the plane y = 0); other surfaces are not available",
    "LINX": "only deformations (LINE) can be added to the freedoms of the linear model",
}

# Elements come first, then what places nodes, then everything else: a file may say them in any order.
_FIRST = set(KINDS)


def describe(source: Source) -> Description:
    r"""Return what a file describes.

    Parameters
    ----------
    source : Source
        The statements of a file.

    Raises
    ------
    InputError
        Names file, line, keyword and reason.

    Examples
    --------
    >>> from singletrack.multibody.spacar.statements import parse
    >>> model = describe(parse("PLBEAM 1 1 2 3 4\nX 3 1.0 0.0\nFIX 1\nFIX 2"))
    >>> model.nodes, model.coordinates(3)
    ({1: 'p2', 2: 'o2', 3: 'p2', 4: 'o2'}, (1.0, 0.0))
    """
    reader = Reader(source)
    for statement in source.statements:
        if statement.keyword not in KEYWORDS:
            reader.statement = statement
            if statement.keyword in REFUSED:
                raise reader.refuse(REFUSED[statement.keyword])
            raise reader.refuse(f"is no keyword that is known{nearest(statement.keyword, KEYWORDS)}")
    for elements in (True, False):
        for statement in source.statements:
            if (statement.keyword in _FIRST) is elements:
                reader.statement, reader.numbers = statement, statement.numbers
                KEYWORDS[statement.keyword](reader)
    d = reader.description
    if not d.elements:
        raise InputError(f"{source.where}: has no element, must have one such as PLBEAM 1 1 2 3 4")
    size = sum(WIDTHS[kind] for kind in d.nodes.values())
    if size > MOST_COORDINATES:
        raise InputError(f"{source.where}: has {size} coordinates, at most {MOST_COORDINATES} are solved")
    d.nodes = dict(sorted(d.nodes.items()))
    d.elements = dict(sorted(d.elements.items()))
    return d
