"""A Zarr store that is read with its checksums: what is lost or damaged is an error, never a number.

This module needs zarr, which is optional: import it where a store is opened.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from zarr.storage import LocalStore

from singletrack.errors import InputError
from singletrack.sweep.durable import checksum

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

__all__ = ["CheckedStore"]


class CheckedStore(LocalStore):
    """A folder that is read only, each file by its checksum.

    Parameters
    ----------
    folder : Path
    sums : mapping of str to str
        SHA-256 by name of file.
    complete : bool
        Whether a file that is not in the list is an error, if it is there; otherwise it counts as not written.
    """

    def __init__(self, folder: Path, sums: Mapping[str, str], *, complete: bool = True) -> None:
        super().__init__(folder, read_only=True)
        self._sums, self._complete = sums, complete

    def with_read_only(self, read_only: bool = False) -> CheckedStore:
        """Return the store itself, for ``read_only``; there is no other way to open it."""
        if not read_only:
            raise InputError(f"{self.root}: is opened to be read")
        return self

    async def get(self, key: str, prototype: Any = None, byte_range: Any = None) -> Any:
        """Return a file, if it is as it was written."""
        listed = key in self._sums
        if not listed and not self._complete:
            return None
        found = await super().get(key, prototype)
        if not listed and found is None:
            return None
        if not listed:
            raise InputError(f"{self.root / key}: is not in the list of checksums of the sweep")
        if found is None:
            raise InputError(f"{self.root / key}: is missing; `singletrack sweep --check` lists all that is damaged")
        if checksum(found.to_bytes()) != self._sums[key]:
            raise InputError(
                f"{self.root / key}: is not as it was written; `singletrack sweep --check` lists all that is damaged"
            )
        return found if byte_range is None else await super().get(key, prototype, byte_range)

    async def get_partial_values(self, prototype: Any, key_ranges: Iterable[tuple[str, Any]]) -> list[Any]:
        """Return parts of files, if these are as they were written."""
        return [await self.get(key, prototype, part) for key, part in key_ranges]
