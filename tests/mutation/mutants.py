"""Mutants of a package, made by cosmic-ray's operators: each a module with one place changed.

Needs cosmic-ray, which only `make mutants` installs.
"""

from __future__ import annotations

import difflib
import random
import re
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names

if TYPE_CHECKING:
    from pathlib import Path

#: Not counted: changes that make no difference to what a program computes (types, decorators), and operators on bits,
#: which real numbers do not have, so that any test that comes by kills them.
LEFT_OUT = re.compile(
    r"core/(ReplaceBinaryOperator_BitOr_|RemoveDecorator|ExceptionReplacer|.*_(Bit(Or|And|Xor)|[LR]Shift)$)"
)


@dataclass(frozen=True)
class Place:
    """Where an operator can change a module: path from the root, lines from 1 on, which of the operator's places."""

    module: str
    line: int
    last: int
    operator: str
    occurrence: int


def places(root: Path, package: str, part: str = "") -> list[Place]:
    """Return all places of a package that count, in a fixed order; only files whose path has `part` in it."""
    found = []
    for path in sorted((root / "src" / "singletrack" / package).rglob("*.py")):
        module = str(path.relative_to(root))
        if part not in module:
            continue
        nodes = list(ast_nodes(get_ast(path.read_text())))
        for name in sorted(operator_names()):
            if LEFT_OUT.match(name) or get_operator(name).arguments():
                continue
            spans = (span for node in nodes for span in get_operator(name)().mutation_positions(node))
            found += [Place(module, start[0], end[0], name, k) for k, (start, end) in enumerate(spans)]
    return found


def drawn(all_places: list[Place], sample: int, seed: int) -> list[Place]:
    """Return a seeded sample of places, in the order in which they are drawn: the first of them are a sample, too.

    All of them where 0 or more than there are is asked for.
    """
    count = len(all_places) if not sample else min(sample, len(all_places))
    return random.Random(seed).sample(all_places, count)


def mutant(root: Path, place: Place) -> dict[str, Any]:
    """Return a place with the changed source, and the lines that differ."""
    before = (root / place.module).read_text()
    after = mutate_code(before, get_operator(place.operator)(), place.occurrence)
    lines = difflib.unified_diff(before.splitlines(), (after or before).splitlines(), lineterm="", n=0)
    changed = [line for line in lines if line[:1] in "+-" and line[:3] not in {"+++", "---"}]
    return {**asdict(place), "source": after, "changed": changed}
