"""Throw generated files at every reader: `python tests/fuzz/run.py [--count 6000] [--seed 1] [--reader NAME]`.

The same seed makes the same files. Every input must be read or refused in one sentence that says where, in less than
two seconds of processor time, and all inputs together in less than 300 MB; whatever is read must give finite results.
Prints a summary as JSON; exit code 1 and the offending files (kept in --keep) if anything is not as it must be.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import resource
import sys
import tempfile
import time
import traceback
import warnings
import zlib
from pathlib import Path
from typing import Any

from documents import parse, render
from mutators import BYTES, STRUCTURE
from readers import MADE, READERS, check

from singletrack.errors import InputError, OddityWarning

CORPUS = Path(__file__).with_name("corpus")
SECONDS, MEGABYTES, LONGEST = 2.0, 300, 1500
#: Hard stops, far beyond what is allowed: a runaway input ends the process instead of the machine.
ADDRESS_SPACE = 4 << 30
#: How messages say where it is, besides by a line: the file as a whole, an option, a joint or a loop.
WHOLE = re.compile(
    MADE["WHOLE"].pattern
    + r"|mass matrix|must be |is not a number|unknown unit|has a unit|standard deviation|; allowed: "
    + r"|: joint |: loop |: posture |\[\[\w+\]\]|segments"
)


def make(rng: random.Random, reader: str) -> bytes:
    """Return the next file for a reader."""
    _, syntax, text, _ = READERS[reader]
    known = sorted(CORPUS.glob(f"{reader.replace(' ', '-')}-*"))
    if known and rng.random() < 0.1:
        data = rng.choice(known).read_bytes()
    else:
        document = parse(text, syntax)
        for _ in range(rng.choice([1, 1, 2, 2, 3, 5])):
            document = rng.choice(STRUCTURE)(rng, document)
        data = render(document).encode("utf-8", "surrogatepass")
    return rng.choice(BYTES)(rng, data) if data and rng.random() < 0.2 else data


def trouble_with(path: Path, read) -> tuple[str, bool]:
    """Return what is wrong with how a file was taken, or "", and whether it was read."""
    started = time.process_time()
    was_read = False
    try:
        result = read(path)
        was_read = True
        check(result)
        wrong = ""
    except InputError as error:
        message = str(error)
        located = re.search(r"line \d+", message) or WHOLE.search(message)
        poor = not located or len(message) > LONGEST or re.search(r"[\x00-\x08\x0e-\x1f\x7f]", message)
        wrong = f"poor message: {message[:300]!r}" if poor or (not was_read and str(path) not in message) else ""
    except Exception:  # noqa: BLE001  # anything else is what we look for
        wrong = traceback.format_exc()[-2000:]
    spent = time.process_time() - started
    return wrong or (f"{spent:.1f} s" if spent > SECONDS else ""), was_read


def fuzz(reader: str, count: int, seed: int, folder: Path, keep: Path | None) -> dict[str, Any]:
    """Return how many of so many files were read and refused, and what was wrong with which."""
    suffix, _, text, read = READERS[reader]
    path = folder / f"fuzzed{suffix}"
    path.write_text(text, encoding="utf-8")
    read(path)  # the sound file is sound
    rng = random.Random(zlib.crc32(reader.encode()) + seed)
    found: dict[str, Any] = {"read": 0, "refused": 0, "wrong": []}
    for number in range(count):
        data = make(rng, reader)
        path.write_bytes(data)
        wrong, was_read = trouble_with(path, read)
        found["read" if was_read else "refused"] += 1
        if wrong:
            found["wrong"].append(f"{reader} {number}: {wrong}")
            if keep is not None:
                keep.mkdir(parents=True, exist_ok=True)
                (keep / f"{reader.replace(' ', '-')}-{seed}-{number}{suffix}").write_bytes(data)
    return found


def peak_megabytes() -> float:
    """Return the peak of memory; where the system tells, without that of the process which started this one."""
    status = Path("/proc/self/status")
    found = re.search(r"VmHWM:\s+(\d+) kB", status.read_text()) if status.exists() else None
    return (int(found[1]) if found else resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) / 1024


def main() -> int:
    """Run, print a summary."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=6000, help="files in all, the same number for each reader")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--reader", action="append", choices=list(READERS))
    parser.add_argument("--keep", type=Path, help="a folder for files that were taken badly")
    options = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    warnings.simplefilter("error")
    warnings.simplefilter("ignore", OddityWarning)
    try:
        import yeadon  # noqa: F401
    except ImportError:
        READERS.pop("yeadon")
    names = [name for name in options.reader or READERS if name in READERS]
    summary = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            summary[name] = fuzz(name, -(-options.count // len(names)), options.seed, Path(folder), options.keep)
    wrong = [line for found in summary.values() for line in found.pop("wrong")]
    megabytes = peak_megabytes()
    if megabytes > MEGABYTES:
        wrong.append(f"{megabytes:.0f} MB")
    inputs = sum(found["read"] + found["refused"] for found in summary.values())
    sys.stdout.write(
        json.dumps({"inputs": inputs, "readers": summary, "megabytes": megabytes, "wrong": wrong}, indent=1)
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
