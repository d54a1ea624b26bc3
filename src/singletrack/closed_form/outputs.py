"""Joint angles of the rider and forces of the hands, as linear outputs of the model (docs/theory/closed-form.md).

Cut the loops: then every joint s is a coordinate of its own, with equations M_s q" + ... = f_s + G^T m, where q are all
coordinates and m what keeps the loops' conditions g(s, steer) = 0. At rest the joints that the loops hold give m_0,

    0 = g_0 h_s + p_s + G^T m_0        (h: how the mass sinks with a joint, p: preload),

and to first order, with q = T d the motion of the whole loops along the freedoms d,

    G^T m = [M T d" + (C0 + v C1) T d' + (S0 + g K0 + v^2 K2 - m_0 . g") T d - f]_s.

What a hand does to the handlebar is -m, in axes that lean and yaw with the rear frame.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.closed_form.coefficients import coefficients, seated_model
from singletrack.errors import InputError
from singletrack.model import GROUND_ACCELERATION, LinearModel, Outputs
from singletrack.parameters import Bicycle
from singletrack.posture import CutLoops, Options, cut_loops, lateral_work, seat, slaved_bodies

if TYPE_CHECKING:
    from singletrack.parameters import Rider

__all__ = ["rider_outputs"]

_ROWS = ("M", "C0", "C1", "S0", "K0", "K2")


def rider_outputs(
    bicycle: Bicycle,
    rider: Rider,
    options: Options | str = "rigid",
    forces: Mapping[str, str | tuple[float, float]] | None = None,
) -> Outputs:
    """Return angles and rates of the rider's joints, and forces of the hands, as outputs of the linear model.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider
    options : Options or str
        How the rider sits, or a posture's name.
    forces : mapping, optional
        Lateral forces among the model's inputs, by name: the point on which each acts, as for
        :func:`singletrack.control.lateral_force`. What they do at once to the hands depends on it.

    Returns
    -------
    Outputs
        ``right elbow`` and ``right elbow rate`` of each joint that follows from the loops, in rad and rad/s (m and m/s
        of sliders); ``right hand force x``, ``... y``, ``... z`` of each hand, in N: on the handlebar, forward, to the
        right and down in axes that lean and yaw with the rear frame; ``NAME moment`` of a loop of two directions.

    Raises
    ------
    InputError, PostureError
        As for :func:`singletrack.coefficients`.

    Examples
    --------
    How hard the leaned rider presses on the left grip at rest, forward and down, in N:

    >>> from singletrack import load_bicycle, load_rider
    >>> outputs = rider_outputs(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    >>> outputs.select(["left hand force x", "left hand force z"]).rest.round(1).tolist()
    [44.2, 63.7]
    """
    options = Options.of(options)
    model = coefficients(bicycle, rider, options)
    posture = seat(bicycle, rider, options)
    inputs = (*model.inputs, GROUND_ACCELERATION, *(forces or {}))
    if len(set(inputs)) < len(inputs):
        raise InputError(
            f"forces {', '.join(forces or {})}: a name is that of another input: {', '.join(model.inputs)}"
        )
    batch = model.shape
    nothing = {name: np.zeros((*batch, 0, model.freedoms)) for name in _ROWS}
    nothing["B"] = np.zeros((*batch, 0, len(inputs)))
    parts = [(nothing, np.zeros((*batch, 0)))]
    names: list[str] = []
    if posture.loops:
        cut = cut_loops(posture, bicycle)
        joints = [posture.joints[k].name for k in cut.held]
        kept = sorted(range(len(cut.names)), key=lambda k: _loop_order(posture.loops, cut.names[k]))
        names = [*joints, *(f"{name} rate" for name in joints), *(cut.names[k] for k in kept)]
        whole = _Whole(bicycle, cut, model, inputs, forces or {})
        parts += [*whole.angles(), whole.forces(kept)]
    rows: dict[str, Any] = {
        name: np.concatenate([np.broadcast_to(part[name], (*batch, *part[name].shape[-2:])) for part, _ in parts], -2)
        for name in (*_ROWS, "B")
    }
    rest = np.concatenate([np.broadcast_to(own, (*batch, own.shape[-1])) for _, own in parts], -1)
    return Outputs(tuple(names), **rows, gravity=model.gravity, coordinates=model.coordinates, inputs=inputs, rest=rest)


def _loop_order(loops: Any, name: str) -> int:
    return next(k for k, loop in enumerate(loops) if name.startswith(f"{loop.name} "))


@dataclass(frozen=True, eq=False)
class _Whole:
    """A rider with cut loops, beside the model of the whole ones."""

    bicycle: Bicycle
    cut: CutLoops
    model: LinearModel
    inputs: tuple[str, ...]
    at: Mapping[str, str | tuple[float, float]]

    def angles(self) -> list[tuple[dict[str, Any], Any]]:
        """Return the rows of the angles of the joints held, and of their rates."""
        own = self._following()[..., self.cut.held, :]
        zero, still = 0.0 * own, np.zeros((*own.shape[:-1], len(self.inputs)))
        angle = {**dict.fromkeys(_ROWS, zero), "S0": own, "B": still}
        rate = {**dict.fromkeys(_ROWS, zero), "C0": own, "B": still}
        return [(angle, np.zeros(own.shape[:-1])), (rate, np.zeros(own.shape[:-1]))]

    def _following(self) -> Any:
        """Return how the joints follow the model's coordinates, (..., joints, n)."""
        names, following = self.model.coordinates, np.asarray(self.cut.following)
        found = np.zeros((*following.shape[:-1], len(names)))
        for k, name in enumerate(("steer", *self.cut.freedoms)):
            found[..., names.index(name)] = following[..., k]
        return found

    def forces(self, kept: list[int]) -> tuple[dict[str, Any], Any]:
        """Return the rows of what the loops do to their far ends, and its values at rest, in the order wanted."""
        cut, held = self.cut, self.cut.held
        opened = seated_model(self.bicycle, cut.posture, massless=True)
        names, joints = opened.coordinates, [joint.name for joint in cut.posture.joints]
        rows = [names.index(joints[k]) for k in held]
        along = self._along(names, joints)
        # The steer and the joints as they follow the model's coordinates, for the second derivatives.
        bends = along[..., [names.index(name) for name in ("steer", *joints)], :]
        sound = self.model.valid[..., None, None]
        turn = np.linalg.inv(np.where(sound, np.swapaxes(np.asarray(cut.gradient)[..., held], -1, -2), np.nan))
        sinks, preload = self._loads()
        carried = {"K0": -(turn @ sinks[..., None])[..., 0], "S0": -(turn @ preload[..., None])[..., 0]}
        found: dict[str, Any] = {}
        for name in _ROWS:
            own = np.asarray(getattr(opened, name))[..., rows, :] @ along
            if name in carried:
                bent = np.einsum("...c,...cij->...ij", carried[name], np.asarray(cut.bending)[..., held, :])
                own = own - bent @ bends
            found[name] = -(turn @ own)[..., kept, :]
        found["B"] = (turn @ self._pushes(opened, rows))[..., kept, :]
        gravity = np.asarray(self.model.gravity)[..., None]
        return found, -(gravity * carried["K0"] + carried["S0"])[..., kept]

    def _along(self, names: tuple[str, ...], joints: list[str]) -> Any:
        """Return how all coordinates of the cut rider follow the model's, (..., N, n)."""
        following, own = self._following(), self.model.coordinates
        along = np.zeros((*following.shape[:-2], len(names), len(own)))
        for i, name in enumerate(names):
            if name in joints:
                along[..., i, :] = following[..., joints.index(name), :]
            else:
                along[..., i, own.index(name)] = 1.0
        return along

    def _loads(self) -> tuple[Any, Any]:
        """Return how mass times height sinks with the joints held, and their preloads: (..., c) each."""
        bodies, held = slaved_bodies(self.cut.posture, self.bicycle), self.cut.held
        mass, moved = np.asarray(bodies.mass), np.asarray(bodies.displacement)[..., 1:, :, 2]
        sinks = np.sum(mass[..., None, :] * moved, axis=-1)[..., held]
        preloads = [np.asarray(self.cut.posture.joints[k].preload, dtype=float) for k in held]
        return sinks, np.stack(np.broadcast_arrays(*preloads), axis=-1)

    def _pushes(self, opened: LinearModel, rows: list[int]) -> Any:
        """Return the inputs' work on the joints held, (..., c, m)."""
        columns = [np.zeros(len(rows))] * len(self.model.inputs)
        columns.append(np.asarray(opened.K0)[..., 0, :][..., rows])
        for point in self.at.values():
            if isinstance(point, str):
                columns.append(np.asarray(lateral_work(self.cut.posture, self.bicycle, point))[..., rows])
            else:  # a point of the rear frame: no joint moves it
                columns.append(np.zeros(len(rows)))
        return np.stack(np.broadcast_arrays(*columns), axis=-1)
