"""A sweep on three hosts: network namespaces with a scheduler and two workers; a host is lost, the network is gone.

The namespaces share the file system and have a network of their own: needs `ip netns` and the rights to use it.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from typing import TYPE_CHECKING, Any

import pytest

from singletrack.sweep import load_study, run_sweep
from sweep_helpers import files_of

pytest.importorskip("zarr")
pytest.importorskip("distributed")

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = pytest.mark.slow

STUDY = """
bicycle = "browser"
rider = "rider-a"
posture = "upright"
speeds = "0:8:101"
keep = ["critical_speeds"]
[sampling]
method = "random"
samples = 60000
[vary]
trail = { from = "30 mm", to = "80 mm" }
upper_arm_length = { from = "25 cm", to = "35 cm" }
"""
#: Names of this process's own, so that several may run at once.
PREFIX = f"st{os.getpid()}"
HOSTS = {"s": "10.83.7.1", "w1": "10.83.7.2", "w2": "10.83.7.3", "c": "10.83.7.4"}
#: A lost host is given up after ten seconds; by default Dask waits five minutes.
QUICK = {"DASK_DISTRIBUTED__SCHEDULER__WORKER_TTL": "10s", "DASK_DISTRIBUTED__WORKER__DAEMON": "False"}


def ip(*arguments: str) -> None:
    subprocess.run(["ip", *arguments], check=True, capture_output=True)  # noqa: S607


class Network:
    """Four hosts at one switch."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self.folder, self.environment = folder, {**os.environ, **QUICK, **environment}
        self.started: list[subprocess.Popen[str]] = []

    def begin(self) -> None:
        switch = f"{PREFIX}sw"
        ip("netns", "add", switch)
        ip("-n", switch, "link", "add", "sw", "type", "bridge")
        ip("-n", switch, "link", "set", "sw", "up")
        for name, address in HOSTS.items():
            space = PREFIX + name
            ip("netns", "add", space)
            ip("-n", switch, "link", "add", name, "type", "veth", "peer", "name", "eth0", "netns", space)
            ip("-n", switch, "link", "set", name, "master", "sw", "up")
            ip("-n", space, "address", "add", f"{address}/24", "dev", "eth0")
            ip("-n", space, "link", "set", "eth0", "up")
            ip("-n", space, "link", "set", "lo", "up")

    def end(self) -> None:
        for process in self.started:
            process.kill()
            process.wait()
        for name in ("sw", *HOSTS):
            subprocess.run(["ip", "netns", "delete", PREFIX + name], check=False, capture_output=True)  # noqa: S607

    def start(self, host: str, *arguments: str) -> subprocess.Popen[str]:
        command = ["ip", "netns", "exec", PREFIX + host, sys.executable, "-m", *arguments]
        with (self.folder / f"{host}-{len(self.started)}.log").open("w") as log:
            process = subprocess.Popen(
                command, env=self.environment, stdout=log, stderr=log, text=True, cwd=self.folder
            )
        self.started.append(process)
        return process

    def cluster(self, scheme: str) -> str:
        address = f"{scheme}://{HOSTS['s']}:8786"
        self.start(
            "s",
            "distributed.cli.dask_scheduler",
            "--host",
            f"{scheme}://{HOSTS['s']}",
            "--no-dashboard",
            "--no-jupyter",
        )
        for host in ("w1", "w2"):
            self.start(
                host,
                "distributed.cli.dask_worker",
                address,
                "--nthreads",
                "1",
                "--no-nanny",
                "--no-dashboard",
                "--host",
                f"{scheme}://{HOSTS[host]}",
                "--death-timeout",
                "60",
            )
        return address

    def connect(self, host: str, *, to: bool) -> None:
        ip("-n", f"{PREFIX}sw", "link", "set", host, "up" if to else "down")

    def sweep(self, address: str) -> subprocess.Popen[str]:
        return self.start("c", "singletrack", "sweep", "study.toml", "--scheduler", address)

    def said(self) -> str:
        return "\n".join(f"{path.name}: {path.read_text()}" for path in sorted(self.folder.glob("*.log")))

    def wait_for_chunks(self, process: Any, count: int) -> None:
        journal = self.folder / "study.zarr.partial" / "journal.jsonl"
        deadline = time.monotonic() + 180
        while not journal.exists() or journal.read_bytes().count(b"\n") <= count:
            assert process.poll() is None, self.said()
            assert time.monotonic() < deadline, self.said()
            time.sleep(0.02)


