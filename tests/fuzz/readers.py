"""What is fuzzed: sound files of every format, their readers, and what must hold of whatever they return."""

from __future__ import annotations

import math
import runpy
from pathlib import Path

import numpy as np

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.errors import SingletrackError
from singletrack.files.parameter_sets import write_parameter_set
from singletrack.files.registry import FORMATS
from singletrack.files.rigid_rider import read_rigid_rider
from singletrack.files.signals import read_signal
from singletrack.files.source import read_text
from singletrack.files.speeds import parse_speeds
from singletrack.files.text import write_bicycle_text
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_write import write_toml
from singletrack.files.yeadon import read_configuration
from singletrack.library import shipped
from singletrack.library.load import load_any
from singletrack.linear import modes
from singletrack.measuring.oscillation import fit_oscillation
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bodies import with_rigid_rider
from singletrack.posture import Mechanism, load_posture

__all__ = ["READERS", "check"]

MADE = runpy.run_path(str(Path(__file__).parents[1] / "files" / "mutations.py"), run_name="made")
SPEEDS = (0.0, 1.0, 5.0, 12.0)


class SilentError(AssertionError):
    """A result that is wrong and does not say so."""


def check(result: object) -> None:
    """Raise unless all that follows from what was read is finite, or refused in words."""
    if isinstance(result, Bicycle):
        _check_bicycle(result)
    elif isinstance(result, Mechanism):
        _check_posture(result)
    elif isinstance(result, Rider):
        _check_rider(result)
    elif result is not None and not np.isfinite(np.asarray(result, dtype=float)).all():
        raise SilentError(f"read {result!r}")


def _check_bicycle(bicycle: Bicycle) -> None:
    for one in FORMATS:
        if one.write_bicycle and one.read_bicycle:
            again = one.read_bicycle(one.write_bicycle(bicycle), "again")
            if one.name in {"toml", "text"} and again.values() != bicycle.values():
                raise SilentError(f"written and read as {one.name}, it is another bicycle")
    try:
        model = coefficients(bicycle)
        named = modes(model, SPEEDS)
        critical = model.critical_speeds()
    except SingletrackError:
        return
    found = [*model.matrices, named.eigenvalues, *(np.asarray(getattr(critical, k)) for k in ("weave", "capsize"))]
    if not all(np.isfinite(values).all() for values in found):
        raise SilentError("results that are not finite, without a word")
    if any(math.isnan(end) for ends in critical.stable_ranges for end in ends):
        raise SilentError("a stable range that is not a number")


def _check_rider(rider: Rider) -> None:
    if parse_record(Rider, write_toml(rider), "again.toml").values() != rider.values():
        raise SilentError("written and read, it is another rider")
    for posture in ("leaned", "upright"):
        try:
            if not np.isfinite(coefficients(load_bicycle("stratos"), rider, posture).M).all():
                raise SilentError(f"{posture}: a mass matrix that is not finite")
        except SingletrackError:
            continue


def _check_posture(mechanism: Mechanism) -> None:
    try:
        model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), mechanism)
    except SingletrackError:
        return
    if not all(np.isfinite(matrix).all() for matrix in (model.M, model.C1, model.K0, model.K2, model.C0, model.S0)):
        raise SilentError("matrices that are not finite, without a word")


def _configuration(path: Path) -> float:
    return read_configuration(read_text(path), str(path))


def _signal(path: Path) -> tuple[float, ...]:
    fit = fit_oscillation(*read_signal(read_text(path), str(path)), str(path))
    return fit.period, fit.period_deviation, fit.decay, fit.decay_deviation, fit.natural_period


def _rigid_rider(path: Path) -> Bicycle:
    return with_rigid_rider(load_bicycle("browser"), read_rigid_rider(read_text(path), str(path)))


def _speeds(path: Path) -> np.ndarray:
    return parse_speeds(read_text(path).strip("\n"), str(path))


def _sound():
    stratos = load_bicycle("stratos").replace(standard_deviations={"trail": 0.0016, "steer_axis_tilt": 0.003})
    rider = "mB = 72.0+/-2.0\nxB = 0.3\nyB = 0.0\nzB = -1.1\nIBxx = 8.0\nIBxz = -1.9\nIByy = 8.1\nIBzz = 2.4\n"
    posture = shipped("posture")["upright-abduction"].read_text(encoding="utf-8")
    angles = "somersault: 0.175\ntilt: 0.0\ntwist: 0.0\nCA1extension: 0.0\nJ1J2flexion: 0.0\n"
    return {
        "toml bicycle": (".toml", "toml", write_toml(stratos), load_any),
        "toml rider": (".toml", "toml", write_toml(load_rider("rider-a")), load_any),
        "text": (".txt", "equals", write_bicycle_text(stratos), load_any),
        "measured": (".txt", "equals", MADE["raw_measurements"](), load_any),
        "rigid rider": (".txt", "equals", rider, _rigid_rider),
        "yaml benchmark": (".yml", "colon", write_parameter_set(stratos), load_any),
        "yaml principal": (".yml", "colon", write_parameter_set(stratos, "principal"), load_any),
        "yeadon": (".txt", "colon", MADE["yeadon_measurements"](), load_any),
        "configuration": (".txt", "colon", angles, _configuration),
        "signal": (".csv", "columns", MADE["signal"](), _signal),
        "speeds": ("", "cells", "5 km/h:40 km/h:8", _speeds),
        "posture": (".toml", "toml", posture, load_posture),
        "any": ("", "toml", write_toml(stratos), load_any),
    }


#: By name: the file's suffix, its syntax (see documents.py), a sound text, and a function of a path.
READERS = _sound()
