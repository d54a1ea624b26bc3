"""The checksums of a finished store: a list that ``sha256sum --check`` reads too, and what does not agree with it."""

from __future__ import annotations

import hashlib
import re
from typing import TYPE_CHECKING

from singletrack.errors import InputError
from singletrack.sweep.durable import TEMPORARY

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

__all__ = ["CHECKSUMS", "checksum_lines", "damages", "is_intact", "read_checksums"]

#: Name of the list in a finished store.
CHECKSUMS = "SHA256SUMS"
_LINE = re.compile(r"([0-9a-f]{64})  ([ -~]+)")


def checksum_lines(sums: Mapping[str, str]) -> bytes:
    """Return the list of the checksums of files, by name."""
    return "".join(f"{value}  {name}\n" for name, value in sorted(sums.items())).encode()


def read_checksums(store: Path) -> dict[str, str]:
    """Return the checksums of a store's files, by name.

    Raises
    ------
    InputError
        If there is no list, or a line of it is no such line.
    """
    path = store / CHECKSUMS
    try:
        lines = path.read_bytes().decode("ascii").splitlines()
    except FileNotFoundError:
        raise InputError(
            f"{path}: is missing, so that nothing says whether {store.name} is as it was written (or it was written by "
            "singletrack 0.1); xarray.open_zarr opens it unchecked"
        ) from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read as a list of checksums ({error})") from None
    sums = {}
    for number, line in enumerate(lines, start=1):
        found = _LINE.fullmatch(line)
        if found is None:
            raise InputError(f"{path}, line {number}: is damaged; must be a SHA-256 and the name of a file")
        sums[found[2]] = found[1]
    return sums


def is_intact(path: Path, checksum: str) -> bool:
    """Return whether the file at a path is there and has a checksum (SHA-256 in hexadecimal)."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest() == checksum
    except OSError:
        return False


def damages(store: Path, sums: Mapping[str, str]) -> list[str]:
    """Return what is wrong with the files of a store, by file: missing, changed, or not in the list ``sums``."""
    found = []
    for name, value in sums.items():
        if not (store / name).is_file():
            found.append(f"{name} is missing")
        elif not is_intact(store / name, value):
            found.append(f"{name} is not as it was written")
    for path in store.rglob("*"):
        name = path.relative_to(store).as_posix()
        if not path.is_dir() and name not in sums and name != CHECKSUMS and not name.endswith(TEMPORARY):
            found.append(f"{name} is not in the list of checksums")
    return sorted(found)
