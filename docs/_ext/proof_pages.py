"""Every published number that is reproduced, with its file, its digits and its source; nothing here is written by hand.

Numbers of papers come from `tests/reference` with the digits that are printed there, statements from the records behind
`singletrack reproduce`. What is computed is computed while the site is built.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from tables import escaped, table

from singletrack import coefficients, load_bicycle
from singletrack.reproduce.cases import paper_cases
from singletrack.reproduce.measured import measured_case
from singletrack.reproduce.statements import PAPERS, check_statements
from singletrack.reproduce.statements.statement import printed_number_holds

REFERENCE = Path(__file__).parents[2] / "tests" / "reference"
#: The file of a paper's printed numbers, and what its page is called.
FILES = {"founding": "paper.json", "journal": "passive2012.json", "measured": "kooijman2008.json"}
TITLES = {"founding": "The founding paper", "journal": "The journal version", "measured": "The measurement of weave"}
MATRICES = ("M", "C1", "K0", "K2")


def pages() -> dict[str, str]:
    """Return the texts of the pages by their files' names."""
    statements = check_statements(paper_cases(), measured_case())
    found = {f"statements-{paper}.md": _statements(paper, statements) for paper in PAPERS}
    return {"numbers.md": _numbers(), **found}


def read_printed(name: str) -> Any:
    """Return a file of published numbers with every number as the text that is printed."""
    text = (REFERENCE / name).read_text(encoding="utf-8")
    return json.loads(text, parse_float=str, parse_int=str)


def _statements(paper: str, everything: list[Any]) -> str:
    own = [one for one in everything if one.paper == paper]
    counts = {verdict: sum(one.verdict == verdict for one in own) for verdict in dict.fromkeys(o.verdict for o in own)}
    rows = [[one.section, one.says, one.computed, f"**{one.verdict}**", one.note] for one in own]
    lines = [
        f"# {TITLES[paper]}, statement by statement",
        "",
        f"{escaped(PAPERS[paper])}.",
        "",
        f"Printed numbers in `tests/reference/{FILES[paper]}`; statements in `singletrack/reproduce/statements/`;",
        "checked by `tests/reproduce` and `tests/reference`; `singletrack reproduce` writes the same with figures.",
        "A number *holds* where the computed one rounds to it, to the digits that are printed.",
        "",
        f"{len(own)} statements: " + ", ".join(f"{count} × {verdict}" for verdict, count in counts.items()) + ".",
        "",
        *table(["section", "the paper says", "computed", "verdict", "note"], rows, raw={3}),
    ]
    return "\n".join([*lines, ""])


def _numbers() -> str:
    benchmark, measured = read_printed("meijaard2007.json"), read_printed("kooijman2008.json")
    header = ["number", "published", "computed", "agrees to"]
    lines = [
        "# Published numbers",
        "",
        "## The benchmark bicycle",
        "",
        f"{escaped(benchmark['source'])}.",
        "File: `tests/reference/meijaard2007.json`; test: `tests/reference/test_meijaard.py`.",
        "",
        *table(header, _benchmark_rows(benchmark)),
        "",
        "## The instrumented bicycle",
        "",
        f"{escaped(measured['source'])}.",
        "File: `tests/reference/kooijman2008.json`; test: `tests/reference/test_kooijman.py`.",
        "",
        *table(header, _instrumented_rows(measured["printed"])),
        "",
    ]
    return "\n".join(lines)


def _benchmark_rows(published: dict[str, Any]) -> list[list[str]]:
    """Return a row for each number: matrices, eigenvalues at eleven speeds, critical speeds."""
    model = coefficients(load_bicycle("benchmark"))
    critical = model.critical_speeds()
    rows = [row for name in MATRICES for row in _matrix_rows(name, published[name], getattr(model, name))]
    for speed, roots in published["eigenvalues"].items():
        for printed, value in zip(roots, model.eigenvalues(float(speed))[0], strict=True):
            number = complex(float(printed[0]), float(printed[1]))
            digits = _digits(abs(number - value) / abs(number))
            text = [_complex(*printed), _complex(repr(float(value.real)), repr(float(value.imag)))]
            rows.append([f"eigenvalue at {speed} m/s, 1/s", *text, digits])
    for name, value in (("weave", critical.weave[0]), ("capsize", critical.capsize[0])):
        printed = published[f"{name}_speed"]
        rows.append([f"{name} speed, m/s", printed, repr(float(value)), _digits(abs(float(printed) / value - 1))])
    return rows


def _instrumented_rows(printed: dict[str, Any]) -> list[list[str]]:
    model = coefficients(load_bicycle("kooijman-2008"))
    critical = model.critical_speeds()
    values = {"M": model.M, "C1": model.C1, "gK0": model.gravity * model.K0, "K2": model.K2}
    rows = []
    for name, matrix in values.items():
        for i, j in np.ndindex(2, 2):
            text, value = printed[name][i][j], float(matrix[i, j])
            rows.append([f"{name}, row {i + 1}, column {j + 1}", text, f"{value:.7f}", _printed(text, value)])
    for name, value in (("weave", critical.weave[0]), ("capsize", critical.capsize[0])):
        text = printed[f"{name}_speed"]
        rows.append([f"{name} speed, m/s", text, f"{value:.4f}", _printed(text, float(value))])
    return rows


def _matrix_rows(name: str, printed: Any, computed: Any) -> list[list[str]]:
    rows = []
    for i, j in np.ndindex(2, 2):
        number, value = float(printed[i][j]), float(computed[i, j])
        difference = abs(number - value) / abs(number) if number else abs(value)
        rows.append([f"{name}, row {i + 1}, column {j + 1}", printed[i][j], repr(value), _digits(difference)])
    return rows


def _complex(real: str, imaginary: str) -> str:
    sign = "−" if imaginary.startswith("-") else "+"
    return real if float(imaginary) == 0 else f"{real} {sign} {imaginary.lstrip('-')} i"


def _digits(difference: float) -> str:
    """Return in words how many digits agree for a relative difference."""
    return "the last bit" if difference == 0 else f"{int(-np.log10(difference))} digits"


def _printed(text: str, value: float) -> str:
    digits = len(text.lstrip("-0.").replace(".", ""))
    return f"all {digits} printed" if printed_number_holds(text, value) else "does not hold"
