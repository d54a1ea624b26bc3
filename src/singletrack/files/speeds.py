"""Forward speeds as text."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from singletrack.errors import InputError

if TYPE_CHECKING:
    import numpy as np

__all__ = ["parse_speeds"]

_ALLOWED = "must be START:STOP:COUNT in m/s with 0 <= START < STOP and 2 <= COUNT <= 1000000, or one speed"
_MOST = 1_000_000


def parse_speeds(text: str, name: str = "--speeds") -> np.ndarray:
    """Return the speeds (n,) in m/s that START:STOP:COUNT or a single value stands for.

    Parameters
    ----------
    text : str
    name : str
        What the text was given for, for the message.

    Raises
    ------
    InputError
        If the text is neither.

    Examples
    --------
    >>> parse_speeds("0:10:5").tolist(), parse_speeds("4.6").tolist()
    ([0.0, 2.5, 5.0, 7.5, 10.0], [4.6])
    """
    import numpy as np  # lazy: `import singletrack` stays light

    parts = text.split(":")
    wrong = InputError(f"{name} {text!r}: {_ALLOWED}", parameters=("speeds",), found=text, allowed=_ALLOWED)
    try:
        numbers = [float(part) for part in parts[:2]]
        count = int(parts[2]) if len(parts) == 3 else 1
    except (ValueError, OverflowError):
        raise wrong from None
    if not all(isfinite(number) and number >= 0 for number in numbers):
        raise wrong
    if len(parts) == 1:
        return np.array(numbers)
    if len(parts) != 3 or not numbers[0] < numbers[1] or not 2 <= count <= _MOST:
        raise wrong
    return np.linspace(numbers[0], numbers[1], count)
