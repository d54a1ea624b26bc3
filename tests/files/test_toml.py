"""Our own files: written so that every double comes back, and templates that read once filled in."""

import json
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import InputError, load_bicycle, load_rider
from singletrack.files.registry import templates
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_write import quantity_text, write_toml
from singletrack.library import shipped
from singletrack.library.schema import schema
from singletrack.library.template import template
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.shapes import SegmentShape
from singletrack.parameters.units import parse_quantity

SHIPPED = [("bicycle", name) for name in shipped("bicycle")] + [("rider", name) for name in shipped("rider")]
LOAD = {"bicycle": load_bicycle, "rider": load_rider}
CLASS = {"bicycle": Bicycle, "rider": Rider}


@pytest.mark.parametrize(("kind", "name"), SHIPPED)
def test_shipped_records_come_back_from_their_own_text(kind, name):
    record = LOAD[kind](name)
    back = parse_record(CLASS[kind], write_toml(record), "a.toml")
    assert back.values() == record.values()
    assert (back.name, back.description, back.source) == (record.name, record.description, record.source)
    assert getattr(back, "forward_lean_angles", {}) == getattr(record, "forward_lean_angles", {})


@settings(max_examples=200, deadline=None)
@given(st.floats(1e-6, 1.5), st.none() | st.floats(0, 1), st.sampled_from(["rad", "m", "kg*m**2", "m/s**2", "kg", ""]))
def test_any_quantity_reads_back_as_the_same_double(value, deviation, unit):
    text = quantity_text(value, deviation, unit)
    found = parse_quantity(json.loads(text), unit)
    assert (found.value, found.deviation) == (value, deviation)


@settings(deadline=None)
@given(st.text(max_size=60), st.text(max_size=60))
def test_any_name_and_description_come_back(name, description):
    printable = [text.encode("utf-8", "ignore").decode() for text in (name, description)]
    record = load_bicycle("stratos").replace(name=printable[0], description=printable[1])
    back = parse_record(Bicycle, write_toml(record), "a.toml")
    assert [back.name, back.description] == printable


def test_deviations_extras_shapes_and_lean_angles_come_back():
    shape = SegmentShape(0.43, 0.2, 0.31, 0.33)
    rider = load_rider("rider-a").replace(
        shapes={"torso": shape}, standard_deviations={"rider_mass": 0.5, "forward_lean_angle on stratos": 0.02}
    )
    back = parse_record(Rider, write_toml(rider), "a.toml")
    assert dict(back.shapes) == {"torso": shape}
    assert dict(back.standard_deviations) == dict(rider.standard_deviations)
    assert back.on(load_bicycle("stratos")).standard_deviations["forward_lean_angle"] == 0.02
    bicycle = load_bicycle("stratos").replace(extras={"v": 5.0}, standard_deviations={"trail": 0.0017})
    again = parse_record(Bicycle, write_toml(bicycle), "a.toml")
    assert dict(again.extras) == {"v": 5.0}
    assert dict(again.standard_deviations) == {"trail": 0.0017}


def test_a_batch_is_not_written():
    with pytest.raises(InputError, match="must be a single design"):
        write_toml(load_bicycle("stratos").replace(trail=[0.05, 0.06]))


def filled(kind, record):
    """Fill in a template as a person would: each question mark by a number."""
    text = template(kind)
    for name, value in record.values().items():
        number = repr(float(value)) if record.descriptions()[name].unit != "rad" else None
        degrees = quantity_text(float(value), None, "rad").strip('"').split()[0]
        text = re.sub(rf'^(?:# )?({name} = )"\?', rf'\g<1>"{number or degrees}', text, flags=re.MULTILINE)
    return text.replace('"9.81 m/s^2"', f'"{float(getattr(record, "gravity", 9.81))!r} m/s^2"')


@pytest.mark.parametrize("kind", ["bicycle", "rider"])
def test_a_filled_template_reads_as_what_was_filled_in(kind):
    record = LOAD[kind]({"bicycle": "stratos", "rider": "rider-a"}[kind])
    if kind == "rider":
        record = record.on(load_bicycle("stratos"))
    assert parse_record(CLASS[kind], filled(kind, record), "mine.toml").values() == record.values()


