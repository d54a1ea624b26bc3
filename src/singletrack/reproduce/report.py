"""The report: one self-contained HTML file that opens offline, and the same in Markdown."""

from __future__ import annotations

import base64
import datetime as dt
from dataclasses import dataclass
from typing import TYPE_CHECKING

from jinja2 import Environment, PackageLoader, StrictUndefined

from singletrack.present.tables import critical_speeds_text
from singletrack.reproduce.statements import PAPERS
from singletrack.version import __version__

if TYPE_CHECKING:
    from collections.abc import Sequence

    from singletrack.reproduce.cases import Case
    from singletrack.reproduce.engines import Agreement
    from singletrack.reproduce.statements import Statement

__all__ = ["Picture", "html_report", "markdown_report"]

_TITLE = "Lateral dynamics of a bicycle with passive rider model: reproduced"
_INTRODUCTION = (
    "From the tape-measure data of Schwab and Kooijman's paper (Stratos and Browser) and of its journal version (hybrid"
    " and city, the same bicycles measured again) with Rider A in three postures: rigid (hands free), leaned (stretched"
    " arms, twisting torso) and upright (flexed arms). Each printed number and each sentence about eigenvalues stands "
    "beside what was computed; so does the riderless bicycle on which weave was measured."
)
_STATEMENT_HEADER = ("section", "the paper says", "computed", "verdict", "note")
_ENGINES = (
    "Each matrix is derived a second time, by the multibody engine: full nonlinear equations with every joint of the "
    "rider, hands and wheels as constraints, linearised exactly. Largest difference of an entry, relative to the "
    "matrix' largest entry; and the force of each hand on its grip at rest, which only the engine knows."
)
_AGREEMENT_HEADER = ("case", "M", "C1", "K0", "K2", "hand force, forward and down")


@dataclass(frozen=True)
class Picture:
    """A figure of the report: file name without suffix, caption, subject, PNG content."""

    name: str
    caption: str
    subject: str
    png: bytes = b""

    @property
    def base64(self) -> str:
        """The content as it stands in an HTML file."""
        return base64.b64encode(self.png).decode()


def _agreement_cells(agreement: Agreement) -> list[str]:
    force = agreement.hand_force
    hands = "hands free" if force is None else f"{force[0]:.1f} N, {force[1]:.1f} N"
    return [agreement.name, *(f"{value:.0e}" for value in agreement.differences.values()), hands]


def _summary(statements: Sequence[Statement]) -> str:
    good, partly = (
        sum(statement.verdict == verdict for statement in statements) for verdict in ("holds", "holds in part")
    )
    corrected = sum(statement.corrected for statement in statements)
    return f"{good} of {len(statements)} statements hold, {partly} hold in part" + (
        f", {corrected} was corrected by the authors." if corrected else "."
    )


def _by_paper(statements: Sequence[Statement]) -> list[tuple[str, str, list[Statement]]]:
    """Return title, summary and statements of each paper."""
    groups = [(title, [one for one in statements if one.paper == paper]) for paper, title in PAPERS.items()]
    return [(title, _summary(own), own) for title, own in groups if own]


def _made() -> str:
    today = dt.datetime.now(tz=dt.UTC).date().isoformat()
    return f"Made with singletrack {__version__} on {today}."


def _matrix_rows(case: Case) -> list[tuple[str, list[list[str]]]]:
    return [
        (name, [[f"{value + 0.0:.6f}" for value in row] for row in getattr(case.model, name).tolist()])
        for name in ("M", "C1", "K0", "K2")
    ]


def markdown_report(
    cases: dict[str, Case], statements: list[Statement], agreements: list[Agreement], pictures: list[Picture]
) -> str:
    """Return the report as Markdown; figures are linked, in ``figures/`` beside it.

    Parameters
    ----------
    cases : dict
        What was computed, by name.
    statements : list of Statement
        What the papers say, and whether it holds.
    agreements : list of Agreement
        Between the two derivations.
    pictures : list of Picture
        The figures, in order.
    """
    lines = [f"# {_TITLE}", "", _INTRODUCTION, "", _made(), "", "## The papers and the computation", ""]
    for title, summary, own in _by_paper(statements):
        lines += [f"### {title}", "", summary, "", "| " + " | ".join(_STATEMENT_HEADER) + " |"]
        lines.append("|---" * len(_STATEMENT_HEADER) + "|")
        for statement in own:
            cells = (statement.section, statement.says, statement.computed, f"**{statement.verdict}**", statement.note)
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
        lines.append("")
    lines += ["", "## Two derivations", "", _ENGINES, "", "| " + " | ".join(_AGREEMENT_HEADER) + " |"]
    lines.append("|---" * len(_AGREEMENT_HEADER) + "|")
    lines += ["| " + " | ".join(_agreement_cells(agreement)) + " |" for agreement in agreements]
    lines += ["", "## Figures", ""]
    for picture in pictures:
        lines += [f"![{picture.caption}](figures/{picture.name}.png)", "", picture.caption, ""]
    lines += ["## Matrices and critical speeds", ""]
    for case in cases.values():
        lines += [f"### {case.name}", "", "```text"]
        for name, rows in _matrix_rows(case):
            lines += [f"{name if i == 0 else '':<3} [ {row[0]:>12} {row[1]:>12} ]" for i, row in enumerate(rows)]
        lines += ["", critical_speeds_text(case.critical), "```", ""]
    return "\n".join(lines)


_TEMPLATES = Environment(
    loader=PackageLoader("singletrack.reproduce"),
    autoescape=True,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    undefined=StrictUndefined,
)


def html_report(
    cases: dict[str, Case], statements: list[Statement], agreements: list[Agreement], pictures: list[Picture]
) -> str:
    """Return the report as one HTML file with everything in it; every text is escaped.

    Parameters
    ----------
    cases : dict
        What was computed, by name.
    statements : list of Statement
        What the papers say, and whether it holds.
    agreements : list of Agreement
        Between the two derivations.
    pictures : list of Picture
        The figures, in order.
    """
    return _TEMPLATES.get_template("report.html").render(
        title=_TITLE,
        introduction=_INTRODUCTION,
        made=_made(),
        statement_header=_STATEMENT_HEADER,
        papers=_by_paper(statements),
        engines=_ENGINES,
        agreement_header=_AGREEMENT_HEADER,
        agreements=[_agreement_cells(agreement) for agreement in agreements],
        pictures=pictures,
        cases=[
            {"name": case.name, "matrices": _matrix_rows(case), "speeds": critical_speeds_text(case.critical)}
            for case in cases.values()
        ],
    )
