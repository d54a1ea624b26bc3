"""Yeadon's rider: 95 measurements as segments of ours (Yeadon 1990, Journal of Biomechanics 23:67-74).

The optional package ``yeadon`` turns perimeters, widths and lengths into some forty solids. Here they become the six
kinds of segment a seated rider has, each with its own mass, centre and radii of gyration, so that the rider can take
every posture, rather than be one lump.
"""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from singletrack.errors import InputError
from singletrack.files.format import Format
from singletrack.files.yaml_text import numbers, read_mapping
from singletrack.files.yeadon_body import make_human, segment_bodies, shape_of
from singletrack.parameters.rider import MASS_FRACTIONS, Rider

if TYPE_CHECKING:
    from singletrack.files.named_values import NamedValues

__all__ = ["CONFIGURATION", "FORMAT", "MEASUREMENTS", "read_configuration", "read_yeadon"]


def _names(limb: str, lengths: str, perimeters: str, widths: str, depths: str = "") -> list[str]:
    kinds = {"L": lengths, "p": perimeters, "w": widths, "d": depths}
    return [f"L{limb}{digit}{kind}" for kind, digits in kinds.items() for digit in digits]


#: The 95 measurements.
MEASUREMENTS = (
    *_names("s", "12345678", "0123567", "01234", "4"),
    *(name for limb in "ab" for name in _names(limb, "234567", "01234567", "4567")),
    *(name for limb in "jk" for name in _names(limb, "1345689", "123456789", "89", "6")),
)
_ALSO = ("measurementconversionfactor", "totalmass")
# Lengths measured from the same joint, outwards.
_CHAINS = (
    *(("Ls1L", "Ls2L", "Ls3L", "Ls4L", "Ls5L"), ("Ls6L", "Ls7L", "Ls8L")),
    *(tuple(f"L{limb}{i}L" for i in levels) for limb in "ab" for levels in ("234", "567")),
    *(tuple(f"L{limb}{i}L" for i in levels) for limb in "jk" for levels in ("1345", "689")),
)
#: Angles of Yeadon's configuration that would bend or turn the trunk, which is straight and symmetric here.
_STRAIGHT = (
    *("tilt", "twist", "PTsagittalFlexion", "PTbending", "TCspinalTorsion", "TCsagittalSpinalFlexion"),
    *("PTfrontalFlexion", "TClateralSpinalFlexion"),
)
#: Angles of the limbs, which follow here from hands on the grips and feet on the pedals.
_LIMBS = (
    *("CA1extension", "CA1adduction", "CA1rotation", "CB1extension", "CB1abduction", "CB1rotation"),
    *("A1A2extension", "B1B2extension", "PJ1extension", "PJ1adduction", "PK1extension", "PK1abduction"),
    *("J1J2flexion", "K1K2flexion"),
)


def read_configuration(text: str, where: str) -> float:
    """Return the forward lean angle in rad that a configuration of Yeadon's human means: 90 deg less ``somersault``.

    Parameters
    ----------
    text : str
    where : str
        The file's name, for messages.

    Raises
    ------
    InputError
        For a trunk that is bent, tilted or twisted, or a lean that is not between 0 and 90 deg.
    """
    given = numbers(read_mapping(text, where), where)
    given.require_known(["somersault", *_STRAIGHT, *_LIMBS], "angle")
    given.require(["somersault"], "the configuration")
    for name, value in given.values().items():
        if name in _STRAIGHT and value != 0:
            raise InputError(
                f"{given.place(name)}: {name} = {value:g} rad, must be 0: a rider's trunk is straight here"
            )
    lean = math.pi / 2 - given.quantities["somersault"].value
    if not 0 < lean < math.pi / 2:
        raise InputError(
            f"{given.place('somersault')}: somersault = {math.pi / 2 - lean:g} rad, must be between 0 and pi/2 "
            "(the trunk leans forward by it from upright)"
        )
    return lean


