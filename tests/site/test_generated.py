"""What the site tells of itself is all that there is: rooms, commands, parameters, published numbers."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

import singletrack
from singletrack.commands.door import COMMANDS, command
from singletrack.parameters import Bicycle, Rider

DOCS = Path(__file__).parents[2] / "docs"
SOURCE = Path(singletrack.__file__).parent


@pytest.fixture(scope="module")
def written() -> Any:
    """Return the modules that write pages; they find each other in their own folder."""
    sys.path.insert(0, str(DOCS / "_ext"))
    try:
        import api_pages
        import command_pages
        import proof_pages
        import schema_pages

        yield {"api": api_pages, "commands": command_pages, "proof": proof_pages, "schemas": schema_pages}
    finally:
        sys.path.remove(str(DOCS / "_ext"))


def test_every_room_has_a_page(written: Any) -> None:
    there = {path.stem for path in SOURCE.iterdir() if (path / "__init__.py").exists() or path.suffix == ".py"}
    assert there - set(written["api"].ROOMS) == {"commands", "__init__", "__main__", "version"}
    assert set(written["api"].pages()) == {"api.rst", *(f"api-{room}.rst" for room in written["api"].ROOMS)}


def test_every_option_of_every_command_is_told(written: Any) -> None:
    (page,) = written["commands"].pages().values()
    sections = dict(zip(COMMANDS, page.split("\n## singletrack ")[1:], strict=True))
    for name, text in sections.items():
        for parameter in command(name).params:
            for option in parameter.opts if parameter.param_type_name == "option" and parameter.name != "help" else ():
                assert f"`{option}`" in text, (name, option)
    assert "| 2 |" in page.partition("## Exit codes")[2]


def test_every_parameter_and_schema_is_told(written: Any) -> None:
    (page,) = written["schemas"].pages().values()
    for record in (Bicycle, Rider):
        assert [name for name in record.descriptions() if f"| `{name}` |" not in page] == []
    schemas = [json.loads(part.partition("```")[0]) for part in page.split("```json\n")[1:]]
    assert [one["title"] for one in schemas] == ["singletrack bicycle", "singletrack rider"]


def test_every_published_number_is_there_with_its_digits(written: Any) -> None:
    page = written["proof"].pages()["numbers.md"]
    benchmark = written["proof"].read_printed("meijaard2007.json")
    printed = [text for name in ("M", "C1", "K0", "K2") for row in benchmark[name] for text in row]
    printed += [part.lstrip("-") for roots in benchmark["eigenvalues"].values() for root in roots for part in root]
    assert [text for text in printed if text.removesuffix(".0") not in page] == []
    assert "does not hold" not in page
    digits = [int(line.split("|")[-2].split()[0]) for line in page.splitlines() if line.endswith("digits |")]
    assert min(digits) >= 12


def test_a_number_that_does_not_agree_would_show(written: Any) -> None:
    assert written["proof"]._digits(3e-6) == "5 digits"
    assert written["proof"]._printed("0.25", 0.26) == "does not hold"
    assert written["proof"]._printed("1.32610", 1.326104) == "all 6 printed"
