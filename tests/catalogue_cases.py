"""Bicycles that were measured, told to the catalogue as a sheet: geometry, masses and what they are fitted with."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from singletrack import coefficients, load_bicycle
from singletrack.body.skeleton import frame_points
from singletrack.catalogue import Estimate, estimate
from singletrack.files.measured import read_measured
from singletrack.parameters import Bicycle, Rider

SHARED = Path(__file__).parents[2] / "shared/data/bicycleparameters/bicycles"
OWN = Path(__file__).parent / "catalogue" / "measured"

#: What the sheet hides.
HIDDEN = tuple(
    f"{end}_{body}_{part}"
    for end in ("rear", "front")
    for body, parts in (
        ("frame", ("x", "z", *(f"inertia_{a}" for a in ("xx", "yy", "zz", "xz")))),
        ("wheel", ("inertia_xx", "inertia_yy")),
    )
    for part in parts
)
_TOLD = (
    *("wheel_base", "trail", "steer_axis_tilt", "gravity", "rear_wheel_radius", "front_wheel_radius"),
    *("rear_frame_mass", "front_frame_mass", "rear_wheel_mass", "front_wheel_mass"),
    *("bottom_bracket_height", "chain_stay_length", "fork_length", "seat_tube_angle", "seat_tube_length"),
)
_CITY = (
    "carrier",
    "rear mudguard",
    "front mudguard",
    "kickstand",
    "ring lock",
    "rear lamp",
    "front lamp",
    "basket",
    "chain case",
)


def load(
    name: str, mass: str, x: str, z: str, size: tuple[float, float, float], on: str = "rear frame"
) -> dict[str, Any]:
    length, width, height = size
    return {"name": name, "mass": mass, "x": x, "z": z, "on": on, "length": length, "width": width, "height": height}


def wide(grips: float) -> str:
    """Return a handlebar's width: the source has the distance between the grips, that of the hands (Moore 2012)."""
    return f"{grips + 0.05} +/- 0.04 m"


#: The Davis instrumented bicycle: direct-drive hub motor, battery of 2.8 kg, netbook on the carrier, 23 mm tyres,
#: rider's harness on an arm with a chest beam, plates for the knees on the top tube, torque sensor on the steer axis
#: (Moore 2012, chapter 9). Where masses and places are not told there, they are as wide as that leaves them.
_RIGID = {
    "bar": "city",
    "bar_width": wide(0.535),
    "wheel_size": "23-622",
    "with_parts": ["rear motor", "diamond", "carrier"],
    "without_parts": [*(part for part in _CITY if part != "carrier"), "suspension fork"],
    "loads": [
        load("battery", "2.8 +/- 0.1 kg", "0.2 +/- 0.2 m", "-0.75 +/- 0.15 m", (0.3, 0.15, 0.1)),
        load("netbook", "1.2 +/- 0.3 kg", "-0.05 +/- 0.07 m", "-0.80 +/- 0.05 m", (0.25, 0.18, 0.04)),
        load("harness", "5 +/- 2.5 kg", "0.3 +/- 0.15 m", "-1.15 +/- 0.15 m", (0.3, 0.35, 0.5)),
        load("electronics", "3 +/- 1.5 kg", "0.3 +/- 0.2 m", "-0.80 +/- 0.15 m", (0.3, 0.2, 0.15)),
        load("knee plates", "1 +/- 0.5 kg", "0.45 +/- 0.1 m", "-0.80 +/- 0.07 m", (0.15, 0.25, 0.15)),
        load(
            "torque sensor", "1.5 +/- 0.7 kg", "0.80 +/- 0.04 m", "-1.05 +/- 0.07 m", (0.06, 0.06, 0.2), "front frame"
        ),
    ],
}
#: Without pedals and cranks; computer, camcorder, battery on the carrier, trainer wheels aside (Kooijman et al. 2008).
_KOOIJMAN = {
    "without_parts": ["pedals", "cranks"],
    "loads": [
        load("computer", "4 +/- 2 kg", "-0.05 +/- 0.15 m", "-0.85 +/- 0.1 m", (0.35, 0.2, 0.15)),
        load("trainer wheels", "3 +/- 1.5 kg", "0.35 +/- 0.2 m", "-0.35 +/- 0.15 m", (0.2, 1.2, 0.2)),
    ],
}