def read_yeadon(text: str, where: str, forward_lean_angle: float | None = None) -> Rider:
    """Return the rider that Yeadon's 95 measurements describe, with a shape for every segment.

    Parameters
    ----------
    text : str
        Lines ``Ls1L: 17.6``, with ``measurementconversionfactor`` to metres and, optionally, ``totalmass`` in kg.
    where : str
        The file's name, for messages.
    forward_lean_angle : float, optional
        On the bicycle, in rad (:func:`read_configuration`).

    Raises
    ------
    InputError
        Names file, line, measurement, what was found and what is allowed; or says how to install ``yeadon``.
    """
    given = numbers(read_mapping(text, where), where, _short_name(where))
    metres, mass = _checked(given)
    human = make_human(metres, mass, where)
    segments = segment_bodies(human)
    lengths = _lengths(human.meas)
    total = sum(MASS_FRACTIONS[f"{name}_mass_fraction"] * body[0] for name, body in segments.items())
    values: dict[str, Any] = {**lengths, **_outlines(human.meas)}
    fractions: dict[str, Any] = {f"{name}_mass_fraction": float(body[0] / total) for name, body in segments.items()}
    spans = {name: lengths.get(f"{name}_length", values["head_circumference"] / (2 * math.pi)) for name in segments}

    def make() -> Rider:
        return Rider(
            name=given.name,
            description="From Yeadon's 95 measurements",
            source=f"measurements {Path(where).name}, solids of the yeadon package",
            rider_mass=float(total),
            forward_lean_angle=cast("float", forward_lean_angle),  # None: as for a rider of our own files
            shapes={name: shape_of(body, spans[name]) for name, body in segments.items()},
            **values,
            **fractions,
        )

    return given.build(make, {"shoulder_to_shoulder": "Ls4w", "chest_circumference": "Ls3p"})


def _short_name(where: str) -> str:
    return Path(where).stem.removesuffix("Meas").removesuffix("Yeadon").lower() or Path(where).stem


def _checked(given: NamedValues) -> tuple[dict[str, float], float | None]:
    """Return the measurements in m and the total mass."""
    given.require_known([*MEASUREMENTS, *_ALSO], "measurement")
    given.require([*MEASUREMENTS, "measurementconversionfactor"], "the measurements")
    values = given.values()
    for name, value in values.items():
        if value <= 0:
            raise InputError(f"{given.place(name)}: {name} = {value:g}, must be greater than zero")
    factor = values["measurementconversionfactor"]
    for name in MEASUREMENTS:
        metres = values[name] * factor
        if not 1e-3 < metres < 3:
            raise InputError(
                f"{given.place(name)}: {name} = {values[name]:g} is {metres:g} m with "
                f"measurementconversionfactor {factor:g}, must be between 0.001 and 3 m"
            )
    for chain in _CHAINS:
        for inner, outer in itertools.pairwise(chain):
            if values[outer] <= values[inner]:
                raise InputError(
                    f"{given.place(outer)}: {outer} = {values[outer]:g}, must be more than "
                    f"{inner} = {values[inner]:g}, which is nearer to the joint both are measured from"
                )
    mass = values.get("totalmass")
    if mass is not None and not 1 < mass < 1000:
        raise InputError(f"{given.place('totalmass')}: totalmass = {mass:g} kg, must be between 1 and 1000 kg")
    return {name: values[name] * factor for name in MEASUREMENTS}, mass


def _lengths(m: dict[str, float]) -> dict[str, float]:
    """Return joint-to-joint lengths in m: the base of the thumb is at the grip, the heel on the pedal."""
    return {
        "torso_length": float(m["Ls4L"]),
        "upper_arm_length": float(m["La2L"]),
        "lower_arm_length": float(m["La4L"] - m["La2L"] + m["La5L"]),
        "upper_leg_length": float(m["Lj3L"]),
        "lower_leg_length": float(m["Lj5L"] - m["Lj3L"] + m["Lj6L"]),
        "shoulder_to_shoulder": float(m["Ls4w"]),
        "hip_joint_to_hip_joint": float(m["Ls0w"] / 2),
    }


def _outlines(m: dict[str, float]) -> dict[str, float]:
    """Return circumferences in m, for drawing (the shapes carry the inertia): those measured at the middle."""
    return {
        "chest_circumference": float(m["Ls3p"]),
        "head_circumference": float(m["Ls7p"]),
        "upper_arm_circumference": float(m["La1p"]),
        "lower_arm_circumference": float(m["La3p"]),
        "upper_leg_circumference": float(m["Lj2p"]),
        "lower_leg_circumference": float(m["Lj4p"]),
    }


FORMAT = Format(
    name="yeadon",
    description="Yeadon's 95 measurements",
    recognises=lambda clues: "measurementconversionfactor" in clues.values or {"Ls1L", "La2L"} <= set(clues.values),
    read_rider=read_yeadon,
)
CONFIGURATION = Format(
    name="configuration",
    description="a configuration of Yeadon's human",
    recognises=lambda clues: "somersault" in clues.values,
    used_by="`singletrack convert MEASUREMENTS OUTPUT --configuration FILE` takes it",
)
