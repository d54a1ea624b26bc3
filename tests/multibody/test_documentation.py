"""The page on the engine runs."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

PAGE = Path(__file__).parents[2] / "docs" / "theory" / "engine.md"


def test_the_programs_of_the_page_run(capsys: Any) -> Any:
    programs = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    for program in programs:
        exec(compile(program, str(PAGE), "exec"), {})  # noqa: S102  # our own page
    printed = capsys.readouterr().out
    assert "right hand" in printed
    assert "1 degrees of freedom" in printed
