"""From options to a mechanism: the shipped ones, files, torso lean, soft hands, springs and dampers by joint."""

from __future__ import annotations

import functools
from dataclasses import replace
from pathlib import Path

from singletrack.errors import InputError, unknown_name
from singletrack.files.registry import format_of
from singletrack.files.source import read_text
from singletrack.library import shipped
from singletrack.posture.mechanism import FRAME, Direction, JointPlan, Mechanism, Place
from singletrack.posture.mechanism_file import parse_mechanism
from singletrack.posture.options import POSTURES, Options
from singletrack.posture.springs import sprung, with_sliders

__all__ = ["TORSO_LEAN", "file_of_posture", "is_posture", "load_posture", "mechanism_of", "named_posture"]

#: The hinge along x at the hips of the journal version (2012), under all of the upper body.
TORSO_LEAN = "torso lean"
#: File of each shipped posture by its options (shoulder, arms); the first is the default.
_VARIANTS: dict[str, dict[tuple[str, str | None], str]] = {
    "upright": {("axial", None): "upright-axial", ("abduction", None): "upright-abduction"},
    "leaned": {
        ("abduction", "straight"): "leaned-straight-abduction",
        ("abduction", "bent"): "leaned-bent-abduction",
        ("axial", "bent"): "leaned-bent-axial",
    },
}


def load_posture(name_or_path: str | Path) -> Mechanism:
    """Load a mechanism: a shipped posture's name, or a file.

    Parameters
    ----------
    name_or_path : str or path

    Raises
    ------
    InputError
        If there is no such thing, or the file is no mechanism.

    Examples
    --------
    >>> load_posture("upright").freedoms, len(load_posture("upright").joints)
    ((), 6)
    """
    name = str(name_or_path)
    if name in _VARIANTS:
        return _base(name, None, None)
    if name in shipped("posture"):
        return _read(name)
    path = Path(name_or_path)
    try:
        there = path.exists()
    except (OSError, ValueError):  # a name too long, or with a NUL
        there = False
    if not there:
        known = dict.fromkeys([*POSTURES, *(name for name in shipped("posture") if name not in _variant_files())])
        raise InputError(f"{unknown_name('posture', name[:200], known)}, and there is no such file")
    return parse_mechanism(read_text(path), str(path))


def is_posture(name_or_path: str | Path) -> bool:
    """Tell whether a name is a shipped posture's, or a file is a mechanism by what it says.

    Parameters
    ----------
    name_or_path : str or path

    Examples
    --------
    >>> is_posture("upright"), is_posture("stratos")
    (True, False)
    """
    name = str(name_or_path)
    if name in POSTURES or name in shipped("posture"):
        return True
    try:
        path = Path(name_or_path)
        return path.is_file() and format_of(read_text(path), name).name == "posture"
    except (InputError, OSError, ValueError):
        return False


def named_posture(found: str | Path | Mechanism) -> str | Mechanism:
    """Return a posture as options take it: a shipped name as it is, a file's mechanism, a mechanism as it is.

    Parameters
    ----------
    found : str, path or Mechanism

    Raises
    ------
    InputError
        If there is no such posture and no such file.

    Examples
    --------
    >>> named_posture("leaned")
    'leaned'
    """
    if isinstance(found, Mechanism):
        return found
    name = str(found)
    return name if name in POSTURES or name in shipped("posture") else load_posture(found)


def mechanism_of(options: Options) -> Mechanism:
    """Return the mechanism that options ask for.

    Parameters
    ----------
    options : Options

    Raises
    ------
    InputError
        For an option that the posture does not have, springs or dampers at joints that it does not have.

    Examples
    --------
    >>> from singletrack.posture import Options
    >>> mechanism_of(Options("upright", torso_lean=True, springs={"torso lean": 100.0})).joints[0].stiffness
    100.0
    """
    if isinstance(options.posture, Mechanism):
        mechanism = options.posture
        if options.shoulder is not None or options.arms is not None:
            raise InputError(f"posture {mechanism.name}: is a mechanism; its file says what shoulders and arms do")
        mechanism = with_torso_lean(mechanism) if options.torso_lean else mechanism
    else:
        mechanism = _base(options.posture, options.shoulder, options.arms)
        mechanism = _leaning(options.posture, options.shoulder, options.arms) if options.torso_lean else mechanism
    if options.springs or options.dampers:
        mechanism = sprung(mechanism, options.springs, options.dampers)
    return with_sliders(mechanism) if any(loop.stiffness is not None for loop in mechanism.loops) else mechanism


def _variant_files() -> set[str]:
    return {name for variants in _VARIANTS.values() for name in variants.values()}


@functools.cache
def _read(name: str) -> Mechanism:
    return parse_mechanism(shipped("posture")[name].read_text(encoding="utf-8"), name)


@functools.cache
def file_of_posture(posture: str, shoulder: str | None, arms: str | None) -> str:
    """Return the name of the file in which a shipped posture with these shoulders and arms is described.

    Parameters
    ----------
    posture : str
    shoulder, arms : str, optional
        As in :class:`~singletrack.posture.Options`.

    Raises
    ------
    InputError
        If arms with such shoulders could not follow the handlebar.

    Examples
    --------
    >>> file_of_posture("leaned", None, "bent"), file_of_posture("one-hand", None, None)
    ('leaned-bent-abduction', 'one-hand')
    """
    variants = _VARIANTS.get(posture)
    if variants is None:
        return posture
    for (own_shoulder, own_arms), name in variants.items():
        if shoulder in {None, own_shoulder} and arms in {None, own_arms}:
            return name
    raise InputError(
        f"posture {posture} with shoulder = {shoulder} and arms = {arms}: straight arms that only flex and turn about "
        "themselves cannot follow the handlebar; allowed: arms = bent, or shoulder = abduction"
    )


def _base(posture: str, shoulder: str | None, arms: str | None) -> Mechanism:
    return _read(file_of_posture(posture, shoulder, arms))


@functools.cache
def _leaning(posture: str, shoulder: str | None, arms: str | None) -> Mechanism:
    return with_torso_lean(_base(posture, shoulder, arms))


def with_torso_lean(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism with one more free hinge, along x at the hips, under all that is not a leg.

    Parameters
    ----------
    mechanism : Mechanism

    Examples
    --------
    >>> with_torso_lean(load_posture("rigid")).segments["head"]
    'torso lean'
    """
    if any(joint.name == TORSO_LEAN for joint in mechanism.joints):
        raise InputError(f"posture {mechanism.name}: has a joint {TORSO_LEAN} already; ask for no torso lean beside it")
    lean = JointPlan(TORSO_LEAN, FRAME, Place(13), Direction(vector=(1.0, 0.0, 0.0)), free=True)
    legs = {joint.name for joint in mechanism.joints if joint.parent == FRAME and _carries_legs_only(mechanism, joint)}
    joints = tuple(
        replace(joint, parent=TORSO_LEAN) if joint.parent == FRAME and joint.name not in legs else joint
        for joint in mechanism.joints
    )
    segments = {
        name: TORSO_LEAN if joint == FRAME and "leg" not in name else joint
        for name, joint in mechanism.segments.items()
    }
    return replace(mechanism, joints=(lean, *joints), segments=segments)


def _carries_legs_only(mechanism: Mechanism, root: JointPlan) -> bool:
    beyond = {root.name}
    for joint in mechanism.joints:
        if joint.parent in beyond:
            beyond.add(joint.name)
    carried = [segment for segment, joint in mechanism.segments.items() if joint in beyond]
    return bool(carried) and all("leg" in segment for segment in carried)
