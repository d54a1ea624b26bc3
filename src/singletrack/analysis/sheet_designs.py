"""A design that is a geometry sheet: its entries vary, and the bicycle follows, with masses and inertias."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping  # part of the record
from typing import TYPE_CHECKING

from singletrack.analysis.designs import Design
from singletrack.arrays import Number  # part of the record
from singletrack.catalogue import Expected  # part of the public signature
from singletrack.errors import InputError

if TYPE_CHECKING:
    from singletrack.parameters import Rider
    from singletrack.posture import Options

__all__ = ["SheetDesign"]


@dataclasses.dataclass(frozen=True, eq=False)
class SheetDesign(Design):
    """A sheet, who sits on the bicycle that it makes, and how. Its numbers are the sheet's, not the bicycle's.

    Attributes
    ----------
    expected : Expected
        What bicycles the sheet makes as its entries vary.
    entries : mapping of str to array, shape (...)
        The entries, in SI.

    Examples
    --------
    >>> from singletrack.catalogue import expected
    >>> sheet = expected(head_angle="69 deg", fork_offset="50 mm", wheel_size="37-622", wheel_base="1.1 m")
    >>> design = SheetDesign.of_sheet(sheet)
    >>> changed = design.changed({"fork_offset": 0.06})
    >>> round(float(design.bicycle.trail), 4), round(float(changed.bicycle.trail), 4)
    (0.0779, 0.0672)
    """

    expected: Expected | None = None
    entries: Mapping[str, Number] = dataclasses.field(default_factory=dict)

    @classmethod
    def of_sheet(
        cls, expected: Expected, rider: Rider | None = None, options: Options | str = "rigid", title: str = ""
    ) -> SheetDesign:
        """Return the design that a sheet makes.

        Parameters
        ----------
        expected : Expected
        rider : Rider, optional
        options : Options or str
            How the rider sits, or a posture's name.
        title : str
            By default the sheet's name.
        """
        own = Design.of(expected.bicycle({}), rider, options, title or expected.sheet.name or "sheet")
        return cls(own.bicycle, own.rider, own.options, own.title, expected, dict(expected.values))

    def _sheet(self) -> Expected:
        if self.expected is None:
            raise InputError("SheetDesign: has no sheet; make it by SheetDesign.of_sheet")
        return self.expected

    def values(self) -> dict[str, Number]:
        """Return every number that can be changed: entries of the sheet, the rider's and the posture's, in SI."""
        bicycle = self.bicycle.values()
        return dict(self.entries) | {n: value for n, value in super().values().items() if n not in bicycle}

    def units(self) -> dict[str, str]:
        """Return the SI unit of each of :meth:`values`."""
        return super().units() | self._sheet().units

    def deviations(self) -> dict[str, float]:
        """Return the standard deviations of :meth:`values`, in SI, where there are."""
        theirs = {} if self.rider is None else self.rider.standard_deviations
        return {name: float(deviation) for name, deviation in {**theirs, **self._sheet().deviations}.items()}

    def changed(self, changes: Mapping[str, Number]) -> SheetDesign:
        """Return the design, or a batch, with some numbers of other values; the bicycle follows from the sheet.

        Parameters
        ----------
        changes : mapping of str to array, shape (...)
            SI.

        Raises
        ------
        InputError
            If there is no such number, or no such bicycle can exist.
        """
        own = {name: value for name, value in changes.items() if name in self.entries}
        rest = super().changed({name: value for name, value in changes.items() if name not in own})
        entries = dict(self.entries) | own
        bicycle = self._sheet().bicycle(entries) if own else self.bicycle
        return dataclasses.replace(self, bicycle=bicycle, rider=rest.rider, options=rest.options, entries=entries)
