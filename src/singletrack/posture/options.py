"""How the rider sits and what is sprung: everything a model is made with beside bicycle and rider."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from singletrack.arrays import Number, is_concrete, part_of
from singletrack.errors import InputError, unknown_name
from singletrack.library import shipped
from singletrack.posture.mechanism import STIFFEST, Mechanism

__all__ = ["ARMS", "POSTURES", "SHOULDERS", "STEER", "Options", "input_name"]

POSTURES = ("rigid", "leaned", "upright")
SHOULDERS = ("abduction", "axial")
ARMS = ("straight", "bent")
#: What springs and dampers may act on beside joints and hands.
STEER = "steer"


def input_name(joint: str) -> str:
    """Return the name of the torque (or force) that works on a free joint.

    >>> input_name("torso lean"), input_name("right elbow")
    ('torso torque', 'right elbow torque')
    """
    return "torso torque" if joint == "torso lean" else f"{joint} torque"


@dataclass(frozen=True)
class Options:
    """How a rider sits, holds the handlebar and is sprung.

    Attributes
    ----------
    posture : str or Mechanism
        A shipped posture's name, or a mechanism.
    shoulder : {"abduction", "axial"}, optional
        Second axis of the shoulder joint; by default as the posture has it.
    arms : {"straight", "bent"}, optional
        Of the leaned posture.
    torso_lean : bool
        Whether the torso may lean sideways, about a hinge along x at the hips.
    springs, dampers : mapping of str to array
        Stiffness in N m/rad and damping in N m s/rad by joint, or ``steer``; in N/m and N s/m by hand, or ``hands``.
    fit : array, optional
        Elbow angle in rad to which the rider's forward lean is fitted; without, he leans as he does.

    Raises
    ------
    InputError
        For a name that is not known, an option that the posture does not have, a number that is negative, not finite or
        beyond all that is ridden.

    Examples
    --------
    >>> Options("leaned").posture, Options.of("upright").torso_lean
    ('leaned', False)
    """

    posture: str | Mechanism = "rigid"
    shoulder: str | None = None
    arms: str | None = None
    torso_lean: bool = False
    springs: Mapping[str, Number] = field(default_factory=dict)
    dampers: Mapping[str, Number] = field(default_factory=dict)
    fit: Number | None = None

    def __post_init__(self) -> None:
        if isinstance(self.posture, str) and self.posture not in POSTURES and self.posture not in shipped("posture"):
            raise InputError(unknown_name("posture", self.posture, POSTURES))
        for what, found, known in (("shoulder", self.shoulder, SHOULDERS), ("arms", self.arms, ARMS)):
            if found is not None and found not in known:
                raise InputError(unknown_name(what, str(found), known))
        if self.arms is not None and self.posture != "leaned":
            raise InputError(
                f"arms = {self.arms}: only the posture leaned has straight or bent arms, not {self.posture}"
            )
        if not isinstance(self.torso_lean, bool | np.bool_):
            reason = f"torso_lean = {self.torso_lean!r:.80}, must be True or False"
            raise InputError(reason, parameters=("torso_lean",), found=self.torso_lean, allowed="True or False")
        for what, unit, values in (("spring", "N m/rad", self.springs), ("damper", "N m s/rad", self.dampers)):
            if not isinstance(values, Mapping):
                allowed = 'a dictionary by joint, such as {"steer": 3.0}'
                reason = f"{what}s = {values!r:.80}, must be {allowed}"
                raise InputError(reason, parameters=(f"{what}s",), found=values, allowed=allowed)
            for joint, value in values.items():
                _refuse_negative(f"{what} at {joint}", value, unit)
        object.__setattr__(self, "springs", dict(self.springs))
        object.__setattr__(self, "dampers", dict(self.dampers))

    @classmethod
    def of(cls, options: Options | Mechanism | str) -> Self:
        """Return options as they are, or those of a posture alone."""
        return options if isinstance(options, cls) else cls(options)  # type: ignore[arg-type]

    def part(self, which: slice | np.ndarray, shape: tuple[int, ...]) -> Self:
        """Return the options of some designs of a batch, on one axis.

        Parameters
        ----------
        which : slice or array of int
            Indices of designs, as numbered along one axis.
        shape : tuple of int
            Of the batch, to which springs and dampers broadcast.
        """

        def some(value: Number) -> Number:
            return part_of(np.asarray(value) if np.ndim(value) else value, which, shape)

        springs, dampers = (
            {joint: some(value) for joint, value in values.items()} for values in (self.springs, self.dampers)
        )
        return replace(self, springs=springs, dampers=dampers, fit=None if self.fit is None else some(self.fit))

    @property
    def name(self) -> str:
        """The posture's name."""
        return self.posture if isinstance(self.posture, str) else self.posture.name

    @property
    def title(self) -> str:
        """The posture's name with what else is asked for, in words.

        >>> Options("leaned", arms="bent", torso_lean=True, springs={"torso lean": 100.0}).title
        'leaned, arms bent, torso lean, spring at torso lean'
        """
        parts = [self.name]
        parts += [f"shoulder {self.shoulder}"] if self.shoulder else []
        parts += [f"arms {self.arms}"] if self.arms else []
        parts += ["torso lean"] if self.torso_lean else []
        parts += [f"spring at {joint}" for joint in self.springs] + [f"damper at {joint}" for joint in self.dampers]
        parts += ["fitted"] if self.fit is not None else []
        return ", ".join(parts)

    def require_rider(self) -> None:
        """Raise InputError if a rider is needed: there is none."""
        sprung = [name for name in (*self.springs, *self.dampers) if name != STEER]
        for what, wanted, allowed in (
            (f"posture {self.name}", self.posture != "rigid", "rigid"),
            ("torso lean", self.torso_lean, "no torso lean"),
            ("fit", self.fit is not None, "no fit"),
            *((f"a spring or damper at {name}", True, f"one at {STEER}") for name in sprung),
        ):
            if wanted:
                raise InputError(f"{what} needs a rider; allowed without one: {allowed}")


def _refuse_negative(what: str, value: Number, unit: str) -> None:
    if not is_concrete(value):
        return
    numbers = np.asarray(value)
    if numbers.dtype.kind not in "iufc":
        raise InputError(f"{what}: found {value!r}, must be a number in {unit}")
    if not np.isfinite(numbers).all() or (numbers.real < 0).any():
        raise InputError(f"{what}: found {value} {unit}, must be a finite number of zero or more")
    if (np.abs(numbers) > STIFFEST).any():
        most = f"at most {STIFFEST:g} {unit}"
        raise InputError(f"{what}: found {np.abs(numbers).max():g} {unit}, must be {most}", found=value, allowed=most)
