"""Running sweeps: results as computed directly, killed and resumed, on a cluster that loses a worker."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from singletrack import InputError, SingletrackError, coefficients, load_bicycle, load_rider
from singletrack.commands.sweep import run_study
from singletrack.sweep import chunks, load_study, open_sweep, run_sweep

pytest.importorskip("zarr")
pytest.importorskip("distributed")

if TYPE_CHECKING:
    from pathlib import Path

    from singletrack.sweep import Study

TEXT = """
name = "arms and trail"
bicycle = "browser"
rider = "rider-a"
posture = "upright"
speeds = "0:8:5"
keep = ["matrices", "eigenvalues", "critical_speeds", "stable_ranges"]
[sampling]
method = "latin-hypercube"
samples = 1500
seed = 5
[vary]
trail = { from = "30 mm", to = "80 mm" }
upper_arm_length = { from = "10 cm", to = "35 cm" }
"""
CHUNK = 64  # designs in a chunk, here: many chunks


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chunks, "_DESIGNS", CHUNK)


def make_study(folder: Path, text: str = TEXT) -> Study:
    path = folder / "study.toml"
    path.write_text(text)
    return load_study(path)


@pytest.fixture
def study(tmp_path: Path) -> Study:
    return make_study(tmp_path)


def same(one: Any, other: Any) -> None:
    assert set(one.variables) == set(other.variables)
    for name in one.variables:
        np.testing.assert_array_equal(one[name].values, other[name].values, err_msg=name)
    assert one.attrs["fault_kinds"] == other.attrs["fault_kinds"]


@pytest.fixture
def whole(study: Study, tmp_path: Path) -> Any:
    run_sweep(study, tmp_path / "whole.zarr", workers=1)
    return open_sweep(tmp_path / "whole.zarr")


def test_results_are_those_of_direct_calls(study: Study, whole: Any, tmp_path: Path) -> None:
    rows = study.designs.rows(0, study.designs.count)
    bicycle = load_bicycle("browser").replace(trail=rows[:, 0])
    rider = load_rider("rider-a").on(load_bicycle("browser")).replace(upper_arm_length=rows[:, 1])
    model = coefficients(bicycle, rider, "upright")
    valid = model.valid
    assert 100 < valid.sum() < 1400
    np.testing.assert_array_equal(whole.fault.values == 0, valid)
    np.testing.assert_allclose(whole.M.values[valid], model.M[valid], rtol=1e-12)
    np.testing.assert_allclose(whole.eigenvalues.values[valid], model.eigenvalues(study.speeds)[valid], rtol=1e-8)
    critical = model.critical_speeds()
    np.testing.assert_allclose(whole.capsize_speeds.values[valid], critical.capsize_speeds[valid], rtol=1e-8)
    np.testing.assert_allclose(whole.stable_ranges.values[valid], critical.ranges[valid], rtol=1e-8)
    assert not (tmp_path / "whole.zarr.partial").exists()


def test_the_store_is_labelled_and_says_where_it_comes_from(study: Study, whole: Any) -> None:
    assert whole.eigenvalues.dims == ("design", "speed", "root")
    assert whole.eigenvalues.attrs["units"] == "1/s"
    assert whole.trail.attrs["units"] == "m"
    assert set(whole.coords) >= {"trail", "upper_arm_length", "speed", "coordinate"}
    np.testing.assert_array_equal(whole.speed, study.speeds)
    described = json.loads(whole.attrs["study"])
    assert described["bicycle"]["wheel_base"] == study.bicycle.wheel_base
    assert described["designs"]["seed"] == 5
    assert whole.attrs["fingerprint"] == study.fingerprint


def test_faulty_designs_are_empty_and_say_why(whole: Any) -> None:
    bad = whole.fault.values > 0
    assert np.isnan(whole.eigenvalues.values[bad]).all()
    assert np.isnan(whole.M.values[bad]).all()
    assert np.isfinite(whole.M.values[~bad]).all()
    kinds = [whole.attrs["fault_kinds"][k - 1] for k in np.unique(whole.fault.values[bad])]
    assert any("the shoulder-grip distance is <distance> m" in kind for kind in kinds)


def test_a_grid_has_its_parameters_as_dimensions(tmp_path: Path) -> None:
    text = """
