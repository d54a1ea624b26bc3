"""The rider: body lengths, circumferences and masses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, pi
from typing import TYPE_CHECKING, ClassVar

from singletrack.arrays import Number
from singletrack.arrays.faults import Fault
from singletrack.errors import InputError, unknown
from singletrack.parameters.record import Record, parameter
from singletrack.parameters.shapes import SEGMENTS, SegmentShape
from singletrack.parameters.values import real_numbers

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.bicycle import Bicycle

__all__ = ["MASS_FRACTIONS", "Rider"]

_BODY, _MASS = "body", "mass"
_TORSO = ("shoulder_to_shoulder", "upper_arm_circumference", "chest_circumference")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Rider(Record):
    """A rider, SI units, angles in radians; the names are those of Table 3 of Schwab and Kooijman.

    ``forward_lean_angle`` belongs to a rider *on* a bicycle: give it outright, or for bicycles by name in
    ``forward_lean_angles``. Lengths and masses of arms and legs are those of one side. Every parameter may be an array.
    ``shapes`` says how the mass of a segment is spread where that is known better than by cylinders, a sphere and a
    prism of uniform density (such as from Yeadon's 95 measurements).

    Raises
    ------
    InputError
        If a single design has a value that is missing, not finite or not allowed.

    Examples
    --------
    >>> from math import degrees
    >>> from singletrack import load_bicycle, load_rider
    >>> round(degrees(load_rider("rider-a").on(load_bicycle("stratos")).forward_lean_angle), 9)
    63.9
    """

    kind: ClassVar[str] = "rider"
    in_short: ClassVar[tuple[str, ...]] = ("rider_mass", "torso_length", "forward_lean_angle")

    chest_circumference: Number = parameter("m", "cch", "around the chest", group=_BODY)
    forward_lean_angle: Number = parameter(
        "rad", "λfl", "torso from the horizontal, on this bicycle", "angle", group=_BODY, optional=True
    )
    elbow_drop_angle: Number = parameter(
        "rad", "λed", "elbows turned out less far than hanging down (90 deg)", "angle", group=_BODY, optional=True
    )
    head_circumference: Number = parameter("m", "ch", "around the head", group=_BODY)
    hip_joint_to_hip_joint: Number = parameter("m", "lhh", "between the hip joints", group=_BODY)
    lower_arm_circumference: Number = parameter("m", "cla", "around the lower arm", group=_BODY)
    lower_arm_length: Number = parameter("m", "lla", "elbow to grip", group=_BODY)
    lower_leg_circumference: Number = parameter("m", "cll", "around the lower leg", group=_BODY)
    lower_leg_length: Number = parameter("m", "lll", "knee to pedal", group=_BODY)
    shoulder_to_shoulder: Number = parameter("m", "lss", "between the shoulder joints", group=_BODY)
    torso_length: Number = parameter("m", "lto", "hip joints to shoulder joints", group=_BODY)
    torso_thickness: Number = parameter(
        "m", "tto", "front to back; else from the chest's circumference", group=_BODY, optional=True
    )
    torso_width: Number = parameter(
        "m", "wto", "side to side; else between the insides of the upper arms", group=_BODY, optional=True
    )
    upper_arm_circumference: Number = parameter("m", "cua", "around the upper arm", group=_BODY)
    upper_arm_length: Number = parameter("m", "lua", "shoulder to elbow", group=_BODY)
    upper_leg_circumference: Number = parameter("m", "cul", "around the upper leg", group=_BODY)
    upper_leg_length: Number = parameter("m", "lul", "hip to knee", group=_BODY)

    rider_mass: Number = parameter("kg", "mBr", "whole rider", group=_MASS)
    head_mass_fraction: Number = parameter("", "mh/mBr", "head", "fraction", group=_MASS, most=0.5)
    lower_arm_mass_fraction: Number = parameter("", "mla/mBr", "one lower arm", "fraction", group=_MASS)
    lower_leg_mass_fraction: Number = parameter("", "mll/mBr", "one lower leg", "fraction", group=_MASS)
    torso_mass_fraction: Number = parameter("", "mto/mBr", "torso", "fraction", group=_MASS)
    upper_arm_mass_fraction: Number = parameter("", "mua/mBr", "one upper arm", "fraction", group=_MASS)
    upper_leg_mass_fraction: Number = parameter("", "mul/mBr", "one upper leg", "fraction", group=_MASS)

    forward_lean_angles: Mapping[str, Number] = field(default_factory=dict)
    shapes: Mapping[str, SegmentShape] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, shape in self.shapes.items():
            if name not in SEGMENTS:
                raise unknown("segment", str(name), SEGMENTS, place="shapes")
            if not isinstance(shape, SegmentShape):
                reason = f"shapes[{name!r}] = {shape!r:.80}, must be a SegmentShape"
                raise InputError(reason, parameters=(name,), found=shape, allowed="a SegmentShape", place=self.name)

    def on(self, bicycle: Bicycle) -> Rider:
        """Return this rider with the forward lean angle on a bicycle.

        Raises
        ------
        InputError
            If the rider has neither a ``forward_lean_angle`` nor one for a bicycle of that name.
        """
        if getattr(bicycle, "kind", "") != "bicycle":
            hint = f'; type load_bicycle("{bicycle}")' if isinstance(bicycle, str) else ""
            reason = f"bicycle is a {type(bicycle).__name__}, must be a Bicycle{hint}"
            raise InputError(reason, parameters=("bicycle",), found=bicycle, allowed="a Bicycle")
        if self.forward_lean_angle is not None:
            return self
        if bicycle.name not in self.forward_lean_angles:
            known = ", ".join(self.forward_lean_angles) or "none"
            raise InputError(
                f"{self.name or 'rider'}: forward_lean_angle on bicycle {bicycle.name or '(no name)'!r} is not known "
                f"(known on: {known}); it must be given, between 0 and 90 deg: as forward_lean_angle in the rider's "
                'file, or on the command line with --set "forward_lean_angle=70 deg"',
                parameters=("forward_lean_angle",),
                allowed="between 0 and 90 deg",
            )
        deviations = dict(self.standard_deviations)
        own = deviations.get(f"forward_lean_angle on {bicycle.name}")
        if own is not None:
            deviations["forward_lean_angle"] = own
        angle = self.forward_lean_angles[bicycle.name]
        return self.replace(forward_lean_angle=angle, standard_deviations=deviations)

    @property
    def torso_section(self) -> tuple[Number, Number]:
        """Width (along y) and thickness of the torso in m, shape (...) each.

        As given; else the width is that between the insides of the upper arms, and a stadium of that width and the
        thickness has the chest's circumference (a given width leaves the thickness as derived).
        """
        width = self.shoulder_to_shoulder - self.upper_arm_circumference / pi
        thickness = (self.chest_circumference - 2 * width) / (pi - 2)
        return (
            width if self.torso_width is None else self.torso_width,
            thickness if self.torso_thickness is None else self.torso_thickness,
        )

    def _physical_faults(self) -> Iterator[Fault]:
        inputs = real_numbers(*(getattr(self, name) for name in _TORSO))
        if inputs is None:
            return
        if self.torso_width is not None and self.torso_thickness is not None:
            return
        shoulders, arm, chest = inputs
        # Only operators from here, which work on floats and arrays alike; comparisons with NaN are false.
        width = shoulders - arm / pi
        usable = (width > -inf) & (width < inf) & (chest > -inf) & (chest < inf)
        narrow, tight = usable & (width <= 0), usable & (width > 0) & (chest <= 2 * width)
        if self.torso_thickness is not None:
            tight &= False
        if narrow is False and tight is False:
            return
        found = {"width": width, "twice": 2 * width} | dict(zip(_TORSO, inputs, strict=True))
        yield Fault(
            narrow,
            "shoulder_to_shoulder = {shoulder_to_shoulder:.6g} m leaves no torso between upper arms of "
            "upper_arm_circumference = {upper_arm_circumference:.6g} m, must be more than upper_arm_circumference / pi",
            found,
            InputError,
            _TORSO[:2],
            "more than upper_arm_circumference / pi",
        )
        yield Fault(
            tight,
            "chest_circumference = {chest_circumference:.6g} m does not go around a torso {width:.6g} m wide "
            "(shoulder_to_shoulder - upper_arm_circumference / pi), must be more than {twice:.6g} m",
            found,
            InputError,
            ("chest_circumference", *_TORSO[:2]),
            "more than twice the width of the torso",
        )


#: Names of the mass fractions with the number of such segments; the fractions of all segments sum to 1.
MASS_FRACTIONS = {
    "head_mass_fraction": 1,
    "lower_arm_mass_fraction": 2,
    "lower_leg_mass_fraction": 2,
    "torso_mass_fraction": 1,
    "upper_arm_mass_fraction": 2,
    "upper_leg_mass_fraction": 2,
}
