"""What can go wrong, in words a user can act on.

Every error that a user can cause derives from :class:`SingletrackError`; the command line prints it as one message
and exits with code 2.
"""

from __future__ import annotations

import difflib
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

__all__ = [
    "InputError",
    "ModelError",
    "OddityWarning",
    "PostureError",
    "SingletrackError",
    "install_hint",
    "nearest",
    "shown",
    "unknown",
    "unknown_name",
]


#: Errors that one message tells; whoever made this many has made one mistake, not many.
_MOST_TOLD = 8


class SingletrackError(ValueError):
    """Any error caused by what was asked for; its text is one complete message, its attributes say the same in parts.

    Parameters
    ----------
    reason : str
        What is wrong: the message without the place.
    parameters : iterable of str
        The parameters concerned.
    found : object
        What was found: a value, or values by parameter where there are several.
    allowed : object
        What is allowed instead: words, or the names that exist.
    place : str
        Where: a file with its line, an option, the name of a record. Whoever knows it fills it in, by :meth:`at`.
    parts : iterable of SingletrackError
        The errors one by one where several were found at once (see :meth:`of_all`).

    Attributes
    ----------
    reason, parameters, found, allowed, place, parts
        As above; ``parameters`` and ``parts`` as tuples.

    Examples
    --------
    >>> error = InputError("trail = nan m, must be a finite number", parameters=["trail"], allowed="a finite number")
    >>> str(error.at("bicycle.toml, line 7")), error.parameters
    ('bicycle.toml, line 7: trail = nan m, must be a finite number', ('trail',))
    """

    def __init__(
        self,
        reason: str = "",
        *,
        parameters: Iterable[str] = (),
        found: Any = None,
        allowed: Any = "",
        place: str = "",
        parts: Iterable[SingletrackError] = (),
    ) -> None:
        super().__init__(reason)
        self.reason = reason
        self.parameters = tuple(parameters)
        self.found = found
        self.allowed = allowed
        self.place = place
        self._parts = tuple(parts)

    @classmethod
    def of_all(cls, errors: Sequence[SingletrackError]) -> SingletrackError:
        """Return several errors as one, of the first one's class and with what it found and what it allows."""
        if len(errors) == 1:
            return errors[0]
        first, errors = errors[0], [part for error in errors for part in error.parts]
        names = dict.fromkeys(name for error in errors for name in error.parameters)
        return type(first)(
            "; ".join(error.reason for error in errors),
            parameters=names,
            found=first.found,
            allowed=first.allowed,
            place=first.place,
            parts=errors,
        )

    @property
    def parts(self) -> tuple[SingletrackError, ...]:
        """The errors one by one where several were found at once, else the error itself alone."""
        return self._parts or (self,)

    def __str__(self) -> str:
        told, before = [], ""
        for part in self.parts:
            told.append(f"{part.place}: {part.reason}" if part.place != before and part.place else part.reason)
            before = part.place
        more = [f"and {len(told) - _MOST_TOLD} more"] if len(told) > _MOST_TOLD else []
        return "; ".join([*told[:_MOST_TOLD], *more])

    def of(self, parameter: str) -> SingletrackError:
        """Return an error about a value as one about the parameter that was to have it.

        >>> str(InputError("'wide' is not a number").of("trail").at("bicycle.toml, line 7"))
        "bicycle.toml, line 7: trail = 'wide' is not a number"
        """
        return type(self)(
            f"{parameter} = {self.reason}",
            parameters=(parameter,),
            found=self.found,
            allowed=self.allowed,
            place=self.place,
        )

    def at(self, place: str) -> SingletrackError:
        """Return the same error with its place known, instead of any it had."""
        return self.located(lambda _: place)

    def located(self, place_of: Callable[[tuple[str, ...]], str]) -> SingletrackError:
        """Return the same error with its places known: of each part by ``place_of``, which is given its parameters.

        >>> both = InputError.of_all([InputError("a is 1", parameters="a"), InputError("b is 2", parameters="b")])
        >>> lines = {"a": 3, "b": 4}
        >>> str(both.located(lambda names: f"f.toml, line {lines[names[0]]}"))
        'f.toml, line 3: a is 1; f.toml, line 4: b is 2'
        """
        placed = [
            type(part)(
                part.reason,
                parameters=part.parameters,
                found=part.found,
                allowed=part.allowed,
                place=place_of(part.parameters),
            )
            for part in self.parts
        ]
        return self.of_all(placed)


