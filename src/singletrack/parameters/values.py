"""One parameter's value as a caller gives it: a double, or a batch of doubles that nobody else can change."""

from __future__ import annotations

from typing import Any

import numpy as np

from singletrack.arrays import Number, complex_allowed, is_concrete, is_jax
from singletrack.errors import InputError

__all__ = ["FrozenDict", "as_parameter", "real_numbers"]


class FrozenDict(dict[str, Any]):
    """A dictionary that cannot be changed; ``|`` and ``dict()`` make one that can."""

    __slots__ = ()

    def _refuse(self, *_: Any, **__: Any) -> Any:
        raise TypeError("this mapping belongs to a frozen record; make another record with .replace(...)")

    __setitem__ = __delitem__ = __ior__ = clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[type[FrozenDict], tuple[dict[str, Any]]]:
        return FrozenDict, (dict(self),)


def as_parameter(value: Any) -> Number:
    """Return a value as a float, as a read-only array of doubles of its own, or as the JAX array that it is.

    Parameters
    ----------
    value : object
        A number, or an array or nested sequence of numbers, of shape (...).

    Raises
    ------
    InputError
        If it is anything else: text, truth values, objects, masked arrays, numbers with a unit, whole numbers that no
        double holds; complex numbers, but within :func:`~singletrack.arrays.complex_steps`. The message lacks the
        parameter's name, which the caller knows.

    Examples
    --------
    >>> as_parameter(1), as_parameter([0.05, 0.06])
    (1.0, array([0.05, 0.06]))
    >>> as_parameter("0.05")
    Traceback (most recent call last):
    ...
    singletrack.errors.InputError: '0.05' is text, not a number
    """
    if type(value) is float:
        return value
    if isinstance(value, bool):
        raise _refusal(value, "is a truth value, not a number")
    if isinstance(value, int | float):
        try:
            return float(value)
        except OverflowError:
            raise _refusal("a whole number beyond the largest double", "is too large") from None
    if isinstance(value, str | bytes):
        raise _refusal(value, "is text, not a number")
    if is_jax(value):
        _refuse_kind(value, value.dtype.kind)
        return value
    return _as_array(value)


def real_numbers(*values: Number) -> tuple[Any, ...] | None:
    """Return the real parts of parameters: floats as they are, else NumPy arrays.

    None if one of them is missing, or hidden by JAX.

    Parameters
    ----------
    *values : float or array, shape (...)

    Examples
    --------
    >>> real_numbers(1.0, 2.0)
    (1.0, 2.0)
    """
    for value in values:
        if type(value) is not float:
            break
    else:
        return values
    if not all(value is not None and is_concrete(value) for value in values):
        return None
    return tuple(np.real(np.asarray(value)) for value in values)


def _as_array(value: Any) -> float | np.ndarray:
    if isinstance(value, np.ma.MaskedArray):
        raise _refusal(value, "is a masked array; fill or leave out what is masked")
    if hasattr(value, "magnitude") or hasattr(value, "unit"):
        raise _refusal(value, "has a unit of its own; give the number in the parameter's SI unit")
    if isinstance(value, list | tuple) and any(isinstance(one, bool | np.bool_) for one in value):
        raise _refusal(value, "holds truth values, not numbers")
    try:
        array = np.array(value)
    except (ValueError, TypeError):
        raise _refusal(value, "is not an array of numbers") from None
    _refuse_kind(value, array.dtype.kind)
    array = array.astype(complex if array.dtype.kind == "c" else float)
    array.flags.writeable = False
    return array if array.ndim else array[()].item()


def _refuse_kind(value: Any, kind: str) -> None:
    if kind in "iuf":
        return
    if kind != "c":
        raise _refusal(value, "is not a number" if kind != "b" else "is a truth value, not a number")
    if not complex_allowed():
        raise _refusal(value, "is complex; a complex step is taken within `with complex_steps():`")


def _refusal(value: Any, reason: str) -> InputError:
    found = value if reason == "is too large" else repr(value)[:80]
    return InputError(f"{found} {reason}", found=value, allowed="a number or an array of numbers")
