"""The sketches of what to measure: every name can be read."""

from __future__ import annotations

import itertools
import runpy
from pathlib import Path

import numpy as np
import pytest
from matplotlib.text import Text

DRAW = runpy.run_path(str(Path(__file__).parents[2] / "docs" / "draw_measuring.py"), run_name="drawing")


@pytest.mark.parametrize("name", ["bicycle", "rider", "pendulums"])
def test_names_cover_nothing(name):
    with DRAW["style"]():
        figure = DRAW[name]()
    figure.canvas.draw()
    (axes,) = figure.axes
    words = [text for text in axes.findobj(Text) if text.get_text().strip()]
    boxes = [(word.get_text(), word.get_window_extent()) for word in words]
    for (one, box), (other, other_box) in itertools.combinations(boxes, 2):
        assert not box.overlaps(other_box), (one, other)
    frame = figure.bbox
    for word, box in boxes:
        assert frame.x0 <= box.x0, word
        assert box.x1 <= frame.x1, word
        assert frame.y0 <= box.y0, word
        assert box.y1 <= frame.y1, word
        for line in axes.lines:
            ends = axes.transData.transform(np.column_stack(line.get_data()).astype(float))
            for start, end in itertools.pairwise(ends):
                points = start + np.linspace(0, 1, 200)[:, None] * (end - start)
                covered = ((points > [box.x0, box.y0 + 1]) & (points < [box.x1, box.y1 - 1])).all(axis=1)
                assert not covered.any(), (word, line.get_gid(), ends.tolist())


def test_all_that_a_template_asks_for_is_in_a_sketch():
    """Every frame length of a bicycle that a side view can show has its name in the sketch."""
    with DRAW["style"]():
        names = {text.get_text() for text in DRAW["bicycle"]().findobj(Text)}
    hidden = {"front_hub_width", "rear_hub_width", "handlebar_width"}  # across the view
    from_template = {
        name for name, p in DRAW["load_bicycle"]("browser").descriptions().items() if "frame geo" in p.group
    }
    assert from_template - hidden <= names
