"""Names in docstrings lead to their documentation.

A docstring names its neighbours as the code beside it does, without their package. What is documented under one full
name only is found by its last part; what exists but is not public (a module of a room) is printed without a link; what
does not exist stays a warning, and warnings are errors.
"""

from __future__ import annotations

import contextlib
import importlib
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from docutils import nodes
    from sphinx.application import Sphinx
    from sphinx.environment import BuildEnvironment


def find(app: Sphinx, env: BuildEnvironment, node: Any, words: nodes.TextElement) -> nodes.Node | None:
    """Return the link to what a docstring names, its plain words where it is not public, or nothing."""
    if node.get("refdomain") != "py":
        return None
    target = node["reftarget"].lstrip(".~")
    domain = env.domains["py"]
    full = {name for name in domain.objects if name == target or name.endswith("." + target)}
    if len(full) == 1:
        node["reftarget"] = full.pop()
        found: Any = domain.resolve_xref(
            env, node["refdoc"], app.builder, node["reftype"], node["reftarget"], node, words
        )
        return found or words
    return words if full or _exists(target, node.get("py:module")) else None


def _exists(name: str, module: str | None) -> bool:
    """Return whether a dotted name is a module or something in one; a name alone, in `module` and below."""
    inside = (other for other in sys.modules if other == module or other.startswith(f"{module}."))
    if any(hasattr(sys.modules[other], name) for other in list(inside)):
        return True
    for full in (name, f"{module}.{name}"):
        for depth in range(full.count("."), -1, -1):
            parts = full.split(".")
            with contextlib.suppress(ImportError, AttributeError, ValueError):
                found: Any = importlib.import_module(".".join(parts[: depth + 1]))
                for part in parts[depth + 1 :]:
                    found = getattr(found, part)
                return True
    return False


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("missing-reference", find)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
