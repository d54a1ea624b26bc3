"""Files to fill in."""

from __future__ import annotations

from singletrack.errors import InputError, unknown_name
from singletrack.files.registry import templates

__all__ = ["template"]


def template(kind: str) -> str:
    """Return a file to fill in: replace each question mark by a number.

    Parameters
    ----------
    kind : {"bicycle", "rider", "measurements"}
        ``measurements`` are raw: periods, angles and lengths, from which ``singletrack measure`` makes a bicycle.

    Raises
    ------
    InputError
        For an unknown kind.

    Examples
    --------
    >>> print(template("bicycle").splitlines()[-1])
    # handlebar_drop = "? m" # optional, hhb: grips below the stem top (negative: above); else none; a finite number
    """
    known = templates()
    if kind not in known:
        raise InputError(unknown_name("kind", kind, known))
    return known[kind]()
