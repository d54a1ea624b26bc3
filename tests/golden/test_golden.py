"""What version 0.1.0 printed for the shipped cases: only keys may have been added.

Each file here holds the outputs of one command by case, as 0.1.0 printed them on Linux (x86-64). Bare bicycles are the
same to the last digit; on other systems sine and cosine differ there. With a rider the terms are added in another order
since mechanisms are data: the text is the same but for the last digits of its numbers.
"""

from __future__ import annotations

import dataclasses
import json
import platform
import re
from pathlib import Path

import numpy as np
import pytest

from singletrack.commands import door
from singletrack.commands.model_options import ModelOptions

HERE = Path(__file__).parent
SAME_SYSTEM = (platform.system(), platform.machine()) == ("Linux", "x86_64")
COMMANDS = {
    "coefficients-json": ["coefficients", "--json"],
    "eigenvalues-json": ["eigenvalues", "--json"],
    "eigenvalues-csv": ["eigenvalues", "--csv", "--speeds", "0:10:21"],
    "critical-json": ["critical-speeds", "--json"],
}
GOLDEN = {kind: json.loads((HERE / f"{kind}.json").read_text(encoding="utf-8")) for kind in COMMANDS}
CASES = [(kind, case) for kind, outputs in GOLDEN.items() for case in outputs]
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")


def arguments(case):
    """Return the arguments of a case: bicycle, then posture and shoulder of the rider if any."""
    bicycle, *rest = case.split("_")
    if not rest:
        return [bicycle]
    posture = ["--rider", "rider-a", "--posture", rest[0]]
    if rest[0] == "leaned" and any(field.name == "arms" for field in dataclasses.fields(ModelOptions)):
        posture += ["--arms", "bent"]  # in 0.1.0 there were no others
    return [bicycle, *posture, *(["--shoulder", rest[2]] if len(rest) > 1 else [])]


def without_added(found, golden):
    """Return a JSON value with those keys only that the golden one has, in its own order."""
    if isinstance(golden, dict):
        return {key: without_added(found[key], golden[key]) for key in found if key in golden}
    return found


@pytest.mark.parametrize(("kind", "case"), CASES, ids=[f"{kind} {case}" for kind, case in CASES])
def test_output_is_that_of_version_0_1(kind, case, capsys):
    command, *options = COMMANDS[kind]
    assert door.run([command, *arguments(case), *options]) == 0
    printed, golden = capsys.readouterr().out, GOLDEN[kind][case]
    if kind.endswith("json"):
        printed = json.dumps(without_added(json.loads(printed), json.loads(golden)), indent=1) + "\n"
    if SAME_SYSTEM and len(arguments(case)) == 1:
        assert printed == golden
    else:
        assert NUMBER.sub("", printed) == NUMBER.sub("", golden)
        numbers = [np.array(NUMBER.findall(text), dtype=float) for text in (printed, golden)]
        np.testing.assert_allclose(*numbers, rtol=2e-12, atol=1e-13)
