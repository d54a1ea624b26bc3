"""A sweep from an installation that cannot be written to, without a home folder."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from installations import read_only_installation, run
from sweep_helpers import SMALL, files_of

if TYPE_CHECKING:
    from pathlib import Path

pytest.importorskip("zarr")


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="needs the permissions of a POSIX system")
def test_from_a_read_only_installation_without_a_home(tmp_path: Path) -> None:
    work = tmp_path / "work"
    work.mkdir()
    (work / "study.toml").write_text(SMALL)
    sweep = "singletrack sweep study.toml"
    with read_only_installation(tmp_path) as command:
        done = run(command, f"{sweep} --workers 1 --output 0.zarr && {sweep} --workers 2 --output 1.zarr", tmp_path)
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    assert files_of(work / "0.zarr") == files_of(work / "1.zarr")
