"""The JSON schemas of our own files, as `singletrack schema` prints them, and each parameter as a table."""

from __future__ import annotations

import json

from tables import table

from singletrack.library.schema import schema
from singletrack.parameters import Bicycle, Rider

KINDS = {"bicycle": Bicycle, "rider": Rider}


def pages() -> dict[str, str]:
    """Return the text of the page by its file's name."""
    lines = [
        "# Parameters and schemas",
        "",
        "`singletrack schema bicycle > bicycle.json` gives the schema to an editor, which then checks files.",
        "Symbols are those of Meijaard et al. (2007) where that paper has one.",
        "",
    ]
    for kind, record in KINDS.items():
        rows = [
            [f"`{name}`", one.symbol, one.unit or "", one.meaning, "optional" if one.optional else "required"]
            for name, one in record.descriptions().items()
        ]
        lines += [f"## Parameters of a {kind}", ""]
        lines += table(["name", "symbol", "unit", "meaning", ""], rows, raw={0})
        text = json.dumps(schema(kind), indent=2, ensure_ascii=False)
        lines += ["", f":::{{dropdown}} JSON schema of a {kind}", "```json", text, "```", ":::", ""]
    return {"schemas.md": "\n".join(lines)}
