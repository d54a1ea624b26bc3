"""The bicycle: the 25 parameters of the linear model and the frame geometry that seats a rider."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from singletrack.arrays import Number
from singletrack.parameters.hinge_rules import hinge_faults
from singletrack.parameters.inertia_rules import FLATNESS_TOLERANCE, inertia_faults, skate_faults, tyre_faults
from singletrack.parameters.record import Record, parameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.arrays.faults import Fault

__all__ = ["FLATNESS_TOLERANCE", "FRAME_GEOMETRY", "Bicycle"]

_GENERAL, _REAR_WHEEL, _REAR_FRAME = "bicycle", "rear wheel", "rear frame (body and frame assembly)"
_FRONT_FRAME, _FRONT_WHEEL = "front frame (handlebar and fork assembly)", "front wheel"
_GRIPS = "grips (where they are not level with the stem top, as wide as the shoulders)"
_TYRES = "tyres (knife edges where no radius is given)"
_SOFT = "soft frame and fork (rigid without stiffness; hinges by default at the fork's crown)"
_GEOMETRY = "frame geometry (needed to seat a rider)"


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Bicycle(Record):
    """A bicycle, SI units, angles in radians, in the frame of Meijaard et al. (2007).

    Origin at the rear wheel contact, x forward, y right, z down; inertias about each body's own centre of mass.
    The names are those of Tables 1 and 2 of Schwab and Kooijman. Every parameter may be an array.

    Raises
    ------
    InputError
        If a single design has a value that is missing, not finite or not allowed, or an inertia no body can have.
        A batch keeps its faulty designs and lists them in ``faults``.

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> bicycle = load_bicycle("benchmark")
    >>> bicycle.trail, bicycle.replace(trail=0.05).trail
    (0.08, 0.05)
    """

    kind: ClassVar[str] = "bicycle"
    in_short: ClassVar[tuple[str, ...]] = ("wheel_base", "trail", "steer_axis_tilt")

    wheel_base: Number = parameter("m", "w", "between the wheel contacts", group=_GENERAL)
    trail: Number = parameter("m", "c", "front contact behind the steer axis at the ground", "any", group=_GENERAL)
    steer_axis_tilt: Number = parameter("rad", "λ", "steer axis from the vertical, top back", "tilt", group=_GENERAL)
    gravity: Number = parameter("m/s**2", "g", "strength of gravity", group=_GENERAL)

    rear_wheel_radius: Number = parameter("m", "rR", "ground to hub", "not negative", group=_REAR_WHEEL)
    rear_wheel_mass: Number = parameter("kg", "mR", "mass", "not negative", group=_REAR_WHEEL)
    rear_wheel_inertia_xx: Number = parameter("kg*m**2", "IRxx", "about a diameter", "not negative", group=_REAR_WHEEL)
    rear_wheel_inertia_yy: Number = parameter("kg*m**2", "IRyy", "about the axle", "not negative", group=_REAR_WHEEL)

    rear_frame_x: Number = parameter("m", "xB", "centre of mass, forward", "any", group=_REAR_FRAME)
    rear_frame_z: Number = parameter("m", "zB", "centre of mass, down", "above ground", group=_REAR_FRAME)
    rear_frame_mass: Number = parameter("kg", "mB", "mass", group=_REAR_FRAME)
    rear_frame_inertia_xx: Number = parameter("kg*m**2", "IBxx", "about x", "not negative", group=_REAR_FRAME)
    rear_frame_inertia_yy: Number = parameter("kg*m**2", "IByy", "about y", "not negative", group=_REAR_FRAME)
    rear_frame_inertia_zz: Number = parameter("kg*m**2", "IBzz", "about z", "not negative", group=_REAR_FRAME)
    rear_frame_inertia_xz: Number = parameter("kg*m**2", "IBxz", "tensor entry (x, z)", "any", group=_REAR_FRAME)

    front_frame_x: Number = parameter("m", "xH", "centre of mass, forward", "any", group=_FRONT_FRAME)
    front_frame_z: Number = parameter("m", "zH", "centre of mass, down", "above ground", group=_FRONT_FRAME)
    front_frame_mass: Number = parameter("kg", "mH", "mass", group=_FRONT_FRAME)
    front_frame_inertia_xx: Number = parameter("kg*m**2", "IHxx", "about x", "not negative", group=_FRONT_FRAME)
    front_frame_inertia_yy: Number = parameter("kg*m**2", "IHyy", "about y", "not negative", group=_FRONT_FRAME)
    front_frame_inertia_zz: Number = parameter("kg*m**2", "IHzz", "about z", "not negative", group=_FRONT_FRAME)
    front_frame_inertia_xz: Number = parameter("kg*m**2", "IHxz", "tensor entry (x, z)", "any", group=_FRONT_FRAME)

    front_wheel_radius: Number = parameter("m", "rF", "ground to hub", "not negative", group=_FRONT_WHEEL)
    front_wheel_mass: Number = parameter("kg", "mF", "mass", "not negative", group=_FRONT_WHEEL)
    front_wheel_inertia_xx: Number = parameter(
        "kg*m**2", "IFxx", "about a diameter", "not negative", group=_FRONT_WHEEL
    )
    front_wheel_inertia_yy: Number = parameter("kg*m**2", "IFyy", "about the axle", "not negative", group=_FRONT_WHEEL)

    bottom_bracket_height: Number = parameter("m", "hbb", "ground to crank axle", group=_GEOMETRY, optional=True)
    chain_stay_length: Number = parameter("m", "lcs", "rear hub to crank axle", group=_GEOMETRY, optional=True)
    fork_length: Number = parameter("m", "lf", "front hub to the fork crown", group=_GEOMETRY, optional=True)
    front_hub_width: Number = parameter("m", "wfh", "between the drop-outs", group=_GEOMETRY, optional=True)
    handlebar_length: Number = parameter(
        "m", "lhb", "grips behind the stem (negative: in front)", "any", group=_GEOMETRY, optional=True
    )
    rear_hub_width: Number = parameter("m", "wrh", "between the drop-outs", group=_GEOMETRY, optional=True)
    seat_post_length: Number = parameter("m", "lsp", "seat tube top to saddle", group=_GEOMETRY, optional=True)
    seat_tube_angle: Number = parameter("rad", "λst", "from the ground", "angle", group=_GEOMETRY, optional=True)
    seat_tube_length: Number = parameter("m", "lst", "crank axle to seat tube top", group=_GEOMETRY, optional=True)
    stem_length: Number = parameter("m", "ls", "along the steer axis", group=_GEOMETRY, optional=True)

    rear_tyre_radius: Number = parameter(
        "m", "cR", "of the rear tyre's cross-section; else a knife edge", "not negative", group=_TYRES, optional=True
    )
    front_tyre_radius: Number = parameter(
        "m", "cF", "of the front tyre's cross-section; else a knife edge", "not negative", group=_TYRES, optional=True
    )

    frame_torsion_stiffness: Number = parameter(
        "N*m/rad", "kft", "of the rear frame's twist about its hinge", "positive", group=_SOFT, optional=True
    )
    frame_torsion_damping: Number = parameter(
        "N*m*s/rad", "cft", "of that twist; else none", "not negative", group=_SOFT, optional=True
    )
    frame_hinge_x: Number = parameter("m", "xft", "point of the hinge, forward", "any", group=_SOFT, optional=True)
    frame_hinge_z: Number = parameter("m", "zft", "point of the hinge, down", "any", group=_SOFT, optional=True)
    frame_hinge_tilt: Number = parameter(
        "rad", "λft", "of the hinge, front end up; else that of the steer axis", "tilt", group=_SOFT, optional=True
    )
    fork_bending_stiffness: Number = parameter(
        "N*m/rad", "kfb", "of the front wheel's tilt in the fork", "positive", group=_SOFT, optional=True
    )
    fork_bending_damping: Number = parameter(
        "N*m*s/rad", "cfb", "of that tilt; else none", "not negative", group=_SOFT, optional=True
    )
    fork_hinge_x: Number = parameter("m", "xfb", "point of the hinge, forward", "any", group=_SOFT, optional=True)
    fork_hinge_z: Number = parameter("m", "zfb", "point of the hinge, down", "any", group=_SOFT, optional=True)
    fork_hinge_tilt: Number = parameter(
        "rad", "λfb", "of the hinge, front end up; else that of the steer axis", "tilt", group=_SOFT, optional=True
    )

    handlebar_width: Number = parameter(
        "m", "whb", "between the grips; else that of the rider's shoulders", group=_GRIPS, optional=True
    )
    handlebar_drop: Number = parameter(
        "m", "hhb", "grips below the stem top (negative: above); else none", "any", group=_GRIPS, optional=True
    )

    def missing_geometry(self) -> list[str]:
        """Return the names of the lengths and angles that are needed to seat a rider and are not given."""
        return [name for name in FRAME_GEOMETRY if getattr(self, name) is None]

    def _physical_faults(self) -> Iterator[Fault]:
        yield from hinge_faults(self)
        for body in ("rear_frame", "front_frame"):
            entries = [getattr(self, f"{body}_inertia_{axes}") for axes in ("xx", "yy", "zz", "xz")]
            yield from inertia_faults(body, ("xx", "yy", "zz", "xz"), *entries)
        for body in ("rear_wheel", "front_wheel"):
            xx, yy = (getattr(self, f"{body}_inertia_{axes}") for axes in ("xx", "yy"))
            yield from inertia_faults(body, ("xx", "yy"), xx, yy, xx, 0.0)
            yield from tyre_faults(
                body, getattr(self, f"{body}_radius"), getattr(self, body.replace("wheel", "tyre_radius"))
            )
            yield from skate_faults(body, getattr(self, f"{body}_radius"), getattr(self, f"{body}_mass"), xx, yy)


FRAME_GEOMETRY = tuple(name for name, p in Bicycle.descriptions().items() if p.group == _GEOMETRY)
