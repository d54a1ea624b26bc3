"""Every call to the system under a sweep's store fails once, in turn: a sentence, and the same bytes afterwards."""

from __future__ import annotations

import errno
import os
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("zarr")

from singletrack import SingletrackError
from singletrack.sweep import check_sweep, durable, run_sweep
from sweep_helpers import CHUNK, SMALL, chunks_of, files_of, in_turn, small_study

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from singletrack.sweep import Study

TEXT = SMALL.replace('"matrices", "eigenvalues", "critical_speeds", ', "")
CALLS = ("open", "write", "fsync", "replace", "makedirs", "rename")


class Faulty:
    """The module ``os``, of which one call fails: the n-th of its kind, with an error, or (write) after a few bytes."""

    def __init__(self, name: str = "", fails: int = -1, code: int = errno.ENOSPC, *, short: bool = False) -> None:
        self.name, self.fails, self.code, self.short = name, fails, code, short
        self.counts = dict.fromkeys(CALLS, 0)

    def __getattr__(self, name: str) -> Any:
        real = getattr(os, name)
        if name not in CALLS:
            return real

        def call(*arguments: Any, **options: Any) -> Any:
            number = self.counts[name]
            self.counts[name] += 1
            if name != self.name or number != self.fails:
                return real(*arguments, **options) if name != "fsync" else None
            if self.short:
                return real(arguments[0], bytes(arguments[1])[:3])
            if name == "write":
                real(arguments[0], bytes(arguments[1])[: len(arguments[1]) // 2])
            raise OSError(self.code, os.strerror(self.code), str(arguments[0]))

        return call


@pytest.fixture(autouse=True)
def small_chunks() -> Iterator[None]:
    with chunks_of(CHUNK):
        yield


@pytest.fixture
def study(tmp_path: Path) -> Study:
    return small_study(tmp_path, TEXT)


@pytest.fixture
def right(study: Study, tmp_path: Path) -> dict[str, bytes]:
    run_sweep(study, tmp_path / "right.zarr", workers=1)
    return files_of(tmp_path / "right.zarr")


@pytest.fixture
def counts(study: Study, right: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    faulty = Faulty()
    with monkeypatch.context() as patch:
        patch.setattr(durable, "os", faulty)
        run_sweep(study, tmp_path / "counted.zarr", workers=1)
    assert len(right) > 20
    return faulty.counts


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO], ids=["full", "broken"])
def test_each_call_fails_once(
    study: Study,
    right: dict[str, bytes],
    counts: dict[str, int],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    name: str,
    code: int,
) -> None:
    assert counts[name] > 0
    said = {errno.ENOSPC: "the disk is full", errno.EIO: "Input/output error"}[code]
    for fails in in_turn(counts[name], f"{name} {code}"):
        output = tmp_path / f"{fails}.zarr"
        with monkeypatch.context() as patch:
            patch.setattr(durable, "os", Faulty(name, fails, code))
            try:
                run_sweep(study, output, workers=1)
            except SingletrackError as error:
                assert said in str(error) or "cannot be written" in str(error)  # noqa: PT017
            else:
                raise AssertionError(f"{name} number {fails} failed unnoticed")
        if not output.exists():  # it may fail after the last move
            run_sweep(study, output, workers=1)
        assert files_of(output) == right
        assert not list(tmp_path.rglob(f"*{durable.TEMPORARY}"))


def test_a_short_write_goes_on(
    study: Study, right: dict[str, bytes], counts: dict[str, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for fails in in_turn(counts["write"], "short"):
        output = tmp_path / f"{fails}.zarr"
        with monkeypatch.context() as patch:
            patch.setattr(durable, "os", Faulty("write", fails, short=True))
            run_sweep(study, output, workers=1)
        assert files_of(output) == right


def test_data_are_on_the_disk_before_the_journal_says_so(
    study: Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is not synced when the machine stops is lost: at every sync of the journal, all files it names are."""
    names: dict[int, str] = {}
    dirty: set[str] = set()
    unsynced_folders: set[str] = set()
    lines = []

    class Watched(Faulty):
        def __getattr__(self, name: str) -> Any:
            real: Callable[..., Any] = getattr(os, name)

            def watch(*arguments: Any, **options: Any) -> Any:
                result = None if name == "fsync" else real(*arguments, **options)
                if name == "open":
                    names[result] = str(arguments[0])
                elif name == "write":
                    dirty.add(names[arguments[0]])
                elif name == "replace":
                    assert str(arguments[0]) not in dirty  # moved to its place before it was synced
                    unsynced_folders.add(str(arguments[1].parent))
                elif name == "fsync":
                    dirty.discard(names[arguments[0]])
                    unsynced_folders.discard(names[arguments[0]])
                    if names[arguments[0]].endswith("journal.jsonl"):
                        lines.append(1)
                        assert not dirty
                        assert not unsynced_folders
                elif name == "rename":
                    assert not dirty
                    assert not unsynced_folders
                return result

            return watch if callable(real) and not isinstance(real, type) else real

    monkeypatch.setattr(durable, "os", Watched())
    run_sweep(study, tmp_path / "out.zarr", workers=1)
    assert len(lines) == 4  # whose it is, and three chunks
    assert check_sweep(tmp_path / "out.zarr").damages == ()


def test_a_file_is_there_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    durable.write_files(tmp_path, {"a/b": b"old"})
    monkeypatch.setattr(durable, "os", Faulty("write", 0))
    with pytest.raises(OSError, match="No space"):
        durable.write_files(tmp_path, {"a/b": b"something new"})
    assert files_of(tmp_path) == {"a/b": b"old"}


def test_a_line_cut_short_stays_alone(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    durable.append_line(path, "one")
    path.write_bytes(path.read_bytes() + b"tw")
    durable.append_line(path, "three")
    assert path.read_bytes() == b"one\ntw\nthree\n"
