"""Raw measurements to parameters: physics of the pendulums, published bicycles, uncertainties."""

import re
import runpy
from math import pi
from pathlib import Path

import numpy as np
import pytest

from singletrack import InputError, load_bicycle
from singletrack.files.measured import read_measured
from singletrack.library.template import template
from singletrack.measuring.comparison import compare_measured
from singletrack.measuring.pendulums import CENTRE_FITS
from singletrack.measuring.quantities import MEASURED_QUANTITIES

MUTATIONS = runpy.run_path(str(Path(__file__).parents[1] / "files" / "mutations.py"), run_name="mutations")
WHEELS_XX = {"rear_wheel_inertia_xx", "front_wheel_inertia_xx"}
MEASURED = ("Stratos", "Browser")


def swung(bicycle, alphas=((3.0, 140.0, 230.0), (347.0, 28.0, 287.0))):
    """Return what ideal pendulums would show for a known bicycle: the measuring procedure, forwards."""
    b, g, stiffness = bicycle, float(bicycle.gravity), 5.01
    rod = {"mP": 5.56, "lP": 1.05, "dP": 0.03}
    rod_inertia = rod["mP"] / 12 * (3 * (rod["dP"] / 2) ** 2 + rod["lP"] ** 2)
    tilt = float(b.steer_axis_tilt)
    torsional = lambda inertia: 2 * pi * np.sqrt(inertia / stiffness)  # noqa: E731
    compound = lambda inertia, m, l: 2 * pi * np.sqrt((inertia + m * l**2) / (m * g * l))  # noqa: E731
    raw = {**rod, "TtP1": torsional(rod_inertia), "w": b.wheel_base, "g": g, "gamma": 90 - np.degrees(tilt)}
    raw["f"] = b.front_wheel_radius * np.sin(tilt) - b.trail * np.cos(tilt)
    for end, letter in (("rear", "R"), ("front", "F")):
        mass, radius = getattr(b, f"{end}_wheel_mass"), getattr(b, f"{end}_wheel_radius")
        xx, yy = (getattr(b, f"{end}_wheel_inertia_{axes}") for axes in ("xx", "yy"))
        raw |= {f"n{letter}": 13, f"d{letter}": 13 * 2 * pi * radius, f"m{letter}": mass, f"l{letter}": 0.29}
        raw |= {f"Tt{letter}1": torsional(xx), f"Tc{letter}1": compound(yy, mass, 0.29)}
    hubs = {"B": (0.0, -b.rear_wheel_radius), "H": (b.wheel_base, -b.front_wheel_radius)}
    for (end, letter), angles in zip((("rear", "B"), ("front", "H")), alphas, strict=True):
        mass, x, z = (getattr(b, f"{end}_frame_{part}") for part in ("mass", "x", "z"))
        xx, yy, zz, xz = (getattr(b, f"{end}_frame_inertia_{axes}") for axes in ("xx", "yy", "zz", "xz"))
        dx, dz = x - hubs[letter][0], z - hubs[letter][1]
        raw |= {f"m{letter}": mass, f"Tc{letter}1": compound(yy, mass, np.hypot(dx, dz))}
        for i, alpha in enumerate(angles, start=1):
            # The vertical (down) of the hung body, in the bicycle's axes: turned about y by beta.
            beta = tilt - np.radians(alpha)
            down = np.array([np.cos(beta), -np.sin(beta)])
            raw[f"Tt{letter}{i}"] = torsional(down @ np.array([[xx, xz], [xz, zz]]) @ down)
            raw[f"alpha{letter}{i}"] = alpha
            raw[f"a{letter}{i}"] = -(np.sin(beta) * dx + np.cos(beta) * dz)
    return "\n".join(f"{name} = {float(value)!r}+/-0.001" for name, value in raw.items()) + "\n"


