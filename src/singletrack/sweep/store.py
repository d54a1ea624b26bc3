"""The store of a sweep: a labelled xarray Dataset in Zarr, filled stretch by stretch, and a journal of what is done.

While a sweep runs, everything is in ``NAME.partial``: the store, and a journal that gets a line when all arrays of a
stretch are on disk. What the journal does not list is computed again, over whatever was there. The finished store is
moved to its place in one step.
"""

from __future__ import annotations

import base64
import fcntl
import json
import os
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from singletrack.errors import InputError
from singletrack.sweep.chunks import chunk_size
from singletrack.sweep.study import Study  # field of a record

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Self

    import xarray


__all__ = ["Store", "open_sweep", "write_chunk"]

#: For each array: dimensions after "design", unit, dtype and meaning.
_ARRAYS: dict[str, tuple[tuple[str, ...], str, str, str]] = {
    "M": (("equation", "coordinate"), "kg m^2", "f8", "mass matrix"),
    "C1": (("equation", "coordinate"), "kg m", "f8", "damping matrix per speed"),
    "K0": (("equation", "coordinate"), "kg m", "f8", "stiffness matrix per gravity"),
    "K2": (("equation", "coordinate"), "kg", "f8", "stiffness matrix per squared speed"),
    "eigenvalues": (("speed", "root"), "1/s", "c16", "sorted by real then imaginary part"),
    "weave_speeds": (("crossing",), "m/s", "f8", "a pair crosses the imaginary axis; NaN: no more"),
    "capsize_speeds": (("crossing",), "m/s", "f8", "a real root crosses zero; NaN: no more"),
    "stable_ranges": (("range", "bound"), "m/s", "f8", "all roots in the left half plane; NaN: no more"),
    "fault": ((), "", "i2", "0: sound; k: faulty, the k-th of the attribute fault_kinds; its results are NaN"),
}
_LABELS: dict[str, list[str]] = {
    "equation": ["lean", "steer"],
    "coordinate": ["lean", "steer"],
    "bound": ["from", "to"],
}
_KEPT = {
    "matrices": ("M", "C1", "K0", "K2"),
    "eigenvalues": ("eigenvalues",),
    "critical_speeds": ("weave_speeds", "capsize_speeds"),
    "stable_ranges": ("stable_ranges",),
}
_SIZES = {"equation": 2, "coordinate": 2, "root": 4, "crossing": 2, "range": 3, "bound": 2}


