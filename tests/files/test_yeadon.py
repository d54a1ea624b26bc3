"""Yeadon's 95 measurements as segments of our rider."""

import runpy
from math import degrees, pi
from pathlib import Path

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider, multibody
from singletrack.body import rider_segments, skeleton
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_write import write_toml
from singletrack.files.yeadon import MEASUREMENTS, read_configuration, read_yeadon
from singletrack.mechanics import combine
from singletrack.parameters.rider import MASS_FRACTIONS, Rider

yeadon = pytest.importorskip("yeadon", reason="the optional package yeadon is not installed")
TEXT = runpy.run_path(str(Path(__file__).with_name("mutations.py")), run_name="m")["yeadon_measurements"]()


def test_there_are_95_measurements():
    assert len(set(MEASUREMENTS)) == 95
    assert set(MEASUREMENTS) == set(yeadon.Human.measnames)


def test_the_segments_have_the_mass_of_the_whole():
    rider = read_yeadon(TEXT, "me.txt")
    assert rider.rider_mass == pytest.approx(80.0)
    assert sum(n * getattr(rider, name) for name, n in MASS_FRACTIONS.items()) == pytest.approx(1.0)
    # The package's shared densities were left alone: without totalmass the next body has its own mass.
    free = read_yeadon(TEXT.replace("totalmass: 80", "# 80"), "me.txt").rider_mass
    assert free == pytest.approx(yeadon.Human(in_metres()).mass)


def in_metres():
    lines = [line.split(": ") for line in TEXT.splitlines()[2:]]
    return {name: 0.01 * float(value) for name, value in lines}


@pytest.mark.parametrize(
    ("segment", "of_theirs", "sign"),
    [("upper_arm", "A1", -1), ("lower_arm", "A2", -1), ("upper_leg", "J1", -1), ("lower_leg", "J2", -1)],
)
def test_limbs_have_the_packages_mass_centre_and_inertia(segment, of_theirs, sign):
    rider = read_yeadon(TEXT.replace("totalmass: 80", "# 80"), "me.txt")
    theirs = getattr(yeadon.Human(in_metres()), of_theirs)
    length, shape = getattr(rider, f"{segment}_length"), rider.shapes[segment]
    mass = getattr(rider, f"{segment}_mass_fraction") * rider.rider_mass
    assert mass == pytest.approx(theirs.mass)
    assert shape.centre * length == pytest.approx(sign * theirs.rel_center_of_mass[2, 0])
    radii = (shape.gyration_sideways, shape.gyration_across, shape.gyration_along)
    assert mass * (np.array(radii) * length) ** 2 == pytest.approx(np.diag(theirs.rel_inertia))


def test_trunk_and_head_together_are_the_packages_pelvis_thorax_and_chest_head():
    rider = read_yeadon(TEXT.replace("totalmass: 80", "# 80"), "me.txt")
    human = yeadon.Human(in_metres())
    torso, head = (getattr(rider, f"{name}_mass_fraction") * rider.rider_mass for name in ("torso", "head"))
    theirs = [human.P, human.T, human.C]
    assert torso + head == pytest.approx(sum(part.mass for part in theirs))
    moment = sum(part.mass * part.center_of_mass[2, 0] for part in theirs)
    at = rider.torso_length + rider.shapes["head"].centre * rider.head_circumference / (2 * pi)
    assert torso * rider.shapes["torso"].centre * rider.torso_length + head * at == pytest.approx(moment)


@pytest.mark.parametrize("posture", ["rigid", "leaned", "upright"])
def test_such_a_rider_takes_every_posture_and_both_derivations_agree(posture):
    bicycle, rider = load_bicycle("browser"), read_yeadon(TEXT, "me.txt", forward_lean_angle=1.35)
    closed, engine = coefficients(bicycle, rider, posture), multibody.coefficients(bicycle, rider, posture)
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_allclose(getattr(closed, name), getattr(engine, name), atol=1e-10)


