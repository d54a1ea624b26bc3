"""The program: from its arguments to an exit code, whatever happens between."""

from __future__ import annotations

import importlib
import os
import signal
import sys
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, NoReturn

from singletrack.errors import OddityWarning, SingletrackError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

__all__ = ["EXIT_CODES", "main"]

#: What the program says to the one that called it.
EXIT_CODES = {
    0: "Done.",
    1: "An error of the program itself, or not enough memory: nothing that other input would mend. "
    "SINGLETRACK_TRACEBACK=1 shows where.",
    2: "Something that you can mend: one sentence on standard error names the file, the parameter, what was found and "
    "what is allowed. Nothing half-written is left.",
    128 + signal.SIGINT: "Interrupted (Ctrl-C); a sweep says how to go on.",
    141: "Nobody reads the output any more (a pipe that was closed).",
    128 + signal.SIGTERM: "Terminated; as after Ctrl-C.",
}


#: For Matplotlib's warning of each such character, which names places in our code.
_NO_GLYPH = "a name or a title has characters that the figure's font lacks; they are drawn as boxes"


class _Terminated(BaseException):
    """The system asks the program to end."""


def main() -> None:
    """Run the command line: one sentence on standard error and an exit code for whatever does not go well."""
    try:
        with _termination_raises(), _warnings_said():
            code = _run()
            _flush()
    except BaseException as error:  # noqa: BLE001  # every way out of the program is in one place
        code = _code_of(error)
    sys.exit(code)


def _run() -> int:
    # Commands are imported within the guard: an interruption while libraries load ends in one sentence too.
    if importlib.import_module("singletrack.commands.plain").answered(sys.argv[1:]):
        return 0
    return int(importlib.import_module("singletrack.commands.door").run(sys.argv[1:]))


def _code_of(error: BaseException) -> int:
    """Say what happened and return the exit code for it: 2 for what the user can mend, 128 + n for a signal n."""
    if isinstance(error, BrokenPipeError):
        _end_as_by_broken_pipe()
    if isinstance(error, SystemExit):
        return error.code if isinstance(error.code, int) else 1
    text, code = _told(error)
    if code == 1 and os.environ.get("SINGLETRACK_TRACEBACK"):
        raise error
    if isinstance(error, OSError):
        _drop_output()
    return _said(text, code)


def _told(error: BaseException) -> tuple[str, int]:
    """Return the sentence and the exit code for an error."""
    match error:
        case KeyboardInterrupt():
            return "; ".join(["interrupted", *_notes(error)]), 128 + signal.SIGINT
        case _Terminated():
            return "; ".join(["terminated", *_notes(error)]), 128 + signal.SIGTERM
        case SingletrackError():
            return str(error), 2
        case OSError():
            return f"{error.filename or 'standard output'}: {error.strerror or error}", 2
        case MemoryError():
            return "there is not enough memory for this", 1
    text = f"internal error, please report it: {type(error).__name__}: {error}"
    return f"{text} (SINGLETRACK_TRACEBACK=1 shows where)", 1


def _notes(error: BaseException) -> list[str]:
    """Return what was noted on an error on its way: what is kept, how to go on."""
    return list(getattr(error, "__notes__", ()))


def _said(text: str, code: int) -> int:
    say = importlib.import_module("singletrack.present.readable").say  # light; guarded like all the rest
    say(f"singletrack: {text}")
    return code


def _flush() -> None:
    """Bring what was printed out of this process, so that a full disk or a closed pipe is met here and not later."""
    if sys.stdout is not None:
        sys.stdout.flush()


def _drop_output() -> None:
    """Throw away what could not be printed: the interpreter would try again at its end, and fail with a traceback."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, ValueError, AttributeError):  # no file of the system behind it
        return


def _end_as_by_broken_pipe() -> NoReturn:
    """End as the system ends a program that writes to a pipe that nobody reads any more: silently, by signal."""
    _drop_output()
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGPIPE)
    sys.exit(141)


@contextmanager
def _termination_raises() -> Iterator[None]:
    """Turn SIGTERM into an exception, so that files are cleaned up behind it."""

    def end(number: int, frame: FrameType | None) -> NoReturn:
        raise _Terminated(number, frame)

    try:
        before = signal.signal(signal.SIGTERM, end)
    except ValueError:  # not the main thread: somebody else's program
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def _warnings_said() -> Iterator[None]:
    """Print what looks odd as a line on standard error, once."""
    said: set[str] = set()

    def show(message: Warning | str, category: type[Warning], *place: object) -> None:
        text = _NO_GLYPH if category is UserWarning and str(message).startswith("Glyph ") else str(message)
        if not issubclass(category, OddityWarning) and text is not _NO_GLYPH:
            usual(message, category, *place)  # type: ignore[arg-type]
        elif text not in said:
            said.add(text)
            _said(f"warning: {text}", 0)

    with warnings.catch_warnings():
        usual = warnings.showwarning
        warnings.showwarning = show  # type: ignore[assignment]
        warnings.simplefilter("always", OddityWarning)
        yield
