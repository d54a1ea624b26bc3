"""Inertia tensors of uniform solids about their centres, any leading batch dimensions."""

from __future__ import annotations

from singletrack.arrays import Array, Number, as_arrays, cross, unit_vector, vector

__all__ = ["cylinder_inertia", "gyration_inertia", "prism_inertia", "sphere_inertia"]


def _about_axis(axis: Array, along: Number, across: Number) -> Array:
    """Return the tensor with moment ``along`` about a unit axis (..., 3) and ``across`` about any normal to it."""
    xp, (axis, along, across) = as_arrays(axis, along, across)
    scaled = (along - across)[..., None] * axis
    return scaled[..., :, None] * axis[..., None, :] + across[..., None, None] * xp.eye(3, dtype=axis.dtype)


def cylinder_inertia(mass: Number, radius: Number, length: Number, axis: Array) -> Array:
    """Return the inertia (..., 3, 3) in kg m^2 of a solid cylinder about its centre.

    Parameters
    ----------
    mass, radius, length : array, shape (...)
        In kg and m.
    axis : array, shape (..., 3)
        Unit vector along the cylinder.

    Examples
    --------
    >>> import numpy as np
    >>> np.diag(cylinder_inertia(12.0, 1.0, 2.0, np.array([0.0, 0.0, 1.0]))).tolist()
    [7.0, 7.0, 6.0]
    """
    return _about_axis(axis, mass * radius**2 / 2, mass * (3 * radius**2 + length**2) / 12)


def sphere_inertia(mass: Number, radius: Number) -> Array:
    """Return the inertia (..., 3, 3) in kg m^2 of a solid sphere of mass (...) kg and radius (...) m.

    >>> sphere_inertia(5.0, 1.0)[0].tolist()
    [2.0, 0.0, 0.0]
    """
    xp, (moment,) = as_arrays(0.4 * mass * radius**2)
    return moment[..., None, None] * xp.eye(3, dtype=moment.dtype)


def prism_inertia(mass: Number, length: Number, width: Number, thickness: Number, axis: Array) -> Array:
    """Return the inertia (..., 3, 3) in kg m^2 of a solid rectangular prism about its centre.

    Parameters
    ----------
    mass, length, width, thickness : array, shape (...)
        In kg and m; ``length`` along ``axis``, ``width`` along y, ``thickness`` normal to both.
    axis : array, shape (..., 3)
        Unit vector along the prism, in the x-z plane.

    Examples
    --------
    >>> import numpy as np
    >>> np.diag(prism_inertia(12.0, 3.0, 2.0, 1.0, np.array([0.0, 0.0, -1.0]))).tolist()
    [13.0, 10.0, 5.0]
    """
    along, sideways = mass * (width**2 + thickness**2) / 12, mass * (length**2 + thickness**2) / 12
    return _about_three_axes(axis, along, sideways, mass * (length**2 + width**2) / 12)


def gyration_inertia(mass: Number, along: Number, sideways: Number, across: Number, axis: Array) -> Array:
    """Return the inertia (..., 3, 3) in kg m^2 of a body with given radii of gyration about its centre.

    Parameters
    ----------
    mass, along, sideways, across : array, shape (...)
        In kg; radii in m about ``axis``, about y, about the normal to both.
    axis : array, shape (..., 3)
        Unit vector; where it is not in the x-z plane, y stands for the direction nearest to y that is normal to it.

    Examples
    --------
    >>> import numpy as np
    >>> np.diag(gyration_inertia(2.0, 1.0, 2.0, 2.0, np.array([0.0, 0.0, 1.0]))).tolist()
    [8.0, 8.0, 2.0]
    """
    return _about_three_axes(axis, mass * along**2, mass * sideways**2, mass * across**2)


def _about_three_axes(axis: Array, along: Number, sideways: Number, across: Number) -> Array:
    """Return the tensor with given moments about a unit axis, y (or nearest to it), and the normal to both."""
    normal = unit_vector(vector(-axis[..., 2], 0.0 * axis[..., 1], axis[..., 0]))
    aside = cross(normal, axis)
    return _about_axis(axis, along, 0.0) + _about_axis(normal, across, 0.0) + _about_axis(aside, sideways, 0.0)
