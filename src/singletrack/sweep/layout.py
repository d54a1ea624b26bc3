"""The arrays of a store: what they hold, how large they are, and their bytes in Zarr's format 2.

Sizes are those of the results of one design, so that a model of any number of freedoms finds its place. Zarr makes the
bytes, in memory; :mod:`singletrack.sweep.durable` brings them to the disk.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["ARRAYS", "Column", "Layout", "encode", "metadata", "status_of"]

_STATUS = ("not_computed", "computed", "faulty")
_ANSWER = ("not_computed", "found", "never", "faulty", "could_not_tell")

#: For each array: dimensions after "design", unit and meaning.
ARRAYS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "M": (("equation", "coordinate"), "kg m^2", "mass matrix"),
    "C0": (("equation", "coordinate"), "N m s", "damping matrix of dampers"),
    "C1": (("equation", "coordinate"), "kg m", "damping matrix per speed"),
    "S0": (("equation", "coordinate"), "N m", "stiffness matrix of springs"),
    "K0": (("equation", "coordinate"), "kg m", "stiffness matrix per gravity"),
    "K2": (("equation", "coordinate"), "kg", "stiffness matrix per squared speed"),
    "eigenvalues": (("speed", "root"), "1/s", "sorted by real then imaginary part"),
    "weave_speeds": (("crossing",), "m/s", "a pair crosses the imaginary axis; NaN: no more; see weave_status"),
    "weave_status": ((), "", "whether there are weave speeds"),
    "capsize_speeds": (("crossing",), "m/s", "a real root crosses zero; NaN: no more; see capsize_status"),
    "capsize_status": ((), "", "whether there are capsize speeds"),
    "stable_ranges": (("range", "bound"), "m/s", "all roots in the left half plane; NaN: no more; see stable_status"),
    "stable_status": ((), "", "whether there are stable ranges"),
    "status": ((), "", "whether the design is computed"),
    "fault": ((), "", "0: sound; k: faulty, the k-th of the attribute fault_kinds; its results are NaN"),
}
#: Of the arrays that are codes: what 0, 1, 2, ... mean. Zero is what an array holds that nobody has written.
CODES = {"status": _STATUS, "weave_status": _ANSWER, "capsize_status": _ANSWER, "stable_status": _ANSWER}


def status_of(values: np.ndarray, told: np.ndarray) -> np.ndarray:
    """Return codes (k,) for speeds of sound designs: 1 found, 2 never, 4 could not tell.

    Parameters
    ----------
    values : array, shape (k, ...)
        In m/s, NaN where there are fewer.
    told : bool array, shape (k,)
        Whether anything could be told.
    """
    found = np.isfinite(values).reshape(len(values), -1).any(axis=1)
    codes = np.where(found, _ANSWER.index("found"), _ANSWER.index("never"))
    return np.where(told, codes, _ANSWER.index("could_not_tell")).astype(np.int8)


@dataclass(frozen=True)
class Column:
    """One array of a store: a row for each design.

    Attributes
    ----------
    name : str
    shape : tuple of int
        Of one row.
    dtype : str
    dimensions : tuple of str
        Of one row.
    attributes : dict
        Units and meaning.
    """

    name: str
    shape: tuple[int, ...]
    dtype: str
    dimensions: tuple[str, ...]
    attributes: dict[str, Any]

    @classmethod
    def of_results(cls, name: str, row: np.ndarray) -> Column:
        """Return the column of an array of results by name, from one row of it, shape (...) as for one design."""
        dimensions, unit, meaning = ARRAYS[name]
        attributes: dict[str, Any] = {"units": unit, "long_name": meaning}
        if name in CODES:
            attributes |= {"flag_values": list(range(len(CODES[name]))), "flag_meanings": " ".join(CODES[name])}
        return cls(name, row.shape, row.dtype.str, dimensions, attributes)


@dataclass(frozen=True)
class Layout:
    """The arrays of a store, with the length of their chunks and the labels of their dimensions."""

    designs: int
    chunk: int
    columns: tuple[Column, ...]
    labels: dict[str, np.ndarray]

    @property
    def size(self) -> int:
        """Bytes of the finished store: its chunks are all of one length."""
        chunks = -(-self.designs // self.chunk)
        length = chunks * min(self.chunk, self.designs)
        return sum(length * prod(column.shape) * np.dtype(column.dtype).itemsize for column in self.columns)


def metadata(layout: Layout, attributes: Mapping[str, Any]) -> dict[str, bytes]:
    """Return the files of a store of a layout without its chunks, by name: descriptions, attributes, labels."""
    import zarr  # lazy: optional
    from zarr.storage import MemoryStore

    files: dict[str, Any] = {}
    group = zarr.open_group(MemoryStore(files), mode="w", zarr_format=2)
    for column in layout.columns:
        _array(group, layout, column)
    for name, values in layout.labels.items():
        about = {"units": "m/s"} if name == "speed" else {}
        group.create_array(
            name, data=values, fill_value=None, compressors=None, attributes={"_ARRAY_DIMENSIONS": [name], **about}
        )
    group.attrs.update(dict(attributes))
    zarr.consolidate_metadata(group.store)
    return {name: bytes(buffer.to_bytes()) for name, buffer in files.items()}


def _array(group: Any, layout: Layout, column: Column) -> None:
    """Create an array that is filled chunk by chunk; not compressed, since the digits of results are noise."""
    group.create_array(
        column.name,
        shape=(layout.designs, *column.shape),
        chunks=(min(layout.chunk, layout.designs), *column.shape),
        dtype=column.dtype,
        fill_value=None if np.dtype(column.dtype).kind == "i" else np.nan,  # what equals it reads as missing
        compressors=None,
        attributes={"_ARRAY_DIMENSIONS": ["design", *column.dimensions], **column.attributes},
    )


def encode(described: Mapping[str, bytes], start: int, arrays: Mapping[str, np.ndarray]) -> dict[str, memoryview]:
    """Return the files of one chunk, by name.

    Parameters
    ----------
    described : mapping of str to bytes
        The files that describe the store, of :func:`metadata`.
    start : int
        The first design of the chunk.
    arrays : mapping of str to array, shape (k, ...)
        A row for each design.
    """
    import zarr
    from zarr.core.buffer import default_buffer_prototype
    from zarr.storage import MemoryStore

    make = default_buffer_prototype().buffer.from_bytes
    files: dict[str, Any] = {name: make(data) for name, data in described.items()}
    group: Any = zarr.open_group(MemoryStore(files), mode="r+", zarr_format=2)
    with zarr.config.set({"array.write_empty_chunks": True}):  # looking whether they are empty takes longer
        for name, values in arrays.items():
            group[name][start : start + len(values)] = values
    return {name: memoryview(file.as_numpy_array()) for name, file in files.items() if name not in described}
