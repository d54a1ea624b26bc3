"""The freedoms of a soft frame and fork: their names, their parameters, and what has to be given together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from singletrack.arrays.faults import Fault
from singletrack.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from singletrack.parameters.record import Record

__all__ = ["FORK_BENDING", "FRAME_TORSION", "HINGE_PARAMETERS", "hinge_faults"]

#: Names of the freedoms.
FRAME_TORSION, FORK_BENDING = "frame torsion", "fork bending"
#: How the parameters of each begin: those of its spring and damper, those of its place.
HINGE_PARAMETERS = {FRAME_TORSION: ("frame_torsion", "frame_hinge"), FORK_BENDING: ("fork_bending", "fork_hinge")}


def hinge_faults(bicycle: Record) -> Iterator[Fault]:
    """Yield a fault for each soft hinge of which only one coordinate is given.

    Parameters
    ----------
    bicycle : Record
        A bicycle.
    """
    for what, where in HINGE_PARAMETERS.values():
        if getattr(bicycle, f"{what}_stiffness") is None:
            continue
        for axis, other in ("xz", "zx"):
            if getattr(bicycle, f"{where}_{axis}") is None and getattr(bicycle, f"{where}_{other}") is not None:
                text = f"{where}_{other} needs {where}_{axis} too: both, or none for the fork's crown"
                yield Fault(np.ones((), dtype=bool), text, {}, InputError, (f"{where}_{axis}",), "a finite number in m")