bicycle = "benchmark"
speeds = [2, 5]
keep = ["eigenvalues", "matrices"]
[vary]
trail = [0.06, 0.08, 0.1]
gravity = [1.62, 9.81]
"""
    run_sweep(make_study(tmp_path, text), tmp_path / "grid.zarr", workers=1)
    grid = open_sweep(tmp_path / "grid.zarr")
    assert dict(grid.eigenvalues.sizes) == {"trail": 3, "gravity": 2, "speed": 2, "root": 4}
    found = grid.eigenvalues.sel(trail=0.08, gravity=9.81, speed=5).values
    np.testing.assert_allclose(found, coefficients(load_bicycle("benchmark")).eigenvalues(5.0)[0], rtol=1e-12)
    assert grid.trail.attrs["units"] == "m"


def test_two_processes_give_the_same(study: Study, whole: Any, tmp_path: Path) -> None:
    summary = run_sweep(study, tmp_path / "two.zarr", workers=2)
    assert (summary.designs, summary.resumed) == (1500, 0)
    same(open_sweep(tmp_path / "two.zarr"), whole)


KILLABLE = """
import sys
from pathlib import Path
from singletrack.sweep import chunks, load_study, run_sweep
chunks._DESIGNS = int(sys.argv[3])
run_sweep(load_study(sys.argv[1]), Path(sys.argv[2]), workers=1)
"""


@pytest.mark.slow
def test_killed_at_any_moment_it_loses_and_repeats_nothing(study: Study, whole: Any, tmp_path: Path) -> None:
    output, partial = tmp_path / "killed.zarr", tmp_path / "killed.zarr.partial"
    journal = partial / "journal.jsonl"
    before: list[str] = []
    for wanted in (1, 6, 13):
        arguments = [sys.executable, "-c", KILLABLE, str(tmp_path / "study.toml"), str(output), str(CHUNK)]
        child = subprocess.Popen(arguments)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and child.poll() is None:
            if journal.exists() and len(journal.read_text().splitlines()) > wanted:
                break
            time.sleep(0.001)
        child.send_signal(signal.SIGKILL)
        assert child.wait() == -signal.SIGKILL
        lines = [line for line in journal.read_text().splitlines() if line.endswith("}")]
        assert lines[: len(before)] == before  # nothing lost
        before = lines
    with journal.open("a") as file:
        file.write('{"start": 9')  # a line cut short
    finished = {json.loads(line)["start"] for line in before[1:]}
    seen: list[tuple[int, int]] = []
    summary = run_sweep(study, output, workers=1, progress=lambda done, resumed: seen.append((done, resumed)))
    sizes = [min(CHUNK, 1500 - start) for start in range(0, 1500, CHUNK) if start in finished]
    assert seen[0] == (sum(sizes), sum(sizes))
    assert summary.resumed == sum(sizes)
    assert len(seen) - 1 == len(range(0, 1500, CHUNK)) - len(finished)  # nothing repeated
    same(open_sweep(output), whole)


@pytest.mark.slow
def test_a_cluster_that_loses_a_worker(study: Study, whole: Any, tmp_path: Path) -> None:
    from distributed import LocalCluster

    killed: list[int] = []
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50) as cluster:

        def progress(done: int, _resumed: int) -> None:
            if done > 700 and not killed:
                killed.append(cluster.workers[0].pid)
                os.kill(killed[0], signal.SIGKILL)

        run_sweep(study, tmp_path / "cluster.zarr", scheduler=cluster.scheduler_address, progress=progress)
    assert killed
    same(open_sweep(tmp_path / "cluster.zarr"), whole)


def test_outputs_are_not_overwritten(study: Study, whole: Any, tmp_path: Path) -> None:
    assert whole.sizes["design"] == 1500
    with pytest.raises(InputError, match=r"whole.zarr: exists already"):
        run_sweep(study, tmp_path / "whole.zarr", workers=1)


class Stop(Exception):  # noqa: N818
    """Stands for an interrupt."""


def interrupted(study: Study, output: Path) -> None:
    def progress(done: int, _resumed: int) -> None:
        if done > 200:
            raise Stop

    with pytest.raises(Stop):
        run_sweep(study, output, workers=1, progress=progress)


def test_another_study_does_not_go_on_where_one_stopped(study: Study, tmp_path: Path) -> None:
    interrupted(study, tmp_path / "out.zarr")
    other = make_study(tmp_path, TEXT.replace("seed = 5", "seed = 6"))
    with pytest.raises(InputError, match="unfinished sweep of another study"):
        run_sweep(other, tmp_path / "out.zarr", workers=1)


def test_two_sweeps_do_not_write_to_one_output(study: Study, tmp_path: Path) -> None:
    def again(_done: int, _resumed: int) -> None:
        run_sweep(study, tmp_path / "out.zarr", workers=1)

    with pytest.raises(InputError, match="another sweep is writing here"):
        run_sweep(study, tmp_path / "out.zarr", workers=1, progress=again)


def test_an_unfinished_sweep_is_not_opened(study: Study, tmp_path: Path) -> None:
    interrupted(study, tmp_path / "out.zarr")
    with pytest.raises(InputError, match="run it again to go on"):
        open_sweep(tmp_path / "out.zarr")


def test_a_scheduler_that_is_not_there(study: Study, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"--scheduler nonsense: no Dask scheduler"):
        run_sweep(study, tmp_path / "out.zarr", scheduler="nonsense")


def test_the_command_reports(study: Study, tmp_path: Path, monkeypatch: Any, capsys: Any) -> None:
    assert study.designs.count == 1500
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "300")
    run_study(tmp_path / "study.toml", workers=1)
    text = capsys.readouterr().err
    assert "1,500 designs x 5 speeds in" in text
    assert "faulty" in text
    assert open_sweep(tmp_path / "study.zarr").sizes["design"] == 1500


@pytest.mark.parametrize(("scheduler", "workers"), [(None, 0), ("tcp://localhost:1", 2)])
def test_the_command_refuses_workers(tmp_path: Path, scheduler: Any, workers: int) -> None:
    make_study(tmp_path)
    with pytest.raises(SingletrackError, match=f"--workers {workers}"):
        run_study(tmp_path / "study.toml", tmp_path / "out.zarr", scheduler, workers)
