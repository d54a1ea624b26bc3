"""Files of other tools: read as they are, written back to the digit."""

import re
from decimal import Decimal
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError, coefficients, load_bicycle
from singletrack.files.parameter_sets import read_parameter_set, write_parameter_set
from singletrack.files.principal import principal_values
from singletrack.files.rigid_rider import read_rigid_rider
from singletrack.files.text import read_bicycle_text, write_bicycle_text
from singletrack.files.text_lines import read_values
from singletrack.files.uncertain import format_number, parse_number
from singletrack.files.yeadon import read_configuration
from singletrack.mechanics import RigidBody, combine
from singletrack.mechanics.rigid import PlanarBody
from singletrack.parameters.bodies import with_rigid_rider
from singletrack.parameters.symbols import NAMES, SYMBOLS

NUMBER = re.compile(r"[+-]?\d+\.?\d*(?:e[+-]?\d+)?", re.IGNORECASE)


def same_record(one, other):
    assert one.values() == other.values()
    assert dict(one.standard_deviations) == dict(other.standard_deviations)
    assert dict(one.extras) == dict(other.extras)
    assert (one.name, one.description) == (other.name, other.description)


def numbers_by_symbol(text, separator):
    """Read a file with nothing but a regular expression: symbol to its number and standard deviation."""
    found = {}
    for line in text.splitlines():
        name, sign, rest = line.split("#")[0].partition(separator)
        values = NUMBER.findall(rest)
        if sign and values and re.fullmatch(r"\s*[A-Za-z]\w{0,5}\s*", name):
            found[name.strip()] = values
    return found


def assert_same_digits(original, written, separator):
    before, after = (numbers_by_symbol(text, separator) for text in (original, written))
    assert before.keys() == after.keys()
    for symbol, texts in before.items():
        assert len(texts) == len(after[symbol])
        for old, new in zip(texts, after[symbol], strict=True):
            assert float(old) == float(new)
            if len(Decimal(old).as_tuple().digits) <= 15:  # what a double holds
                assert Decimal(old) == Decimal(new), symbol


@pytest.mark.parametrize(
    "name", ["BenchmarkBenchmark.txt", "BrowserBenchmark.txt", "RigidBenchmark.txt", "TmsBenchmark.txt"]
)
def test_reading_and_writing_back_a_text_file_changes_no_digit(shared_data, name):
    text = (shared_data / "bicycles" / name).read_text()
    assert_same_digits(text, write_bicycle_text(load_bicycle(shared_data / "bicycles" / name)), "=")


@pytest.mark.parametrize("name", ["benchmark-benchmark.yml", "benchmark-browser.yml", "principal-browserjason.yml"])
def test_reading_and_writing_back_a_parameter_set_changes_no_digit(shared_data, name):
    path = shared_data / "parameter_sets" / name
    written = write_parameter_set(load_bicycle(path), name.partition("-")[0])
    assert_same_digits(path.read_text(), written, ":")
    same_record(load_bicycle(path), read_parameter_set(written, name))


def test_the_peers_benchmark_file_is_the_shipped_benchmark(shared_data):
    shipped = load_bicycle("benchmark")
    for path in ("bicycles/BenchmarkBenchmark.txt", "parameter_sets/benchmark-benchmark.yml"):
        assert load_bicycle(shared_data / path).values() == pytest.approx(shipped.values(), rel=1e-15)


def test_the_principal_set_agrees_with_bicycle_and_rider_from_other_files(shared_data):
    # The set is the Browser of BrowserBenchmark.txt (five digits) with its rider as a body of its own.
    whole = load_bicycle(shared_data / "parameter_sets" / "principal-browserjason.yml")
    alone = load_bicycle(shared_data / "bicycles" / "BrowserBenchmark.txt")
    p = whole.extras
    sin, cos = np.sin(p["alphaP"]), np.cos(p["alphaP"])
    aa, bb, yy = (p["mP"] * p[f"kP{axes}"] ** 2 for axes in ("aa", "bb", "yy"))
    tensor = np.array([[cos, sin], [-sin, cos]]) @ np.diag([aa, bb]) @ np.array([[cos, sin], [-sin, cos]]).T
    rider = PlanarBody(p["mP"], p["xP"], p["zP"], tensor[0, 0], yy, tensor[1, 1], tensor[0, 1])
    assert with_rigid_rider(alone, rider).values() == pytest.approx(whole.values(), rel=2e-4)


