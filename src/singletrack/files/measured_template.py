"""A file of raw measurements to fill in, with what each number is and where it is measured."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.measuring.quantities import MEASURED_QUANTITIES

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["measured_template"]

_SKETCH = r"""
    1. Roll:  d = distance of n turns, rider on or off as you ride       2. Torsional pendulum (three orientations)
    3. Compound pendulum: period while swinging about the wheel's axle        ======  ceiling
                                                                                |     rod; calibrate it once with
         knife edge ->  ^                                                       |     a straight bar: mP, lP, dP, TtP1
                       /|\    T = Tc..1                                       --o--   frame, hung in orientations 1 2 3
                      / | \   l = axis to centre                              /   \   angles alpha.. of the head tube,
                        o     (wheels: lF, lR)                                        periods Tt..1, Tt..2, Tt..3
    4. Plumb line through the hanging point in each orientation: a = its distance from the wheel centre
       (a > 0 where the wheel centre lies to the left of the line, seen from the bicycle's right side).
    alpha: from the horizontal, pointing right, counter-clockwise to the steer axis, pointing up, seen from the
       bicycle's right side; on its wheels a bicycle has alpha = 90 deg + steer axis tilt.
"""


def measured_template() -> str:
    """Return a file to fill in: periods, angles and lengths, from which ``singletrack measure`` makes a bicycle.

    Examples
    --------
    >>> measured_template().splitlines()[0]
    '# Raw measurements of a bicycle. Fill in: name = value, or name = value+/-standard deviation.'
    """
    return "\n".join(_lines()) + "\n"


def _lines() -> Iterator[str]:
    yield "# Raw measurements of a bicycle. Fill in: name = value, or name = value+/-standard deviation."
    yield "# `singletrack measure FILE` makes a bicycle of them. Units are as said here and cannot be changed."
    yield "#"
    yield from (f"# {line}".rstrip() for line in _SKETCH.strip("\n").splitlines())
    yield ""
    for name, p in MEASURED_QUANTITIES.items():
        if not p.usual:
            continue
        yield f"{'' if p.needed else '# '}{name} = # {p.unit + ', ' if p.unit else ''}{p.meaning}"
