"""A bicycle's parameters from a sheet: mean, standard deviations and covariance, from a seeded sample."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.catalogue.notes import notes_of
from singletrack.catalogue.sample import draw
from singletrack.parameters import Bicycle

if TYPE_CHECKING:
    from singletrack.catalogue.sample import Drawn
    from singletrack.catalogue.weighing import Collection

__all__ = ["Estimate", "bicycle", "estimate", "summary"]


@dataclass(frozen=True, eq=False)
class Estimate:
    """A bicycle estimated from a sheet.

    Attributes
    ----------
    bicycle : Bicycle
        Means, with the standard deviations of all that is not known.
    names : tuple of str
        Of the k parameters.
    covariance : array, shape (k, k)
        Of these parameters, SI.
    sample : Bicycle
        A batch of shape (n,): designs that agree with the sheet, all parameters varying together.
    notes : dict of str to str
        Where each parameter comes from, in words.
    masses : dict of str to (float, float)
        Components by ``assembly: name``, with mean and standard deviation in kg given all that was weighed.
    """

    bicycle: Bicycle
    names: tuple[str, ...]
    covariance: np.ndarray
    sample: Bicycle
    notes: dict[str, str] = field(default_factory=dict)
    masses: dict[str, tuple[float, float]] = field(default_factory=dict)


def bicycle(**entries: Any) -> Bicycle:
    """Return a bicycle from a geometry sheet and what was weighed.

    Parameters
    ----------
    **entries
        Bare numbers are SI; text may have units and a standard deviation (``"72 deg"``, ``"45 +/- 1 mm"``).
        The angle of the steer axis, by ``head_angle`` or ``steer_axis_tilt``; ``fork_offset`` or ``trail``;
        ``wheel_size`` (``"37-622"``; ``rear_wheel_size``, ``front_wheel_size``) or ``rear_wheel_radius`` and
        ``front_wheel_radius``; ``wheel_base`` or ``front_centre`` or ``stack`` with ``reach``. Optional, or else
        typical: ``chain_stay_length``, ``bottom_bracket_drop`` or ``bottom_bracket_height``, ``stack``,
        ``head_tube_length``, ``fork_length``, ``seat_tube_angle``, ``seat_tube_length``, ``saddle_height``,
        ``saddle_setback``, ``stem_length``, ``stem_angle``, ``spacers``, ``bar`` (``"flat"``, ``"riser"``, ``"city"``,
        ``"drop"``), ``bar_width``, ``bar_rise``, ``bar_sweep`` (or ``grip_height``, ``grip_x``), ``front_hub_width``,
        ``rear_hub_width``, ``gravity``, ``name``. Masses: ``total_mass``, ``rear_frame_mass``, ``front_frame_mass``,
        ``rear_wheel_mass``, ``front_wheel_mass``, ``parts`` (``{"saddle": "600 g"}``), ``loads`` (mappings with
        ``name, mass, x, z``, optionally ``on, length, width, height``), ``with_parts`` and ``without_parts`` (names of
        what is there or not: ``"carrier"``, ``"dynamo hub"``).

    Returns
    -------
    Bicycle
        With standard deviations of all that is not known.

    Raises
    ------
    InputError
        For entries that are unknown, missing, or contradict each other; both values are told.

    Examples
    --------
    >>> mine = bicycle(head_angle="69 deg", fork_offset="50 mm", wheel_size="37-622", wheel_base="1.1 m")
    >>> round(mine.trail, 4), mine.standard_deviations["front_frame_inertia_zz"] > 0
    (0.0779, True)
    """
    return estimate(**entries).bicycle


def estimate(count: int = 2000, **entries: Any) -> Estimate:
    """Return a bicycle from a geometry sheet, with the covariance of its parameters and a sample.

    Parameters
    ----------
    count : int
        Size of the sample; the same sheet gives the same one.
    **entries
        As for :func:`bicycle`, which also tells the errors.

    Examples
    --------
    >>> mine = estimate(500, head_angle="69 deg", fork_offset="50 mm", wheel_size="37-622", wheel_base="1.1 m")
    >>> mine.sample.shape, mine.covariance.shape == (len(mine.names),) * 2
    ((500,), True)
    """
    return summary(draw(count, **entries))


def summary(made: Drawn) -> Estimate:
    """Return what a sample (``made``) says: means, deviations, covariance, and where each number comes from."""
    sheet, collection, masses, drawn = made.sheet, made.collection, made.masses, made.values
    count = len(masses)
    values = {name: float(array[0] if len(array) > count else array.mean()) for name, array in drawn.items()}
    sample = {name: array[-count:] for name, array in drawn.items()}
    known = {name: array for name, array in sample.items() if np.ptp(array) > 1e-9 * max(abs(values[name]), 1e-3)}
    # Centred on the values given, which for geometry are the sheet's.
    centred = np.stack([array - array.mean() for array in known.values()])
    covariance = centred @ centred.T / (count - 1)
    deviations = dict(zip(known, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    averages = {name: (float(mass.mean()), float(mass.std())) for name, mass in _by_name(collection, masses).items()}
    source = "estimated from its geometry and from what components weigh (singletrack new); docs/howto/catalogue.md"
    values = {name: _rounded(value, deviations.get(name)) for name, value in values.items()}
    deviations = {name: float(f"{deviation:.2e}") for name, deviation in deviations.items()}
    texts: dict[str, Any] = {"name": sheet.name, "source": source, "standard_deviations": deviations}
    own = Bicycle(**values | texts)
    texts = {"name": sheet.name}
    batch = Bicycle(**values | known | texts)
    return Estimate(own, tuple(known), covariance, batch, notes_of(made.geometry, collection, averages), averages)


def _by_name(collection: Collection, masses: np.ndarray) -> dict[str, np.ndarray]:
    """Return masses (n,) by ``assembly: component``; what has a place on each kind of bar is one component."""
    found: dict[str, np.ndarray] = {}
    for row, mass in zip(collection.rows, masses.T, strict=True):
        name = f"{row.assembly}: {row.name}"
        found[name] = found.get(name, 0.0) + mass
    return found


def _rounded(value: float, deviation: float | None) -> float:
    """Return a mean with no more digits than its standard deviation leaves meaning: a hundredth of it."""
    return value if not deviation else round(value, 2 - math.floor(math.log10(deviation)))
