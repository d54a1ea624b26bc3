"""Every file of a store damaged in five ways: refused or computed again, never a wrong number."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

pytest.importorskip("zarr")

from singletrack import InputError
from singletrack.commands.sweep import run
from singletrack.sweep import check_sweep, designs_to_dicts, durable, open_sweep, run_sweep
from singletrack.sweep.store import Store
from sweep_helpers import CHUNK, SMALL, chunks_of, files_of, in_turn, interrupted, small_study

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from singletrack.sweep import Study

TEXT = SMALL.replace('"matrices", "eigenvalues", ', "")


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(durable.os, "fsync", lambda _handle: None)  # nothing is lost here by a power cut
    with chunks_of(CHUNK):
        yield


@pytest.fixture
def study(tmp_path: Path) -> Study:
    return small_study(tmp_path, TEXT)


@pytest.fixture
def store(study: Study, tmp_path: Path) -> Path:
    run_sweep(study, tmp_path / "whole.zarr", workers=1)
    return tmp_path / "whole.zarr"


def truncate(path: Path, _others: list[Path]) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def flip(path: Path, _others: list[Path]) -> None:
    content = bytearray(path.read_bytes())
    if content:
        content[len(content) * 2 // 3] ^= 0x10
    path.write_bytes(content)


def zero(path: Path, _others: list[Path]) -> None:
    path.write_bytes(bytes(path.stat().st_size))


def replace(path: Path, others: list[Path]) -> None:
    """Put another file of the same folder there, one that differs, or any other."""
    different = [other for other in others if other.read_bytes() != path.read_bytes()]
    beside = [other for other in different if other.parent == path.parent and other.name[0] != "."]
    path.write_bytes((beside or different)[0].read_bytes())


DAMAGES: dict[str, Callable[[Path, list[Path]], None]] = {
    "deleted": lambda path, _others: path.unlink(),
    "truncated": truncate,
    "flipped": flip,
    "zeroed": zero,
    "replaced": replace,
}


def values_of(dataset: Any) -> dict[str, Any]:
    return {name: dataset[name].values for name in dataset.variables} | {"attributes": json.dumps(dataset.attrs)}


def is_told(store: Path, name: str) -> bool:
    """Return whether the check names a damaged file, or refuses its list."""
    try:
        found = check_sweep(store).damages
    except InputError as error:
        return name in str(error)
    return any(line.startswith(name) for line in found) or (name == "SHA256SUMS" and found != ())


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_finished_store_gives_its_numbers_or_an_error(store: Path, damage: str) -> None:
    right = values_of(open_sweep(store))
    paths = sorted(path for path in store.rglob("*") if path.is_file())
    assert len(paths) > 40
    unread: list[str] = []
    for path in paths:
        content = path.read_bytes()
        DAMAGES[damage](path, paths)
        if path.exists() and path.read_bytes() == content:  # zeros were zeroed
            continue
        name = path.relative_to(store).as_posix()
        assert is_told(store, name), name
        try:
            found = values_of(open_sweep(store))
        except InputError:
            pass  # told
        else:  # a file that is not needed for the numbers, such as what .zmetadata repeats
            unread.append(name)
            np.testing.assert_equal(found, right)
        path.write_bytes(content)
    np.testing.assert_equal(values_of(open_sweep(store)), right)
    parameters = ("trail/", "upper_arm_length/")  # of a grid, whose axes are in the attributes
    assert all(".z" in name or name.startswith(parameters) for name in unread)


def test_a_file_that_nobody_knows(store: Path) -> None:
    (store / "trail" / "9").write_bytes(b"what is this")
    assert check_sweep(store).damages == ("trail/9 is not in the list of checksums",)


@pytest.mark.parametrize("damage", DAMAGES)
def test_an_unfinished_store_is_mended_or_refused(study: Study, store: Path, tmp_path: Path, damage: str) -> None:
    right = files_of(store)
    output, kept = tmp_path / "out.zarr", tmp_path / "kept"
    interrupted(study, output, 2 * CHUNK)
    partial = tmp_path / "out.zarr.partial"
    shutil.copytree(partial, kept)
    names = [path.relative_to(partial) for path in sorted(partial.rglob("*")) if path.is_file()]
    refused = []
    for name in [Path("journal.jsonl"), *(names[i] for i in in_turn(len(names), damage))]:
        DAMAGES[damage](partial / name, [partial / other for other in names])
        try:
            summary = run_sweep(study, output, workers=1)
        except InputError as error:
            assert "journal" in str(error)  # noqa: PT017
            refused.append(name.name)
        else:
            assert files_of(output) == right
            assert summary.damaged <= 1
            assert not partial.exists()
            shutil.rmtree(output)
        shutil.rmtree(partial, ignore_errors=True)
        shutil.copytree(kept, partial)
    assert set(refused) <= {"journal.jsonl"}


def test_damaged_chunks_are_counted(study: Study, tmp_path: Path) -> None:
    output = tmp_path / "out.zarr"
    interrupted(study, output, 2 * CHUNK)
    flip(tmp_path / "out.zarr.partial" / "data.zarr" / "weave_speeds" / "1.0", [])
    summary = run_sweep(study, output, workers=1)
    assert (summary.resumed, summary.damaged) == (CHUNK, 1)


JOURNALS = {
    "a number": lambda lines: [*lines, b"5"],
    "a word for a start": lambda lines: [*lines, b'{"start": "x"}'],
    "another program's line": lambda lines: [*lines, b'{"start": 14, "sums": {}, "faults": {}}'],
    "a null": lambda lines: [lines[0], b"null", *lines[1:]],
    "a list": lambda lines: [*lines, b'[{"start": 7}]'],
    "no text": lambda lines: [*lines, b"\xff\xfe\x00\x01"],
    "deeply nested": lambda lines: [*lines, b"[" * 100_000],
    "many digits": lambda lines: [*lines, b'{"start": ' + b"9" * 10_000 + b"}"],
    "blank lines": lambda lines: [b"", *lines, b"", b" "],
    "carriage returns": lambda lines: [line + b"\r" for line in lines],
    "the same line twice": lambda lines: [*lines, lines[1]],
    "the order turned": lambda lines: [lines[0], *reversed(lines[1:])],
    "cut short": lambda lines: [*lines[:-1], lines[-1][:-20]],
}
REFUSED = {
    "no first line": lambda lines: lines[1:],
    "a bad first line": lambda lines: [lines[0].replace(b"browser", b"stratos"), *lines[1:]],
    "five alone": lambda _lines: [b"5"],
    "utf-16": lambda lines: [b"\n".join(lines).decode().encode("utf-16")],
    "latin letters": lambda _lines: ["Öhrchen".encode("latin-1")],
    "version 0.1": lambda _lines: [b'{"study": "0123"}', b'{"start": 0, "faults": {}}'],
}


@pytest.mark.parametrize("what", [*JOURNALS, *REFUSED])
def test_a_journal_with(study: Study, store: Path, tmp_path: Path, what: str) -> None:
    output = tmp_path / "out.zarr"
    interrupted(study, output, 2 * CHUNK)
    journal = tmp_path / "out.zarr.partial" / "journal.jsonl"
    lines = journal.read_bytes().strip().split(b"\n")
    assert len(lines) == 3
    journal.write_bytes(b"\n".join({**JOURNALS, **REFUSED}[what](lines)) + b"\n")
    if what in REFUSED:
        with pytest.raises(InputError, match=r"does not say which study .* remove that folder"):
            run_sweep(study, output, workers=1)
        assert journal.exists()
        return
    run_sweep(study, output, workers=1)
    assert files_of(output) == files_of(store)


@pytest.mark.parametrize("content", [b"", b"\n", b'{"study": "12', b'\n{"study": "12'])
def test_a_journal_that_was_only_begun(study: Study, store: Path, tmp_path: Path, content: bytes) -> None:
    partial = tmp_path / "out.zarr.partial"
    partial.mkdir()
    (partial / "journal.jsonl").write_bytes(content)
    run_sweep(study, tmp_path / "out.zarr", workers=1)
    assert files_of(tmp_path / "out.zarr") == files_of(store)


def test_what_a_kill_at_the_very_end_leaves_is_tidied(study: Study, store: Path, tmp_path: Path, capsys: Any) -> None:
    interrupted(study, tmp_path / "out.zarr", CHUNK)
    partial = tmp_path / "out.zarr.partial"
    shutil.rmtree(partial / "data.zarr")  # moved to its place, by another name here
    store.rename(tmp_path / "out.zarr")
    run(tmp_path / "study.toml", tmp_path / "out.zarr")
    assert "is the finished sweep" in " ".join(capsys.readouterr().err.split())
    assert not partial.exists()
    assert check_sweep(tmp_path / "out.zarr").damages == ()


@pytest.mark.parametrize("what", ["a file", "a link"])
def test_something_else_where_the_sweep_is_collected(study: Study, tmp_path: Path, what: str) -> None:
    partial = tmp_path / "out.zarr.partial"
    if what == "a file":
        partial.write_text("mine")
    else:
        (tmp_path / "elsewhere").mkdir()
        partial.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="is not a folder"):
        run_sweep(study, tmp_path / "out.zarr", workers=1)
    assert partial.is_symlink() or partial.read_text() == "mine"


def test_not_computed_never_and_faulty_are_three_things(study: Study, store: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.zarr"
    interrupted(study, output, CHUNK)
    part = open_sweep(output, unfinished=True)
    whole = open_sweep(store)
    status = whole.weave_status.values.ravel()
    assert set(status) == {1, 2, 3}  # found, never, faulty
    np.testing.assert_array_equal(part.weave_status, np.where(np.arange(20) < CHUNK, status, 0))
    assert part.weave_status.attrs["flag_meanings"].split() == [
        "not_computed",
        "found",
        "never",
        "faulty",
        "could_not_tell",
    ]
    assert part.status.attrs["flag_meanings"].split() == ["not_computed", "computed", "faulty"]
    told = json.loads(json.dumps(designs_to_dicts(whole), allow_nan=False))
    for design, code in zip(told, status, strict=True):
        if code == 1:
            assert design["weave_speeds"]
        else:
            assert design["weave_speeds"] == {2: [], 3: None}[code]
        assert (design["fault"] is not None) == (code == 3)
        assert design["status"] == ("faulty" if code == 3 else "computed")
    after = json.loads(json.dumps(designs_to_dicts(part), allow_nan=False))[CHUNK:]
    assert {design["status"] for design in after} == {"not_computed"}
    assert {design["weave_speeds"] for design in after} == {None}


def test_the_command_checks(store: Path, capsys: Any) -> None:
    run(check=store)
    assert "all " in capsys.readouterr().out
    run(check=store, json=True)
    told = json.loads(capsys.readouterr().out)
    assert (told["damages"], sum(told["designs"].values())) == ([], 20)
    (store / "trail" / "0").unlink()
    with pytest.raises(InputError, match=r"1 of \d+ files are damaged\n  trail/0 is missing"):
        run(check=store, json=True)
    assert json.loads(capsys.readouterr().out)["damages"] == ["trail/0 is missing"]


@pytest.mark.skipif(shutil.which("sha256sum") is None, reason="there is no sha256sum here")
def test_the_list_is_one_that_others_read(store: Path) -> None:
    done = subprocess.run(["sha256sum", "--quiet", "--check", "SHA256SUMS"], cwd=store, check=False)  # noqa: S607
    assert done.returncode == 0


def test_identical_runs_are_identical_to_the_last_bit(study: Study, store: Path, tmp_path: Path) -> None:
    run_sweep(study, tmp_path / "again.zarr", workers=1)
    run_sweep(study, tmp_path / "two.zarr", workers=2)
    assert files_of(tmp_path / "again.zarr") == files_of(store)
    assert files_of(tmp_path / "two.zarr") == files_of(store)


def test_fault_codes_do_not_depend_on_who_is_first(tmp_path: Path, monkeypatch: Any) -> None:
    text = TEXT.replace(
        '["20 cm", "22 cm", "29 cm", "30 cm"]', '["20 cm", "22 cm", "29 cm", "30 cm"]\nrider_mass = [-5, 72]'
    )
    study = small_study(tmp_path, text)
    run_sweep(study, tmp_path / "forth.zarr", workers=1)
    chunks = Store.chunks
    monkeypatch.setattr(Store, "chunks", lambda self: reversed(list(chunks(self))))
    run_sweep(study, tmp_path / "back.zarr", workers=1)
    assert len(open_sweep(tmp_path / "forth.zarr").attrs["fault_kinds"]) > 1
    assert files_of(tmp_path / "back.zarr") == files_of(tmp_path / "forth.zarr")
