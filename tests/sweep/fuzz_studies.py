"""Throw mutated study files at the reader: `python fuzz_studies.py COUNT SEED FOLDER`; prints what was seen as JSON.

Mutations know what a study is made of: entries are dropped, doubled, renamed and moved, values exchanged for values of
other kinds and sizes, and now and then bytes are changed. Anything but a study or a refusal ends with a traceback.
"""

from __future__ import annotations

import json
import random
import re
import resource
import sys
import time
import warnings
from pathlib import Path

import numpy as np

from singletrack.errors import InputError
from singletrack.sweep import Study, load_study
from singletrack.sweep.chunks import chunk_size

ENTRIES = {
    "kind": ['"study"', '"bicycle"', '""', "3"],
    "name": ['"a"', '"[red]x[/red]"', '"\\u001b[31m"', '"' + "n" * 5000 + '"', "[]", '"é𝄞"'],
    "description": ['"d"', "true", "{}"],
    "bicycle": [
        '"browser"',
        '"stratos"',
        '"benchmark"',
        '"nobody"',
        '"../study.toml"',
        '"."',
        '"/dev/null"',
        '"a\\u0000b"',
        "5",
        '""',
    ],
    "rider": ['"rider-a"', '"rider-b"', '"browser"', '"' + "x" * 400 + '"', "false"],
    "posture": ['"rigid"', '"leaned"', '"upright"', '"sideways"', "1"],
    "springs": [
        '{ steer = "3 N*m/rad" }',
        "{ steer = 3 }",
        "{ steer = true }",
        '{ elbow = "1 kg" }',
        "{ steer = nan }",
        "{}",
    ],
    "dampers": ['{ steer = "3 N*m*s/rad" }', "{ steer = -1 }", "[1]"],
    "shoulder": ['"abduction"', '"axial"', '"other"', "[1]"],
    "arms": ['"straight"', '"bent"', "2"],
    "torso_lean": ["true", "false", '"yes"', "1"],
    "speeds": [
        '"0:10:11"',
        "5",
        "[1, 2.5]",
        '"10:0:3"',
        '"0:10:1e9"',
        '"0:1:100000000000"',
        "[]",
        "[nan]",
        "[inf, 1]",
        "[-1]",
        "true",
        "[true]",
        '"٥"',
        "1e300",
        "[[1]]",
        '"5 km/h:40 km/h:8"',
        "1979-05-27",
        '"0:10:999999"',
    ],
    "keep": [
        '["eigenvalues"]',
        '["matrices", "stable_ranges"]',
        '["critical_speeds"]',
        "[]",
        '"eigenvalues"',
        '["eigenvalues", "eigenvalues"]',
        "[3]",
        '["nothing"]',
    ],
}
SAMPLING = {
    "method": ['"grid"', '"list"', '"random"', '"latin-hypercube"', '"sobol"', '"soboll"', "0"],
    "samples": ["1", "8", "1000", "65536", "100000000", "100000001", "0", "-4", "2.5", "true", "9" * 30, "1_0"],
    "seed": ["0", "1", "4294967295", "4294967296", "-1", '"one"', "1e3"],
}
NAMES = [
    "trail",
    "wheel_base",
    "steer_axis_tilt",
    "rider_mass",
    "upper_arm_length",
    "gravity",
    "nothing",
    '"a.b"',
    '""',
]
NUMBERS = [
    "0.05",
    "72",
    '"60 mm"',
    '"21 deg"',
    '"5 furlong"',
    '"1e308 ft"',
    "nan",
    "inf",
    "-1",
    "1e400",
    "9" * 400,
    "true",
    '"٠.٠٥"',
    '""',
    "0x1F",
    '"1 m" ',
    "1e-320",
    "-0.0",
    "[1]",
    "1979-05-27",
]
WORDS = [
    *"[]{}=,\"'#.\\\n\t ",
    "\x00",
    "\x1b",
    "é",
    "\U0001d11e",
    "\r\n",
    '"""',
    "[[",
    "vary",
    "[vary]",
    "= =",
    "a.b.c = 1",
]


RIGHT = {"trail": ("5 cm", "6 cm"), "wheel_base": ("1 m", "1.1 m"), "steer_axis_tilt": ("18 deg", "22 deg")}
RIGHT |= {"rider_mass": ("70 kg", "75 kg"), "upper_arm_length": ("28 cm", "30 cm")}


