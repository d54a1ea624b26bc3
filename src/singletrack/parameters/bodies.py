"""The four bodies of a bicycle, told once: which parameters are whose mass, centre and inertia."""

from __future__ import annotations

from typing import TYPE_CHECKING

from singletrack.mechanics.rigid import PlanarBody, combine

if TYPE_CHECKING:
    from collections.abc import Mapping

    from singletrack.arrays import Number
    from singletrack.parameters.bicycle import Bicycle

__all__ = ["bicycle_bodies", "bodies_of_values", "frame_parameters", "with_rigid_rider"]

_ENDS = ("rear", "front")
_WHEEL = ("mass", "radius", "inertia_xx", "inertia_yy")
_FRAME = ("mass", "x", "z", "inertia_xx", "inertia_yy", "inertia_zz", "inertia_xz")


def bicycle_bodies(bicycle: Bicycle) -> dict[str, PlanarBody]:
    """Return rear frame, front frame, rear wheel and front wheel by name, upright and straight ahead.

    Parameters
    ----------
    bicycle : Bicycle
        Parameters of any broadcastable shapes (...).

    Examples
    --------
    >>> from singletrack import load_bicycle
    >>> {name: (body.x, body.z) for name, body in bicycle_bodies(load_bicycle("benchmark")).items()}
    {'rear frame': (0.3, -0.9), 'front frame': (0.9, -0.7), 'rear wheel': (0.0, -0.3), 'front wheel': (1.02, -0.35)}
    """
    return bodies_of_values(bicycle.values())


def bodies_of_values(values: Mapping[str, Number]) -> dict[str, PlanarBody]:
    """Return the four bodies of parameters by name, as kernels have them (see :func:`bicycle_bodies`).

    Parameters
    ----------
    values : mapping of str to array, shape (...)
        The 25 parameters of a bicycle.
    """
    frames = {f"{end} frame": PlanarBody(*(values[f"{end}_frame_{part}"] for part in _FRAME)) for end in _ENDS}
    wheels = {}
    for end, x in zip(_ENDS, (0.0, values["wheel_base"]), strict=True):
        mass, radius, across, along = (values[f"{end}_wheel_{part}"] for part in _WHEEL)
        wheels[f"{end} wheel"] = PlanarBody(mass, x, -radius, xx=across, yy=along, zz=across, xz=0.0)
    return frames | wheels


def frame_parameters(end: str, body: PlanarBody) -> dict[str, float]:
    """Return a frame's body as parameters, by name: what :func:`bicycle_bodies` makes, undone.

    Parameters
    ----------
    end : {"rear", "front"}
    body : PlanarBody
        A single one.
    """
    return {f"{end}_frame_{part}": float(entry) for part, entry in zip(_FRAME, body, strict=True)}


def with_rigid_rider(bicycle: Bicycle, rider: PlanarBody) -> Bicycle:
    """Return a bicycle with a rigid rider lumped into its rear frame (a rider given as one body, hands free).

    Parameters
    ----------
    bicycle : Bicycle
        A single design.
    rider : PlanarBody
    """
    frame = bicycle_bodies(bicycle)["rear frame"]
    changes = frame_parameters("rear", PlanarBody.of(combine([frame.body(), rider.body()])))
    # The frame's standard deviations are not those of frame and rider.
    kept = {name: sd for name, sd in bicycle.standard_deviations.items() if name not in changes}
    return bicycle.replace(**changes, standard_deviations=kept)
