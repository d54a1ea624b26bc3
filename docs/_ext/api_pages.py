"""A page for each room of the package: everything its modules make public, once, where a user finds it."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

#: The rooms in the order in which a user meets them; what two of them show is documented in the first.
ROOMS = (
    "public",
    "library",
    "parameters",
    "catalogue",
    "body",
    "posture",
    "closed_form",
    "model",
    "linear",
    "control",
    "analysis",
    "certify",
    "multibody",
    "spacar",
    "sweep",
    "measuring",
    "files",
    "webpage",
    "present",
    "reproduce",
    "mechanics",
    "arrays",
    "tracing",
    "output",
    "markup",
    "errors",
)

#: Rooms whose modules are told, too: what the names of the room itself return is made there.
OPEN = ("public",)


def pages() -> dict[str, str]:
    """Return the text of each page by its file's name."""
    told: dict[int, str] = {}
    found = {f"api-{room}.rst": _page(room, told) for room in ROOMS}
    return {"api.rst": _front(told), **found}


def public_names() -> set[str]:
    """Return the full names of all functions and classes that the pages tell, where they are defined."""
    told: dict[int, str] = {}
    for room in ROOMS:
        _page(room, told)
    _front(told)
    things = (_thing(full) for full in told.values())
    return {f"{thing.__module__}.{thing.__qualname__}" for thing in things}


def _thing(full: str) -> Any:
    module, _, name = full.rpartition(".")
    return getattr(importlib.import_module(module), name)


def _front(told: dict[int, str]) -> str:
    """Return the page of the package itself: where each of its names is told, and the rooms."""
    package = importlib.import_module("singletrack")
    lines = ["Programs", "========", "", ".. py:module:: singletrack", "", _first(package), "", ".. list-table::", ""]
    own = []
    for name in package.__all__:
        value = getattr(package, name)
        if name.startswith("__"):
            continue
        if not inspect.ismodule(value) and id(value) not in told:
            own += _told(f"singletrack.{name}", value, told)
        where = told.get(id(value), f"singletrack.{name}")
        kind = "mod" if inspect.ismodule(value) else "obj"
        lines += [f"   * - :py:{kind}:`singletrack.{name} <{where}>`", f"     - {_first(value)}"]
    lines += ["", *own, "", ".. toctree::", "   :maxdepth: 1", "", *(f"   api-{room}" for room in ROOMS), ""]
    return "\n".join(lines)


def _first(value: object) -> str:
    """Return the first paragraph of a docstring as one line."""
    return " ".join((inspect.getdoc(value) or "").partition("\n\n")[0].split())


def _page(room: str, told: dict[int, str]) -> str:
    module = importlib.import_module(f"singletrack.{room}")
    title = f"singletrack.{room}"
    lines = [title, "=" * len(title), "", f".. automodule:: {title}", "   :no-members:", ""]
    lines += _members(module, told) if hasattr(module, "__all__") else []
    for part in _modules(module) if room in OPEN or not hasattr(module, "__all__") else ():
        members = list(_members(part, told))
        if members:
            lines += [part.__name__, "-" * len(part.__name__), "", f".. automodule:: {part.__name__}"]
            lines += ["   :no-members:", "", *members]
    return "\n".join(lines)


def _modules(package: ModuleType) -> Iterator[ModuleType]:
    for found in pkgutil.iter_modules(package.__path__):
        yield importlib.import_module(f"{package.__name__}.{found.name}")


def _members(module: ModuleType, told: dict[int, str]) -> Iterator[str]:
    """Yield the directives for what a module makes public and no page before has told."""
    for name in module.__all__:
        value = getattr(module, name)
        if not inspect.ismodule(value) and id(value) not in told:
            yield from _told(f"{module.__name__}.{name}", value, told)


def _told(full: str, value: object, told: dict[int, str]) -> Iterator[str]:
    """Yield the directive that tells one thing, and note where it is told."""
    if isinstance(value, type):
        told[id(value)] = full
        yield f".. autoclass:: {full}\n   :members:\n"
    elif inspect.isroutine(value):
        told[id(value)] = full
        yield f".. autofunction:: {full}\n"
    else:
        yield f".. autodata:: {full}\n   :no-value:\n"
