"""Compute, draw, write: what `singletrack reproduce` does."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from singletrack.analysis.outline import turned
from singletrack.body.skeleton import POINT_NAMES
from singletrack.control import control_summary
from singletrack.output import prepare_folder, write_whole
from singletrack.present.control import angles_figure
from singletrack.present.drawings import posture_figure
from singletrack.present.eigenvalues import eigenvalue_figure
from singletrack.present.measured import measured_figure
from singletrack.present.phasors import phasor_figure
from singletrack.present.style import figure_bytes
from singletrack.present.tables import eigenvalues_csv, write_csv
from singletrack.present.terminal import Terminal
from singletrack.reproduce.cases import SPEEDS, Case, paper_cases
from singletrack.reproduce.engines import compare_engines
from singletrack.reproduce.measured import MeasuredCase, measured_case
from singletrack.reproduce.report import Picture, html_report, markdown_report
from singletrack.reproduce.statements import Statement, check_statements

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from matplotlib.figure import Figure

__all__ = ["reproduce"]

#: The paper's figures of eigenvalues, and the case that each shows.
_EIGENVALUE_FIGURES = {
    "4a": ("stratos-rigid", "Stratos with fully rigid rider, hands free"),
    "4b": ("stratos-leaned", "Stratos with stretched arms, hands on the bar, yawing upper body"),
    "5a": ("browser-rigid", "Browser with fully rigid rider, hands free"),
    "5b": ("browser-upright", "Browser with rigid upper body, flexed arms, hands on the bar"),
    "journal-3a": ("stratos-2012-rigid", "Hybrid with fully rigid rider, hands free"),
    "journal-3b": ("stratos-2012-leaned", "Hybrid with straight arms, hands on the bar, yawing upper body"),
    "journal-5a": ("browser-2012-rigid", "City bicycle with fully rigid rider, hands free"),
    "journal-5b": ("browser-2012-upright", "City bicycle with rigid upper body, flexed arms, hands on the bar"),
}
_PHASOR_SPEED = 5.0
_FOUNDING = ("stratos", "browser")


def reproduce(output: Path) -> Path:
    """Reproduce the paper, with progress shown, and return the path of the report.

    Parameters
    ----------
    output : Path
        Folder to write to, made if it does not exist: ``report.html`` (self-contained), ``report.md``, ``figures/``
        (PNG and SVG), ``tables/`` (CSV), ``coefficients/`` (JSON).

    Raises
    ------
    InputError
        If the folder cannot be written to; nothing is computed then.
    """
    prepare_folder(output)
    columns = (TextColumn("{task.description:<34}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Terminal(stderr=True)) as progress:
        cases, measured = paper_cases(), measured_case()
        jobs = [*_drawings(cases), *_control_drawings(cases), _measured_drawing(measured)]
        task = progress.add_task("matrices, eigenvalues, statements", total=len(jobs) + 3)
        statements = check_statements(cases, measured)
        _write_tables(output, cases, statements)
        progress.update(task, advance=1, description="multibody engine")
        agreements = compare_engines(cases)
        progress.advance(task)
        pictures = []
        for picture, draw in jobs:
            progress.update(task, description=f"figure {picture.name}")
            pictures.append(_drawn(output, picture, draw))
            progress.advance(task)
        progress.update(task, description="report")
        write_whole(output / "report.md", markdown_report(cases, statements, agreements, pictures))
        write_whole(output / "report.html", html_report(cases, statements, agreements, pictures))
        progress.update(task, advance=1, description="done")
    return output / "report.html"


def _drawings(cases: dict[str, Case]) -> Iterator[tuple[Picture, Callable[[], Figure]]]:
    """Yield every figure with the call that draws it."""

    def eigenvalues(number: str) -> Callable[[], Figure]:
        name, caption = _EIGENVALUE_FIGURES[number]
        return lambda: eigenvalue_figure(cases[name].modes, cases[name].critical, caption)

    def posture(case: Case) -> Callable[[], Figure]:
        return lambda: posture_figure(case.bicycle, case.seated, case.title, turned(case.bicycle, case.seated))

    def phasors(bicycle: str) -> Callable[[], Figure]:
        rows = [
            (case.posture, case.model.modes(_PHASOR_SPEED))
            for case in cases.values()
            if case.bicycle.name == bicycle and not case.variation
        ]
        return lambda: phasor_figure(rows, 0, f"{bicycle.title()}, Rider A, at {_PHASOR_SPEED:g} m/s")

    for number, (name, caption) in _EIGENVALUE_FIGURES.items():
        yield Picture(f"figure-{number}", f"Figure {number}. {caption}.", name), eigenvalues(number)
    for case in cases.values():
        if case.bicycle.name in _FOUNDING and not case.variation:
            caption = f"{case.title}: side and top view from the skeleton points."
            yield Picture(f"posture-{case.name}", caption, case.name), posture(case)
    for bicycle in _FOUNDING:
        caption = (
            f"{bicycle.title()}: eigenmotions at {_PHASOR_SPEED:g} m/s in each posture, lean and steer as phasors."
        )
        yield Picture(f"eigenmotions-{bicycle}", caption, bicycle), phasors(bicycle)


def _control_drawings(cases: dict[str, Case]) -> Iterator[tuple[Picture, Callable[[], Figure]]]:
    """Yield the journal's figures 7 and 8: how well steer and torso torque reach the modes."""
    inputs = ("steer torque", "torso torque")
    for number, name, title in (
        ("7", "stratos-2012-leaned-leaning", "Hybrid, leaned rider with leaning torso"),
        ("8", "browser-2012-upright-leaning", "City bicycle, upright rider with leaning torso"),
    ):

        def draw(name: str = name, title: str = title) -> Figure:
            return angles_figure(control_summary(cases[name].model, SPEEDS[::20], inputs, efforts=False), title)

        yield Picture(f"figure-journal-{number}", f"Figure {number} of the journal version. {title}.", name), draw


