"""``singletrack sweep``: a study with a progress bar."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from singletrack.errors import InputError
from singletrack.present.terminal import Terminal
from singletrack.sweep.run import Summary, require_extra, run_sweep
from singletrack.sweep.study import Study, load_study

__all__ = ["run", "run_study"]


def run(
    study: Annotated[Path, typer.Argument(metavar="STUDY", help="A study file (TOML).")],
    output: Annotated[Path | None, typer.Option(metavar="STORE", help="Zarr store to write.")] = None,
    scheduler: Annotated[str | None, typer.Option(metavar="ADDRESS", help="A running Dask scheduler.")] = None,
    workers: Annotated[int | None, typer.Option(help="Processes on this machine; by default one a core.")] = None,
) -> None:
    """Compute many designs as a study file says."""
    run_study(study, output, scheduler, workers)


def run_study(
    study_file: Path, output: Path | None = None, scheduler: str | None = None, workers: int | None = None
) -> None:
    """Run a study file to a store, with progress, rate and time left on stderr.

    Parameters
    ----------
    study_file : Path
    output : Path, optional
        By default the study file's name with ``.zarr``, in the current folder.
    scheduler : str, optional
        Address of a Dask scheduler.
    workers : int, optional
        Processes on this machine, by default one for each core.

    Raises
    ------
    InputError
        If anything about the study, the output or the scheduler is wrong.
    KeyboardInterrupt
        If interrupted; said on stderr before, with how to go on.
    """
    require_extra()
    if workers is not None and (workers < 1 or scheduler is not None):
        raise InputError(f"--workers {workers}: must be at least 1, and is not for a --scheduler, which has its own")
    study = load_study(study_file)
    if output is None:
        output = Path.cwd() / f"{study_file.stem}.zarr"
    console = Terminal(stderr=True)
    try:
        summary = _with_progress(study, output, scheduler, workers, console)
    except KeyboardInterrupt:
        console.print(f"Interrupted. What is done is kept in {output}.partial; run the same command again to go on.")
        raise
    console.print(_report(summary, study, output))


def _with_progress(
    study: Study, output: Path, scheduler: str | None, workers: int | None, console: Terminal
) -> Summary:
    problems = len(study.speeds)
    columns = (
        BarColumn(bar_width=12),
        TaskProgressColumn(),
        TextColumn("{task.completed:,.0f} of {task.total:,.0f}"),
        TextColumn("{task.fields[rate]}"),
        TimeRemainingColumn(compact=True),
    )  # fits a terminal of 80 columns, time left included
    console.print(f"{study.name}: {study.designs.count:,} designs x {problems:,} speeds")
    with Progress(*columns, console=console) as bar:
        task = bar.add_task(study.name, total=study.designs.count, rate="")

        def progress(done: int, resumed: int) -> None:
            speed = bar.tasks[0].speed or bar.tasks[0].finished_speed
            rate = f"{speed * problems:,.0f} problems/s" if speed and done > resumed else ""
            bar.update(task, completed=done, rate=rate)

        return run_sweep(study, output, scheduler, workers, progress)


def _report(summary: Summary, study: Study, output: Path) -> str:
    parts = [f"{summary.designs:,} designs x {len(study.speeds):,} speeds in {output}"]
    if summary.resumed:
        parts.append(f"{summary.resumed:,} of them from an earlier run")
    if summary.faulty:
        parts.append(f"{summary.faulty:,} faulty (NaN; `fault` and `fault_kinds` say why)")
    return "; ".join(parts)
