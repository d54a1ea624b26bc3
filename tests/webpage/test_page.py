"""The page as a file: self-contained, small, built from the sources as they are, names stay text."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

import singletrack
from singletrack import InputError, load_bicycle, load_rider
from singletrack.webpage import page
from singletrack.webpage.sources import sources_hash

ROOT = Path(__file__).parents[2]
WEB = ROOT / "web"
STATIC = Path(singletrack.__file__).parent / "webpage" / "static"
needs_sources = pytest.mark.skipif(not WEB.exists(), reason="the page's sources are not part of an installation")


def records_of(text):
    return json.loads(re.search(r'id="singletrack-data">(.*?)</script>', text, re.DOTALL)[1])


def test_the_page_is_one_small_file_without_addresses():
    text = page().text
    assert len(text.encode()) < 1_500_000
    outside = re.findall(r'(?:src|href)="(?!data:|#)([^"]+)"', text.split("<body>")[0])
    assert outside == []
    assert not re.search(r"@import|url\(\s*['\"]?http", text)


@needs_sources
def test_the_shipped_page_is_as_old_as_its_sources():
    built = (STATIC / "page.sha256").read_text().strip()
    assert built == sources_hash(WEB), "the sources of the page have changed: run `make page`"


@needs_sources
def test_programs_are_those_that_the_equations_give():
    pytest.importorskip("jax", reason="programs are traced by JAX, which is not installed")
    from singletrack.webpage.generate import manifest, programs, variants

    generated = WEB / "src" / "generated"
    made = variants()
    assert programs(made) == (generated / "programs.js").read_text(encoding="utf-8"), "run `make page`"
    assert manifest(made) == json.loads((generated / "manifest.json").read_text(encoding="utf-8")), "run `make page`"


def test_own_records_come_first_and_names_stay_text():
    name = '</script><script>alert("a")</script>'
    text = page(load_bicycle("benchmark").replace(name=name), rider=load_rider("rider-a"), posture="upright").text
    assert name not in text
    records = records_of(text)
    assert (records["bicycle"], records["rider"], records["posture"]) == (name, "rider-a", "upright")
    assert records["bicycles"][0]["values"]["trail"] == 0.08


def test_a_batch_is_refused():
    with pytest.raises(InputError, match=r"batch of shape \(2,\), must be a single design"):
        page(load_bicycle("benchmark").replace(trail=np.array([0.05, 0.06])))


def test_it_is_saved_whole_and_shown_in_notebooks(tmp_path):
    made = page()
    assert made.save(tmp_path / "a.html").read_text(encoding="utf-8") == made.text
    assert made._repr_html_().startswith("<iframe srcdoc=")
    assert singletrack.page is page


@pytest.mark.parametrize(
    ("bicycles", "rider", "posture", "said"),
    [
        (["browser"], "rider-a", "uprite", "did you mean upright"),
        (["browser"], "rider-a", "moore-2012", "unknown posture 'moore-2012'"),
        (["browser"], None, "leaned", "needs a rider"),
        (["browser", "browser"], None, None, "browser: two bicycles have this name"),
    ],
)
def test_what_the_page_cannot_show_is_refused(bicycles, rider, posture, said):
    riders = None if rider is None else load_rider(rider)
    with pytest.raises(InputError, match=said):
        page(*map(load_bicycle, bicycles), rider=riders, posture=posture)


def test_names_in_place_of_records_are_refused():
    with pytest.raises(InputError, match=r'type load_bicycle\("stratos"\)'):
        page("stratos")  # type: ignore[arg-type]


def test_a_prompt_shows_no_megabyte():
    assert len(repr(page())) < 100
