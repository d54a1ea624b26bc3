"""The paper from start to finish."""

from __future__ import annotations

import csv
import dataclasses
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from singletrack.output import write_whole
from singletrack.reproduce import report as report_module
from singletrack.reproduce import reproduce
from singletrack.reproduce.cases import paper_cases
from singletrack.reproduce.engines import compare_engines
from singletrack.reproduce.measured import measured_case
from singletrack.reproduce.statements import check_statements

EXPECTED_TO_FAIL = (
    "Stratos, leaned rider: M(2, 2)",
    "Stratos, leaned rider: g K0(2, 2)",
    "The off-diagonal terms of K0 decrease by 50 %",
    "The added mass decreases the weave frequencies",
    "The changed stiffness increases the weave frequencies",
    "Hybrid, leaned rider: M(2, 2)",
    "Hybrid, rigid rider: g K0(2, 2)",
    "They make the lean modes stable and oscillatory",
    "Hybrid with the lean freedom",
)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Two runs, for comparison."""
    runs = [tmp_path_factory.mktemp(f"run{i}") for i in range(2)]
    for folder in runs:
        reproduce(folder)
    return runs


@pytest.fixture(scope="module")
def output(folders):
    return folders[0]


def test_two_runs_write_the_same_bytes(folders):
    first, second = folders
    files = sorted(path.relative_to(first) for path in first.rglob("*") if path.is_file())
    assert files == sorted(path.relative_to(second) for path in second.rglob("*") if path.is_file())
    for name in files:
        one, other = ((folder / name).read_bytes() for folder in folders)
        assert one == other, name


FIGURES = ["4a", "4b", "5a", "5b", *(f"journal-{name}" for name in ("3a", "3b", "5a", "5b", "7", "8"))]


@pytest.mark.parametrize("name", [*(f"figure-{name}" for name in FIGURES), "measured-weave"])
def test_the_papers_figures_are_there(output, name):
    assert (output / "figures" / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert "<svg" in (output / "figures" / f"{name}.svg").read_text()


def test_drawings_of_all_postures_and_eigenmotions(output):
    names = {path.name for path in (output / "figures").iterdir()}
    for bicycle in ("stratos", "browser"):
        for kind in ("png", "svg"):
            assert f"eigenmotions-{bicycle}.{kind}" in names
            for posture in ("rigid", "leaned", "upright"):
                assert f"posture-{bicycle}-{posture}.{kind}" in names


def test_report_is_self_contained(output):
    text = (output / "report.html").read_text()
    for source in re.findall(r'(?:src|href)="([^"]*)"', text):
        assert source.startswith("data:")
    assert "http://" not in text
    assert "https://" not in text
    assert text.count("<figure>") == len(list((output / "figures").glob("*.png")))


def test_report_holds_every_statement(output):
    html, markdown = (output / "report.html").read_text(), (output / "report.md").read_text()
    for statement in check_statements(paper_cases(), measured_case()):
        assert statement.computed.replace("|", "\\|") in markdown
        assert statement.verdict in html
    for link in re.findall(r"\]\((figures/[^)]*)\)", markdown):
        assert (output / link).is_file()


def test_every_printed_number_and_sentence_has_a_verdict():
    statements = check_statements(paper_cases(), measured_case())
    printed = {
        "4.7",
        "7.9",
        "0.25",
        "0.69",
        "0.46",
        "-6.8",
        "-3.2",
        "-6.6",
        "2.3",
        "0.28",
        "-6.9",
        "4.8",
        "0.72",
        "-9.7",
    }
    assert printed <= {number for statement in statements for number in re.findall(r"= (-?[\d.]+) ", statement.says)}
    for statement in statements:
        assert statement.holds != statement.says.startswith(EXPECTED_TO_FAIL), statement


def test_tables_and_coefficients(output):
    for name, case in paper_cases().items():
        found = json.loads((output / "coefficients" / f"{name}.json").read_text())
        np.testing.assert_array_equal(found["M"], case.model.M)
        with (output / "tables" / f"eigenvalues-{name}.csv").open() as file:
            rows = list(csv.DictReader(file))
        assert len(rows) == 1001
        assert float(rows[500]["weave_1_real"]) == case.modes.eigenvalues[500, 0].real


def test_both_derivations_agree():
    for agreement in compare_engines(paper_cases()):
        assert max(agreement.differences.values()) < 1e-12
        assert (agreement.hand_force is None) == ("rigid" in agreement.name)


def test_date_is_the_only_change(monkeypatch):
    cases = paper_cases()
    statements = check_statements(cases, measured_case())
    texts = []
    for day in ("on one day", "on another day"):
        monkeypatch.setattr(report_module, "_made", lambda day=day: day)
        texts.append(report_module.html_report(cases, statements, [], []).replace(day, ""))
    assert texts[0] == texts[1]


def test_every_text_of_the_report_is_escaped_and_it_is_readable_on_a_phone():
    cases = paper_cases()
    statement = dataclasses.replace(
        check_statements(cases, measured_case())[0], says="<script>x & y</script>", note='"<b>"'
    )
    picture = report_module.Picture("a", "<img src=x>", "s", b"png")
    html = report_module.html_report(cases, [statement], [], [picture])
    assert "<script>" not in html
    assert "<img src=x>" not in html
    assert "&lt;script&gt;x &amp; y&lt;/script&gt;" in html
    assert '<meta name="viewport" content="width=device-width, initial-scale=1">' in html
    parser = HTMLParser()
    parser.feed(html)  # no unclosed quotation
    for tag in ("table", "tr", "td", "section", "figure", "div"):
        assert html.count(f"<{tag}>") + html.count(f"<{tag} ") == html.count(f"</{tag}>")


def test_files_are_written_whole_or_not_at_all(tmp_path, monkeypatch):
    target = tmp_path / "table.csv"
    write_whole(target, "old")

    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pathlib.Path.replace", fail)
    with pytest.raises(KeyboardInterrupt):
        write_whole(target, "new")
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["table.csv"]
