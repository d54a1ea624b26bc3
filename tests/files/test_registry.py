"""Formats: a new one is a record; everything finds it through the registry."""

import json

import pytest

from singletrack import Bicycle, InputError, load_bicycle
from singletrack.commands import convert
from singletrack.commands import list as listing
from singletrack.files import registry
from singletrack.files.format import Format, clues_of
from singletrack.library.load import load_any
from singletrack.library.template import template

# A format of another tool, as someone might add it: JSON.
JSON = Format(
    name="json",
    description="JSON of a tool that nobody knows",
    recognises=lambda clues: clues.suffix == ".json",
    suffixes=(".json",),
    read_bicycle=lambda text, where: Bicycle(name=where, **json.loads(text)),
    write_bicycle=lambda bicycle: json.dumps(bicycle.values()),
    losses=lambda record: ("JSON holds no name",) if record.name else (),
    templates={"json": lambda: "{}\n"},
)


@pytest.fixture
def with_json(monkeypatch):
    monkeypatch.setattr(registry, "FORMATS", (JSON, *registry.FORMATS))


@pytest.mark.usefixtures("with_json")
def test_a_new_format_is_read_written_and_offered_everywhere(tmp_path):
    path = tmp_path / "stratos.json"
    path.write_text(JSON.write(load_bicycle("stratos")))
    assert load_bicycle(path).values() == load_bicycle("stratos").values()
    assert load_any(path).kind == "bicycle"
    assert template("json") == "{}\n"
    assert registry.write_format("a.JSON") is JSON
    with pytest.raises(InputError, match=r"must be one of \.json, \.toml"):
        registry.write_format("a.xls")


@pytest.mark.usefixtures("with_json")
def test_commands_know_it_too(tmp_path, capsys):
    path = tmp_path / "stratos.json"
    convert.run("stratos", path)
    assert "JSON holds no name" in capsys.readouterr().out
    assert json.loads(path.read_text())["trail"] == 0.0563
    listing.run()
    assert "JSON of a tool that nobody knows: reads bicycle, writes bicycle (.json)" in capsys.readouterr().out


@pytest.mark.parametrize("one", registry.FORMATS, ids=lambda one: one.name)
def test_formats_are_told_apart_and_read_what_they_write(one):
    for name in ("stratos", "benchmark"):
        if one.write_bicycle and one.read_bicycle:
            bicycle = load_bicycle(name)
            text = one.write(bicycle)
            file = f"{name}{one.suffixes[0]}"
            assert registry.format_of(text, file) is one
            assert one.read_bicycle(text, file).values().keys() <= bicycle.values().keys()
    for kind, make in one.templates.items():
        where = "new.toml" if one.suffixes else "new.txt"
        assert registry.format_of(make(), where) is one, kind


def test_clues_see_names_tables_and_signs():
    clues = clues_of('# w = 1\n[parameters]\nkind = "rider" # a\nx: 1\n : 2\n2a = 3\n', "A.TOML")
    assert clues.suffix == ".toml"
    assert dict(clues.values) == {"kind": '"rider"', "x": "1"}
    assert clues.tables == {"parameters"}
    assert (clues.equals, clues.colons) == (2, 2)


@pytest.mark.parametrize(
    ("text", "lacks"),
    [
        ('kind = "rider"\n[parameters]\n', "chest_circumference"),
        ("[parameters]\nrider_mass = 72\n", "chest_circumference"),
        ("[parameters]\nwheel_base = 1\n", "trail"),
        ("w = 1", "c"),
    ],
)
def test_which_of_a_bicycle_and_a_rider_a_text_is(text, lacks):
    with pytest.raises(InputError, match=f"lacks {lacks}, "):
        registry.read_any(text, "a")


@pytest.mark.parametrize(
    ("text", "where", "says"),
    [
        ("0,1\n1,2\n", "a.csv", "looks like a recorded signal, must be a bicycle: .*`singletrack period FILE`"),
        ("somersault: 1", "a.txt", "looks like a configuration of Yeadon's human, must be a rider: .*--configuration"),
    ],
)
def test_what_is_neither_is_sent_where_it_belongs(text, where, says):
    with pytest.raises(InputError, match=says):
        (registry.read_rider if "rider" in says else registry.read_bicycle)(text, where)
