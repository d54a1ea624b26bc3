"""The kinds of joints: what a child may do relative to its parent, as motions in succession.

Arguments have the same meaning in all of them; :func:`revolute` tells it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from singletrack.errors import ModelError
from singletrack.multibody.engine.checks import check_axis, check_number
from singletrack.multibody.engine.elements import Joint, Motion, Scalar, Vector, X, Y, Z

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["cylindrical", "fixed", "free", "planar", "prismatic", "revolute", "spherical", "universal"]


def _joint(
    name: str,
    parent: str,
    child: str,
    point: Vector,
    motions: Sequence[tuple[bool, Vector]],
    *,
    defaults: Sequence[str],
    coordinates: Sequence[str] | None = None,
    stiffness: Any = 0.0,
    damping: Any = 0.0,
    preload: Any = 0.0,
) -> Joint:
    element, count = f"joint {name}", len(motions)
    names = tuple(defaults) if coordinates is None else tuple(coordinates)
    if len(names) != count:
        raise ModelError(f"{element}: {count} coordinates need {count} names, found {names}")

    def spread(quantity: str, value: Any) -> list[Scalar]:
        values = list(value) if isinstance(value, (tuple, list)) else [value] * count
        if len(values) != count:
            raise ModelError(f"{element}: {quantity} must be one number or {count}, found {len(values)}")
        return [check_number(element, quantity, number) for number in values]

    laws = zip(spread("stiffness", stiffness), spread("damping", damping), spread("preload", preload), strict=True)
    return Joint(
        name,
        parent,
        child,
        point,
        tuple(
            Motion(coordinate, rotates, check_axis(element, "axis", axis), *law)
            for coordinate, (rotates, axis), law in zip(names, motions, laws, strict=True)
        ),
    )


def fixed(name: str, parent: str, child: str) -> Joint:
    """Return a joint that lets nothing move.

    Arguments as for :func:`revolute`.

    >>> fixed("weld", "frame", "rack").coordinates
    ()
    """
    return Joint(name, parent, child, (0.0, 0.0, 0.0), ())


def revolute(name: str, parent: str, child: str, point: Vector, axis: Vector, **law: Any) -> Joint:
    """Return a hinge about ``axis`` through ``point``; its coordinate (rad) has the joint's name.

    Parameters
    ----------
    name : str
        Of the joint.
    parent, child : str
        Names of the bodies it connects; the ground is ``ground``. A body is the child of at most one joint.
    point, axis : three numbers or parameters
        A point of the joint in m, and a direction of any length, in the drawing.
    **law
        ``stiffness`` (N m/rad), ``damping`` (N m s/rad) and ``preload`` (N m) of its coordinates, one number or one for
        each (N/m, N s/m and N where it slides), and ``coordinates``, other names for them.

    Raises
    ------
    ModelError
        Where a number is not finite, an axis has no length, or there are not as many names or laws as coordinates.

    >>> revolute("steer", "frame", "fork", (1.1, 0, 0), (0.3, 0, 0.95)).coordinates
    ('steer',)
    """
    return _joint(name, parent, child, point, [(True, axis)], defaults=(name,), **law)


def prismatic(name: str, parent: str, child: str, axis: Vector, **law: Any) -> Joint:
    """Return a slider along ``axis``; its coordinate (m) has the joint's name.

    Arguments as for :func:`revolute`.

    >>> prismatic("seat post", "frame", "saddle", (0, 0, 1), stiffness=1e4).motions[0].stiffness
    10000.0
    """
    return _joint(name, parent, child, (0.0, 0.0, 0.0), [(False, axis)], defaults=(name,), **law)


def cylindrical(name: str, parent: str, child: str, point: Vector, axis: Vector, **law: Any) -> Joint:
    """Return a joint that slides along (m) and turns about (rad) one axis.

    Arguments as for :func:`revolute`.

    >>> cylindrical("tube", "frame", "post", (0, 0, 0), (0, 0, 1)).coordinates
    ('tube.slide', 'tube.turn')
    """
    return _joint(
        name, parent, child, point, [(False, axis), (True, axis)], defaults=(f"{name}.slide", f"{name}.turn"), **law
    )


def universal(name: str, parent: str, child: str, point: Vector, axes: tuple[Vector, Vector], **law: Any) -> Joint:
    """Return a Cardan joint: a turn about the first axis, then about the second, carried along (rad).

    Arguments as for :func:`revolute`, with two axes.

    >>> universal("shoulder", "torso", "arm", (0, 0.2, -1), ((0, 1, 0), (0, 0, 1))).coordinates
    ('shoulder.1', 'shoulder.2')
    """
    return _joint(
        name, parent, child, point, [(True, axis) for axis in axes], defaults=(f"{name}.1", f"{name}.2"), **law
    )


def spherical(
    name: str,
    parent: str,
    child: str,
    point: Vector,
    axes: Sequence[Vector] = (Z, X, Y),
    *,
    quaternion: bool = False,
    **law: Any,
) -> Joint:
    """Return a ball joint: turns about three axes in succession (rad), by default z, x, y.

    The angles are singular where the second turn brings the third axis onto the first. A ``quaternion`` never is; it
    takes four coordinates, and no springs or dampers. Arguments as for :func:`revolute`, with three axes.

    >>> spherical("hip", "frame", "torso", (0, 0, -1)).coordinates
    ('hip.1', 'hip.2', 'hip.3')
    """
    if quaternion:
        return _quaternion_joint(name, parent, child, point, [], law)
    names = tuple(f"{name}.{i}" for i in (1, 2, 3))
    return _joint(name, parent, child, point, [(True, axis) for axis in axes], defaults=names, **law)


def _quaternion_joint(
    name: str, parent: str, child: str, point: Vector, slides: Sequence[Motion], law: dict[str, Any]
) -> Joint:
    if law:
        raise ModelError(f"joint {name}: a quaternion takes no {', '.join(law)}; use angles instead")
    turns = tuple(Motion(f"{name}.q{i}", rotates=True, axis=X) for i in range(4))
    return Joint(name, parent, child, point, (*slides, *turns), quaternion=True)


def planar(name: str, parent: str, child: str, point: Vector, *, normal: Vector, along: Vector, **law: Any) -> Joint:
    """Return a joint that slides along ``along`` and ``normal x along`` (m) and turns about ``normal`` (rad).

    Arguments as for :func:`revolute`.

    >>> planar("puck", "ground", "disc", (0, 0, 0), normal=(0, 0, 1), along=(1, 0, 0)).motions[1].axis
    (0.0, 1.0, 0.0)
    """
    n, a = check_axis(f"joint {name}", "normal", normal), check_axis(f"joint {name}", "along", along)
    across = (n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0])
    names = (f"{name}.along", f"{name}.across", f"{name}.turn")
    return _joint(name, parent, child, point, [(False, a), (False, across), (True, n)], defaults=names, **law)


def free(
    name: str,
    parent: str,
    child: str,
    point: Vector = (0, 0, 0),
    axes: Sequence[Vector] = (Z, X, Y),
    *,
    quaternion: bool = False,
    **law: Any,
) -> Joint:
    """Return six degrees of freedom: x, y, z of ``point`` (m), then turns about three axes in succession (rad).

    With the default axes the turns are yaw, lean and pitch; for ``quaternion`` see :func:`spherical`. Arguments as for
    :func:`revolute`, with three axes.

    >>> free("frame", "ground", "rear frame").coordinates
    ('frame.x', 'frame.y', 'frame.z', 'frame.1', 'frame.2', 'frame.3')
    """
    slides = [(f"{name}.{part}", axis) for part, axis in zip("xyz", (X, Y, Z), strict=True)]
    if quaternion:
        motions = [Motion(slide, rotates=False, axis=axis) for slide, axis in slides]
        return _quaternion_joint(name, parent, child, point, motions, law)
    names = (*(slide for slide, _ in slides), *(f"{name}.{i}" for i in (1, 2, 3)))
    turns = [(False, axis) for _, axis in slides] + [(True, axis) for axis in axes]
    return _joint(name, parent, child, point, turns, defaults=names, **law)
