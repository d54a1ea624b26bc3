"""Split forks: a handlebar (G) and a fork (S) of their own, in files of parameters and of measurements."""

import numpy as np
import pytest

from singletrack import InputError, load_bicycle
from singletrack.analysis.uncertainty import linear_uncertainty
from singletrack.files.measured import read_measured
from singletrack.files.text import read_bicycle_text, write_bicycle_text
from singletrack.files.text_lines import read_values
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_write import write_toml
from singletrack.measuring.geometry import steer_geometry, wheel_radius
from singletrack.measuring.measurement import measure
from singletrack.parameters import Bicycle
from singletrack.parameters.split_fork import SPLIT_SYMBOLS, WHOLE_SYMBOLS, combined

# A handlebar and a fork of round numbers, and by hand what they are together.
G = {"mG": 3.0, "xG": 0.8, "zG": -1.1, "IGxx": 0.05, "IGyy": 0.02, "IGzz": 0.06, "IGxz": 0.005}
S = {"mS": 1.0, "xS": 0.9, "zS": -0.7, "ISxx": 0.08, "ISyy": 0.09, "ISzz": 0.02, "ISxz": -0.03}
H = {"mH": 4.0, "xH": 0.825, "zH": -1.0, "IHxx": 0.25, "IHyy": 0.2375, "IHzz": 0.0875, "IHxz": -0.055}


def with_fork(*parts):
    """Return the text of the benchmark with these symbols in place of its front frame's."""
    kept = [line for line in write_bicycle_text(load_bicycle("benchmark")).splitlines() if line.split()[0] not in H]
    return "\n".join([*kept, *(f"{symbol} = {value}" for part in parts for symbol, value in part.items())]) + "\n"


def test_handlebar_and_fork_are_combined():
    assert combined(G | S) == pytest.approx(H, rel=1e-12)
    bicycle = read_bicycle_text(with_fork(G, S), "split.txt")
    whole = read_bicycle_text(with_fork(H), "whole.txt")
    assert bicycle.values() == pytest.approx(whole.values(), rel=1e-12)


def test_a_front_frame_given_too_must_be_what_they_make():
    assert read_bicycle_text(with_fork(G, S, H), "split.txt").front_frame_x == 0.825
    with pytest.raises(
        InputError, match=r"^split\.txt, line \d+: xH = 0\.83, must be 0\.825: it follows from the rest"
    ):
        read_bicycle_text(with_fork(G, S, H | {"xH": 0.83}), "split.txt")


def test_a_handlebar_without_its_fork_is_refused():
    with pytest.raises(InputError, match=r"^split\.txt: the split fork lacks mS, xS, zS"):
        read_bicycle_text(with_fork(G, H), "split.txt")


def test_parts_are_written_back_and_dropped_once_the_front_frame_is_another():
    text = with_fork(G, S)
    bicycle = read_bicycle_text(text.replace("xG = 0.8", "xG = 0.8+/-0.01"), "split.txt")
    assert "xG = 0.8+/-0.01" in write_bicycle_text(bicycle)
    assert "xG" not in write_bicycle_text(bicycle.replace(front_frame_x=0.9))
    again = parse_record(Bicycle, write_toml(bicycle), "split.toml")
    assert again.values() == bicycle.values()
    assert dict(again.extras) == dict(bicycle.extras)
    assert dict(again.standard_deviations) == dict(bicycle.standard_deviations)


def test_standard_deviations_of_the_parts_are_those_of_a_sample():
    uncertain = {"mG": 0.03, "xG": 0.004, "zS": 0.003, "ISxz": 0.001}
    text = with_fork({s: f"{v}+/-{uncertain[s]}" if s in uncertain else v for s, v in (G | S).items()})
    bicycle = read_bicycle_text(text, "split.txt")
    rng = np.random.default_rng(2)
    shaken = [
        combined({s: v + 0.01 * uncertain.get(s, 0.0) * rng.standard_normal() for s, v in (G | S).items()})
        for _ in range(2000)
    ]
    for symbol, name in zip(WHOLE_SYMBOLS, ("mass", "x", "z", "inertia_xx"), strict=False):
        sample = np.std([draw[symbol] for draw in shaken]) / 0.01
        assert bicycle.standard_deviations[f"front_frame_{name}"] == pytest.approx(sample, rel=0.06)
    assert np.isfinite(linear_uncertainty(bicycle).critical_speeds().weave_deviation).all()


def test_the_peers_split_bicycle_follows_from_its_measurements(shared_data):
    # RigidBenchmark.txt was computed from RigidMeasured.txt by the peer: heights above a table in place of wheel base
    # and head angle, several counts, a handlebar and a fork apart. All 12 digits, and its standard deviations.
    text = (shared_data / "bicycles" / "RigidMeasured.txt").read_text()
    found = read_measured(text, "RigidMeasured.txt", "intersections")
    peer = load_bicycle(shared_data / "bicycles" / "RigidBenchmark.txt")
    assert {name: found.bicycle.values()[name] for name in peer.values()} == pytest.approx(peer.values(), rel=1e-10)
    assert dict(found.bicycle.extras) == pytest.approx(dict(peer.extras), rel=1e-10)
    assert set(peer.extras) == set(SPLIT_SYMBOLS)
    assert set(found.lines) == {"rear_frame", "handlebar", "fork"}
    theirs = {name: float(sd) for name, sd in peer.standard_deviations.items()}
    ratios = {name: float(found.bicycle.standard_deviations[name]) / sd for name, sd in theirs.items() if sd > 0}
    # The peer takes the steer axis for independent of the lengths it follows from; what depends on both differs.
    on_both = {"trail", "wheel_base", "front_frame_x", "xG", "xS"}
    assert {name for name, ratio in ratios.items() if abs(ratio - 1) > 1e-3} == on_both
    assert 0.6 < ratios.pop("trail") < 0.8
    assert all(0.97 < ratio < 1.03 for ratio in ratios.values())


def test_the_trails_deviation_is_that_of_a_sample(shared_data):
    given = read_values((shared_data / "bicycles" / "RigidMeasured.txt").read_text(), "RigidMeasured.txt")
    m, deviations = given.values(), given.deviations()
    rng = np.random.default_rng(4)
    shaken = {name: value + 0.01 * deviations.get(name, 0.0) * rng.standard_normal(20_000) for name, value in m.items()}
    trail = steer_geometry(shaken, wheel_radius(shaken, "R"), wheel_radius(shaken, "F"))[2]
    found = measure(m, deviations).bicycle
    assert found.standard_deviations["trail"] == pytest.approx(trail.std() / 0.01, rel=0.03)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("h3 = ", "# h3 = ", "the measurements lacks h3"),
        ("h6 = ", "# h6 = ", "the measurements lacks h6"),
        ("mS = ", "# mS = ", "the measurements lacks mS"),
        ("aS2 = ", "# aS2 = ", "the measurements lacks aS2"),
        ("d = 0.96", "d = 0.06", r"line \d+"),
        ("h7 = ", "h7 = 9 # ", "RigidMeasured"),
    ],
)
def test_refusals_of_split_measurements(shared_data, old, new, says):
    text = (shared_data / "bicycles" / "RigidMeasured.txt").read_text()
    assert f"\n{old}" in text
    with pytest.raises(InputError, match=rf"^RigidMeasured\.txt.*{says}|^{says}"):
        read_measured(text.replace(f"\n{old}", f"\n{new}"), "RigidMeasured.txt")
