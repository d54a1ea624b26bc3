"""Every open, write, fsync and rename of a command fails once in turn: whole or not at all, and one sentence."""

from __future__ import annotations

import errno
import os
import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

from singletrack.commands import app
from singletrack.errors import InputError
from singletrack.output import write_whole
from singletrack.reproduce.cases import paper_cases
from singletrack.reproduce.measured import measured_case
from singletrack.reproduce.statements import check_statements

failing = runpy.run_path(str(Path(__file__).with_name("faults.py")))["failing"]
MUTATIONS = runpy.run_path(str(Path(__file__).parents[1] / "files" / "mutations.py"), run_name="m")
ERRORS = [errno.ENOSPC, errno.EIO, errno.EROFS]


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    (folder / "raw.txt").write_text(MUTATIONS["raw_measurements"](), encoding="utf-8")
    time = np.linspace(0, 10, 301)
    np.savetxt(folder / "swing.csv", np.stack([time, np.exp(-0.02 * time) * np.sin(4 * time)], axis=-1), delimiter=",")
    return folder


COMMANDS = {
    "convert to toml": ["convert", "stratos", "OUT/deep/er/a.toml"],
    "convert to text": ["convert", "stratos", "OUT/a.txt"],
    "convert to a parameter set": ["convert", "stratos", "OUT/a.yml"],
    "convert a rider": ["convert", "rider-a", "OUT/a.toml"],
    "template": ["template", "bicycle", "--output", "OUT/a.toml"],
    "schema": ["schema", "rider", "--output", "OUT/a.json"],
    "measure": ["measure", "IN/raw.txt", "--output", "OUT/a.toml"],
    "period": ["period", "IN/swing.csv", "--plot", "OUT/a.svg"],
}


def run(arguments, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
    with pytest.raises(SystemExit) as stop:
        app.main()
    return stop.value.code, capsys.readouterr().err


def files(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("old", [None, b"what was there before\n"], ids=["new", "over an old file"])
def test_a_failure_anywhere_leaves_all_or_nothing(name, old, inputs, tmp_path, monkeypatch, capsys):
    def prepared(number):
        folder = tmp_path / str(number)
        folder.mkdir()
        arguments = [part.replace("OUT", str(folder)).replace("IN", str(inputs)) for part in COMMANDS[name]]
        target = next(Path(part) for part in arguments if part.startswith(str(folder)))
        if old is not None:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(old)
        return folder, arguments, str(target.relative_to(folder))

    folder, arguments, target = prepared("whole")
    with failing(folder) as counter:
        assert run(arguments, monkeypatch, capsys)[0] == 0
    whole = files(folder)
    assert list(whole) == [target]
    assert {"open", "write", "fsync", "replace"} <= set(counter.made)
    before = {} if old is None else {target: old}
    for index in range(len(counter.made)):
        folder, arguments, target = prepared(index)
        with failing(folder, index, ERRORS[index % len(ERRORS)]) as counter:
            code, said = run(arguments, monkeypatch, capsys)
        (failed,) = counter.failed
        assert code == 2, failed
        assert said.count("\n") == 1, said
        assert said.startswith("singletrack: "), said
        assert "cannot be written" in said
        found = files(folder)
        # After the file is in its place, only bringing the folder to the disk can fail: the file is whole then.
        assert found in (before, whole), failed
        if found == before:
            assert [path for path in folder.rglob("*") if path.is_dir() and not any(path.iterdir())] == []


@pytest.fixture(scope="module")
def computed():
    """What the reproduction computes, once for all its runs here."""
    cases, measured = paper_cases(), measured_case()
    return cases, measured, check_statements(cases, measured)


@pytest.mark.parametrize("kind", ["open", "write", "fsync", "replace", "mkdir"])
def test_reproduce_leaves_whole_files_only(kind, computed, tmp_path, monkeypatch, capsys):
    cases, measured, statements = computed
    stubs = {"paper_cases": lambda: cases, "measured_case": lambda: measured, "compare_engines": lambda _: []}
    stubs["check_statements"] = lambda *_: statements
    drawn = ("posture_figure", "eigenvalue_figure", "phasor_figure", "measured_figure")
    stubs |= dict.fromkeys(drawn, lambda *_: None)
    stubs["figure_bytes"] = lambda *_: b"a figure"
    for name, stub in stubs.items():
        monkeypatch.setattr(f"singletrack.reproduce.run.{name}", stub)
    whole = tmp_path / "whole"
    with failing(whole) as counter:
        assert run(["reproduce", "--output", str(whole)], monkeypatch, capsys)[0] == 0
    places = [index for index, made in enumerate(counter.made) if made == kind]
    for index in {places[0], places[len(places) // 2], places[-1]}:
        folder = tmp_path / str(index)
        with failing(folder, index) as counter:
            code, said = run(["reproduce", "--output", str(folder)], monkeypatch, capsys)
        assert counter.failed == [kind]
        assert code == 2
        assert said.splitlines()[-1].startswith(f"singletrack: {folder}")
        assert "Traceback" not in said
        expected = files(whole)
        for name, content in files(folder).items():
            assert name in expected
            assert len(content) == len(expected[name]) or "report" in name


def test_interruption_leaves_nothing(tmp_path, monkeypatch):
    usual = os.write

    def interrupt(handle, data):
        usual(handle, bytes(data)[:3])
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "write", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_whole(tmp_path / "a" / "b" / "new", "content")
    assert list(tmp_path.iterdir()) == []


def test_short_writes_are_gone_on_with(tmp_path, monkeypatch):
    usual = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: usual(handle, bytes(data)[:7]))
    write_whole(tmp_path / "new", bytes(range(256)))
    assert (tmp_path / "new").read_bytes() == bytes(range(256))


def test_a_failure_of_the_device_is_one_sentence(tmp_path):
    with failing(tmp_path, 0, errno.EDQUOT), pytest.raises(InputError, match="cannot be written"):
        write_whole(tmp_path / "new", "x")
    assert list(tmp_path.iterdir()) == []
