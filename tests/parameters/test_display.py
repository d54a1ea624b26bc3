"""Records at a prompt and in a notebook: short, complete, escaped."""

from __future__ import annotations

import html
from html.parser import HTMLParser

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack import load_bicycle, load_rider
from singletrack.markup import table, told

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")


class Cells(HTMLParser):
    """The texts of all cells, and the tags that are open at the end."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.open: list[str] = []
        self.texts: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, _):
        self.tags.add(tag)
        self.open.append(tag)
        if tag in {"td", "th", "caption"}:
            self.texts.append("")

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts[-1] += data


@pytest.mark.parametrize("record", [STRATOS, RIDER, RIDER.on(STRATOS), STRATOS.replace(trail=[0.05, np.nan])], ids=repr)
def test_a_line_and_a_table_of_all_parameters(record):
    assert len(repr(record)) < 160
    assert "\n" not in repr(record)
    cells = Cells(record._repr_html_())
    assert cells.open == []
    for name, description in record.descriptions().items():
        assert (name in cells.texts) == (getattr(record, name) is not None)
        assert description.meaning in cells.texts or getattr(record, name) is None


def test_a_batch_is_told_by_its_extremes():
    batch = STRATOS.replace(trail=np.array([0.05, np.nan, 0.07]))
    assert repr(batch) == (
        "<Bicycle stratos: designs of shape (3,), wheel_base 1.037 m, trail 0.05 to 0.07 m (1 not finite), "
        "steer_axis_tilt 16.9 deg>"
    )
    assert "no designs" not in repr(STRATOS.replace(trail=np.array([])))


def test_deviations_stand_beside_their_values():
    cells = Cells(STRATOS.replace(standard_deviations={"trail": 0.0017})._repr_html_())
    at = cells.texts.index("trail")
    assert cells.texts[at : at + 4] == ["trail", "c", "0.0563 m", "0.0017 m"]


@given(st.text(), st.text())
def test_names_are_data(name, description):
    page = STRATOS.replace(name=name, description=description)._repr_html_()
    cells = Cells(page)
    assert cells.open == []
    assert cells.tags == {"table", "caption", "thead", "tbody", "tr", "th", "td"}
    assert html.escape(name) in page


@given(st.lists(st.lists(st.text(), min_size=1, max_size=3), max_size=4), st.text())
def test_any_table_is_well_formed(rows, caption):
    cells = Cells(table(rows, caption=caption))
    assert cells.open == []
    assert cells.tags <= {"table", "caption", "tbody", "tr", "th", "td"}


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_read_back(number):
    assert float(told(number, 17).replace("−", "-")) == number
