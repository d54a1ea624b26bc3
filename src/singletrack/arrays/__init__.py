"""Arrays on NumPy or JAX, vectors, and what is wrong with some designs of a batch."""

from singletrack.arrays.faults import Fault, refuse_single, valid_mask
from singletrack.arrays.namespace import (
    Array,
    ArrayLike,
    Number,
    as_arrays,
    is_concrete,
    is_jax,
    namespace,
    require_double,
)
from singletrack.arrays.steps import complex_allowed, complex_steps
from singletrack.arrays.stretches import in_stretches, part_of, single_thread, stretches, threads
from singletrack.arrays.vectors import cross, dot, matvec, skew, stack, unit_vector, vector

__all__ = [
    "Array",
    "ArrayLike",
    "Fault",
    "Number",
    "as_arrays",
    "complex_allowed",
    "complex_steps",
    "cross",
    "dot",
    "in_stretches",
    "is_concrete",
    "is_jax",
    "matvec",
    "namespace",
    "part_of",
    "refuse_single",
    "require_double",
    "single_thread",
    "skew",
    "stack",
    "stretches",
    "threads",
    "unit_vector",
    "valid_mask",
    "vector",
]
