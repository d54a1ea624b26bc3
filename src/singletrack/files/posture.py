"""Mechanism files of riders, as far as files know: what tells them from others, and one to fill in."""

from __future__ import annotations

from importlib import resources
from typing import TYPE_CHECKING

from singletrack.files.format import Format

if TYPE_CHECKING:
    from singletrack.files.format import Clues

__all__ = ["FORMAT"]


def _recognises(clues: Clues) -> bool:
    return clues.values.get("kind", "").strip("\"' ") == "posture"


def _template() -> str:
    return (resources.files("singletrack") / "data" / "templates" / "posture.toml").read_text(encoding="utf-8")


FORMAT = Format(
    name="posture",
    description="a rider's mechanism",
    recognises=_recognises,
    used_by="`--posture FILE` seats a rider so",
    templates={"posture": _template},
)
