"""Output files: whole or not at all, on the disk when the call returns, and nothing destroyed that is not a file.

A regular file is written under another name in the same folder, synchronised to the disk, given the permissions that
were there (or those that the umask leaves to a new file), and moved to its place; then the folder is synchronised.
Symbolic links are followed and stay: their target is written. Devices, FIFOs and sockets are written to, as every
program does that does not know better: there is nothing to replace.
"""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
from pathlib import Path
from typing import TYPE_CHECKING

from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["check_writable", "prepare_folder", "sync_folder", "write_whole"]


def prepare_folder(folder: Path) -> Path:
    """Make a folder for output, if it is not there, and make sure that it can be written to.

    Parameters
    ----------
    folder : path
        Its parents are made too.

    Raises
    ------
    InputError
        If it is a file, cannot be made or cannot be written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _probe(folder)
    except (OSError, ValueError) as error:
        raise InputError(
            f"{folder}: cannot be used for output ({_reason(error)}); must be a folder that can be written to"
        ) from None
    return folder


def check_writable(path: str | Path) -> None:
    """Make sure, before anything is computed, that :func:`write_whole` will be able to write a file; leaves no trace.

    Parameters
    ----------
    path : str or path
        Where the file will be written. Folders that are missing are not made yet.

    Raises
    ------
    InputError
        If it is a folder, or it or its folder cannot be written to.

    Examples
    --------
    >>> check_writable("/")
    Traceback (most recent call last):
    singletrack.errors.InputError: /: cannot be written (Is a directory)
    """
    path = Path(path)
    try:
        found = _found(path)
        if found is not None and not stat.S_ISREG(found.st_mode):
            return
        folder = _target(path).parent
        while not folder.exists() and folder != folder.parent:
            folder = folder.parent  # the nearest folder that is there: the others are made in it
        _probe(folder)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise _unwritable(path, error) from None


def write_whole(path: str | Path, content: bytes | str) -> None:
    """Write a file: whole or not at all, whatever happens meanwhile; folders that are missing are made.

    Parameters
    ----------
    path : str or path
        A regular file is replaced and keeps its permissions; a symbolic link is followed; a device or FIFO is
        written to.
    content : bytes or str
        Text is written as UTF-8.

    Raises
    ------
    InputError
        If the file cannot be written; it is then as it was, and nothing is left behind.
    """
    path = Path(path)
    data = content.encode() if isinstance(content, str) else content
    try:
        found = _found(path)
        if found is not None and not stat.S_ISREG(found.st_mode):
            _write_into(path, data)
            return
        target = _target(path)
        with _folders(target.parent):
            _replace(target, data, found)
        sync_folder(target.parent)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise _unwritable(path, error) from None


def sync_folder(folder: str | Path) -> None:
    """Bring the names in a folder to the disk, where the system can do so (Windows and some network disks cannot)."""
    if os.name != "posix":
        return
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in {errno.EINVAL, errno.ENOTSUP}:
            raise
    finally:
        os.close(handle)


def _probe(folder: Path) -> None:
    """Make an empty file in a folder and take it away again."""
    name = folder / f".{secrets.token_hex(8)}.new"
    os.close(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600))
    name.unlink()


def _found(path: Path) -> os.stat_result | None:
    """Return what is where a path leads, links followed; refuse what is there and may not be written to."""
    try:
        found = path.stat()
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, "Is a directory")
    if not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, "Permission denied")
    return found


def _target(path: Path) -> Path:
    """Return the file to replace: a link's target, so that the link stays."""
    return Path(os.path.realpath(path)) if path.is_symlink() else path


@contextlib.contextmanager
def _folders(folder: Path) -> Iterator[None]:
    """Make the folders that are missing; take them away again if what is done in them fails."""
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    made: list[Path] = []
    try:
        for each in reversed(missing):
            each.mkdir(exist_ok=True)
            made.append(each)
            sync_folder(each.parent)
        yield
    except BaseException:
        for each in reversed(made):
            with contextlib.suppress(OSError):  # another program may use it by now
                each.rmdir()
        raise


def _replace(target: Path, data: bytes, old: os.stat_result | None) -> None:
    """Write beside the target, to the disk, and move there."""
    new = target.with_name(f".{target.name[:100]}.{secrets.token_hex(8)}.new")
    # Opened as any new file is, so that the umask and the folder's own rules decide who may read it.
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    try:
        handle = os.open(new, flags, 0o666)
        try:
            if old is not None:
                _keep_owner(new, old)
                new.chmod(stat.S_IMODE(old.st_mode))
            _write(handle, data)
            os.fsync(handle)
        finally:
            os.close(handle)
        new.replace(target)
    except BaseException:
        with contextlib.suppress(OSError):
            new.unlink()
        raise


def _write_into(path: Path, data: bytes) -> None:
    """Write to a device or FIFO: there is nothing to replace and nothing to bring to a disk."""
    handle = os.open(path, os.O_WRONLY | getattr(os, "O_BINARY", 0))
    try:
        _write(handle, data)
    finally:
        os.close(handle)


def _keep_owner(new: Path, old: os.stat_result) -> None:
    made = new.stat()
    if hasattr(os, "chown") and (made.st_uid, made.st_gid) != (old.st_uid, old.st_gid):
        with contextlib.suppress(PermissionError):  # only an administrator may give files away
            os.chown(new, old.st_uid, old.st_gid)


def _write(handle: int, data: bytes) -> None:
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]


def _reason(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)


def _unwritable(path: Path, error: Exception) -> InputError:
    return InputError(f"{path}: cannot be written ({_reason(error)})")
