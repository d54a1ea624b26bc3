"""Output files: written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from singletrack.errors import InputError

__all__ = ["prepare_folder", "write_whole"]


def prepare_folder(folder: Path) -> Path:
    """Make a folder for output, if it is not there, and make sure that it can be written to.

    Raises
    ------
    InputError
        If it is a file, cannot be made or cannot be written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"{folder}: cannot be used for output ({reason}); must be a folder that can be written to"
        ) from None
    return folder


def write_whole(path: Path, content: bytes | str) -> None:
    """Write a file under another name beside its place, then move it there: no reader ever sees half of it.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    data = content.encode() if isinstance(content, str) else content
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            Path(name).chmod(0o644)
            Path(name).replace(path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{path}: cannot be written ({reason})") from None
