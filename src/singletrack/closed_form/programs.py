"""The shipped programs: the closed form of each structure as one straight list of scalar statements.

They are traced from the equations (``make programs``, :mod:`.generate`), which remain the only derivation; a test keeps
them fresh. A program is text in ``data/programs``; what its words ``sqrt, sin, where, ...`` mean is settled where it is
run, so that it serves numbers and arrays alike.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from operator import itemgetter
from pathlib import Path
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any

from singletrack.errors import InputError
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bicycle import FRAME_GEOMETRY
from singletrack.posture import Mechanism, Options, file_of_posture, shipped_alike

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ASIDE", "FOLDER", "LEAN", "MATRICES", "RIDERLESS", "Program", "program_named", "program_of", "values_of"]

FOLDER = Path(__file__).parents[1] / "data" / "programs"
#: What a program returns first, n x n entries each; with a rider follow his load
#: (:func:`~singletrack.closed_form.round_tyres.load_of_rider`) and the :class:`~singletrack.posture.Margins`.
MATRICES = ("M", "C1", "K0", "K2")
#: Names of structures: a bicycle alone, and what is added to a posture's file for elbows that need not hang in the
#: plane of their shoulder (a handlebar of a given width, an elbow drop angle), and for a torso that may lean.
RIDERLESS, ASIDE, LEAN = "bicycle", "-elbows-aside", "-torso-lean"
#: Parameters that, given, make another structure.
_SOFT = ("frame_torsion_stiffness", "fork_bending_stiffness")
_geometry = itemgetter(*FRAME_GEOMETRY)
#: The meaning of a program's words for numbers.
_OF_NUMBERS = {
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
    "where": lambda condition, yes, no: yes if condition else no,
    "maximum": max,
}


@dataclass(frozen=True, eq=False)
class Program:
    """The closed form of one structure.

    Attributes
    ----------
    name : str
    freedoms : int
        The number n of coordinates.
    of_bicycle, of_rider : tuple of str
        The parameters that it takes, in this order.
    code : code object
    """

    name: str
    freedoms: int
    of_bicycle: tuple[str, ...]
    of_rider: tuple[str, ...]
    code: CodeType

    def function(self, words: dict[str, Any] | None = None) -> Callable[..., tuple[Any, ...]]:
        """Return the program as a function of the parameters' values, which returns the entries one after the other.

        Parameters
        ----------
        words : dict, optional
            What its words mean; by default those of numbers.
        """
        return FunctionType(self.code, dict(_OF_NUMBERS if words is None else words), "program")


def program_of(bicycle: Bicycle, rider: Rider | None, options: Options) -> Program | None:
    """Return the program of a model's structure, or None where there is none: it is no common one.

    Springs, dampers and round tyres are added to what a program returns.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider, optional
    options : Options

    Examples
    --------
    >>> from singletrack import load_bicycle, load_rider
    >>> program = program_of(load_bicycle("browser"), load_rider("rider-a"), Options("upright"))
    >>> program.name, program.freedoms, program.of_bicycle[:2]
    ('upright-axial', 2, ('wheel_base', 'trail'))
    """
    own = bicycle.__dict__
    if any(own[stiffness] is not None for stiffness in _SOFT):
        return None
    if rider is None:
        return program_named(RIDERLESS)
    if rider.shapes or any(value is None for value in _geometry(own)):
        return None
    name = None if options.fit is not None else _file_of(options)
    if name is None:
        return None
    aside = own["handlebar_width"] is not None or rider.elbow_drop_angle is not None
    return program_named("".join((name, ASIDE if aside else "", LEAN if options.torso_lean else "")))


def values_of(program: Program, bicycle: Bicycle, rider: Rider | None) -> tuple[Any, ...]:
    """Return the values that a program takes, each of a shape (...) of its own; None where one is missing.

    Parameters
    ----------
    program : Program
    bicycle : Bicycle
    rider : Rider, optional

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> values_of(program_named("bicycle"), load_bicycle("benchmark"), None)[:2]
    (1.02, 0.08)
    """
    own: dict[str, Any] = bicycle.__dict__
    if rider is not None:
        own = {**own, **rider.__dict__}
        own["torso_width"], own["torso_thickness"] = rider.torso_section
        for parameter, usual in (
            ("forward_lean_angle", rider.forward_lean_angles.get(bicycle.name)),
            ("handlebar_drop", 0.0),
            ("handlebar_width", own["shoulder_to_shoulder"]),
            ("elbow_drop_angle", math.pi / 2),
        ):
            if own[parameter] is None:
                own[parameter] = usual
    found: tuple[Any, ...] = _reader(program)(own)
    return found


@functools.cache
def _reader(program: Program) -> Callable[[dict[str, Any]], tuple[Any, ...]]:
    return itemgetter(*program.of_bicycle, *program.of_rider)


def _file_of(options: Options) -> str | None:
    """Return the name of the file of the posture that options ask for, None where it is not shipped."""
    if isinstance(options.posture, Mechanism):
        plain = options.shoulder is None and options.arms is None
        return shipped_alike(options.posture) if plain else None
    try:
        return file_of_posture(options.posture, options.shoulder, options.arms)
    except InputError:  # said when the posture itself is asked for
        return None


@functools.cache
def program_named(name: str) -> Program | None:
    """Return a shipped program, or None if there is none of this name.

    Parameters
    ----------
    name : str
        That of the posture's file, with what the torso does; or that of a bicycle alone.
    """
    path = FOLDER / f"{name}.txt"
    if not path.is_file():
        return None
    # As a module is read: what has been compiled is kept beside the text, where there is a place to write to.
    module: Any = SourceFileLoader(f"{__name__}.{name}", str(path)).get_code(f"{__name__}.{name}")
    code = next(constant for constant in module.co_consts if isinstance(constant, CodeType))
    inputs = code.co_varnames[: code.co_argcount]
    return Program(
        name,
        3 if name.endswith(LEAN) else 2,
        tuple(one for one in inputs if one in Bicycle.__dataclass_fields__),
        tuple(one for one in inputs if one in Rider.__dataclass_fields__),
        code,
    )