@pytest.mark.parametrize("name", ["benchmark", "stratos", "browser"])
@pytest.mark.parametrize("parameterization", ["benchmark", "principal"])
def test_a_parameter_set_keeps_the_equations(name, parameterization):
    bicycle = load_bicycle(name)
    back = read_parameter_set(write_parameter_set(bicycle, parameterization), f"{name}.yml")
    for one, other in zip(*(coefficients(b).matrices for b in (bicycle, back)), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13)
    assert back.gravity == bicycle.gravity


def test_principal_radii_invert_the_tensor():
    values = principal_values(load_bicycle("stratos"))
    sin, cos, mass = np.sin(values["alphaH"]), np.cos(values["alphaH"]), values["mH"]
    turned = mass * np.diag([values["kHaa"] ** 2, values["kHbb"] ** 2])
    rotation = np.array([[cos, sin], [-sin, cos]])
    np.testing.assert_allclose(rotation @ turned @ rotation.T, [[0.17684, -0.02734], [-0.02734, 0.04464]], rtol=1e-12)


deviations = st.none() | st.floats(0, 1e3)


@settings(max_examples=60, deadline=None)
@given(st.floats(0.01, 0.2), deviations, deviations, st.floats(0.01, 1.5))
def test_any_double_survives_a_text_file(trail, first, second, tilt):
    given_deviations = {"trail": first, "steer_axis_tilt": second}
    known = {name: value for name, value in given_deviations.items() if value is not None}
    bicycle = load_bicycle("stratos").replace(trail=trail, steer_axis_tilt=tilt, standard_deviations=known)
    back = read_bicycle_text(write_bicycle_text(bicycle), "stratos.txt")
    assert back.values() == bicycle.values()
    assert dict(back.standard_deviations) == known


@settings(deadline=None)
@given(st.floats(allow_nan=False, allow_infinity=False), deviations)
def test_a_number_reads_back_as_the_same_double(value, deviation):
    found = parse_number(format_number(value, deviation))
    assert (found.value, found.deviation) == (value, deviation)


def test_several_values_are_averaged():
    found = parse_number("0.1+/-0.03, 0.2+/-0.04")
    assert found.value == pytest.approx(0.15)
    assert found.deviation == pytest.approx(0.025)


def test_comments_blank_lines_and_spaces_mean_nothing():
    text = write_bicycle_text(load_bicycle("stratos"))
    loose = "# a bicycle\r\n\r\n" + text.replace(" = ", "=").replace("\n", "   # measured\r\n\r\n")
    assert read_bicycle_text(loose, "a.txt").values() == read_bicycle_text(text, "a.txt").values()


