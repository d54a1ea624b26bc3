"""The report: one self-contained HTML file that opens offline, and the same in Markdown."""

from __future__ import annotations

import base64
import datetime as dt
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

from singletrack.present.tables import critical_speeds_text
from singletrack.version import __version__

if TYPE_CHECKING:
    from singletrack.reproduce.cases import Case
    from singletrack.reproduce.claims import Claim
    from singletrack.reproduce.engines import Agreement

__all__ = ["Picture", "html_report", "markdown_report"]

_TITLE = "Lateral dynamics of a bicycle with passive rider model: reproduced"
_INTRODUCTION = (
    "From the tape-measure data of Tables 1 to 4 of Schwab and Kooijman's paper, the Stratos and the Browser with "
    "Rider A in three postures: rigid (hands free), leaned (stretched arms, twisting torso) and upright (flexed arms). "
    "Each printed number and each sentence about eigenvalues stands beside what was computed."
)
_CLAIM_HEADER = ("section", "the paper says", "computed", "verdict", "note")
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


def _agreement_cells(agreement: Agreement) -> list[str]:
    force = agreement.hand_force
    hands = "hands free" if force is None else f"{force[0]:.1f} N, {force[1]:.1f} N"
    return [agreement.name, *(f"{value:.0e}" for value in agreement.differences.values()), hands]


def _summary(claims: list[Claim]) -> str:
    good, partly = (sum(claim.verdict == verdict for claim in claims) for verdict in ("holds", "holds in part"))
    return f"{good} of {len(claims)} statements hold, {partly} hold in part."


def _made() -> str:
    today = dt.datetime.now(tz=dt.UTC).date().isoformat()
    return f"Made with singletrack {__version__} on {today}."


def _matrix_rows(case: Case) -> list[tuple[str, list[list[str]]]]:
    return [
        (name, [[f"{value + 0.0:.6f}" for value in row] for row in getattr(case.model, name).tolist()])
        for name in ("M", "C1", "K0", "K2")
    ]


def markdown_report(
    cases: dict[str, Case], claims: list[Claim], agreements: list[Agreement], pictures: list[Picture]
) -> str:
    """Return the report as Markdown; figures are linked, in ``figures/`` beside it."""
    lines = [f"# {_TITLE}", "", _INTRODUCTION, "", _made(), "", "## The paper and the computation", ""]
    lines += [_summary(claims), "", "| " + " | ".join(_CLAIM_HEADER) + " |", "|---" * len(_CLAIM_HEADER) + "|"]
    for claim in claims:
        cells = (claim.section, claim.says, claim.computed, f"**{claim.verdict}**", claim.note)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
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


_CSS = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { border-bottom: 1px solid #ddd; padding: .35rem .6rem; text-align: left; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.holds { color: #1b6e2c; font-weight: 600; white-space: nowrap; }
.fails { color: #a33b00; font-weight: 600; white-space: nowrap; }
figure { display: inline-block; margin: 1rem 1rem 1rem 0; vertical-align: top; max-width: 33rem; }
figure img { width: 100%; }
figcaption { font-size: 13px; color: #555; }
.cases { display: flex; flex-wrap: wrap; gap: 1rem 3rem; }
pre { background: #f6f6f6; padding: .6rem; font-size: 13px; }
"""


def html_report(
    cases: dict[str, Case], claims: list[Claim], agreements: list[Agreement], pictures: list[Picture]
) -> str:
    """Return the report as one HTML file with everything in it."""
    head = f'<meta charset="utf-8"><title>{_TITLE}</title><style>{_CSS}</style>'
    parts = [
        f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>',
        f"<h1>{_TITLE}</h1>\n<p>{_INTRODUCTION}</p>\n<p>{_made()}</p>",
        f"<h2>The paper and the computation</h2>\n<p>{_summary(claims)}</p>",
        _html_claims(claims),
        f"<h2>Two derivations</h2>\n<p>{_ENGINES}</p>",
        _html_table(_AGREEMENT_HEADER, [[escape(cell) for cell in _agreement_cells(one)] for one in agreements]),
        "<h2>Figures</h2>",
        *(_html_figure(picture) for picture in pictures),
        '<h2>Matrices and critical speeds</h2>\n<div class="cases">',
        *(_html_case(case) for case in cases.values()),
        "</div></body></html>\n",
    ]
    return "\n".join(parts)


def _html_claims(claims: list[Claim]) -> str:
    rows = [
        [
            escape(claim.section),
            escape(claim.says),
            escape(claim.computed),
            f'<span class="{"holds" if claim.holds else "fails"}">{claim.verdict}</span>',
            escape(claim.note),
        ]
        for claim in claims
    ]
    return _html_table(_CLAIM_HEADER, rows)


def _html_table(header: tuple[str, ...], rows: list[list[str]]) -> str:
    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    body = "\n".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><tr>{head}</tr>\n{body}</table>"


def _html_figure(picture: Picture) -> str:
    content = base64.b64encode(picture.png).decode()
    image = f'<img alt="{escape(picture.caption)}" src="data:image/png;base64,{content}">'
    return f"<figure>{image}<figcaption>{escape(picture.caption)}</figcaption></figure>"


def _html_case(case: Case) -> str:
    rows = []
    for name, matrix in _matrix_rows(case):
        for i, row in enumerate(matrix):
            cells = "".join(f'<td class="number">{value}</td>' for value in row)
            rows.append(f"<tr><th>{name if i == 0 else ''}</th>{cells}</tr>")
    speeds = escape(critical_speeds_text(case.critical))
    return f"<section><h3>{escape(case.name)}</h3><table>{''.join(rows)}</table><pre>{speeds}</pre></section>"