class InputError(SingletrackError):
    """A file, name or value that cannot be used; names the file, the parameter, what was found and what is allowed."""


class PostureError(SingletrackError):
    """A rider who cannot sit on this bicycle in this posture: a limb too short or too long, a loop that cannot move."""


class ModelError(SingletrackError):
    """A multibody system that is not well defined; names the element."""


class OddityWarning(UserWarning):
    """Something allowed that looks odd: a value that is seldom meant (a trail of 60 m), an option without effect.

    Attributes
    ----------
    name, parameter : str
        Of the bicycle or rider and of the parameter, "" where there is none.
    found : float
        What was found, in SI units.
    expected : str
        What is usual, in words.

    Examples
    --------
    >>> str(OddityWarning("trail = 60 m is odd", name="mine", parameter="trail", found=60.0))
    'mine: trail = 60 m is odd'
    """

    def __init__(
        self, reason: str = "", *, name: str = "", parameter: str = "", found: Any = None, expected: str = ""
    ) -> None:
        super().__init__(reason)
        self.reason = reason
        self.name = name
        self.parameter = parameter
        self.found = found
        self.expected = expected

    def __str__(self) -> str:
        return f"{self.name}: {self.reason}" if self.name else self.reason


_MOST_LISTED = 12


def shown(found: object, longest: int = 60) -> str:
    """Return what was found as a message shows it: never long, whatever it is.

    Parameters
    ----------
    found : object
    longest : int
        Characters to show.

    Examples
    --------
    >>> shown(list(range(100)), 12), shown(16**10_000)
    ('[0, 1, 2, 3,...', 'a number of 12042 digits')
    """
    try:
        text = repr(found)
    except ValueError:  # Python's limit on the digits of whole numbers
        digits = found.bit_length() * 30103 // 100000 + 1 if isinstance(found, int) else "too many"
        return f"a number of {digits} digits"
    except RecursionError:
        return "something nested too deeply"
    return text if len(text) <= longest else f"{text[:longest]}..."


def nearest(name: str, known: Iterable[str]) -> str:
    """Return a sentence part that offers the nearest known name, or nothing.

    >>> nearest("trial", ["trail", "wheel_base"])
    '; did you mean trail?'
    >>> nearest("xyz", ["trail", "wheel_base"])
    ''
    """
    name = name[:80]  # the comparison takes the product of both lengths
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


def unknown(what: str, name: str, known: Iterable[str], place: str = "") -> InputError:
    """Return the error for a name that is not known; its message is that of :func:`unknown_name`.

    Parameters
    ----------
    what : str
        What the name should be.
    name : str
    known : iterable of str
    place : str
        Where it stands.

    >>> error = unknown("posture", "uprite", ["rigid", "upright"])
    >>> error.parameters, error.allowed
    (('uprite',), ('rigid', 'upright'))
    """
    known = tuple(known)
    return InputError(unknown_name(what, name, known), parameters=(name,), found=name, allowed=known, place=place)


def install_hint(extra: str) -> str:
    """Return the command that installs an optional part, from the checkout that this is if it is one.

    Parameters
    ----------
    extra : str
        As pyproject.toml names it.

    Examples
    --------
    >>> install_hint("sweep").endswith("[sweep]'")
    True
    """
    checkout = Path(__file__).resolve().parents[2]
    what = str(checkout) if (checkout / "pyproject.toml").is_file() else "singletrack"
    return f"pip install {shlex.quote(f'{what}[{extra}]')}"
