"""``singletrack sweep``: a study with a progress bar."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from singletrack.commands.options import JsonOption
from singletrack.commands.printing import print_json, print_plain
from singletrack.errors import InputError
from singletrack.present.terminal import Terminal
from singletrack.sweep.chunks import layout_of
from singletrack.sweep.reading import check_sweep, is_finished
from singletrack.sweep.run import Summary, require_extra, run_sweep
from singletrack.sweep.store import in_words, refuse_existing, tidy
from singletrack.sweep.study import Study, load_study

__all__ = ["check_store", "run", "run_study"]

_MOST_LINES = 20


def run(
    study: Annotated[Path | None, typer.Argument(metavar="[STUDY]", help="A study file (TOML).")] = None,
    output: Annotated[Path | None, typer.Option(metavar="STORE", help="Zarr store to write.")] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="A running Dask scheduler; docs/howto/sweep.md tells its dangers."),
    ] = None,
    workers: Annotated[int | None, typer.Option(help="Processes on this machine; by default one a core.")] = None,
    check: Annotated[
        Path | None, typer.Option(metavar="STORE", help="Instead, compare a finished store with its checksums.")
    ] = None,
    json: JsonOption = False,
) -> None:
    """Compute many designs as a study file says, or check a store."""
    if (study is None) == (check is None):
        raise InputError("sweep: needs either a STUDY to compute or a store to --check")
    if check is not None:
        check_store(check, json=json)
    elif study is not None:
        if json:
            raise InputError("--json: is for --check; the results are in the store, for xarray")
        run_study(study, output, scheduler, workers)


def check_store(store: Path, *, json: bool = False) -> None:
    """Compare every file of a finished store with its checksum, and print how many designs are sound.

    Parameters
    ----------
    store : Path
    json : bool
        Print JSON.

    Raises
    ------
    InputError
        If there is no finished store, or a file is missing, changed, or nobody's; with a line for each.
    """
    require_extra()
    found = check_sweep(store)
    if json:
        print_json({"store": str(store)} | dataclasses.asdict(found))
    if found.damages:
        lines = "\n".join(f"  {line}" for line in found.damages[:_MOST_LINES])
        more = f"\n  and {len(found.damages) - _MOST_LINES} more" if len(found.damages) > _MOST_LINES else ""
        raise InputError(f"{store}: {len(found.damages)} of {found.files} files are damaged\n{lines}{more}")
    if not json:
        counts = ", ".join(f"{count:,} {status.replace('_', ' ')}" for status, count in found.designs.items())
        print_plain(f"{store}: all {found.files} files are as they were written; designs: {counts}")


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
    SingletrackError
        If anything about the study, the output or the scheduler is wrong, or something fails on the way.
    KeyboardInterrupt
        If interrupted, with a note on how to go on.
    """
    require_extra(scheduler)
    if workers is not None and (workers < 1 or scheduler is not None):
        raise InputError(f"--workers {workers}: must be at least 1, and is not for a --scheduler, which has its own")
    study = load_study(study_file)
    if output is None:
        output = Path.cwd() / f"{study_file.stem}.zarr"
    console = Terminal(stderr=True)
    if is_finished(study, output):
        tidy(output)
        console.print(f"{output}: exists already, and is the finished sweep of this study; nothing is left to do")
        return
    refuse_existing(output)
    if scheduler is not None and not scheduler.startswith("tls://"):
        console.print(
            f"{scheduler}: is not protected; whoever reaches it can run code as you do (docs/howto/sweep.md: TLS)"
        )
    console.print(_report(_with_progress(study, output, scheduler, workers, console), study, output))


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
    size = in_words(layout_of(study).size)
    console.print(f"{study.name}: {study.designs.count:,} designs x {problems:,} speeds, {size} in {output}")
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
    if summary.damaged:
        parts.append(f"{summary.damaged:,} chunks were damaged on the disk, and computed again")
    return "; ".join(parts)
