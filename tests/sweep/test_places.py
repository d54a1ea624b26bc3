"""A sweep from an installation that cannot be written to, without a home folder."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import singletrack
from sweep_helpers import SMALL, files_of

pytest.importorskip("zarr")

#: A folder that nobody can make, not even root.
NOWHERE = "/proc/nonexistent"


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="needs the permissions of a POSIX system")
def test_from_a_read_only_installation_without_a_home(tmp_path: Path) -> None:
    source = tmp_path / "source"
    shutil.copytree(
        Path(singletrack.__file__).parent, source / "singletrack", ignore=shutil.ignore_patterns("__pycache__")
    )
    work = tmp_path / "work"
    work.mkdir()
    (work / "study.toml").write_text(SMALL)
    environment = {"PYTHONPATH": str(source), "HOME": NOWHERE, "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}
    python = f"{sys.executable} -m singletrack sweep study.toml"
    sweeps = f"{python} --workers 1 --output 0.zarr && {python} --workers 2 --output 1.zarr"
    try:
        if os.geteuid() == 0:  # whom permissions do not stop
            mounted = f"mount --bind {source} {source} && mount -o remount,bind,ro {source} || exit 99"
            command = ["unshare", "-m", "sh", "-c", f"{mounted}; touch {source}/x && exit 98; {sweeps}"]
        else:
            for path in (source, *source.rglob("*")):
                path.chmod(0o555 if path.is_dir() else 0o444)
            command = ["sh", "-c", sweeps]
        done = subprocess.run(command, check=False, capture_output=True, text=True, cwd=work, env=environment)
    finally:
        for path in (source, *source.rglob("*")):
            path.chmod(0o755 if path.is_dir() else 0o644)
    if done.returncode == 99:
        pytest.skip(f"nothing can be mounted here: {done.stderr.strip()}")
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert files_of(work / "0.zarr") == files_of(work / "1.zarr")
