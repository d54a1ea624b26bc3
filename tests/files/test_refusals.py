"""Refusals that no other test of files asks for: each with its place and what is wrong."""

import pytest

from singletrack import Bicycle, InputError, Rider, load_bicycle, load_rider
from singletrack.files.parameter_sets import read_parameter_set, write_parameter_set
from singletrack.files.principal import principal_values
from singletrack.files.registry import write_format
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_write import write_toml
from singletrack.files.yaml_text import read_mapping
from singletrack.library.load import load_any
from singletrack.measuring.measurement import measure

STRATOS, RIDER = load_bicycle("stratos"), load_rider("rider-a")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", r"^a: is empty"),
        ("- 1\n", r"line 1: found a list, must be lines"),
        ("just words\n", r"line 1: found 'just words', must be lines"),
        ("a: 1\na: 2\n", r"line 2: a is given twice \(first on line 1\)"),
        ("a: [1]\n", r"line 1: a is a list"),
        ("? [a]\n: 1\n", r"line 1: found a list or mapping as a name"),
        ("a: {b: *c}\n", r"line 1: has a YAML reference"),
        ("a: 'b\n", r"line \d: is not valid YAML"),
        ("a: \x01\n", r"line 1: is not valid YAML"),
        ("a: " + "[" * 30 + "]" * 30, r"line 1: is nested more than 20 deep"),
        ("a: " + "x" * 40_000, r"has 40003 characters, must have at most 30000"),
    ],
)
def test_yaml(text, says):
    with pytest.raises(InputError, match=says):
        read_mapping(text, "a")


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("parameterization: benchmark", "parameterization: benchmrk", "did you mean benchmark"),
        ("rider: False", "riders: False", "line 3: unknown entry 'riders'; did you mean rider"),
        ("description:", "description: {a: 1} #", "line 4: description must be text"),
        ("values:\n", "values: 3\nmore:\n", "line 5: values must be a mapping of symbols to numbers"),
        ("  c: 0.0563", "  c: {a: 1}", "c is a mapping, must be a number"),
    ],
)
def test_parameter_sets(old, new, says):
    text = write_parameter_set(STRATOS)
    assert old in text
    with pytest.raises(InputError, match=says):
        read_parameter_set(text.replace(old, new), "a.yml")


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("kHyy: ", "kHyy: -", "kHyy = -.*, must be zero or more"),
        ("mD: ", "mD: 0 # ", "mD = 0, must be greater than zero"),
        ("kHyy: ", "kHyy: 0.1+/-0.1 # ", "kHyy has a standard deviation"),
        ("zF: ", "zF: 1 # ", "zF = 1, must be -0"),
    ],
)
def test_principal_sets(old, new, says):
    text = write_parameter_set(STRATOS, "principal")
    assert old in text
    with pytest.raises(InputError, match=rf"^a\.yml, line \d+: {says}"):
        read_parameter_set(text.replace(old, new), "a.yml")


def test_parameterizations_that_are_none():
    with pytest.raises(InputError, match="did you mean principal"):
        write_parameter_set(STRATOS, "pricipal")
    with pytest.raises(InputError, match="did you mean benchmark"):
        write_format("a.yml", "bnchmark")


def test_a_principal_set_of_a_changed_bicycle_is_made_anew():
    read = read_parameter_set(write_parameter_set(STRATOS, "principal"), "a.yml")
    changed = read.replace(rear_frame_mass=9.0)
    assert principal_values(read)["mD"] == STRATOS.rear_frame_mass
    assert principal_values(changed)["mD"] == 9.0


@pytest.mark.parametrize(
    ("cls", "old", "new", "says"),
    [
        (Bicycle, 'kind = "bicycle"', "kind = 3", "line 1: is a 3 file, must be a bicycle"),
        (Bicycle, 'name = "stratos"', "name = 3", "line 2: name = 3, must be text"),
        (Bicycle, "[parameters]", "extras = 3\n[parameters]", "line 6: extras must be a table"),
        (Bicycle, "[parameters]", "[extras]\nv = 'fast'\n[parameters]", "line 7: v = 'fast' is not a number"),
        (Bicycle, "[parameters]", "wheel_base = 1\n[parameters]", "parameters go under .parameters."),
        (
            Bicycle,
            "wheel_base =",
            "head_angle =",
            r"line 7: unknown .* 'head_angle'; give steer_axis_tilt",
        ),
        (Bicycle, "wheel_base =", "rake =", "unknown bicycle parameter 'rake'; give trail = "),
        (Bicycle, "wheel_base = ", "wheel_base = " + "[" * 2000 + "#", "not valid TOML: nested too deeply"),
        (Rider, "[parameters]", "segments = 3\n[parameters]", "segments must be a table"),
        (Rider, "[parameters]", "[segments.nose]\ncentre = 1\n[parameters]", "line 6: unknown segment 'nose'"),
        (Rider, 'stratos = "63.9 deg"', 'stratos = "steep"', "forward_lean_angle = 'steep' is not a number"),
    ],
)
def test_our_own_files(cls, old, new, says):
    text = write_toml(STRATOS if cls is Bicycle else RIDER)
    assert old in text
    with pytest.raises(InputError, match=says) as refusal:
        parse_record(cls, text.replace(old, new), "a.toml")
    assert str(refusal.value).startswith("a.toml")


def test_extras_with_standard_deviations_survive():
    text = write_toml(STRATOS.replace(extras={"v": 5.0}, standard_deviations={"v": 0.25, "trail": 0.001}))
    assert 'v = "5.0 +/- 0.25"' in text
    back = parse_record(Bicycle, text, "a.toml")
    assert dict(back.extras) == {"v": 5.0}
    assert dict(back.standard_deviations) == {"v": 0.25, "trail": 0.001}


def test_batches_are_not_written():
    with pytest.raises(InputError, match=r"is a batch of shape \(2,\)"):
        write_toml(STRATOS.replace(trail=[0.05, 0.06]))


@pytest.mark.parametrize("what", [None, 5, ["stratos"], STRATOS])
def test_only_names_and_paths_are_loaded(what):
    with pytest.raises(InputError, match="must be a name or a path"):
        load_any(what)


@pytest.mark.parametrize(
    ("raw", "deviations", "says"),
    [
        ({"x": 1.0}, {}, "unknown measurement 'x'"),
        ({"w": 1.0}, {}, "the measurements lacks"),
        ({"alphaB1": 1.0}, {}, "the measurements lacks aB1, TtB1"),
    ],
)
def test_measurements_in_python(raw, deviations, says):
    with pytest.raises(InputError, match=says) as refusal:
        measure(raw, deviations)
    assert refusal.value.parameters
