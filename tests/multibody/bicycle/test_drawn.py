"""What is seen of a ride: lines that stay on their bodies, hands that stay on the bar."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from singletrack import load_bicycle, load_rider
from singletrack.multibody import bicycle_model, ride
from singletrack.multibody.bicycle.drawn import drawn_lines, placed


@pytest.mark.parametrize(("name", "posture"), [("browser", "upright"), ("stratos", "leaned"), ("browser", "rigid")])
def test_lines_move_with_their_bodies(name: str, posture: str) -> None:
    bicycle, rider = load_bicycle(name), load_rider("rider-a")
    model, lines = bicycle_model(bicycle, rider, posture), drawn_lines(bicycle, rider, posture)
    upright = ride(model, 0.0)
    turned = ride(model, 0.0, {"lean": 0.3, "steer": 0.2, "x": 2.0, "y": -1.0, "yaw": 0.4, "rear wheel": -0.7})
    places = placed(model, lines, np.array([upright.q, turned.q]))
    for line, place in zip(lines, places, strict=True):
        assert place.shape == (2, len(line.points), 3)
        np.testing.assert_allclose(place[0], line.points, atol=1e-9)
        lengths = np.linalg.norm(np.diff(place, axis=1), axis=2)  # rigid
        np.testing.assert_allclose(lengths[1], lengths[0], atol=1e-12)
    rims = [
        place[1] for line, place in zip(lines, places, strict=True) if line.part == "wheel" and len(line.points) > 2
    ]
    for rim in rims:
        assert rim[:, 2].max() == pytest.approx(0.0, abs=5e-3)  # a polygon on the ground


def test_hands_stay_on_the_bar() -> None:
    bicycle, rider = load_bicycle("browser"), load_rider("rider-a")
    model, lines = bicycle_model(bicycle, rider, "upright"), drawn_lines(bicycle, rider, "upright")
    state = ride(model, 0.0, {"lean": 0.2, "steer": 0.25})
    places: Any = dict(
        zip([(line.body, line.part) for line in lines], placed(model, lines, state.q[None]), strict=True)
    )
    bar = places["front frame", "front"][0]
    along = (bar[1] - bar[0]) / np.linalg.norm(bar[1] - bar[0])
    for side in ("right", "left"):
        hand = places[f"{side} elbow link", "rider"][0, -1]
        off = (hand - bar[0]) - along * ((hand - bar[0]) @ along)
        assert np.linalg.norm(off) < 1e-9
