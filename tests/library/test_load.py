"""Files: read whole, or refused with file, line, found and allowed."""

from __future__ import annotations

import pytest

from singletrack import InputError, load_bicycle, load_rider
from singletrack.library.load import override, shipped
from singletrack.library.template import template

STRATOS = shipped("bicycle")["stratos"].read_text()
RIDER = shipped("rider")["rider-a"].read_text()


@pytest.fixture
def write(tmp_path):
    def write(content, name="mine.toml"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


def test_own_file_is_read_like_the_shipped_one(write):
    mine, theirs = load_bicycle(write(STRATOS)), load_bicycle("stratos")
    assert mine.values() == theirs.values()
    assert load_rider(write(RIDER)).values() == load_rider("rider-a").values()


@pytest.mark.parametrize("kind", ["bicycle", "rider"])
def test_all_shipped_files_are_read_and_cite_a_source(kind):
    for name in shipped(kind):
        record = (load_bicycle if kind == "bicycle" else load_rider)(name)
        assert record.name == name
        assert record.source
        assert record.description


def test_uncertainties_are_kept(write):
    bicycle = load_bicycle(write(STRATOS.replace('"0.0563 m"', '"0.0563 +/- 0.0017 m"')))
    assert bicycle.standard_deviations == {"trail": 0.0017}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('trail = "0.0563 m"', 'trail = "nan m"', "line 8: trail = nan m, must be a finite number"),
        ('"7.22 kg"', '"-7.22 kg"', "rear_frame_mass = -7.22 kg, must be greater than zero"),
        ('"16.9 deg"', "16.9", "line 9: steer_axis_tilt = 16.9 rad .968.299 deg., must be between -90 and 90 deg"),
        ('"16.9 deg"', '"16.9 mm"', "line 9: steer_axis_tilt = '16.9 mm' has a unit that is no angle"),
        ('"1.037 m"', '"1.037 deg"', "line 7: wheel_base = '1.037 deg' has a unit that is no length"),
        ("wheel_base", "wheelbase", "line 7: unknown bicycle parameter 'wheelbase'; did you mean wheel_base"),
        ('trail = "0.0563 m"', "", "lacks trail"),
        ('trail = "0.0563 m"', "trail = ", "not valid TOML.*line 8"),
        ('trail = "0.0563 m"', "trail = true", "line 8: trail = True is not a number"),
        ('"0.71687 kg*m^2"', '"7.1687 kg*m^2"', "rear_frame_inertia .* is no body's"),
        ('kind = "bicycle"', 'kind = "rider"', "line 1: is a 'rider' file, must be a bicycle"),
        ('kind = "bicycle"', 'kinds = "bicycle"', "unknown entry 'kinds'; did you mean kind"),
        ("[parameters]", "", "unknown entry 'wheel_base'.*go under .parameters."),
        ('name = "stratos"', "name = 3", "name = 3, must be text"),
    ],
)
def test_wrong_values(write, old, new, message):
    assert old in STRATOS
    path = write(STRATOS.replace(old, new, 1))
    with pytest.raises(InputError, match=message) as error:
        load_bicycle(path)
    assert str(path) in str(error.value)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "is empty"),
        (b"\x89PNG\r\n\x1a\n\x00\xff", "line 1: is not UTF-8 text"),
        (b"\n\n\xff\xfe", "line 3: is not UTF-8 text"),
        (b"[parameters", "not valid TOML"),
        (b"a = " + b"[" * 20000, "not valid TOML"),
        (b'kind = "bicycle"\nparameters = 3\n', "has no .parameters."),
        (b"# " + b"x" * 1_100_000, "is larger than 200 kB"),
    ],
)
def test_files_that_are_none(write, content, message):
    path = write(content)
    with pytest.raises(InputError, match=message) as error:
        load_bicycle(path)
    assert str(path) in str(error.value)


def test_directories_and_missing_files(tmp_path):
    with pytest.raises(InputError, match="is a directory"):
        load_bicycle(tmp_path)
    with pytest.raises(InputError, match="no such file"):
        load_bicycle(tmp_path / "none.toml")
    with pytest.raises(InputError, match="unknown bicycle 'stratus'; did you mean stratos"):
        load_bicycle("stratus")
    with pytest.raises(InputError, match="unknown rider"):
        load_rider("x" * 5000)
    with pytest.raises(InputError, match="unknown bicycle"):
        load_bicycle("a\0b")


def test_overrides():
    stratos = load_bicycle("stratos")
    assert override(stratos, {"steer_axis_tilt": "18.5 deg"}).steer_axis_tilt == pytest.approx(0.32288591)
    assert override(stratos, {"trail": "60 +/- 2 mm"}).standard_deviations == {"trail": 0.002}
    for texts in ({"trail": "nan"}, {"trail": "5 kg"}, {"trial": "1"}, {"wheel_base": "-1"}):
        with pytest.raises(InputError, match=r"--set|parameter"):
            override(stratos, texts)


@pytest.mark.parametrize("kind", ["bicycle", "rider"])
def test_template_becomes_a_file_when_filled_in(write, kind):
    """Filled with the shipped values, the template is the shipped record."""
    known = load_bicycle("stratos") if kind == "bicycle" else load_rider("rider-a").on(load_bicycle("stratos"))
    lines = []
    for line in template(kind).splitlines():
        name = line.partition(" = ")[0]
        lines.append(f"{name} = {known.values()[name]!r}" if name in known.values() else line)
    loaded = (load_bicycle if kind == "bicycle" else load_rider)(write("\n".join(lines)))
    assert loaded.values() == known.values()


def test_template_unfilled_is_refused_kindly(write):
    with pytest.raises(InputError, match=r"line \d+: wheel_base = '\? m' is not a number"):
        load_bicycle(write(template("bicycle")))


def test_an_empty_name_is_not_this_folder():
    with pytest.raises(InputError, match="bicycle '': must be a name or a path"):
        load_bicycle("")
