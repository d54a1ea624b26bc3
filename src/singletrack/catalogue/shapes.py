"""Own shapes of components: centres and second moments of tubes, lumps, arcs and the hoops of a wheel.

A component off the middle plane stands for itself and its mirror image, half the mass each.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.arrays import namespace
from singletrack.mechanics.rigid import PlanarBody

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["LUMP_SIZE", "Placed", "assemble", "place", "wheel_inertias"]

#: Relative standard deviation of a lump's length, width and height: how a box stands for what is none.
LUMP_SIZE = 0.2
_PLANE = np.array([0, 2])
#: Centre (n, 2), forward and down in m; second moments about it by unit mass, (n,) each, in m^2: xx, yy, zz, xz.
Placed = tuple[np.ndarray, tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]


def place(
    shape: str, form: Mapping[str, Any], points: Mapping[str, np.ndarray], shift: np.ndarray, swell: np.ndarray
) -> Placed:
    """Return where a component's mass is.

    Parameters
    ----------
    shape : {"lump", "rod", "arc"}
    form : mapping
        What the shape needs, as the table of components tells.
    points : mapping of str to array, shape (n, 3)
    shift : array, shape (n, 3)
        How far from its usual place it is, in m: forward, down, aside.
    swell : array, shape (n,)
        Standard normal number: how much larger a lump is than usual, in deviations of :data:`LUMP_SIZE`.
    """
    aside, shift = shift[:, 2], shift[:, :2]
    if shape == "rod":
        start, end = (points[form[key]] for key in ("from", "to"))
        apart, thick = form.get("apart", 0.0), form.get("thick", 0.03)
        along = (end - start)[:, _PLANE]
        left, right = start[:, 1] + aside, end[:, 1] + aside
        y = (left**2 + left * right + right**2) / 3 + apart**2
        own = thick**2 / 8
        moments = (
            along[:, 0] ** 2 / 12 + own,
            y + own / 2,
            along[:, 1] ** 2 / 12 + own,
            along[:, 0] * along[:, 1] / 12,
        )
        return (start + end)[:, _PLANE] / 2 + shift, moments
    if shape == "arc":
        hub = points[form["about"]]
        angles = np.radians(np.linspace(form["arc"][0], form["arc"][1], 19))
        x, z = np.cos(angles), -np.sin(angles)
        radius = 0.015 - hub[:, 2]
        centre = hub[:, _PLANE] + radius[:, None] * np.array([x.mean(), z.mean()]) + shift
        xz = ((x - x.mean()) * (z - z.mean())).mean()
        square = radius**2
        return centre, (square * x.var(), 0.0 * square + 0.025**2, square * z.var(), square * xz)
    at = points[form["at"]]
    length, width, height = (size * np.exp(LUMP_SIZE * swell) for size in form["size"])
    y = (at[:, 1] + form.get("apart", 0.0) + aside) ** 2 + width**2 / 12
    centre = at[:, _PLANE] + np.array(form.get("offset", (0.0, 0.0))) + shift
    return centre, (length**2 / 12, y, height**2 / 12, 0.0 * y)


def assemble(masses: Sequence[np.ndarray], placed: Sequence[Placed]) -> PlanarBody:
    """Return components as one rigid body, entries of shape (n,).

    Parameters
    ----------
    masses : sequence of array, shape (n,)
        In kg.
    placed : sequence of Placed
        Of the same components.
    """
    xp = namespace(*masses, placed[0][0])
    weights = xp.stack(masses)
    total = weights.sum(0)
    centres = xp.stack([centre for centre, _ in placed])
    centre = (weights[..., None] * centres).sum(0) / total[:, None]
    arms = centres - centre
    own = xp.stack([xp.stack(xp.broadcast_arrays(*moments)) for _, moments in placed])
    x2, y2, z2, xz = (weights[:, None] * own).sum(0)
    x2 = x2 + (weights * arms[..., 0] ** 2).sum(0)
    z2 = z2 + (weights * arms[..., 1] ** 2).sum(0)
    xz = xz + (weights * arms[..., 0] * arms[..., 1]).sum(0)
    return PlanarBody(total, centre[:, 0], centre[:, 1], xx=y2 + z2, yy=x2 + z2, zz=x2 + y2, xz=-xz)


def wheel_inertias(
    masses: Sequence[np.ndarray],
    forms: Sequence[Mapping[str, Any]],
    radii: Mapping[str, np.ndarray],
    shifts: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Return a wheel's moments about a diameter and about the axle, each (n,), in kg m^2.

    A hoop between two radii is a set of radial rods: its mean square radius is (a^2 + a b + b^2) / 3.

    Parameters
    ----------
    masses : sequence of array, shape (n,)
        In kg, of the components.
    forms : sequence of mapping
        What each hoop needs, as the table of components tells.
    radii : mapping of str to array, shape (n,)
        ``hub``, ``bead`` and ``outside`` in m.
    shifts : array, shape (c, n)
        Standard normal numbers: how far each radius is from its usual one.
    """
    xp = namespace(*masses, *radii.values())
    about_axle, across = 0.0 * masses[0], 0.0 * masses[0]
    for mass, form, shift in zip(masses, forms, shifts, strict=True):
        inner, outer = (
            xp.maximum(radii[base] + offset + form["spread"] * shift, 0.0)
            for base, offset in (form["from"], form["to"])
        )
        about_axle = about_axle + mass * (inner**2 + inner * outer + outer**2) / 3
        across = across + mass * form["across"] ** 2
    return about_axle / 2 + across, about_axle
