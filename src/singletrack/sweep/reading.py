"""Opening a sweep: an xarray Dataset whose numbers are those that were written, or an error."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import InputError
from singletrack.sweep.checksums import CHECKSUMS, damages, is_intact, read_checksums
from singletrack.sweep.journal import read_journal
from singletrack.sweep.layout import CODES
from singletrack.sweep.store import DATA, JOURNAL, partial_of

if TYPE_CHECKING:
    import xarray

    from singletrack.sweep.study import Study

__all__ = ["Condition", "check_sweep", "designs_to_dicts", "is_finished", "open_sweep"]

#: Answers of a design, with the array that says whether there is one.
_ANSWERS = {"weave_speeds": "weave_status", "capsize_speeds": "capsize_status", "stable_ranges": "stable_status"}


@dataclass(frozen=True)
class Condition:
    """What a check of a store has found.

    Attributes
    ----------
    files : int
        Checked.
    damages : tuple of str
        What is wrong, a line for each file.
    designs : dict of str to int
        How many are not computed, computed, faulty.
    """

    files: int
    damages: tuple[str, ...]
    designs: dict[str, int]


def open_sweep(path: str | Path, *, unfinished: bool = False) -> xarray.Dataset:
    """Open a sweep: labelled, with units and provenance, every file checked as it is read: lazily, but for grids.

    Designs are on the dimension ``design``, with the parameters that vary as coordinates; designs of a grid have a
    dimension for each parameter instead. ``status`` says of each design whether it is computed (1), faulty (2) or not
    computed (0); ``weave_status`` and its like whether a speed was found (1), there is none (2), the design is faulty
    (3) or not computed (0), or nothing can be told (4). The codes stand in the attributes ``flag_values`` and
    ``flag_meanings``.

    Parameters
    ----------
    path : str or Path
        ``NAME.zarr``.
    unfinished : bool
        Open what there is of a sweep that is not finished. Its parameters are NaN where it is not computed, it stays
        on the dimension ``design``, and there is no ``fault``.

    Raises
    ------
    InputError
        If there is no finished sweep at that path, or a file of it is not as it was written (then, or when it is read).
    """
    import xarray as xr  # lazy: heavy

    from singletrack.sweep.checked_zarr import CheckedStore  # lazy: optional

    path = Path(path)
    if unfinished:
        store = CheckedStore(partial_of(path) / DATA, _sums_so_far(path), complete=False)
    else:
        _refuse_unfinished(path)
        store = CheckedStore(path, read_checksums(path))
    dataset: xarray.Dataset = xr.open_zarr(store, chunks=None, consolidated=True)
    described = json.loads(dataset.attrs["study"])["designs"]
    dataset = dataset.set_coords(described["order"])
    if unfinished:
        return dataset.drop_vars("fault")
    if described["method"] != "grid":
        return dataset
    return _unstacked(dataset, {name: described["vary"][name]["numbers"] for name in described["order"]})


def check_sweep(path: str | Path) -> Condition:
    """Read every file of a finished sweep and compare it with its checksum.

    Raises
    ------
    InputError
        If there is no finished sweep at that path, or its list of checksums cannot be read.
    """
    path = Path(path)
    _refuse_unfinished(path)
    sums = read_checksums(path)
    found = damages(path, sums)
    designs = {} if found else _counts(open_sweep(path)["status"].values)
    return Condition(len(sums), tuple(found), designs)


def is_finished(study: Study, path: Path) -> bool:
    """Return whether there is the finished sweep of a study at a path, as far as its description goes."""
    try:
        sums = read_checksums(path)
        attributes = json.loads((path / ".zattrs").read_bytes())
    except (InputError, OSError, ValueError):
        return False
    return is_intact(path / ".zattrs", sums.get(".zattrs", "")) and attributes["fingerprint"] == study.fingerprint


def _sums_so_far(path: Path) -> dict[str, str]:
    found = read_journal(partial_of(path) / JOURNAL)
    if found is None:
        raise InputError(f"{partial_of(path)}: is not an unfinished sweep")
    sums = dict(found.files)
    for entry in found.entries.values():
        sums |= entry.sums
    return sums


def _counts(status: np.ndarray) -> dict[str, int]:
    counts = np.bincount(status.ravel(), minlength=len(CODES["status"]))
    return {meaning: int(count) for meaning, count in zip(CODES["status"], counts, strict=True)}


def _refuse_unfinished(path: Path) -> None:
    if not path.is_dir() or not ((path / ".zgroup").exists() or (path / CHECKSUMS).exists()):
        unfinished = partial_of(path).exists()
        hint = "; the sweep is not finished: run it again to go on" if unfinished else ""
        raise InputError(f"{path}: is not a finished sweep{hint}")


def designs_to_dicts(dataset: xarray.Dataset, start: int = 0, stop: int | None = None) -> list[dict[str, Any]]:
    """Return designs as plain values for JSON: parameters, status, and what is known of the critical speeds.

    An answer is a list; it is empty for "never" and None where there is none, the design being faulty or not computed,
    or because nothing could be told.

    Parameters
    ----------
    dataset : xarray.Dataset
        Of :func:`open_sweep`.
    start, stop : int, optional
        The designs, by number.
    """
    names = json.loads(dataset.attrs["study"])["designs"]["order"]
    flat = dataset if "design" in dataset.dims else dataset.stack(design=names)  # xarray's
    part = flat.isel(design=slice(start, stop))
    kinds = ["", *dataset.attrs.get("fault_kinds", [])]
    records = []
    for i in range(part.sizes["design"]):
        one = part.isel(design=i)
        status = CODES["status"][int(one["status"])]
        record: dict[str, Any] = {name: None if status == "not_computed" else float(one[name]) for name in names}
        record["status"] = status
        if "fault" in part:
            record["fault"] = kinds[int(one["fault"])] or None
        for name, code in _ANSWERS.items():
            if name in part:
                record[name] = _answer(one[name].values, CODES[code][int(one[code])])
        records.append(record)
    return records


def _answer(values: np.ndarray, status: str) -> list[Any] | None:
    if status not in {"found", "never"}:
        return None
    if values.ndim == 1:
        return [float(value) for value in values if np.isfinite(value)]
    return [[float(low), None if np.isinf(high) else float(high)] for low, high in values if not np.isnan(low)]


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
