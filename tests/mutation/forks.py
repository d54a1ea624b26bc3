"""A process of its own for each mutant: forked, limited in time, asked for one line of JSON."""

from __future__ import annotations

import json
import os
import signal
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import pytest

#: Seconds that a test may take beyond some times what it takes: of processor time, as the machine may be busy, ...
BEYOND, TIMES = 3.0, 5.0
#: ... and as many times that by the clock, for a process that waits for ever.
IDLE = 20.0


def forked(work: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Return what a function returns in a process of its own; {"killed": "time"} if a limit ended it."""
    reading, writing = os.pipe()
    process = os.fork()
    if not process:
        code = 1
        try:
            os.close(reading)
            sink = os.open(os.devnull, os.O_RDWR)
            for stream in (1, 2):
                os.dup2(sink, stream)
            os.write(writing, json.dumps(work()).encode())
            code = 0
        except BaseException as error:  # noqa: BLE001  # whatever it is, it is told and the process ends
            os.write(writing, json.dumps({"killed": "", "error": repr(error)}).encode())
        finally:
            os._exit(code)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        data = pipe.read()
    _, status = os.waitpid(process, 0)
    if data:
        return json.loads(data)
    timed = os.WIFSIGNALED(status) and os.WTERMSIG(status) in {signal.SIGPROF, signal.SIGALRM}
    return {"killed": "time" if timed else f"the process ended with {status}"}


def limit(seconds: float) -> None:
    """End this process if what comes next takes much longer than this."""
    for name in (signal.SIGPROF, signal.SIGALRM):
        signal.signal(name, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_PROF, BEYOND + TIMES * seconds)
    signal.setitimer(signal.ITIMER_REAL, IDLE * (BEYOND + TIMES * seconds))


def first_failing(items: Iterable[pytest.Item], seconds: dict[str, float]) -> dict[str, Any]:
    """Run tests in turn until one fails; return it, if any, and how many were run."""
    from _pytest.runner import runtestprotocol

    ordered = list(items)
    for count, item in enumerate(ordered, 1):
        limit(seconds.get(item.nodeid, 1.0))
        following = ordered[count] if count < len(ordered) else None
        bad = [report for report in runtestprotocol(item, log=False, nextitem=following) if report.failed]
        if bad:
            return {"killed": item.nodeid, "run": count, "why": str(bad[0].longrepr)[-300:]}
    return {"killed": "", "run": len(ordered)}
