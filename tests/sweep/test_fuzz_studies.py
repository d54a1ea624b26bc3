"""Thousands of mutated study files, seeded: each is a study or one refusal that names the file; none costs much.

`SINGLETRACK_FUZZ=6000` sets their number; in processes of their own, so that time and memory can be limited.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

COUNT = int(os.environ.get("SINGLETRACK_FUZZ", "1500"))
PROGRAM = Path(__file__).with_name("fuzz_studies.py")


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_mutated_studies(tmp_path: Path, seed: int) -> None:
    arguments = [str(PROGRAM), str(COUNT // 2), str(seed), str(tmp_path)]
    done = subprocess.run([sys.executable, *arguments], check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    told = json.loads(done.stdout)
    assert told["poor"] == []
    assert told["studies"] > COUNT // 20
    assert told["refused"] > COUNT // 20
    assert told["slowest"] < 2.0, told["slowest file"]
    assert told["megabytes"] < 300
