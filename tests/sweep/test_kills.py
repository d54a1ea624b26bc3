"""Killed at random instants, stopped by Ctrl-C and SIGTERM, robbed of a worker: nothing lost, nothing wrong."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from singletrack.sweep import check_sweep, open_sweep
from sweep_helpers import SMALL, files_of, small_study

pytest.importorskip("zarr")
psutil = pytest.importorskip("psutil")

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="needs the signals of a POSIX system")

LOOP = Path(__file__).with_name("kill_loop.py")
#: `make kill` sets 100.
KILLS = int(os.environ.get("SINGLETRACK_KILLS", "12"))

#: Long enough to be disturbed, in many chunks.
LONG = """
bicycle = "browser"
rider = "rider-a"
posture = "upright"
speeds = "0:8:101"
keep = ["eigenvalues"]
[sampling]
method = "random"
samples = 60000
[vary]
trail = { from = "30 mm", to = "80 mm" }
upper_arm_length = { from = "25 cm", to = "35 cm" }
"""
COMMAND = [sys.executable, "-m", "singletrack", "sweep"]


@pytest.mark.slow
@pytest.mark.parametrize(("workers", "kills"), [(1, KILLS), (2, max(KILLS // 10, 2))])
def test_killed_at_random_instants(tmp_path: Path, workers: int, kills: int) -> None:
    small_study(tmp_path, SMALL)
    arguments = [str(LOOP), str(tmp_path / "study.toml"), str(tmp_path), str(kills), str(workers)]
    done = subprocess.run([sys.executable, *arguments], check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout)
    assert seen["kills"] == kills


class Running:
    """A sweep in a process group of its own, as a terminal starts it."""

    def __init__(self, folder: Path, *options: str) -> None:
        (folder / "study.toml").write_text(LONG)
        self.output, self.partial = folder / "out.zarr", folder / "out.zarr.partial"
        self.process = subprocess.Popen(
            [*COMMAND, str(folder / "study.toml"), "--output", str(self.output), *options],
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def wait_for_chunks(self, count: int) -> None:
        journal = self.partial / "journal.jsonl"
        deadline = time.monotonic() + 120
        while not journal.exists() or journal.read_bytes().count(b"\n") <= count:
            assert self.process.poll() is None, self.process.communicate()[1]
            assert time.monotonic() < deadline
            time.sleep(0.005)

    def children(self) -> list[psutil.Process]:
        """Return the workers of its pool."""
        found = psutil.Process(self.process.pid).children()
        return [child for child in found if any("spawn_main" in part for part in child.cmdline())]

    def end(self) -> tuple[int, str]:
        """Return exit code and what was said, without the bar; it ends soon, and leaves no process behind."""
        said = self.process.communicate(timeout=60)[1]
        deadline = time.monotonic() + 20
        while self.left() and time.monotonic() < deadline:
            time.sleep(0.05)
        assert not self.left()
        return self.process.returncode, re.sub(r"[━╸╺ ]+\d+%.*\n?", "", said)

    def left(self) -> list[int]:
        """Return what is alive of its session."""
        alive = []
        for process in psutil.process_iter(["status"]):
            try:
                if os.getsid(process.pid) == self.process.pid and process.info["status"] != psutil.STATUS_ZOMBIE:
                    alive.append(process.pid)
            except OSError:
                continue
        return alive

    def kill(self) -> None:
        if self.left():
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.communicate()


@pytest.fixture
def running(tmp_path: Path, request: Any) -> Any:
    started = Running(tmp_path, *getattr(request, "param", ("--workers", "2")))
    yield started
    started.kill()


@pytest.mark.slow
@pytest.mark.parametrize("running", [("--workers", "1"), ("--workers", "2")], indirect=True)
@pytest.mark.parametrize(("number", "code", "word"), [("SIGINT", 130, "interrupted"), ("SIGTERM", 143, "terminated")])
def test_stopped_by_a_signal(running: Running, number: str, code: int, word: str) -> None:
    running.wait_for_chunks(1)
    os.killpg(running.process.pid, getattr(signal, number))  # as a terminal does: to all of them
    found, said = running.end()
    assert found == code
    assert "Traceback" not in said
    (line,) = [line for line in said.splitlines() if line.startswith("singletrack:")]
    assert (
        line == f"singletrack: {word}; what is done is kept in {running.partial}: run the same command again to go on"
    )
    assert not running.output.exists()


@pytest.mark.slow
def test_a_worker_that_is_killed_is_replaced(running: Running) -> None:
    running.wait_for_chunks(2)
    running.children()[0].kill()
    code, said = running.end()
    assert (code, "Traceback" in said) == (0, False), said
    dataset = open_sweep(running.output)
    assert int((dataset.status.values == 0).sum()) == 0
    assert int((dataset.status.values == 1).sum()) > 50_000


@pytest.mark.slow
def test_workers_end_with_a_parent_that_is_killed(running: Running) -> None:
    running.wait_for_chunks(1)
    assert running.children()
    running.process.send_signal(signal.SIGKILL)
    assert running.end()[0] == -signal.SIGKILL


def command(folder: Path, *options: str, text: str = SMALL) -> subprocess.CompletedProcess[str]:
    (folder / "study.toml").write_text(text)
    return subprocess.run(
        [*COMMAND, str(folder / "study.toml"), *options], check=False, capture_output=True, text=True, cwd=folder
    )


def one_sentence(done: subprocess.CompletedProcess[str], *parts: str) -> None:
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith("singletrack: ")
    assert len(done.stderr.strip().splitlines()) == 1
    for part in parts:
        assert part in done.stderr


def test_a_symbolic_link_is_no_output(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "link.zarr").symlink_to(tmp_path / "elsewhere")
    one_sentence(command(tmp_path, "--output", "link.zarr"), "link.zarr: is a symbolic link")
    (tmp_path / "nowhere.zarr").symlink_to(tmp_path / "missing")
    one_sentence(command(tmp_path, "--output", "nowhere.zarr"), "nowhere.zarr: is a symbolic link")
    assert list((tmp_path / "elsewhere").iterdir()) == []


def test_a_grid_beyond_reason_is_refused_with_its_number(tmp_path: Path) -> None:
    lines = "\n".join(f"{name} = {{ from = 0.1, to = 0.2, count = 10000000 }}" for name in ("trail", "wheel_base"))
    text = SMALL.partition("[vary]")[0] + "[vary]\n" + lines.replace("10000000", "1000000")
    one_sentence(command(tmp_path, text=text), "1,000,000 x 1,000,000 = 1,000,000,000,000 designs", "at most")
    text = text.replace("count = 1000000", "count = 100000000000000", 1)
    one_sentence(command(tmp_path, text=text), "count = 100000000000000")
    assert not list(tmp_path.glob("*.partial"))


def test_what_does_not_fit_on_the_disk_is_refused(tmp_path: Path) -> None:
    text = LONG.replace("60000", "100000000").replace("0:8:101", "0:8:100001")
    one_sentence_end = command(tmp_path, text=text)
    assert one_sentence_end.returncode == 2
    assert "need 640 TB" in one_sentence_end.stderr
    assert not list(tmp_path.glob("*.partial"))


def test_a_finished_sweep_says_so(tmp_path: Path) -> None:
    assert command(tmp_path).returncode == 0
    before = files_of(tmp_path / "study.zarr")
    done = command(tmp_path)
    assert done.returncode == 0
    assert "is the finished sweep of this study; nothing is left to do" in done.stderr.replace("\n", " ")
    assert "%" not in done.stderr
    assert files_of(tmp_path / "study.zarr") == before
    one_sentence(command(tmp_path, text=SMALL.replace("20 cm", "21 cm")), "exists already")


def test_a_full_disk(tmp_path: Path) -> None:
    """On a small file system of its own, where one can be mounted: one sentence, and the rest when there is room."""
    (tmp_path / "study.toml").write_text(LONG.replace("60000", "5190"))
    sweep = f"{sys.executable} -m singletrack sweep ../study.toml --output disk.zarr --workers 1"
    script = f"""
        mkdir disk && mount -t tmpfs -o size=48m none disk && cd disk || exit 99
        timeout 60 sh -c 'until [ -e disk.zarr.partial/journal.jsonl ]; do sleep 0.01; done
                          head -c 44M /dev/zero >ballast' &
        {sweep} 2>../first; echo $? >../first.code
        wait; rm ballast
        {sweep} 2>../second; echo $? >../second.code
        cp -r disk.zarr ..
    """
    done = subprocess.run(
        ["unshare", "-rm", "sh", "-c", script],  # noqa: S607
        check=False,
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    if done.returncode:
        pytest.skip(f"no file system can be mounted here: {done.stderr.strip()}")
    assert (tmp_path / "first.code").read_text().strip() == "2"
    (line,) = [line for line in (tmp_path / "first").read_text().splitlines() if line.startswith("singletrack:")]
    assert "the disk is full; what is done is kept" in line
    assert (tmp_path / "second.code").read_text().strip() == "0", (tmp_path / "second").read_text()
    assert check_sweep(tmp_path / "disk.zarr").damages == ()
