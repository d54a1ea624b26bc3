"""Whatever a file holds, it is read or refused in a sentence: no traceback, no hang, no memory eaten."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("mutations.py")
READERS = (
    *("toml bicycle", "toml rider", "text", "measured", "yaml benchmark", "yaml principal", "yeadon"),
    *("configuration", "signal", "any"),
)


@pytest.mark.slow
@pytest.mark.parametrize("reader", READERS)
def test_2000_mutated_files_are_read_or_refused(reader, tmp_path):
    if reader == "yeadon":
        pytest.importorskip("yeadon", reason="the optional package yeadon is not installed")
    done = subprocess.run(
        [sys.executable, str(SCRIPT), reader, "2000", "20260101", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=540,  # far beyond what it takes: only a hang gets there
    )
    assert done.returncode == 0, done.stderr[-2000:]
    result = json.loads(done.stdout)
    assert result["read"] + result["refused"] == 2000
    assert min(result["read"], result["refused"]) > 50  # the mutations neither all kill nor all spare
    assert result["poor"] == []
    assert result["megabytes"] < 200