@pytest.mark.parametrize("fit", CENTRE_FITS)
@pytest.mark.parametrize("name", ["stratos", "browser", "benchmark"])
def test_ideal_pendulums_give_the_bicycle_back(name, fit):
    bicycle = load_bicycle(name)
    found = read_measured(swung(bicycle), "ideal.txt", fit).bicycle
    assert found.values() == pytest.approx({n: v for n, v in bicycle.values().items() if n in found.values()}, rel=1e-9)


def test_more_than_three_orientations_are_used():
    bicycle = load_bicycle("stratos")
    text = swung(bicycle, ((3.0, 140.0, 230.0, 70.0, 300.0), (347.0, 28.0, 287.0, 120.0)))
    found = read_measured(text, "ideal.txt")
    assert (len(found.lines["rear_frame"]), len(found.lines["front_frame"])) == (5, 4)
    assert found.bicycle.rear_frame_inertia_xz == pytest.approx(bicycle.rear_frame_inertia_xz, rel=1e-9)
    fewer = read_measured(swung(bicycle), "ideal.txt").bicycle.standard_deviations
    assert found.bicycle.standard_deviations["rear_frame_inertia_xz"] < fewer["rear_frame_inertia_xz"]


def test_plumb_lines_go_through_the_centre_of_mass():
    bicycle = load_bicycle("browser")
    found = read_measured(swung(bicycle), "ideal.txt")
    for end, lines in found.lines.items():
        point = np.array([getattr(bicycle, f"{end}_x"), getattr(bicycle, f"{end}_z")])
        np.testing.assert_allclose(lines[:, :2] @ point, lines[:, 2], atol=1e-12)


@pytest.mark.parametrize("fit", CENTRE_FITS)
def test_standard_deviations_are_those_of_a_sample(fit):
    text = MUTATIONS["raw_measurements"]()
    found = read_measured(text, "raw.txt", fit)
    rng = np.random.default_rng(5)

    def shaken(line):
        name, value, deviation = re.match(r"(\w+) = (.*)\+/-(.*)", line).groups()
        return f"{name} = {float(value) + 0.01 * float(deviation) * rng.standard_normal()!r}"

    lines = text.splitlines()[1:]
    draws = [read_measured("\n".join(map(shaken, lines)), "raw.txt", fit).bicycle.values() for _ in range(400)]
    names = [name for name, deviation in found.bicycle.standard_deviations.items() if deviation > 0]
    sample = np.array([[draw[name] for name in names] for draw in draws])
    expected = np.array([found.bicycle.standard_deviations[name] for name in names])
    np.testing.assert_allclose(sample.std(axis=0, ddof=1) / 0.01, expected, rtol=0.15)
    index = [found.names.index(name) for name in names]
    correlation = found.covariance[np.ix_(index, index)] / np.outer(expected, expected)
    np.testing.assert_allclose(np.corrcoef(sample.T), correlation, atol=0.25)


def test_the_peers_results_from_the_same_measurements(shared_data):
    # BrowserBenchmark.txt was computed from BrowserMeasured.txt by the peer: 12 digits, and its deviations.
    text = (shared_data / "bicycles" / "BrowserMeasured.txt").read_text()
    found = read_measured(text, "BrowserMeasured.txt", "intersections").bicycle
    peer = load_bicycle(shared_data / "bicycles" / "BrowserBenchmark.txt")
    assert {name: found.values()[name] for name in peer.values()} == pytest.approx(peer.values(), rel=1e-11)
    for name, deviation in peer.standard_deviations.items():
        assert found.standard_deviations[name] == pytest.approx(deviation, rel=1e-5), name


@pytest.mark.parametrize("name", MEASURED)
def test_measured_bicycles_agree_with_table_2(shared_data, name):
    text = (shared_data / "bicycles" / f"{name}Measured.txt").read_text()
    rows = {
        row.name: row
        for row in compare_measured(read_measured(text, f"{name}Measured.txt").bicycle, load_bicycle(name.lower()))
    }
    assert len(rows) == 26
    # The one exception: Table 2 prints each wheel's moment about a diameter under the other wheel.
    assert {parameter for parameter, row in rows.items() if not row.agrees} == WHEELS_XX
    assert all("exchanged" in rows[parameter].reason for parameter in WHEELS_XX)
    # Beyond two standard deviations, but equal to the digits printed: radii, known to 0.1 mm and printed to 1 mm.
    assert {n for n, row in rows.items() if row.agrees and abs(row.ratio) > 2} <= {
        "rear_wheel_radius",
        "front_wheel_radius",
    }