#: Gazelle Grenoble, step-through, made a prototype with a motor in the head tube (2024): motor at the crank, battery in
#: the down tube. Geometry with the deviations that were measured; places of the rest as wide as that leaves them.
_GAZELLE = {
    "chain_stay_length": "0.48 +/- 0.005 m",
    "bottom_bracket_height": "0.30 +/- 0.005 m",
    "seat_tube_length": "0.54 +/- 0.005 m",
    "saddle_height": "0.81 +/- 0.007 m",
    "seat_tube_angle": "1.2165 +/- 0.01 rad",
    "bar": "city",
    "bar_width": wide(0.53),
    # 0.93 m from the front hub, 1.11 m from the rear hub.
    "grip_x": 0.719,
    "grip_height": 1.195,
    "with_parts": ["low step", *(part for part in _CITY if part not in {"basket", "chain case"})],
    "without_parts": ["basket", "rear motor", "front motor"],
    "loads": [
        load("motor", "3.2 +/- 0.3 kg", "0.45 +/- 0.03 m", "-0.31 +/- 0.03 m", (0.2, 0.2, 0.2)),
        load("battery", "2.9 +/- 0.4 kg", "0.67 +/- 0.06 m", "-0.50 +/- 0.06 m", (0.3, 0.08, 0.3)),
        load("steer motor", "2.5 +/- 1.2 kg", "0.85 +/- 0.06 m", "-0.85 +/- 0.1 m", (0.15, 0.12, 0.2)),
        load("electronics", "3 +/- 1.5 kg", "0.2 +/- 0.3 m", "-0.75 +/- 0.15 m", (0.3, 0.2, 0.2)),
    ],
}


@dataclass(frozen=True)
class Case:
    name: str
    measured: Bicycle
    sheet: dict[str, Any]
    #: Parameters that are not those of a bicycle.
    left_out: tuple[str, ...] = ()
    estimated: Estimate = field(init=False)

    def __post_init__(self):
        object.__setattr__(self, "estimated", estimate(**{**told(self.measured), **self.sheet}))

    def scores(self) -> dict[str, float]:
        """Return how many of its stated standard deviations each estimate is off."""
        own = self.estimated.bicycle
        return {
            name: (getattr(self.measured, name) - getattr(own, name)) / own.standard_deviations[name]
            for name in HIDDEN
            if name not in self.left_out
        }


def told(bicycle: Bicycle) -> dict[str, Any]:
    """Return a bicycle's geometry and masses as a sheet; the grips as measured."""
    sheet = {name: getattr(bicycle, name) for name in _TOLD if getattr(bicycle, name) is not None}
    sheet["name"] = bicycle.name
    if bicycle.seat_post_length is not None:
        sheet["saddle_height"] = bicycle.seat_tube_length + bicycle.seat_post_length
    if bicycle.handlebar_length is not None:
        # The grips do not depend on these.
        usual = {"fork_length": 0.44, "front_hub_width": 0.1, "rear_hub_width": 0.13}
        grip = frame_points(bicycle.replace(**{n: w for n, w in usual.items() if getattr(bicycle, n) is None}))[19]
        sheet |= {"grip_x": float(grip[0]), "grip_height": -float(grip[2])}
    return sheet


