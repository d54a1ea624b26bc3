"""What comes with the package, and the formats of files, line by line."""

from __future__ import annotations

from singletrack.files import registry
from singletrack.library.load import descriptions

__all__ = ["listing"]


def listing() -> list[str]:
    """Return the lines of the list: bicycles, riders and postures with what they are, formats.

    Examples
    --------
    >>> listing()[0], listing()[1][:29]
    ('bicycles', '  benchmark       The benchma')
    """
    lines = []
    for kind in ("bicycle", "rider", "posture"):
        found = descriptions(kind)
        width = max(16, *(len(name) + 2 for name in found))
        lines += [f"{kind}s", *(f"  {name:<{width}}{text}" for name, text in found.items())]
    return [*lines, "formats", *(f"  {each.name:<16}{each.summary()}" for each in registry.FORMATS)]