def test_symbols_are_those_of_the_field():
    assert {"w", "c", "lam", "g", "IBxz", "IFyy", "hbb", "lamst"} <= set(SYMBOLS.values())
    assert NAMES["c"] == "trail"


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("c = 0.0563", "c = ", "line {line}: c has no value"),
        ("c = 0.0563", "c = 0,0563", "line {line}: c found '0,0563', must have a decimal point"),
        ("c = 0.0563", "c = nan", "line {line}: c found 'nan', must be a finite number"),
        ("c = 0.0563", "c 0.0563", "line {line}: found 'c 0.0563', must be a line such as"),
        ("c = 0.0563", "c = 0.0563\nc = 0.06", "c is given twice (first on line {line})"),
        ("c = 0.0563", "cc = 0.0563", "line {line}: unknown symbol 'cc'"),
        ("c = 0.0563\n", "", "lacks c"),
        ("IBxx = 0.37287", "ibxx = 0.37287", "did you mean IBxx?"),
        ("mB = 7.22", "mB = -7.22", "mB: rear_frame_mass = -7.22 kg, must be greater than zero"),
        ("lam = ", "lam = 16.9 #", "must be between -90 and 90 deg"),
        ("IByy = 0.71687", "IByy = 7.1687", "IBxx: rear_frame_inertia"),
        ("g = 9.81", "g = 9.81\nyB = 0.1", "yB = 0.1, must be 0"),
    ],
)
def test_refusals_of_text_files_name_file_line_and_reason(old, new, says):
    text = write_bicycle_text(load_bicycle("stratos"))
    assert old in text
    with pytest.raises(InputError) as refusal:
        read_bicycle_text(text.replace(old, new, 1), "bike.txt")
    assert str(refusal.value).startswith("bike.txt")
    line = 1 + text.splitlines().index("c = 0.0563")
    assert says.format(line=line) in str(refusal.value)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("  c: 0.0563", "  c: x", "c found 'x'"),
        ("  c: 0.0563", "  c: [1]", "c is a list, must be one value"),
        ("  c: 0.0563", "  c: *a", "has a YAML reference"),
        ("  c: 0.0563", "  c: {", "is not valid YAML"),
        ("  c: 0.0563", "  c: &a 0.0563", "has a YAML reference"),
        ("  c: 0.0563", "  c: 0.0563\n  c: 0.06", "c is given twice"),
        ("parameterization: benchmark", "parameterization: bench", "did you mean benchmark?"),
        ("rider: False", "riders: False", "did you mean rider?"),
    ],
)
def test_refusals_of_parameter_sets_name_file_line_and_reason(old, new, says):
    text = write_parameter_set(load_bicycle("stratos"))
    assert old in text
    with pytest.raises(InputError, match=r"^set\.yml, line \d+: ") as refusal:
        read_parameter_set(text.replace(old, new, 1), "set.yml")
    assert says in str(refusal.value)


def test_a_lean_in_degrees_in_a_file_of_radians_is_refused(tmp_path):
    path = tmp_path / "bike.txt"
    path.write_text(write_bicycle_text(load_bicycle("browser")).replace("lam = 0.39968", "lam = 22.9 # 0.39968"))
    with pytest.raises(InputError, match=r"bike\.txt, line \d+: lam: steer_axis_tilt = 22\.9 rad"):
        load_bicycle(path)


def test_the_empty_template_of_others_is_refused_with_its_first_line(shared_data):
    with pytest.raises(InputError, match=r"MeasuredTemplate\.txt, line 1: dF has no value"):
        load_bicycle(shared_data / "bicycles" / "MeasuredTemplate.txt")


def test_every_bicycle_of_others_is_read_and_left_as_it_is(shared_data):
    bicycles = [*shared_data.glob("bicycles/*.txt"), *shared_data.glob("parameter_sets/*.yml")]
    read = {path.name: load_bicycle(path) for path in bicycles if path.name != "MeasuredTemplate.txt"}
    assert len(read) == 10
    for bicycle in read.values():
        assert np.linalg.eigvalsh(np.asarray(coefficients(bicycle).M)).min() > 0
    # The same Browser in two formats.
    two = [read[name] for name in ("BrowserBenchmark.txt", "benchmark-browser.yml")]
    assert two[0].values() == two[1].values()


def test_entries_know_their_lines():
    given = read_values("\n# one\na = 1\n\nb = 2+/-0.5\n", "x.txt")
    assert dict(given.lines) == {"a": 3, "b": 5}
    assert given.deviations() == {"b": 0.5}


def test_angles_in_text_files_are_radians():
    text = write_bicycle_text(load_bicycle("benchmark"))
    assert float(re.search(r"^lam = (.*)$", text, re.MULTILINE)[1]) == pi / 10


RIGID = "mB = 72.0+/-2.0\nxB = 0.3\nyB = 0.0\nzB = -1.1\nIBxx = 8.0\nIBxz = -1.9\nIByy = 8.1\nIBzz = 2.4\n"


