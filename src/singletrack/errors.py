"""What can go wrong, in words a user can act on.

Every error that a user can cause derives from :class:`SingletrackError`; the command line prints it as one message
and exits with code 2.
"""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["InputError", "ModelError", "PostureError", "SingletrackError", "nearest", "unknown_name"]


class SingletrackError(ValueError):
    """Any error caused by what was asked for; its text is one complete message."""


class InputError(SingletrackError):
    """A file, name or value that cannot be used; names the file, the parameter, what was found and what is allowed."""


class PostureError(SingletrackError):
    """A rider who cannot sit on this bicycle in this posture: a limb too short or too long, a loop that cannot move."""


class ModelError(SingletrackError):
    """A multibody system that is not well defined; names the element."""


_MOST_LISTED = 12


def nearest(name: str, known: Iterable[str]) -> str:
    """Return a sentence part that offers the nearest known name, or nothing.

    >>> nearest("trial", ["trail", "wheel_base"])
    '; did you mean trail?'
    >>> nearest("xyz", ["trail", "wheel_base"])
    ''
    """
    by_lower = {other.lower(): other for other in known}
    close = difflib.get_close_matches(name.lower(), by_lower, n=1, cutoff=0.6)
    return f"; did you mean {by_lower[close[0]]}?" if close else ""


def unknown_name(what: str, name: str, known: Iterable[str]) -> str:
    """Return the message for a name that is not known: what it is, the nearest, and all that exist.

    >>> unknown_name("posture", "uprite", ["rigid", "upright"])
    "unknown posture 'uprite'; did you mean upright? (known: rigid, upright)"
    """
    known = list(known)
    listing = f"known: {', '.join(known)}" if len(known) <= _MOST_LISTED else f"{len(known)} names are known"
    return f"unknown {what} {name[:80]!r}{nearest(name, known)} ({listing})"