def _measured_drawing(case: MeasuredCase) -> tuple[Picture, Callable[[], Figure]]:
    title = "Instrumented bicycle, riderless: 26 runs on the computed curves"
    caption = f"Figure 7 of Kooijman, Schwab and Meijaard (2008). {title}; a bar is as wide as the speeds of its run."
    return (
        Picture("measured-weave", caption, case.name),
        lambda: measured_figure(case.modes, case.critical, case.runs, title),
    )


def _drawn(output: Path, picture: Picture, draw: Callable[[], Figure]) -> Picture:
    figure = draw()
    contents = {kind: figure_bytes(figure, kind) for kind in ("png", "svg")}
    for kind, content in contents.items():
        write_whole(output / "figures" / f"{picture.name}.{kind}", content)
    return Picture(picture.name, picture.caption, picture.subject, contents["png"])


def _write_tables(output: Path, cases: dict[str, Case], statements: list[Statement]) -> None:
    tables = output / "tables"
    for case in cases.values():
        text = json.dumps(case.model.to_dict(), indent=1) + "\n"
        write_whole(output / "coefficients" / f"{case.name}.json", text)
        write_whole(tables / f"eigenvalues-{case.name}.csv", eigenvalues_csv(case.modes))
        if not case.variation and case.posture == "rigid":
            points = zip(range(1, 32), POINT_NAMES, case.seated.skeleton.points.tolist(), strict=True)
            rows = [[number, name, *point] for number, name, point in points]
            content = write_csv(["point", "name", "x", "y", "z"], rows)
            write_whole(tables / f"skeleton-{case.bicycle.name}.csv", content)
    write_whole(
        tables / "critical-speeds.csv",
        write_csv(
            ["case", "weave", "capsize", "stable_ranges"],
            (
                [
                    case.name,
                    " ".join(map(repr, case.critical.weave)),
                    " ".join(map(repr, case.critical.capsize)),
                    " ".join(f"{low!r}:{high!r}" for low, high in case.critical.stable_ranges),
                ]
                for case in cases.values()
            ),
        ),
    )
    write_whole(
        tables / "claims.csv",
        write_csv(
            ["section", "paper", "computed", "verdict", "note", "source"],
            (
                [
                    statement.section,
                    statement.says,
                    statement.computed,
                    statement.verdict,
                    statement.note,
                    statement.paper,
                ]
                for statement in statements
            ),
        ),
    )
