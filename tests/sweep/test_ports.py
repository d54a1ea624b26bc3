"""Nothing listens on any port during any command of a default installation."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from singletrack.commands.door import COMMANDS
from sweep_helpers import SMALL

psutil = pytest.importorskip("psutil")
pytestmark = pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="needs /proc/net")

#: Loaded by every Python process of a command, also those that it starts: says when a socket gets an address.
HOOK = """
import os, sys
def said(event, arguments):
    if event == "socket.bind":
        with open(os.environ["SINGLETRACK_PORTS_SEEN"], "a") as file:
            file.write(f"{os.getpid()} {sys.argv} {arguments[1]}\\n")
sys.addaudithook(said)
"""
ARGUMENTS = {
    "reproduce": ["reproduce", "--output", "reproduced"],
    "coefficients": ["coefficients", "browser", "--rider", "rider-a", "--posture", "upright"],
    "eigenvalues": ["eigenvalues", "benchmark"],
    "critical-speeds": ["critical-speeds", "benchmark"],
    "list": ["list"],
    "show": ["show", "browser"],
    "template": ["template", "bicycle"],
    "schema": ["schema", "bicycle"],
    "convert": ["convert", "browser", "browser.txt"],
    "measure": ["measure", "measurements.toml"],
    "period": ["period", "signal.txt"],
    "page": ["page", "browser", "--no-open"],
    "turn": ["turn", "browser", "--speed", "5", "--lean", "10 deg"],
    "sweep": ["sweep", "study.toml", "--workers", "2"],
}


def listening(pids: set[int]) -> list[str]:
    """Return the lines of /proc/net of sockets of some processes that listen or wait for datagrams."""
    inodes = set()
    for pid in pids:
        for link in Path(f"/proc/{pid}/fd").glob("*"):
            try:
                target = str(link.readlink())
            except OSError:
                continue
            if target.startswith("socket:["):
                inodes.add(target[8:-1])
    found = []
    for kind, states in (("tcp", {"0A"}), ("tcp6", {"0A"}), ("udp", {"07"}), ("udp6", {"07"})):
        path = Path(f"/proc/net/{kind}")
        for line in path.read_text().splitlines()[1:] if path.exists() else []:
            parts = line.split()
            if parts[3] in states and parts[9] in inodes:
                found.append(f"{kind} {line}")
    path = Path("/proc/net/unix")  # flag 00010000: it listens
    found += [
        line
        for line in path.read_text().splitlines()[1:]
        if line.split()[3] == "00010000" and line.split()[6] in inodes
    ]
    return found


def family(process: Any) -> set[int]:
    try:
        return {process.pid, *(child.pid for child in process.children(recursive=True))}
    except psutil.NoSuchProcess:
        return {process.pid}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "sitecustomize.py").write_text(HOOK)
    (tmp_path / "study.toml").write_text(SMALL.replace("count = 5", "count = 3000"))
    lines = [f"{i / 100:.2f} {2.718 ** (-i / 500) * ((-1) ** (i // 50))}" for i in range(1000)]
    (tmp_path / "signal.txt").write_text("\n".join(lines))
    command = [sys.executable, "-m", "singletrack", "template", "measurements", "--output", "measurements.toml"]
    subprocess.run(command, check=True, cwd=tmp_path, capture_output=True)
    return tmp_path


def run(folder: Path, arguments: list[str]) -> tuple[int, list[str], str]:
    """Run a command; return its exit code, the sockets seen to listen, and those said to be bound."""
    seen = folder / "seen"
    paths = [str(folder), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "SINGLETRACK_PORTS_SEEN": str(seen)}
    process = psutil.Popen(
        [sys.executable, *arguments],
        cwd=folder,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    found: list[str] = []
    while process.poll() is None:
        found += listening(family(process))
        time.sleep(0.02)
    return process.returncode, found, seen.read_text() if seen.exists() else ""


def test_this_test_sees_a_port(folder: Path) -> None:
    program = "import socket, time; s = socket.create_server(('127.0.0.1', 0)); time.sleep(1)"
    _, found, bound = run(folder, ["-c", program])
    assert found
    assert "127.0.0.1" in bound


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_no_command_listens(folder: Path, command: str) -> None:
    if command == "sweep":
        pytest.importorskip("zarr")
    arguments = ARGUMENTS.get(command, [command, "browser"])  # most commands take a bicycle
    code, found, bound = run(folder, ["-m", "singletrack", *arguments])
    assert code in {0, 2}  # the template of measurements is to be filled in
    assert (found, bound) == ([], "")
