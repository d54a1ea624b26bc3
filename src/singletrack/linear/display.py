"""How modes and critical speeds look at a prompt and in a notebook."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from singletrack.markup import table, told

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["line_of_critical_speeds", "line_of_modes", "table_of_critical_speeds", "table_of_modes"]

_MOST_ROWS = 60


class _ModesShown(Protocol):
    """What is shown of :class:`~singletrack.linear.Modes`."""

    @property
    def names(self) -> tuple[str, ...]: ...
    @property
    def speeds(self) -> np.ndarray: ...
    @property
    def eigenvalues(self) -> np.ndarray: ...
    @property
    def applies(self) -> np.ndarray: ...


class _CriticalSpeedsShown(Protocol):
    """What is shown of :class:`~singletrack.linear.CriticalSpeeds`."""

    @property
    def told(self) -> np.ndarray: ...
    @property
    def weave(self) -> list[Any]: ...
    @property
    def capsize(self) -> list[Any]: ...
    @property
    def stable_ranges(self) -> list[Any]: ...


def line_of_modes(modes: _ModesShown) -> str:
    """Return one line: the modes' names, how many designs and speeds.

    >>> from singletrack import coefficients, load_bicycle
    >>> print(line_of_modes(coefficients(load_bicycle("benchmark")).modes([0.0, 5.0])))
    <Modes weave, weave, capsize, castering at 2 speeds, 0 to 5 m/s>
    """
    return f"<Modes {_what(modes)}>"


def table_of_modes(modes: _ModesShown) -> str:
    """Return an HTML table, a row for each speed; in parentheses where a mode's name does not describe the motion."""
    if modes.eigenvalues.ndim > 2:
        return table([["modes", _what(modes)]])
    return table(_rows(modes), ["speed in m/s", *modes.names], f"Eigenvalues in 1/s: {_what(modes)}")


def _what(modes: _ModesShown) -> str:
    batch, count = modes.eigenvalues.shape[:-2], len(modes.speeds)
    designs = f"designs of shape {batch}, " if batch else ""
    between = f", {told(float(modes.speeds.min()))} to {told(float(modes.speeds.max()))} m/s" if count else ""
    return f"{designs}{', '.join(modes.names)} at {count} speed{'s' * (count != 1)}{between}"


def _rows(modes: _ModesShown) -> Iterator[list[str]]:
    count = len(modes.speeds)
    left_out = count - _MOST_ROWS
    for i, (speed, roots, applies) in enumerate(zip(modes.speeds, modes.eigenvalues, modes.applies, strict=True)):
        if left_out > 0 and i == _MOST_ROWS // 2:
            yield [f"... {left_out} more speeds ..."]
        if left_out > 0 and _MOST_ROWS // 2 <= i < count - _MOST_ROWS // 2:
            continue
        cells = (_root(root) if fits else f"({_root(root)})" for root, fits in zip(roots, applies, strict=True))
        yield [told(float(speed)), *cells]


def _root(root: complex) -> str:
    if root.imag == 0 or np.isnan(root):
        return told(float(root.real), 5)
    sign = "+" if root.imag > 0 else "−"
    return f"{told(float(root.real), 5)} {sign} {told(abs(float(root.imag)), 5)}i"


def line_of_critical_speeds(speeds: _CriticalSpeedsShown) -> str:
    """Return one line: all speeds and stable ranges of a single design, else how many designs.

    >>> from singletrack import coefficients, load_bicycle
    >>> print(line_of_critical_speeds(coefficients(load_bicycle("benchmark")).critical_speeds()))
    <CriticalSpeeds: weave 4.29238 m/s, capsize 6.02426 m/s, stable 4.29238 to 6.02426 m/s>
    """
    batch = np.shape(speeds.told)
    if batch:
        return f"<CriticalSpeeds of designs of shape {batch}>"
    if not speeds.told:
        return "<CriticalSpeeds: could not tell>"
    return f"<CriticalSpeeds: {', '.join(f'{name} {words}' for name, words in _words(speeds))}>"


def table_of_critical_speeds(speeds: _CriticalSpeedsShown) -> str:
    """Return an HTML table of a single design's critical speeds and stable ranges; of a batch, how many designs."""
    batch = np.shape(speeds.told)
    if batch:
        return table([["designs", " × ".join(map(str, batch))]], caption="Critical speeds")
    rows = _words(speeds) if speeds.told else [("critical speeds", "could not tell")]
    return table(rows, caption="Critical speeds")


def _words(speeds: _CriticalSpeedsShown) -> list[tuple[str, str]]:
    def listed(values: list[float]) -> str:
        return f"{', '.join(told(value) for value in values)} m/s" if values else "never"

    ranges = [
        f"{told(low)} to {told(high)} m/s" if np.isfinite(high) else f"above {told(low)} m/s"
        for low, high in speeds.stable_ranges
    ]
    return [
        ("weave", listed(speeds.weave)),
        ("capsize", listed(speeds.capsize)),
        ("stable", " and ".join(ranges) or "never"),
    ]
