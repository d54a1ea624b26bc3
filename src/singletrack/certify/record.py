"""The certificate: what is proven, as plain numbers with bounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import inf
from typing import Any

from singletrack.certify.balls import Ball, rounded_down, rounded_up
from singletrack.certify.counting import Sides

__all__ = ["Certificate", "CertifiedCrossing", "CertifiedRange", "Eigenvalue"]

_DIGITS = 10


@dataclass(frozen=True)
class Eigenvalue:
    """An eigenvalue in 1/s, proven to lie in a rectangle; exactly one does."""

    real: Ball
    imaginary: Ball


@dataclass(frozen=True)
class CertifiedCrossing:
    """A critical speed in m/s: for each design exactly one speed of the ball.

    ``kind`` is "real" (a root passes zero: capsize), "pair" (an oscillation: weave) or "both" at once; ``before`` and
    ``after`` count the unstable roots on either side; ``direction`` is "gained", "lost", or "touches" where a pair
    reaches the axis and turns back.
    """

    speed: Ball
    kind: str
    direction: str
    before: int
    after: int


@dataclass(frozen=True)
class CertifiedRange:
    """Speeds in m/s, ends excluded, at all of which all designs have the same number of unstable roots.

    ``unstable`` is 0 where they are stable (all roots to the left of the axis). Where it is more, single speeds may
    have fewer, with roots on the axis: they are not stable there either. ``witness`` is a speed inside, and
    ``eigenvalues`` those of a single design there.
    """

    start: float
    stop: float
    unstable: int
    witness: float
    eigenvalues: tuple[Eigenvalue, ...] = ()

    @property
    def words(self) -> str:
        """The range in words, its ends rounded inwards."""
        if self.stop == inf:
            return f"from {rounded_up(self.start, _DIGITS)} m/s on"
        return f"{rounded_up(self.start, _DIGITS)} to {rounded_down(self.stop, _DIGITS)} m/s"


@dataclass(frozen=True)
class Certificate:
    """Which speeds are stable, proven by ball arithmetic for exact parameters or for all designs of some intervals.

    Attributes
    ----------
    parameters : mapping of str to str
        What was taken as exact, as it was written; intervals as "from … to".
    crossings : tuple of CertifiedCrossing
        Every critical speed, ascending; () where their number differs between the designs.
    ranges : tuple of CertifiedRange
        Ascending.
    undecided : tuple of (float, float)
        Speeds of which nothing is claimed: neither in a range nor in the ball of a crossing.
    at_rest : Sides or None
        The roots at v = 0, where pairs may stay on the axis; None if undecided.
    always : str
        Why no design is stable at any speed (a root that is zero throughout, ...); else empty.
    bits, boxes : int
        Precision, and the number of boxes of designs that were looked at.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> certificate = coefficients(load_bicycle("benchmark")).critical_speeds(certify=True)
    >>> [(crossing.kind, crossing.direction, crossing.speed.digits()) for crossing in certificate.crossings]
    [('pair', 'gained', '4.29238253634'), ('real', 'lost', '6.02426201539')]
    >>> certificate.status, [range_.unstable for range_ in certificate.ranges], certificate.at_rest
    ('certified', [2, 0, 1], Sides(right=2, left=2, axis=0, zero=0))
    """

    parameters: Mapping[str, str]
    crossings: tuple[CertifiedCrossing, ...]
    ranges: tuple[CertifiedRange, ...]
    undecided: tuple[tuple[float, float], ...]
    at_rest: Sides | None
    always: str = ""
    bits: int = 0
    boxes: int = 1

    @property
    def status(self) -> str:
        """Return "certified" if every speed is decided, else "undecided" (no range) or "undecided in part"."""
        if not self.undecided:
            return "certified"
        return "undecided in part" if self.ranges else "undecided"

    @property
    def stable_ranges(self) -> list[tuple[float, float]]:
        """Ranges (from, to) in m/s, rounded inwards, in which every design is proven to be stable."""
        return [(each.start, each.stop) for each in self.ranges if not each.unstable]

    @property
    def undecided_words(self) -> list[str]:
        """The undecided intervals in words, rounded outwards."""
        return [
            f"from {rounded_down(low, _DIGITS)} m/s on"
            if high == inf
            else f"{rounded_down(low, _DIGITS)} to {rounded_up(high, _DIGITS)} m/s"
            for low, high in self.undecided
        ]

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain values for JSON, infinity as None."""
        found = {
            "status": self.status,
            "parameters": dict(self.parameters),
            "crossings": [asdict(crossing) for crossing in self.crossings],
            "stable_ranges": self.stable_ranges,
            "ranges": [asdict(each) for each in self.ranges],
            "undecided": self.undecided,
            "at_rest": None if self.at_rest is None else self.at_rest._asdict(),
            "always": self.always,
            "bits": self.bits,
            "boxes": self.boxes,
        }
        plain: dict[str, Any] = _plain(found)
        return plain


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _plain(inner) for name, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    return None if value == inf else value
