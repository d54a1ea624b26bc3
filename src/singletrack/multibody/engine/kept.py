"""Equations as machine code, generated once and kept.

Expressions are evaluated by an interpreter by default, at once and everywhere. Where there is a C compiler, the same
expressions can be compiled instead: some ten times as fast, at the price of a second or two the first time. What was
compiled is kept in a folder under the digest of its source, for every later process.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

import casadi as ca

from singletrack.errors import ModelError

__all__ = ["compile_equations", "kept"]

ASKED = "SINGLETRACK_COMPILE"
GENERATED = ("reduced", "tree")  # what calls no solver
_CHOSEN: dict[str, Path] = {}


def compile_equations(folder: str | Path | None = None, *, on: bool = True) -> None:
    """Compile the equations of motion from now on, for simulations; also asked for by ``SINGLETRACK_COMPILE=1``.

    Parameters
    ----------
    folder
        Where to keep what was compiled; by default the user's cache.
    on
        Off: the interpreter again.

    Raises
    ------
    ModelError
        Where there is no C compiler.

    Examples
    --------
    >>> compile_equations(on=False)
    """
    if not on:
        _CHOSEN.clear()
        return
    _compiler()
    _CHOSEN["folder"] = _default_folder() if folder is None else Path(folder)


def _default_folder() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "singletrack"


def _compiler() -> str:
    found = next((path for name in ("cc", "gcc", "clang") if (path := shutil.which(name))), None)
    if found is None:
        raise ModelError("compiling the equations needs a C compiler (cc, gcc or clang), and there is none")
    return found


def kept(function: ca.Function) -> ca.Function:
    """Return a function as it is, or compiled where that was asked for; from the folder if it was compiled before."""
    if function.name() not in GENERATED:
        return function
    if not _CHOSEN and os.environ.get(ASKED, "") in {"", "0"}:
        return function
    compiler, folder = _compiler(), _CHOSEN.get("folder") or _default_folder()
    source = _source(function)
    mark = hashlib.sha256(f"{source}\n{version('casadi')}\n{compiler}\n{sys.platform}".encode()).hexdigest()[:32]
    library = folder / f"{mark}.so"
    if not library.exists():
        _compile(compiler, source, library)
    return ca.external(function.name(), str(library))


def _source(function: ca.Function) -> str:
    with tempfile.TemporaryDirectory() as work:
        maker = ca.CodeGenerator("equations.c")
        maker.add(function)
        maker.generate(f"{work}{os.sep}")
        return (Path(work) / "equations.c").read_text()


def _compile(compiler: str, source: str, library: Path) -> None:
    library.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=library.parent) as work:
        text, made = Path(work) / "equations.c", Path(work) / "equations.so"
        text.write_text(source)
        command = [compiler, "-O1", "-fPIC", "-shared", str(text), "-o", str(made), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603  # found by its name
        if done.returncode:
            raise ModelError(f"compiling the equations failed: {done.stderr.strip()[:300]}")
        made.replace(library)  # at once: another process may compile the same