@dataclass
class Store:
    """A sweep's store while it is being filled (a context manager that holds the lock).

    Attributes
    ----------
    study : Study
    output : Path
        Where the finished store will be.
    done : set of int
        Starts of the stretches that are on disk.
    """

    study: Study
    output: Path
    done: set[int] = field(default_factory=set)
    _journal: TextIO | None = None

    @property
    def partial(self) -> Path:
        """Folder of the unfinished sweep."""
        return self.output.with_name(self.output.name + ".partial")

    @property
    def data(self) -> Path:
        """The Zarr store inside :attr:`partial`."""
        return self.partial / "data.zarr"

    def pieces(self) -> Iterator[tuple[int, int]]:
        """Yield (start, stop) of the stretches that are left to compute."""
        size, count = chunk_size(len(self.study.speeds)), self.study.designs.count
        for start in range(0, count, size):
            if start not in self.done:
                yield start, min(start + size, count)

    def __enter__(self) -> Self:
        try:
            self.partial.mkdir(parents=True, exist_ok=True)
            journal = (self.partial / "journal.jsonl").open("a+", encoding="utf-8")
        except OSError as error:
            raise InputError(
                f"{self.partial}: cannot be written ({error.strerror}); must be in a folder that can be"
            ) from None
        try:
            fcntl.flock(journal, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            journal.close()
            raise InputError(
                f"{self.partial}: another sweep is writing here; wait for it or choose another output"
            ) from None
        self._journal = journal
        journal.write("\n")  # ends a line that was cut short when its writer was killed
        lines = _journal_lines(self.partial / "journal.jsonl")
        if not lines:
            self._create()
            self._append({"study": self.study.fingerprint})
        elif lines[0].get("study") != self.study.fingerprint:
            journal.close()
            raise InputError(
                f"{self.partial}: holds an unfinished sweep of another study (or of this file before it was changed); "
                "remove it, or choose another output"
            )
        self.done = {line["start"] for line in lines[1:]}
        return self

    def __exit__(self, *_: object) -> None:
        if self._journal is not None:
            self._journal.close()

    def record(self, start: int, faults: dict[str, np.ndarray]) -> None:
        """Note that a stretch is on disk, and which of its designs are faulty (a mask for each kind)."""
        packed = {kind: base64.b64encode(np.packbits(bad).tobytes()).decode() for kind, bad in faults.items()}
        self._append({"start": start, "faults": packed})
        self.done.add(start)

    def _append(self, line: dict[str, Any]) -> None:
        assert self._journal is not None  # noqa: S101  # only used inside the context
        self._journal.write(json.dumps(line) + "\n")
        self._journal.flush()
        os.fsync(self._journal.fileno())

    def _create(self) -> None:
        import zarr  # lazy: optional

        shutil.rmtree(self.data, ignore_errors=True)
        group = zarr.open_group(str(self.data), mode="w", zarr_format=2)
        study, count = self.study, self.study.designs.count
        size = chunk_size(len(study.speeds))
        names = [name for kind in study.keep for name in _KEPT[kind]] + ["fault"]
        used: set[str] = set()
        for name in names:
            dimensions, unit, dtype, meaning = _ARRAYS[name]
            used.update(dimensions)
            tail = tuple(len(study.speeds) if d == "speed" else _SIZES[d] for d in dimensions)
            attributes = {"units": unit, "long_name": meaning}
            _array(group, size, name, (count, *tail), ("design", *dimensions), dtype, attributes)
        for v in study.designs.variations:
            _array(group, size, v.name, (count,), ("design",), "f8", {"units": v.unit, "owner": v.owner})
        labels: dict[str, Any] = {name: np.array(values) for name, values in _LABELS.items() if name in used}
        for name, values in {**labels, "speed": study.speeds}.items():
            about = {"units": "m/s"} if name == "speed" else {}
            group.create_array(
                name, data=values, fill_value=None, compressors=None, attributes={"_ARRAY_DIMENSIONS": [name], **about}
            )
        group.attrs.update(self._provenance())

    def _provenance(self) -> dict[str, Any]:
        study = self.study
        described = study.to_dict()
        described.pop("speeds")
        coordinates = " ".join(v.name for v in study.designs.variations)
        return {
            "name": study.name,
            "description": study.description,
            "study": json.dumps(described),
            "fingerprint": study.fingerprint,
            "singletrack": described["singletrack"],
            "numpy": np.__version__,
            "coordinates": coordinates,
        }

    def finish(self) -> None:
        """Write the faults of all stretches, and move the store to its place."""
        import zarr

        group = zarr.open_group(str(self.data), mode="r+", zarr_format=2)
        lines = _journal_lines(self.partial / "journal.jsonl")[1:]
        kinds = list(dict.fromkeys(kind for line in lines for kind in line["faults"]))
        size, count = chunk_size(len(self.study.speeds)), self.study.designs.count
        fault: Any = group["fault"]
        for line in lines:
            found = np.zeros(min(size, count - line["start"]), dtype=np.int16)
            for kind, packed in line["faults"].items():
                bits = np.unpackbits(np.frombuffer(base64.b64decode(packed), dtype=np.uint8), count=len(found))
                found[(found == 0) & (bits == 1)] = kinds.index(kind) + 1
            fault[line["start"] : line["start"] + size] = found
        group.attrs["fault_kinds"] = kinds
        zarr.consolidate_metadata(group.store)
        self.data.rename(self.output)
        shutil.rmtree(self.partial)


def _array(
    group: Any,
    size: int,
    name: str,
    shape: tuple[int, ...],
    dimensions: tuple[str, ...],
    dtype: str,
    attributes: dict[str, Any],
) -> None:
    """Create an array that is filled stretch by stretch; not compressed, since the digits of results are noise."""
    fill = None if dtype == "i2" else np.nan  # what equals it reads as missing
    group.create_array(
        name,
        shape=shape,
        chunks=(min(size, shape[0]), *shape[1:]),
        dtype=dtype,
        fill_value=fill,
        compressors=None,
        attributes={"_ARRAY_DIMENSIONS": list(dimensions), **attributes},
    )


def _journal_lines(path: Path) -> list[dict[str, Any]]:
    """Return the lines of a journal; one that was cut short when the writer was killed does not count."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            lines.append(json.loads(line))
        except json.JSONDecodeError:
            continue
    return lines


def write_chunk(data: Path, start: int, arrays: dict[str, np.ndarray]) -> None:
    """Write the arrays of the designs from ``start`` on; stretches are chunks of the store, so any order will do."""
    import zarr  # lazy: optional

    group: Any = zarr.open_group(str(data), mode="r+", zarr_format=2)
    with zarr.config.set({"array.write_empty_chunks": True}):  # looking whether they are empty takes longer
        for name, values in arrays.items():
            group[name][start : start + len(values)] = values


def open_sweep(path: str | Path) -> xarray.Dataset:
    """Open a finished sweep: lazily, labelled, with units and provenance.

    Designs are on the dimension ``design``, with the parameters that vary as coordinates; designs of a grid have a
    dimension for each parameter instead.

    Raises
    ------
    InputError
        If there is no finished sweep at that path.
    """
    import xarray as xr  # lazy: heavy

    path = Path(path)
    if not (path / ".zgroup").exists():
        unfinished = path.with_name(path.name + ".partial").exists()
        hint = "; the sweep is not finished: run it again to go on" if unfinished else ""
        raise InputError(f"{path}: is not a finished sweep{hint}")
    dataset: xarray.Dataset = xr.open_zarr(path, chunks=None, consolidated=True)
    described = json.loads(dataset.attrs["study"])["designs"]
    dataset = dataset.set_coords(list(described["vary"]))
    if described["method"] != "grid":
        return dataset
    return _unstacked(dataset, {name: entry["numbers"] for name, entry in described["vary"].items()})


def _unstacked(dataset: xarray.Dataset, axes: dict[str, list[float]]) -> xarray.Dataset:
    import xarray as xr

    units = {name: dict(dataset[name].attrs) for name in axes}
    shape = tuple(len(values) for values in axes.values())
    variables = {}
    for name, variable in dataset.drop_vars(list(axes)).variables.items():
        if "design" in variable.dims:
            values = np.asarray(variable.values).reshape(*shape, *variable.shape[1:])
            variables[name] = ((*axes, *variable.dims[1:]), values, variable.attrs)
        else:
            variables[name] = (variable.dims, variable.values, variable.attrs)
    coordinates = {name: (name, np.array(values), units[name]) for name, values in axes.items()}
    others = {name: variables.pop(name) for name in list(variables) if name in dataset.coords}
    return xr.Dataset(variables, coords={**coordinates, **others}, attrs=dataset.attrs)
