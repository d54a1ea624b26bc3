"""Whether the shipped page was built from the sources as they are."""

from __future__ import annotations

import hashlib
import sys
from pathlib import Path

__all__ = ["sources_hash"]


def sources_hash(folder: Path) -> str:
    """Return one hash of all that the page is built from, line ends aside.

    Parameters
    ----------
    folder : Path
        The page's sources: ``index.html``, ``package-lock.json``, ``src/``, ...
    """
    names = ["index.html", "package-lock.json", "tsconfig.json", "vite.config.ts"]
    files = [folder / name for name in names] + sorted(path for path in (folder / "src").rglob("*") if path.is_file())
    found = hashlib.sha256()
    for file in files:
        content = file.read_bytes().replace(b"\r\n", b"\n")
        found.update(f"{file.relative_to(folder).as_posix()} {len(content)}\n".encode() + content)
    return found.hexdigest()


if __name__ == "__main__":
    print(sources_hash(Path(sys.argv[1])))  # noqa: T201  # for the Makefile
