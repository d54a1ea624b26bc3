"""The page of all commands, their arguments, options, defaults and exit codes, as the program itself knows them."""

from __future__ import annotations

import enum
from typing import Any

from tables import escaped, table

from singletrack.commands.app import EXIT_CODES
from singletrack.commands.door import COMMANDS, command


def pages() -> dict[str, str]:
    """Return the text of the page by its file's name."""
    lines = ["# Commands", "", "`singletrack COMMAND --help` prints the same in a terminal.", ""]
    for name, text in COMMANDS.items():
        lines += [f"(command-{name})=", f"## singletrack {name}", "", escaped(text), "", *_usage(name), ""]
    lines += ["## Exit codes", ""]
    lines += table(["code", "says"], [[str(code), text] for code, text in EXIT_CODES.items()])
    return {"commands.md": "\n".join([*lines, ""])}


def _usage(name: str) -> list[str]:
    parameters = [p for p in command(name).params if not p.hidden and p.name != "help"]
    arguments = [p for p in parameters if p.param_type_name == "argument"]
    words = [_metavar(p) if p.required else f"[{_metavar(p)}]" for p in arguments]
    options = [p for p in parameters if p.param_type_name == "option"]
    lines = ["```text", " ".join(["singletrack", name, *words, *["[options]"] * bool(options)]), "```", ""]
    if not parameters:
        return lines
    rows = [[_name(p), p.help or "", _default(p)] for p in [*arguments, *options]]
    return [*lines, *table(["argument", "says", "default"], rows, raw={0, 2})]


def _metavar(parameter: Any) -> str:
    """Return the placeholder of a value; of a choice without one, what may be chosen."""
    if parameter.metavar:
        return str(parameter.metavar)
    kind = parameter.type_descriptor.annotation
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return "|".join(str(one.value) for one in kind)
    if parameter.param_type_name == "argument":
        return str(parameter.name).upper()
    return getattr(kind, "__name__", str(kind)).upper()


def _name(parameter: Any) -> str:
    if parameter.param_type_name == "argument":
        return f"`{_metavar(parameter)}`".replace("|", r"\|")
    names = ", ".join(f"`{name}`" for name in [*parameter.opts, *parameter.secondary_opts])
    value = "" if parameter.is_flag else f" `{_metavar(parameter)}`"
    return (names + value + (" (repeatable)" if parameter.multiple else "")).replace("|", r"\|")


def _default(parameter: Any) -> str:
    if parameter.required:
        return "required"
    value = parameter.default
    if isinstance(value, enum.Enum):
        value = value.value
    return "" if value is None or value is False or value == [] or callable(value) else f"`{value}`"
