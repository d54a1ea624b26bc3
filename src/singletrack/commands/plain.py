"""Commands in their plainest words, answered without the library that reads options, which takes longer than they do.

Whatever else is typed goes through the door (:mod:`singletrack.commands.door`), and so does all that is not understood.
"""

from __future__ import annotations

import importlib
import json
from pathlib import Path

from singletrack.present.readable import open_streams
from singletrack.version import __version__

__all__ = ["answered"]

_RECORDS = ("bicycle", "rider")
_TEMPLATES = (*_RECORDS, "measurements", "posture")


def answered(arguments: list[str]) -> bool:
    """Print what is asked for and return True; return False where that is not for here.

    Parameters
    ----------
    arguments : list of str
        As after the program's name.
    """
    match arguments:
        case ["convert", source, target] if not source.startswith("-") and not target.startswith("-"):
            open_streams()
            importlib.import_module("singletrack.commands.convert").run(source, Path(target))
            return True
    text = _text(arguments)
    if text is None:
        return False
    open_streams()
    print(text)  # noqa: T201  # as `singletrack.commands.printing` does, which is heavier
    return True


def _text(arguments: list[str]) -> str | None:
    # Doors, each: rooms are imported when they are asked for.
    match arguments:
        case ["--version"]:
            return f"singletrack {__version__}"
        case ["list"]:
            return "\n".join(importlib.import_module("singletrack.library.listing").listing())
        case ["template", kind] if kind in _TEMPLATES:
            return str(importlib.import_module("singletrack.library.template").template(kind)).removesuffix("\n")
        case ["schema", kind] if kind in _RECORDS:
            schema = importlib.import_module("singletrack.library.schema").schema(kind)
            return json.dumps(schema, indent=2, ensure_ascii=False)
    return None
