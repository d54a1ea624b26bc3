"""The array API standard under the kernels: the same code on NumPy (default) and on JAX.

``Array`` is an array of any shape and kind of number, ``Number`` one number or one for each design. Types are told for
NumPy; JAX's arrays answer to the same operations, though the two libraries share no type.
From 2.1 on NumPy's own namespace is that of the standard, as far as the kernels use it.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "Array",
    "ArrayLike",
    "Number",
    "as_arrays",
    "is_concrete",
    "is_jax",
    "namespace",
    "require_double",
]

#: An array; its shape stands in the docstring, batch dimensions first.
Array: TypeAlias = "np.ndarray[Any, np.dtype[Any]]"
#: A number, or an array of one number for each design, shape (...).
Number: TypeAlias = "float | Array"
#: Numbers as people give them, such as speeds: one, a sequence, or an array of any shape.
ArrayLike: TypeAlias = "float | Sequence[float] | Array"


def namespace(*values: ArrayLike) -> Any:
    """Return the array namespace of the values: JAX if any is a JAX array, else NumPy.

    >>> namespace(1.0, 2.0).__name__
    'numpy'
    """
    return sys.modules["jax.numpy"] if is_jax(*values) else np


def is_jax(*values: ArrayLike) -> bool:
    """Tell whether any of the values is a JAX array (or stands for one while JAX traces a function)."""
    jax = sys.modules.get("jax")
    return jax is not None and any(isinstance(value, jax.Array) for value in values)


def require_double(value: Array) -> None:
    """Raise InputError if a result is a JAX array of single precision: too coarse for stability, and easily overlooked.

    Parameters
    ----------
    value : array, shape (...)
        The result, of any unit.

    Raises
    ------
    InputError
        With what to type to make JAX compute in double precision.
    """
    if is_jax(value) and value.dtype.itemsize < (16 if value.dtype.kind == "c" else 8):
        raise InputError(
            f"JAX computes in {value.dtype}, must be double precision: put "
            'jax.config.update("jax_enable_x64", True) at the start of the program'
        )


def is_concrete(value: Number) -> bool:
    """Tell whether a value can be looked at now (a JAX tracer cannot): a number, or an array (...), of any unit."""
    return not any(cls.__name__ == "Tracer" for cls in type(value).__mro__)


def as_arrays(*values: ArrayLike) -> tuple[Any, tuple[Array, ...]]:
    """Return the namespace of values of any units, and the values as arrays of floating-point (or complex) numbers.

    Parameters
    ----------
    values : array_like, shape (...)
        Each of a shape of its own, which it keeps.
    """
    xp = namespace(*values)
    arrays = (xp.asarray(value) for value in values)
    return xp, tuple(array if array.dtype.kind in "fc" else xp.astype(array, xp.float64) for array in arrays)