@pytest.fixture(scope="module")
def right(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    folder = tmp_path_factory.mktemp("right")
    (folder / "study.toml").write_text(STUDY)
    run_sweep(load_study(folder / "study.toml"), folder / "study.zarr", workers=1)
    return files_of(folder / "study.zarr")


@pytest.fixture
def network(tmp_path: Path, request: Any) -> Iterator[Network]:
    (tmp_path / "study.toml").write_text(STUDY)
    found = Network(tmp_path, getattr(request, "param", {}))
    try:
        found.begin()
    except (OSError, subprocess.CalledProcessError) as error:
        found.end()
        pytest.skip(f"no network namespaces here: {getattr(error, 'stderr', error)!r}")
    yield found
    found.end()


def finishes(network: Network, process: Any, right: dict[str, bytes]) -> None:
    code = process.wait(timeout=240)
    assert code == 0, network.said()
    assert files_of(network.folder / "study.zarr") == right


@pytest.mark.parametrize("lost", ["a host", "the network for ten seconds"])
def test_three_hosts_of_which(network: Network, right: dict[str, bytes], lost: str) -> None:
    process = network.sweep(network.cluster("tcp"))
    network.wait_for_chunks(process, 3)
    network.connect("w1", to=False)
    if lost != "a host":
        network.connect("w2", to=False)
        time.sleep(10)
        network.connect("w1", to=True)
        network.connect("w2", to=True)
    finishes(network, process, right)
    assert "is not protected" in network.said()


def test_a_scheduler_that_is_lost_is_told_and_the_sweep_goes_on_without(
    network: Network, right: dict[str, bytes]
) -> None:
    process = network.sweep(network.cluster("tcp"))
    network.wait_for_chunks(process, 3)
    network.started[0].kill()
    assert process.wait(timeout=90) == 2, network.said()
    assert "is lost; what is on disk is kept: run the same command again to go on" in network.said()
    assert "Traceback" not in (network.folder / "c-3.log").read_text()
    again = network.start("c", "singletrack", "sweep", "study.toml", "--workers", "1")
    finishes(network, again, right)


def make_certificates(folder: Path) -> dict[str, str]:
    """Make an authority and one certificate for all hosts; return what Dask reads from the environment."""

    def openssl(*arguments: str) -> None:
        subprocess.run(["openssl", *arguments], check=True, capture_output=True, cwd=folder)  # noqa: S607

    openssl(
        "req",
        "-x509",
        "-newkey",
        "rsa:2048",
        "-nodes",
        "-days",
        "2",
        "-subj",
        "/CN=sweep",
        "-keyout",
        "ca-key.pem",
        "-out",
        "ca.pem",
    )
    openssl("req", "-newkey", "rsa:2048", "-nodes", "-subj", "/CN=host", "-keyout", "key.pem", "-out", "host.csr")
    openssl(
        "x509",
        "-req",
        "-days",
        "2",
        "-in",
        "host.csr",
        "-CA",
        "ca.pem",
        "-CAkey",
        "ca-key.pem",
        "-CAcreateserial",
        "-out",
        "host.pem",
    )
    prefix = "DASK_DISTRIBUTED__COMM__TLS__"
    roles = {
        f"{prefix}{role}__{part}": str(folder / file)
        for role in ("CLIENT", "WORKER", "SCHEDULER")
        for part, file in (("KEY", "key.pem"), ("CERT", "host.pem"))
    }
    return {f"{prefix}CA_FILE": str(folder / "ca.pem"), "DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION": "True", **roles}


@pytest.mark.skipif(shutil.which("openssl") is None, reason="there is no openssl to make certificates with")
def test_three_hosts_with_tls(network: Network, right: dict[str, bytes]) -> None:
    plain = dict(network.environment)
    network.environment |= make_certificates(network.folder)
    address = network.cluster("tls")
    finishes(network, network.sweep(address), right)
    assert "is not protected" not in network.said()
    network.environment = plain  # a stranger, without a certificate
    (network.folder / "study.zarr").rename(network.folder / "before.zarr")
    stranger = network.sweep(address)
    assert stranger.wait(timeout=60) == 2
    said = (network.folder / f"c-{len(network.started) - 1}.log").read_text()
    assert "no Dask scheduler answers" in said
    assert "DASK_DISTRIBUTED__COMM__TLS__CA_FILE" in said
    assert "Traceback" not in said
