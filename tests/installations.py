"""An installation that nobody can write to, for a user without a home folder."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import singletrack

if TYPE_CHECKING:
    from collections.abc import Iterator

#: A folder that nobody can make, not even root.
NOWHERE = "/proc/nonexistent"


@contextmanager
def read_only_installation(folder: Path) -> Iterator[list[str]]:
    """Copy the package to where it cannot be written; give the command that runs a shell script with it."""
    source = folder / "source"
    shutil.copytree(
        Path(singletrack.__file__).parent, source / "singletrack", ignore=shutil.ignore_patterns("__pycache__")
    )
    paths = (source, *source.rglob("*"))
    try:
        if os.geteuid() == 0:  # whom permissions do not stop
            mounted = f"mount --bind {source} {source} && mount -o remount,bind,ro {source} || exit 99"
            yield ["unshare", "-m", "sh", "-c", f'{mounted}; touch {source}/x 2>/dev/null && exit 98; eval "$0"']
        else:
            for path in paths:
                path.chmod(0o555 if path.is_dir() else 0o444)
            yield ["sh", "-c", f'touch {source}/x 2>/dev/null && exit 98; eval "$0"']
    finally:
        for path in paths:
            path.chmod(0o755 if path.is_dir() else 0o644)


def run(command: list[str], script: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a script of `singletrack` commands there, from a folder beside it, without a home."""
    work = folder / "work"
    work.mkdir(exist_ok=True)
    environment = {"PYTHONPATH": str(folder / "source"), "HOME": NOWHERE, "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}
    named = f'singletrack() {{ {sys.executable} -m singletrack "$@"; }}; {script}'
    done = subprocess.run(
        [*command, named], check=False, capture_output=True, text=True, cwd=work, env=environment, timeout=600
    )
    if done.returncode == 99:
        pytest.skip(f"nothing can be mounted here: {done.stderr.strip()}")
    assert done.returncode != 98, "the installation can be written to"
    return done