def case(name: str) -> Case:
    if name in {"stratos", "browser"}:
        bar = {"stratos": "flat", "browser": "city"}[name]
        return Case(name, load_bicycle(name), {"bar": bar, "bar_width": wide(0.58)})
    if name == "benchmark":
        # Made up, with its rider lumped into the rear frame: that is not a bicycle's frame to estimate.
        bicycle = load_bicycle(name)
        frame = tuple(parameter for parameter in HIDDEN if parameter.startswith("rear_frame"))
        return Case(name, bicycle, {"rear_frame_mass": None}, frame)
    if name == "kooijman-2008":
        return Case(name, load_bicycle(name), _KOOIJMAN)
    if name == "gazelle":
        bicycle = load_bicycle(str(OWN / "GazelleBenchmark.txt"))
        uncertain = {"trail": "m", "steer_axis_tilt": "rad", "wheel_base": "m"}
        deviations = bicycle.standard_deviations
        geometry = {n: f"{getattr(bicycle, n)} +/- {deviations[n]} {unit}" for n, unit in uncertain.items()}
        return Case(name, bicycle, geometry | _GAZELLE)
    folder = SHARED if name == "rigid" else OWN
    path = folder / f"{name.capitalize()}Measured.txt"
    sheets = {
        "rigid": _RIGID,
        "crescendo": {"bar": "city", "bar_width": wide(0.56), "with_parts": ["suspension fork"]},
        "fisher": {
            "bar": "flat",
            "wheel_size": "54-559",
            "with_parts": ["diamond", "suspension fork"],
            "without_parts": list(_CITY),
        },
        "pista": {
            "bar": "drop",
            "wheel_size": "23-622",
            "with_parts": ["diamond", "bare chain", "single hub"],
            "without_parts": [*_CITY, "suspension fork"],
        },
        "yellow": {
            "with_parts": ["diamond", "bare chain"],
            "without_parts": [*_CITY, "suspension fork", "cranks", "pedals", "chain", "bottom bracket bearing"],
        },
    }
    return Case(name, read_measured(path.read_text(encoding="utf-8"), str(path)).bicycle, sheets[name])


#: Half of what is between the drop-outs, in m; least width (m) and mass (kg) of a handlebar; half of a saddle.
_HALF_HUB = {"front": 0.05, "rear": 0.0675}
_BAR, _SADDLE = (0.4, 0.25), 0.08


def impossible(made: Case) -> set[str]:
    """Return parameters that no distribution of mass can have, as (Ixx + Izz - Iyy) / 2 = sum m y^2.

    A wheel's mass is between the drop-outs; a front frame has a handlebar, and its grips where they were measured; a
    frame without cranks and pedals is as wide as its saddle.
    """
    b, found = made.measured, set()
    for end, half in _HALF_HUB.items():
        mass, across, about = (getattr(b, f"{end}_wheel_{part}") for part in ("mass", "inertia_xx", "inertia_yy"))
        if across - about / 2 > mass * half**2:
            found.add(f"{end}_wheel_inertia_xx")
        xx, yy, zz = (getattr(b, f"{end}_frame_inertia_{part}") for part in ("xx", "yy", "zz"))
        y2, x2 = (xx + zz - yy) / 2, (yy + zz - xx) / 2
        moments = {f"{end}_frame_inertia_{part}" for part in ("xx", "yy", "zz")}
        if end == "front":
            found |= moments if y2 < _BAR[1] * _BAR[0] ** 2 / 12 else set()
            arm = made.sheet.get("grip_x", told(b).get("grip_x"))
            if arm is not None and x2 < 0.2 * (arm - b.front_frame_x) ** 2:
                found |= {*moments, "front_frame_inertia_xz"}
        elif "pedals" in made.sheet.get("without_parts", ()) and not made.sheet.get("loads"):
            found |= moments if y2 > b.rear_frame_mass * _SADDLE**2 else set()
    return found


def weave_speeds(made: Case, rider: Rider | None) -> tuple[float, float, float]:
    """Return the weave speed as measured, as estimated, and its standard deviation over the sample."""
    own = made.estimated
    missing = made.measured.missing_geometry()
    measured = made.measured.replace(**{name: getattr(own.bicycle, name) for name in missing})

    def first(bicycle: Bicycle) -> Any:
        bicycle = bicycle.replace(handlebar_width=None)
        model = coefficients(bicycle) if rider is None else coefficients(bicycle, rider, posture="rigid")
        return model.critical_speeds().weave

    sample = [speeds[0] if len(speeds) else np.nan for speeds in first(own.sample)]
    return float(first(measured)[0]), float(first(own.bicycle)[0]), float(np.nanstd(sample))


def table(cases: list[Case]) -> str:
    """Return the table of the docs: estimated with deviation, measured, for each."""
    lines = ["| parameter | " + " | ".join(made.name for made in cases) + " |", "|---" * (len(cases) + 1) + "|"]
    for name in HIDDEN:
        cells = []
        for made in cases:
            own = made.estimated.bicycle
            score = made.scores().get(name)
            text = f"{getattr(own, name):.3f} ± {own.standard_deviations[name]:.3f}, {getattr(made.measured, name):.3f}"
            cells.append("" if score is None else f"**{text}**" if abs(score) > 2 else text)
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)
