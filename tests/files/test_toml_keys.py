"""Where keys stand, and how deep they go: told without a parser, in one pass."""

import tomllib
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from singletrack.files.toml_keys import line_of_deep_key, place_of, place_of_any

BARE = st.text("abcXYZ019_-", min_size=1, max_size=8)
QUOTED = st.text('aé"\\ #=.[]\t', max_size=8)
VALUES = st.sampled_from(
    ["1", '"a = 1 # b"', "'x = 2'", '"""\nq = 3\n"""', "'''\nq = 4\\'''", "[1,\n 2]", "1.5", '"\\"q = 5"']
)


def written(name, bare):
    """Return a key as TOML."""
    escaped = name.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t")
    return name if bare else f'"{escaped}"'


@given(st.lists(st.tuples(BARE | QUOTED, VALUES, st.sampled_from(["", "  ", "# c = 1\n", "\n\n"])), max_size=8))
def test_every_key_is_found_on_its_line(rows):
    lines: list[str] = []
    expected: dict[str, Any] = {}
    for name, value, before in rows:
        if name in expected:
            continue
        text = "".join(lines) + before
        bare = name != "" and all(c in "abcXYZ019_-" for c in name)
        expected[name] = text.count("\n") + 1
        lines.append(f"{before}{written(name, bare)} = {value} # q = 6\n")
    text = "".join(lines)
    assert set(tomllib.loads(text)) == set(expected)
    for name, line in expected.items():
        assert place_of("f.toml", text, name) == f"f.toml, line {line}"
    assert place_of("f.toml", text, "q") == "f.toml"


@pytest.mark.parametrize(
    ("text", "name", "line"),
    [
        ("[parameters]\ntrail = 1\n", "parameters", 1),
        ("[segments.torso]\ncentre = 1\n", "torso", 1),
        ("a.b.c = 1\n", "b", 1),
        ("x = 1\nlean = {\n stratos = 1 }\n", "stratos", 3),
        ('x = 1\n"" = 2\n', "", 2),
        ("x = 1\n'a b' = 2\n", "a b", 2),
        ("# trail = 1\ntrail = 2\n", "trail", 2),
        ("source = 'trail = 1'\ntrail = 2\n", "trail", 2),
        ("trail_x = 1\ntrail = 2\n", "trail", 2),
        ("x = 1\r\ntrail = 2\r\n", "trail", 2),
    ],
)
def test_tables_dotted_keys_and_inline_tables(text, name, line):
    assert place_of("f.toml", text, name) == f"f.toml, line {line}"


def test_of_several_names_the_first_that_is_set():
    text = "a = 1\nb = 2\n"
    assert place_of_any("f.toml", text, ["x", "b", "a"]) == "f.toml, line 2"
    assert place_of_any("f.toml", text, ["x"]) == "f.toml"
    assert place_of_any("f.toml", text, []) == "f.toml"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a.b.c = 1\n", None),
        ("x = [" + "1.5, " * 100 + "]\n", None),
        ('x = "' + "a." * 100 + '"\n', None),
        ("# " + "a." * 100 + "\n", None),
        ("x = '''\n" + "a." * 100 + "\n'''\n", None),
        ("x = 1\n" + "a." * 16 + "a = 1\n", 2),
        ("x = 1\n[" + "a . " * 16 + "a]\n", 2),
        ("x = '''\n\n'''\n" + '"a".' * 16 + "a = 1\n", 4),
        ("x = {" + "a." * 20 + "a = 1}\n", 1),
    ],
)
def test_deep_keys_are_told_from_decimal_points_texts_and_comments(text, line):
    assert line_of_deep_key(text) == line