def test_a_rigid_rider_is_lumped_as_rigid_bodies_are():
    bicycle = load_bicycle("browser")
    rider = read_rigid_rider(RIGID, "rider.txt")
    both = with_rigid_rider(bicycle, rider)

    def body(mass, x, z, xx, yy, zz, xz):
        return RigidBody(mass, np.array([x, 0.0, z]), np.array([[xx, 0, xz], [0, yy, 0], [xz, 0, zz]]))

    def frame(b):
        parts = ("mass", "x", "z", "inertia_xx", "inertia_yy", "inertia_zz", "inertia_xz")
        return body(*(getattr(b, f"rear_frame_{part}") for part in parts))

    expected = combine([frame(bicycle), body(72.0, 0.3, -1.1, 8.0, 8.1, 2.4, -1.9)])
    np.testing.assert_allclose(frame(both).centre, expected.centre)
    np.testing.assert_allclose(frame(both).inertia, expected.inertia, atol=1e-12)


def test_the_peers_rigid_rider_is_read(shared_data):
    rider = read_rigid_rider((shared_data / "riders" / "JasonBrowserBenchmark.txt").read_text(), "rider.txt")
    assert (rider.mass, rider.x, rider.z, rider.xz) == (72.0, 0.2909, -1.1091, -1.9272)
    with pytest.raises(InputError, match=r"a rigid rider or a lone body of \w+, must be a bicycle: .*--rigid-rider"):
        load_bicycle(shared_data / "riders" / "JasonBrowserBenchmark.txt")


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("mB = 72.0", "mB = -72.0", "line 1: mB = -72, must be greater than zero"),
        ("zB = -1.1", "zB = 1.1", "line 4: zB = 1.1 m, must be less than zero"),
        ("yB = 0.0", "yB = 0.1", "line 3: yB = 0.1, must be 0"),
        ("IBxz = -1.9", "IBxz = -9.9", "line 6: IBxz = -9.9 kg*m^2 is no body's"),
        ("xB = 0.3\n", "", "the rigid rider lacks xB"),
        ("IByy = 8.1", "IByy = 1.1", "line 7: IByy = 1.1 kg*m^2 is no body's"),
        ("xB = 0.3", "w = 0.3", "unknown symbol of a rigid rider 'w'"),
    ],
)
def test_refusals_of_rigid_riders(old, new, says):
    assert old in RIGID
    with pytest.raises(InputError, match=r"^rider\.txt") as refusal:
        read_rigid_rider(RIGID.replace(old, new, 1), "rider.txt")
    assert says in str(refusal.value)


@pytest.mark.parametrize("parameterization", ["benchmark", "principal"])
def test_a_steer_axis_that_leans_forward_survives_a_parameter_set(parameterization):
    bicycle = load_bicycle("stratos").replace(steer_axis_tilt=-0.1, trail=0.03)
    text = write_parameter_set(bicycle, parameterization)
    back = read_parameter_set(text, "forward.yml")
    assert back.steer_axis_tilt == -0.1
    for one, other in zip(*(coefficients(b).matrices for b in (bicycle, back)), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("parameterization", ["benchmark", "principal"])
def test_a_skate_survives_a_parameter_set(shared_data, parameterization):
    skate = load_bicycle(shared_data / "bicycles" / "TmsBenchmark.txt")
    back = read_parameter_set(write_parameter_set(skate, parameterization), "tms.yml")
    assert back.values() == skate.values()


@pytest.mark.parametrize("name", ["JasonBrowserYeadonCFG.txt", "JasonStratosYeadonCFG.txt"])
def test_configurations_of_others_are_read(shared_data, name):
    text = (shared_data / "riders" / name).read_text()
    somersault = float(re.search(r"somersault:\s*(\S+)", text)[1])
    assert read_configuration(text, name) == pytest.approx(pi / 2 - somersault, abs=1e-15)