@pytest.mark.parametrize("kind", ["bicycle", "rider"])
def test_an_unfilled_template_says_which_line_to_fill(kind):
    first = {"bicycle": "wheel_base", "rider": "chest_circumference"}[kind]
    with pytest.raises(InputError, match=rf"mine\.toml, line \d+: {first} = '\? m' is not a number"):
        parse_record(CLASS[kind], template(kind), "mine.toml")


@pytest.mark.parametrize("kind", list(templates()))
def test_templates_are_plain_and_narrow(kind):
    text = template(kind)
    assert max(map(len, text.splitlines())) < 160
    assert all(line == line.rstrip() for line in text.splitlines())


def test_unknown_kinds_are_refused():
    for function in (template, schema):
        with pytest.raises(InputError, match="did you mean bicycle"):
            function("bicycles")


def check(value, rule, path=""):
    """Check a value against the part of JSON schema that our schemas use."""
    if "anyOf" in rule:
        assert any(passes(value, option) for option in rule["anyOf"]), (path, value)
    if "const" in rule:
        assert value == rule["const"], path
    kinds = {"object": dict, "string": str, "number": (int, float)}
    if "type" in rule:
        assert isinstance(value, kinds[rule["type"]]), (path, value)
    if "pattern" in rule:
        assert re.search(rule["pattern"], value), (path, value)
    if "exclusiveMinimum" in rule:
        assert value > rule["exclusiveMinimum"], path
    if "exclusiveMaximum" in rule:
        assert value < rule["exclusiveMaximum"], path
    if isinstance(value, dict):
        assert set(rule.get("required", ())) <= set(value), path
        extra = rule.get("additionalProperties", True)
        for key, item in value.items():
            inner = rule.get("properties", {}).get(key, extra)
            assert inner is not False, (path, key)
            if isinstance(inner, dict):
                check(item, inner, f"{path}.{key}")


def passes(value, rule):
    try:
        check(value, rule)
    except AssertionError:
        return False
    return True


@pytest.mark.parametrize(("kind", "name"), SHIPPED)
def test_the_schema_accepts_shipped_and_written_files(kind, name):
    import tomllib

    for text in (shipped(kind)[name].read_text(encoding="utf-8"), write_toml(LOAD[kind](name))):
        check(tomllib.loads(text), schema(kind))


def test_the_schema_refuses_what_the_reader_refuses():
    import tomllib

    text = write_toml(load_bicycle("stratos"))
    for old, new in (("1.037 m", "1.037 kg"), ("wheel_base", "wheelbase"), ('kind = "bicycle"', 'kind = "rider"')):
        broken = text.replace(old, new, 1)
        with pytest.raises(InputError):
            parse_record(Bicycle, broken, "a.toml")
        assert not passes(tomllib.loads(broken), schema("bicycle"))
    json.dumps(schema("bicycle"))


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("[parameters]", "[segments.neck]\ncentre = 1\n[parameters]", "unknown segment 'neck'"),
        ("[parameters]", "[segments.torso]\ncentre = 1\n[parameters]", "segments.torso lacks gyration_along"),
        ("[parameters]", "segments = 1\n[parameters]", "segments must be a table"),
        ('stratos = "63.9 deg"', 'stratos = "63.9 kg"', "no angle"),
    ],
)
def test_refusals_of_riders(old, new, says):
    text = write_toml(load_rider("rider-a"))
    assert old in text
    with pytest.raises(InputError, match=r"^a\.toml") as refusal:
        parse_record(Rider, text.replace(old, new, 1), "a.toml")
    assert says in str(refusal.value)


def test_impossible_shapes_are_refused():
    with pytest.raises(InputError, match="no square may exceed the sum of the other two"):
        SegmentShape(0.5, 0.5, 0.1, 0.1)
    with pytest.raises(InputError, match="greater than zero"):
        SegmentShape(0.5, 0.0, 0.1, 0.1)
