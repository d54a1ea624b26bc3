"""Records, results and measurements, printed for people to read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table

from singletrack.present.tables import coefficients_table, critical_speeds_text
from singletrack.present.terminal import Words
from singletrack.present.words import deviation_text, quantity_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from singletrack.analysis.summary import Quantity, Results
    from singletrack.measuring.comparison import ComparedParameter
    from singletrack.parameters import Bicycle, Rider
    from singletrack.present.terminal import Terminal

__all__ = ["print_measured", "print_record", "print_results"]


def print_record(console: Terminal, record: Bicycle | Rider, derived: Iterable[Quantity]) -> None:
    """Print the parameters of a record and what follows from them alone.

    Parameters
    ----------
    console : Terminal
    record : Bicycle or Rider
    derived : iterable of Quantity
    """
    console.print(Words(f"{record.kind} {record.name}".rstrip(), style="bold"))
    for line in (record.description, f"source: {record.source}" if record.source else ""):
        if line:
            console.print(line)
    table = Table(show_header=False, box=None, pad_edge=False)
    described, values = record.descriptions(), record.values()
    rows = [
        (p.group, name, quantity_text([float(values[name])], p.unit), _deviation(record, name), p.meaning)
        for name, p in described.items()
        if name in values
    ]
    rows += [(q.group, q.name, quantity_text(q.values, q.unit), "", q.meaning) for q in derived]
    heading = None
    for group, name, value, deviation, meaning in rows:
        if group != heading:
            heading = group
            table.add_row(Words(f"\n{group}", style="bold"))
        table.add_row(f"  {name}", value, deviation, Words(meaning, style="dim"))
    console.print(table)
    console.print()


def _deviation(record: Bicycle | Rider, name: str) -> str:
    return deviation_text(record.standard_deviations.get(name), record.descriptions()[name].unit)


def print_results(console: Terminal, found: Results, title: str) -> None:
    """Print the matrices, critical speeds and stable ranges, with standard deviations where known.

    Parameters
    ----------
    console : Terminal
    found : Results
    title : str
    """
    console.print(coefficients_table(found.model, title, found.matrix_deviations))
    console.print(critical_speeds_text(found.critical, found.speed_deviations))


def print_measured(
    console: Terminal,
    measured: Bicycle,
    other_name: str = "",
    agreements: Mapping[str, ComparedParameter] | None = None,
) -> None:
    """Print measured parameters, beside those of another source if given.

    Parameters
    ----------
    console : Terminal
    measured : Bicycle
        With standard deviations.
    other_name : str
        Of the other source.
    agreements : mapping of str to ComparedParameter, optional
        By parameter.
    """
    table = Table(box=None, pad_edge=False)
    for heading in ("parameter", "measured", "± sd"):
        table.add_column(Words(heading, whole=True), no_wrap=True)
    if agreements is not None:
        for heading in (other_name or "other", "Δ/sd", "agrees"):
            table.add_column(Words(heading, whole=True), no_wrap=True)
    notes: list[str] = []
    for name, value in measured.values().items():
        unit = measured.descriptions()[name].unit
        cells = [name, quantity_text([float(value)], unit), _deviation(measured, name).removeprefix("± ")]
        agreement = (agreements or {}).get(name)
        if agreement is not None:
            verdict = "yes" if agreement.agrees else "no"
            if agreement.reason:
                reason = agreement.reason.removeprefix("yes: ").removeprefix("no: ")
                notes.append(f"({len(notes) + 1}) {name}: {reason}")
                verdict += f" ({len(notes)})"
            other = quantity_text([agreement.other], unit).partition(" ")[0]
            cells += [other, f"{agreement.ratio:+.2f}", verdict]
        table.add_row(*(Words(cell, whole=True) for cell in cells))
    console.print(table)
    for note in notes:
        console.print(note)
