"""Commented parameter files to fill in."""

from __future__ import annotations

from singletrack.errors import InputError, unknown_name
from singletrack.parameters.bicycle import Bicycle
from singletrack.parameters.record import ALLOWED
from singletrack.parameters.rider import Rider

__all__ = ["template"]

_KINDS: dict[str, type[Bicycle | Rider]] = {"bicycle": Bicycle, "rider": Rider}
_UNITS = {"rad": "deg", "m/s**2": "m/s^2", "kg*m**2": "kg*m^2"}


def template(kind: str) -> str:
    """Return a TOML file for a bicycle or a rider with every parameter explained, to fill in.

    Parameters
    ----------
    kind : {"bicycle", "rider"}

    Raises
    ------
    InputError
        For another kind.

    Examples
    --------
    >>> print(template("rider").splitlines()[0])
    # A rider for singletrack. Fill in every value: a number with a unit, in quotes, such as '290 mm',
    """
    if kind not in _KINDS:
        raise InputError(unknown_name("kind", kind, _KINDS))
    lines = [
        f"# A {kind} for singletrack. Fill in every value: a number with a unit, in quotes, such as '290 mm',",
        "# with its uncertainty if known: '0.290 +/- 0.002 m'. A bare number is in SI units (angles: radians).",
        "# Frame: origin at the rear wheel's contact with the ground, x forward, y right, z down.",
        f'kind = "{kind}"',
        'name = ""',
        'description = ""',
        'source = ""',
        "",
        "[parameters]",
    ]
    group = ""
    for name, p in _KINDS[kind].descriptions().items():
        if p.group != group:
            group = p.group
            lines += ["", f"# --- {group}"]
        unit = _UNITS.get(p.unit, p.unit)
        filled = f'" {unit}"' if unit else '""'
        lines.append(f"{name} = {filled} # {p.symbol}: {p.meaning}; {ALLOWED[p.allowed][0]}")
    return "\n".join(lines) + "\n"
