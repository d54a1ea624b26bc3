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
from singletrack.reproduce.claims import check_claims
from singletrack.reproduce.engines import compare_engines

EXPECTED_TO_FAIL = (
    "Stratos, leaned rider: M(2, 2)",
    "Stratos, leaned rider: g K0(2, 2)",
    "The off-diagonal terms of K0",
    "The added mass decreases the weave frequencies",
    "The changed stiffness increases the weave frequencies",
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


@pytest.mark.parametrize("name", ["figure-4a", "figure-4b", "figure-5a", "figure-5b"])
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


def test_report_holds_every_claim(output):
    html, markdown = (output / "report.html").read_text(), (output / "report.md").read_text()
    for claim in check_claims(paper_cases()):
        assert claim.computed.replace("|", "\\|") in markdown
        assert claim.verdict in html
    for link in re.findall(r"\]\((figures/[^)]*)\)", markdown):
        assert (output / link).is_file()


def test_every_printed_number_and_sentence_has_a_verdict():
    claims = check_claims(paper_cases())
    printed = {"4.7", "7.9", "0.25", "0.69", "0.46", "-6.8", "-3.2", "-6.6", "2.3"}
    assert printed <= {number for claim in claims for number in re.findall(r"= (-?[\d.]+) ", claim.says)}
    for claim in claims:
        assert claim.holds != claim.says.startswith(EXPECTED_TO_FAIL), claim


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
    claims = check_claims(cases)
    texts = []
    for day in ("on one day", "on another day"):
        monkeypatch.setattr(report_module, "_made", lambda day=day: day)
        texts.append(report_module.html_report(cases, claims, [], []).replace(day, ""))
    assert texts[0] == texts[1]


def test_every_text_of_the_report_is_escaped_and_it_is_readable_on_a_phone():
    cases = paper_cases()
    claim = dataclasses.replace(check_claims(cases)[0], says="<script>x & y</script>", note='"<b>"')
    picture = report_module.Picture("a", "<img src=x>", "s", b"png")
    html = report_module.html_report(cases, [claim], [], [picture])
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
