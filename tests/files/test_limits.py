"""No file costs more than two seconds or 300 MB, whatever it is; pipes, devices and odd names neither."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("hostile.py")
READ = {"blank.txt", "carriage.txt", "spaces.txt", "extras.toml", "description.toml", "swing.csv", "pipe that speaks"}
if os.geteuid() == 0:  # who may read everything
    READ |= {"file without permission"}


@pytest.fixture(scope="module")
def taken(tmp_path_factory):
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(tmp_path_factory.mktemp("hostile"))],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,  # far beyond what it takes: only a hang gets there
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def test_each_takes_less_than_two_seconds_of_processor_time_and_all_less_than_300_megabytes(taken):
    assert {name: file["cpu"] for name, file in taken["files"].items() if file["cpu"] > 2.0} == {}
    assert taken["megabytes"] < 300


def test_what_is_sound_in_spite_of_its_looks_is_read(taken):
    # A wave that only alternates is an oscillation too, if an odd one.
    assert {name for name, file in taken["files"].items() if file["found"] == "read"} - {"alternating.csv"} == READ


def test_refusals_are_short_sentences_without_control_characters(taken):
    for name, file in taken["files"].items():
        assert len(file["found"]) < 1500, name
        assert file["found"].isprintable(), name


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("folder", "is a directory; a file is needed"),
        ("pipe without a writer", "is empty"),
        ("pipe with a writer who says nothing", "says nothing for 1 s"),
        ("endless device", "is larger than 200 kB"),
        ("empty device", "is empty"),
        ("memory of the process", "cannot be read"),
        ("socket", "cannot be read"),
        ("link to itself", "there is no such file"),
        ("long name", "there is no such file"),
        ("deep path", "there is no such file"),
        ("name with a NUL", "there is no such file"),
        ("400000-dots.toml", "is larger than 200 kB"),
        ("dots.toml", "line 1: is not valid TOML: nested too deeply"),
        ("quoted-dots.toml", "line 1: is not valid TOML: nested too deeply"),
        ("before-empty-key.toml", "line 1: unknown entry ''"),
        ("after-empty-key.toml", "unknown bicycle parameter ''"),
        ("90000-unknown.txt", "is larger than 200 kB"),
        ("unknown.txt", "line 1: unknown symbol 'x0'"),
        ("hexadecimal.toml", "line 2: wheel_base = a whole number of 228783 digits is too large"),
        ("hexadecimal-name.toml", "line 1: name = a number of 228783 digits, must be text"),
        ("utf-16.txt", "line 1: is not UTF-8 text"),
    ],
)
def test_refusals_say_what_it_is(taken, name, says):
    assert says in taken["files"][name]["found"]
