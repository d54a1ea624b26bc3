"""What docs/howto/sweep.md shows is a study that loads."""

from __future__ import annotations

import re
from pathlib import Path

from singletrack.sweep import load_study

PAGE = Path(__file__).parents[2] / "docs" / "howto" / "sweep.md"


def test_the_study_of_the_page_loads(tmp_path: Path) -> None:
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE.read_text(), re.DOTALL)
    path = tmp_path / "study.toml"
    path.write_text(text)
    study = load_study(path)
    assert study.designs.count == 65536
    assert study.designs.rows(0, 4).shape == (4, 3)


def test_the_program_of_the_page_runs() -> None:
    program = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)[0]
    names: dict[str, object] = {}
    exec(program, names)  # noqa: S102  # our own page
    assert names["model"].shape == (20, 50)  # type: ignore[attr-defined]
    assert names["model"].valid.all()  # type: ignore[attr-defined]