@pytest.mark.parametrize("name", MEASURED)
def test_table_2_fitted_vertical_distances(shared_data, name):
    # All eight printed coordinates of centres of mass, to their last digit.
    text = (shared_data / "bicycles" / f"{name}Measured.txt").read_text()
    found, printed = read_measured(text, f"{name}Measured.txt", "vertical").bicycle, load_bicycle(name.lower())
    for parameter in ("rear_frame_x", "rear_frame_z", "front_frame_x", "front_frame_z"):
        assert round(getattr(found, parameter), 4) == getattr(printed, parameter)


def test_the_browsers_frame_tensor_in_table_2_comes_from_another_first_period(shared_data):
    # 2.0943 s instead of 2.0996 s in the first orientation explains all three printed entries to 3e-5 kg m^2.
    text = (shared_data / "bicycles" / "BrowserMeasured.txt").read_text()
    changed = read_measured(text.replace("TtB1 = 2.09957410356", "TtB1 = 2.0943231"), "BrowserMeasured.txt").bicycle
    printed = load_bicycle("browser")
    for axes in ("xx", "zz", "xz"):
        name = f"rear_frame_inertia_{axes}"
        assert getattr(changed, name) == pytest.approx(getattr(printed, name), abs=3e-5)


@pytest.mark.parametrize("name", MEASURED)
def test_grip_measurements_give_stem_and_handlebar(shared_data, name):
    found = load_bicycle(shared_data / "bicycles" / f"{name}Measured.txt")
    assert found.missing_geometry() == ["fork_length", "front_hub_width", "rear_hub_width"]
    # The handlebar was measured again, later, than for Table 1: the same within 3 cm.
    for parameter in ("stem_length", "handlebar_length"):
        assert getattr(found, parameter) == pytest.approx(getattr(load_bicycle(name.lower()), parameter), abs=0.03)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("gamma = 72.0", "gamma = 172", "gamma = 172 deg, must be between 0 and 90"),
        ("TtB1 = 1.9", "TtB1 = -1.9", "TtB1 = -1.9 s, must be between 0"),
        ("mB = 8.0", "mB = 0", "mB = 0 kg, must be between 0"),
        ("TcB1 = 1.5", "TCB1 = 1.5", "did you mean TcB1?"),
        ("TcB1 = 1.5+/-0.001\n", "", "the measurements lacks TcB1"),
        ("alphaB1 = 10.0", "alphaB4 = 1.0\nalphaB1 = 10.0", "lacks aB4, TtB4"),
        ("TcF1 = 1.35", "TcF1 = 0.35", "TcF1: front_wheel_inertia_yy"),
        ("alphaB2 = 130.0", "alphaB2 = 10.0", "must be"),
        ("nF = 13", "nF = nan", "nF found 'nan"),
    ],
)
def test_refusals_name_file_line_measurement(old, new, says):
    text = MUTATIONS["raw_measurements"]()
    assert old in text
    with pytest.raises(InputError) as refusal:
        read_measured(text.replace(old, new, 1), "raw.txt")
    assert str(refusal.value).startswith("raw.txt")
    assert says in str(refusal.value)


def test_unknown_fits_are_refused():
    with pytest.raises(InputError, match="did you mean vertical"):
        read_measured(MUTATIONS["raw_measurements"](), "raw.txt", "verticals")


def test_the_template_of_measurements_asks_for_all_that_is_needed():
    asked = set(re.findall(r"^(\w+) = #", template("measurements"), re.MULTILINE))
    assert asked == {name for name, p in MEASURED_QUANTITIES.items() if p.needed}
