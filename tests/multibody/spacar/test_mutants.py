"""2000 damaged files are read and run, or refused with a message; none ends in a traceback or hangs."""

from __future__ import annotations

import random
import warnings

import pytest

from singletrack import spacar
from singletrack.errors import SingletrackError
from singletrack.multibody.spacar.describe import KEYWORDS, REFUSED

FLEXIBLE = """
BEAM 1 1 2 3 4 0 1 0
TRUSS 2 1 5
BEARING 3 3 4 6 7 1 0 0
X 3 1 0 0
X 5 0 1 0
X 6 1 0 0
FIX 1
FIX 2
FIX 5
DYNE 3 2
DYNE 1 2 3 4 5 6
DYNE 3 1
EMASS 1 0.4 0.01
ESTIFF 1 0 1 2 3
MASS 6 0.2
MASS 7 0.1 0 0 0.1 0 0.1
FORCE 6 0 0.1 0.2
TORQUEL 7 0.1 0 0
GRAVITY 0 0 -9.81
TIMESTEP 3 0.02
"""
WORDS = [
    *KEYWORDS,
    *REFUSED,
    "END",
    "EOF",
    "%",
    "*",
    "NaN",
    "1e400",
    "-1",
    "0",
    "99999",
    "1.5",
    "é",
    "\x00",
    "--",
    "1e-300",
    "1e30",
]


def mutant(text: str, chance: random.Random) -> str:
    """Return a text with one to four damages."""
    lines = text.split("\n")
    for _ in range(chance.randint(1, 4)):
        i = chance.randrange(len(lines))
        words = lines[i].split()
        kind = chance.randrange(7)
        if kind == 0:
            lines.insert(i, lines[chance.randrange(len(lines))])
        elif kind == 1 and len(lines) > 2:
            del lines[i]
        elif kind == 2 and words:
            words[chance.randrange(len(words))] = chance.choice(WORDS)
        elif kind == 3 and words:
            del words[chance.randrange(len(words))]
        elif kind == 4:
            words.insert(chance.randint(0, len(words)), chance.choice(WORDS))
        elif kind == 5 and words:
            at = chance.randrange(len(words))
            words[at] = str(chance.choice([1, 2, 3, 4, 5, 6, 7, 8, 0.3, -2.0, 1e3, 1e-5]))
        elif lines[i]:
            at = chance.randrange(len(lines[i]))
            lines[i] = lines[i][:at] + chr(chance.randrange(32, 127)) + lines[i][at + 1 :]
            continue
        if kind in {2, 3, 4, 5}:
            lines[i] = " ".join(words)
    return "\n".join(lines)


@pytest.mark.slow
def test_mutants(slider_crank, robot):
    chance = random.Random(20001103)
    short = slider_crank.replace("TIMESTEP 100 5.0", "TIMESTEP 3 0.02")
    seeds = [short, robot, robot.replace("\nxm 4 ", "\ntimestep 0.01 2\nxm 4 "), FLEXIBLE]
    ran = refused = nameless = 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for number in range(2000):
            text = mutant(seeds[number % len(seeds)], chance)
            try:
                model = spacar.read_text(text, "mutant.dat")
                model.listing()
                motion = model.run()[-1] if model.description.steps <= 10 else model.motion()
                model.linearise(motion)
                ran += 1
            except SingletrackError as error:
                refused += 1
                nameless += not str(error).startswith("mutant.dat")
    assert ran > 100
    assert nameless == 0
    assert refused > 300
