"""Writing so that what is said to be on the disk is there, come a kill, a full disk or a power cut.

A file is written under another name, synced, and moved to its place; then its folder is synced. Nobody ever sees half a
file, and what :func:`write_files` has returned from survives the machine. Every call to the system is in this module.
"""

from __future__ import annotations

import hashlib
import os
import secrets
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

__all__ = ["TEMPORARY", "append_line", "check_folder", "checksum", "move_folder", "sync_folder", "write_files"]

#: How names of files end that are being written; after a kill they are nobody's.
TEMPORARY = ".tmp"


def checksum(data: bytes | memoryview) -> str:
    """Return the SHA-256 of data, in hexadecimal, as ``sha256sum`` prints it."""
    return hashlib.sha256(data).hexdigest()


def write_files(folder: Path, files: Mapping[str, bytes | memoryview]) -> None:
    """Write files, by their names relative to a folder, and sync them and the folders that they are in.

    Raises
    ------
    OSError
        If one cannot be written; what was at its place before is still there.
    """
    folders = {folder}
    for name, data in files.items():
        path = folder / name
        os.makedirs(path.parent, exist_ok=True)
        _write(path, data)
        folders.update(parent for parent in path.parents if parent.is_relative_to(folder))
    for changed in sorted(folders, reverse=True):
        sync_folder(changed)


def _write(path: Path, data: bytes | memoryview) -> None:
    temporary = path.with_name(f"{path.name}.{secrets.token_hex(4)}{TEMPORARY}")
    handle = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
    try:
        try:
            _write_all(handle, data)
            os.fsync(handle)
        finally:
            os.close(handle)
        os.replace(temporary, path)
    except BaseException:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise


def _write_all(handle: int, data: bytes | memoryview) -> None:
    left = memoryview(data).cast("B")
    while left:
        left = left[os.write(handle, left) :]


def append_line(path: Path, line: str) -> None:
    """Add a line to the file at a path and sync it; one that was cut short before stays a line of its own."""
    handle = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o666)
    try:
        end = os.lseek(handle, 0, os.SEEK_END)
        cut_short = end > 0 and os.lseek(handle, -1, os.SEEK_END) == end - 1 and os.read(handle, 1) != b"\n"
        _write_all(handle, ("\n" * cut_short + line + "\n").encode())
        os.fsync(handle)
    finally:
        os.close(handle)


def sync_folder(folder: Path) -> None:
    """Sync the entries of a folder, where the system knows such a thing."""
    if os.name == "nt":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def move_folder(source: Path, target: Path) -> None:
    """Move a folder from source to target in one step, on one file system, and sync both folders that hold these."""
    os.rename(source, target)
    sync_folder(target.parent)
    sync_folder(source.parent)


def check_folder(folder: Path) -> None:
    """Write, move and remove a small file in a folder, to find out now what would fail later.

    Raises
    ------
    OSError
        If a file cannot be written there.
    """
    path = folder / f"check{TEMPORARY}"
    try:
        _write(path, b"whether a file can be written here")
        sync_folder(folder)
    finally:
        if os.path.exists(path):
            os.unlink(path)