def value(numbers: random.Random, name: str, *, listed: bool) -> str:
    """Return one entry of [vary], or something like it."""
    low, high = RIGHT.get(name, ("1", "2"))
    count = numbers.choice(["2", "3", "100", "1000000", "1000001", "100000000000000", "1", "-3", "2.0", "true", '"3"'])
    if numbers.random() < 0.85:
        right = [f'["{low}", "{high}"]', f'{{ from = "{low}", to = "{high}", count = 3 }}']
        drawn = [
            f'{{ from = "{low}", to = "{high}" }}',
            f'{{ distribution = "normal", mean = "{high}", deviation = "{low}" }}',
        ]
        return numbers.choice(right if listed else drawn)

    def pick() -> str:
        return numbers.choice(NUMBERS)

    kind = numbers.choice(["normal", "uniform", "gamma"])
    return numbers.choice(
        [
            f"[{', '.join(pick() for _ in range(numbers.randrange(5)))}]",
            f"{{ from = {pick()}, to = {pick()}, count = {count} }}",
            f"{{ from = 0.05, to = 0.06, count = {count} }}",
            f"{{ from = {pick()}, to = {pick()} }}",
            f'{{ distribution = "{kind}", mean = {pick()}, deviation = {pick()} }}',
            f"{{ {numbers.choice(['from', 'too', 'mean', 'count'])} = {pick()} }}",
            pick(),
        ]
    )


def study(numbers: random.Random) -> str:
    """Return the text of a study file: mostly right, each entry now and then wrong."""

    def choose(options: list[str]) -> str:
        return options[0] if numbers.random() < 0.93 else numbers.choice(options)

    needed = {"bicycle", "speeds", "keep", "rider"}
    used = [name for name in ENTRIES if numbers.random() < (0.98 if name in needed else 0.15)]
    lines = [f"{name} = {choose(ENTRIES[name])}" for name in used]
    lines += [f"{numbers.choice(['speed', 'keeps', 'Bicycle', 'vary', 'sampling'])} = 1"] * (numbers.random() < 0.03)
    listed = numbers.random() < 0.6
    if not listed or numbers.random() < 0.1:
        method = numbers.choice(SAMPLING["method"][2:5] if numbers.random() < 0.9 else SAMPLING["method"])
        samples = "64" if numbers.random() < 0.8 else numbers.choice(SAMPLING["samples"])
        lines += ["[sampling]", f"method = {method}", f"samples = {samples}"]
        lines += [f"seed = {choose(SAMPLING['seed'])}"] * (numbers.random() < 0.5)
    lines += ["[vary]"] * (numbers.random() < 0.97)
    names = numbers.sample(NAMES[:5], numbers.randrange(1, 4))
    names = names if numbers.random() < 0.9 else numbers.choices(NAMES, k=3)
    lines += [f"{name} = {value(numbers, name, listed=listed)}" for name in names]
    if numbers.random() < 0.05:
        numbers.shuffle(lines)
    text = "\n".join(lines) + "\n"
    for _ in range(numbers.choice([0, 0, 0, 0, 0, 1, 3])):
        at = numbers.randrange(len(text))
        new = numbers.choice(["", numbers.choice(WORDS), numbers.choice(WORDS) * 1000])
        text = text[:at] + new + text[at + numbers.randrange(3) :]
    return text


def check(found: Study) -> None:
    """Ask a study for what a run asks it for, but the computing."""
    if found.designs.method != "latin-hypercube" or found.designs.count < 10_000:
        assert np.isfinite(found.designs.rows(0, min(found.designs.count, 3))).all()
    assert found.designs.count >= 1
    assert len(found.fingerprint) == 64
    assert np.isfinite(found.speeds).all()
    assert chunk_size(len(found.speeds)) >= 1


def main(count: int, seed: int, folder: Path) -> dict[str, object]:
    numbers = random.Random(seed)
    path = folder / "study.toml"
    path.write_text('bicycle = "browser"\nspeeds = 1\nkeep = ["eigenvalues"]\n[vary]\ntrail = [0.05]\n')
    load_study(path)  # what is imported with the first one
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    studies, poor, slowest, slowest_file = 0, [], 0.0, ""
    warnings.simplefilter("ignore")
    for _ in range(count):
        text = study(numbers)
        data = text.encode("utf-8", "surrogatepass")
        if numbers.random() < 0.03:
            at = numbers.randrange(len(data))
            data = data[:at] + bytes([numbers.randrange(256)]) + data[at:]
        path.write_bytes(data)
        began = time.process_time()
        try:
            check(load_study(path))
            studies += 1
        except InputError as error:
            if (
                not re.search(
                    r"study\.toml|unknown (bicycle|rider)|rider-a|browser|/dev/null|is a directory", str(error)
                )
                or len(str(error)) > 4000
            ):
                poor.append(str(error)[:300])
        except BaseException:
            sys.stderr.write(text)
            raise
        if (took := time.process_time() - began) > slowest:
            slowest, slowest_file = took, text[:2000]
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    told = {"studies": studies, "refused": count - studies, "slowest": slowest, "slowest file": slowest_file}
    return {**told, "megabytes": (after - before) / 1024, "poor": poor[:5]}


if __name__ == "__main__":
    sys.stdout.write(json.dumps(main(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))))
