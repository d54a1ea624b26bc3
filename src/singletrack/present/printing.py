"""Records, results and measurements, printed for people to read."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rich.table import Table

from singletrack.analysis.uncertainty import linear_uncertainty
from singletrack.errors import SingletrackError
from singletrack.measuring.comparison import compare_measured
from singletrack.posture import Options
from singletrack.present.records import derived, parameter_rows, uncertain_results
from singletrack.present.terminal import Words

if TYPE_CHECKING:
    from singletrack.measuring.pendulums import Measurement
    from singletrack.parameters import Bicycle, Rider
    from singletrack.present.terminal import Terminal

__all__ = ["print_measured", "print_measured_speeds", "print_record", "print_results"]


def print_record(console: Terminal, record: Bicycle | Rider) -> None:
    """Print the parameters of a record and what follows from them alone."""
    console.print(Words(f"{record.kind} {record.name}".rstrip(), style="bold"))
    for line in (record.description, f"source: {record.source}" if record.source else ""):
        if line:
            console.print(line)
    table = Table(show_header=False, box=None, pad_edge=False)
    group = None
    for row in (*parameter_rows(record), *derived(record)):
        if row.group != group:
            group = row.group
            table.add_row(Words(f"\n{group}", style="bold"))
        table.add_row(f"  {row.name}", row.value, row.deviation, Words(row.meaning, style="dim"))
    console.print(table)
    console.print()


def print_results(console: Terminal, bicycle: Bicycle, rider: Rider | None, options: Options) -> None:
    """Print the matrices, critical speeds and stable ranges, with standard deviations where known."""
    found = uncertain_results(bicycle, rider, options if rider is not None else Options())
    who = f" with {rider.name or 'rider'}, {options.posture}" if rider is not None else ""
    console.print(Words(f"linear equations{who}", style="bold"))
    for name, matrix in found["matrices"].items():
        for i, row in enumerate(matrix):
            console.print(f"  {name if i == 0 else '':5}[{row[0]:12.6f} {row[1]:12.6f} ]")
    for kind in ("weave", "capsize"):
        speeds = [f"{v:.4f}" + ("" if s is None else f" ± {s:.2g}") + " m/s" for v, s in found[kind]]
        console.print(f"  {kind} speed: {', '.join(speeds) or 'never'}")
    ranges = [f"{low:.4f} to {high:.4f} m/s" for low, high in found["stable_ranges"]]
    console.print(f"  stable: {', '.join(ranges) or 'never'}")


def print_measured(console: Terminal, found: Measurement, other: Bicycle | None) -> None:
    """Print measured parameters, beside those of another source if given."""
    table = Table(box=None, pad_edge=False)
    for heading in ("parameter", "measured", "± sd"):
        table.add_column(heading, no_wrap=True)
    notes: list[str] = []
    agreements = {} if other is None else {a.name: a for a in compare_measured(found.bicycle, other)}
    if other is not None:
        for heading in (other.name or "other", "Δ/sd", "agrees"):
            table.add_column(Words(heading), no_wrap=True)
    for row in parameter_rows(found.bicycle):
        cells = [row.name, row.value, row.deviation.removeprefix("± ")]
        agreement = agreements.get(row.name)
        if agreement is not None:
            unit = row.value.split(" ", 1)[-1]
            factor = 180 / math.pi if unit == "deg" else 1.0
            verdict = "yes" if agreement.agrees else "no"
            if agreement.reason:
                notes.append(
                    f"({len(notes) + 1}) {row.name}: {agreement.reason.removeprefix('yes: ').removeprefix('no: ')}"
                )
                verdict += f" ({len(notes)})"
            cells += [f"{factor * agreement.other:.6g}", f"{agreement.ratio:+.2f}", verdict]
        table.add_row(*cells)
    console.print(table)
    for note in notes:
        console.print(note)


def print_measured_speeds(console: Terminal, found: Measurement) -> None:
    """Print the critical speeds with their standard deviations, from the covariance of the measurement."""
    try:
        speeds = linear_uncertainty(found.bicycle, covariance=(found.names, found.covariance)).critical_speeds()
    except SingletrackError as error:
        console.print(f"no uncertainty of the critical speeds: {error}")
        return
    for kind in ("weave", "capsize"):
        pairs = zip(getattr(speeds, kind), getattr(speeds, f"{kind}_deviation"), strict=True)
        console.print(f"{kind} speed: " + (", ".join(f"{v:.4f} ± {s:.2g} m/s" for v, s in pairs) or "never"))