def test_the_seated_rider_is_the_one_lump_of_another_program(shared_data):
    # Same measurements, seated by another program with other joints: the principal set's rider (5 digits).
    folder = shared_data / "riders"
    lean = read_configuration((folder / "JasonBrowserYeadonCFG.txt").read_text(), "cfg")
    assert degrees(lean) == pytest.approx(90 - degrees(0.175))
    rider = read_yeadon((folder / "JasonYeadonMeas.txt").read_text(), "JasonYeadonMeas.txt", lean)
    bicycle = load_bicycle("browser")
    lump = combine(list(rider_segments(rider, skeleton(bicycle, rider)).values()))
    p = load_bicycle(shared_data / "parameter_sets" / "principal-browserjason.yml").extras
    assert float(lump.mass) == pytest.approx(p["mP"])
    assert lump.centre.tolist() == pytest.approx([p["xP"], 0.0, p["zP"]], abs=0.01)
    moments = np.sort(np.linalg.eigvalsh(lump.inertia))
    theirs = np.sort([p["mP"] * p[f"kP{axes}"] ** 2 for axes in ("aa", "bb", "yy")])
    # There the hands hold a bar 0.58 m wide, here they are as far apart as the shoulders: less about the long axis.
    np.testing.assert_allclose(moments[1:], theirs[1:], rtol=0.02)
    assert 0.8 * theirs[0] < moments[0] < theirs[0]


def test_shapes_survive_our_own_file():
    rider = read_yeadon(TEXT, "me.txt", 1.3)
    back = parse_record(Rider, write_toml(rider), "me.toml")
    assert back.values() == rider.values()
    assert dict(back.shapes) == dict(rider.shapes)


def test_riders_without_shapes_are_as_before_and_scaling_scales():
    rider = read_yeadon(TEXT, "me.txt", 1.35)
    bicycle = load_bicycle("browser")
    segment = rider_segments(rider, skeleton(bicycle, rider))["right_upper_leg"]
    heavier = rider.replace(rider_mass=2 * rider.rider_mass)
    twice = rider_segments(heavier, skeleton(bicycle, heavier))["right_upper_leg"]
    np.testing.assert_allclose(twice.inertia, 2 * segment.inertia)
    np.testing.assert_allclose(twice.centre, segment.centre)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("Ls1L: 18", "Ls1L: -18", "Ls1L = -18, must be greater than zero"),
        ("Ls1L: 18", "Ls1: 18", "unknown measurement 'Ls1'; did you mean Ls1"),
        ("Ls1L: 18\n", "", "the measurements lacks Ls1L"),
        ("Ls2L: 28", "Ls2L: 8", "Ls2L = 8, must be more than Ls1L = 18"),
        ("measurementconversionfactor: 0.01", "measurementconversionfactor: 1", "must be between 0.001 and 3 m"),
        ("totalmass: 80", "totalmass: 0.08", "totalmass = 0.08 kg"),
    ],
)
def test_refusals_name_file_line_and_measurement(old, new, says):
    assert old in TEXT
    with pytest.raises(InputError, match=r"^me\.txt") as refusal:
        read_yeadon(TEXT.replace(old, new, 1), "me.txt")
    assert says in str(refusal.value)


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("twist: 0.1", "twist = 0.1 rad, must be 0"),
        ("somersault: 2", "must be between 0 and pi/2"),
        ("x: 1", "unknown"),
    ],
)
def test_configurations_that_do_not_fit_are_refused(line, says):
    base = "" if line.startswith("somersault") else "somersault: 0.2\n"
    with pytest.raises(InputError, match=r"^cfg\.txt, line \d") as refusal:
        read_configuration(f"{base}{line}\n", "cfg.txt")
    assert says in str(refusal.value)


def test_without_the_package_the_message_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "yeadon", None)
    with pytest.raises(InputError, match=r"pip install '.*\[yeadon\]'"):
        read_yeadon(TEXT, "me.txt")


def test_a_measurement_file_is_found_to_be_a_rider(tmp_path):
    path = tmp_path / "MeYeadonMeas.txt"
    path.write_text(TEXT)
    assert load_rider(path).name == "me"
    with pytest.raises(InputError, match="looks like Yeadon's 95 measurements, must be a bicycle"):
        load_bicycle(path)
