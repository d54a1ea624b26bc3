"""A layer under all writing that fails where a test says: every open, write, fsync, rename, mkdir in a folder."""

from __future__ import annotations

import errno
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["CALLS", "failing"]

#: What is counted, by name in :mod:`os`.
CALLS = ("open", "write", "fsync", "replace", "rename", "mkdir", "chmod")


class Counter:
    """The calls so far, and which of them fails (counted from zero; none with -1)."""

    def __init__(self, folder, fail, error):
        self.folder, self.fail, self.error = os.path.realpath(folder), fail, error
        self.made: list[str] = []
        self.failed: list[str] = []
        self.handles: set[int] = set()

    def concerns(self, where):
        if isinstance(where, int):
            return where in self.handles
        try:
            path = os.path.realpath(os.fspath(where))
        except (TypeError, ValueError):
            return False
        return path.startswith(self.folder)

    def call(self, name, usual, where, *rest, **options):
        if not self.concerns(where):
            return usual(where, *rest, **options)
        if name == "open" and not (rest[0] if rest else options.get("flags", 0)) & (
            os.O_WRONLY | os.O_RDWR | os.O_CREAT
        ):
            self.handles.add(folder := usual(where, *rest, **options))  # to synchronise it
            return folder
        index = len(self.made)
        self.made.append(name)
        if index == self.fail:
            self.failed.append(name)
            if name == "write":  # half of it gets through
                usual(where, bytes(rest[0])[: len(rest[0]) // 2])
            raise OSError(self.error, os.strerror(self.error))
        result = usual(where, *rest, **options)
        if name == "open":
            self.handles.add(result)
        return result


@contextmanager
def failing(folder: Path, fail: int = -1, error: int = errno.ENOSPC):
    """Count all writing calls in a folder, and let one of them fail."""
    counter = Counter(folder, fail, error)
    with pytest.MonkeyPatch.context() as patch:
        for name in CALLS:
            usual = getattr(os, name)
            patch.setattr(
                os,
                name,
                lambda where, *rest, _name=name, _usual=usual, **options: counter.call(
                    _name, _usual, where, *rest, **options
                ),
            )
        close = os.close
        patch.setattr(os, "close", lambda handle: (counter.handles.discard(handle), close(handle))[1])
        yield counter
