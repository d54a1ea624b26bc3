"""What follows from the definition of a kind of element by algorithmic differentiation, once for all elements of it.

For a kind with deformation rates A(x) v: the convective rates c = d(A v)/dx v, and what linearisation needs. For
a kind of mass with kinetic energy T(x, v): the mass matrix, the convective forces h = d(dT/dv)/dx v - dT/dx, and
likewise. Functions take one column an element.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import casadi as ca
import numpy as np

from singletrack.multibody.spacar.kinds import KINDS
from singletrack.multibody.spacar.masses import MASSES

if TYPE_CHECKING:
    from singletrack.arrays import Array

__all__ = ["Mapped", "mass_functions", "per_element", "strain_functions"]


@lru_cache(maxsize=64)
def strain_functions(name: str) -> dict[str, Any]:
    """Return the functions of a kind of element by name.

    ``value``: (x, p) to deformations (those that depend on position) and A, ``rate``: (x, p, v) to c; ``vary``:
    (x, p, v, a, s) to the derivatives of A v, of A a + c (by x, then by v) and of A^T s by x.

    >>> sorted(strain_functions("PLTRUSS"))
    ['rate', 'value', 'vary']
    """
    if name == "EULER":
        width, parameters = 4, 0
    else:
        width, parameters = KINDS[name].width, KINDS[name].parameters
    x, v, a, p = (ca.SX.sym(symbol, n) for symbol, n in zip("xvap", (width, width, width, parameters), strict=True))
    strain = (ca.dot(x, x) - 1) / 2 if name == "EULER" else KINDS[name].strain(x, p)
    rows = ca.jacobian(strain, x)
    if name != "EULER" and (slip := KINDS[name].slip) is not None:
        rows = ca.vertcat(rows, slip(x, p))
    rates = rows @ v
    convective = ca.jacobian(rates, x) @ v
    s = ca.SX.sym("s", rows.shape[0])
    accelerations = rows @ a + convective
    vary = [
        ca.jacobian(rates, x),
        ca.jacobian(accelerations, x),
        ca.jacobian(convective, v),
        ca.jacobian(rows.T @ s, x),
    ]
    return {
        "value": ca.Function("value", [x, p], [ca.densify(strain), ca.densify(rows)]),
        "rate": ca.Function("rate", [x, p, v], [ca.densify(convective)]),
        "vary": ca.Function("vary", [x, p, v, a, s], [ca.densify(part) for part in vary]),
    }


@lru_cache(maxsize=16)
def mass_functions(name: str) -> dict[str, Any]:
    """Return the functions of a kind of mass by name.

    ``force``: (x, p, v) to the mass matrix and h less the weight; ``vary``: (x, p, v, a) to the derivatives of M a + h
    by x and by v.

    >>> sorted(mass_functions("truss2"))
    ['force', 'vary']
    """
    kind = MASSES[name]
    x, v, a, p = (ca.SX.sym(symbol, n) for symbol, n in zip("xvap", (*[kind.width] * 3, kind.parameters), strict=True))
    energy, work = kind.energy(x, v, p)
    momentum = ca.gradient(energy, v)
    mass = ca.jacobian(momentum, v)
    force = ca.jacobian(momentum, x) @ v - ca.gradient(energy, x) - ca.gradient(work, x)
    total = mass @ a + force
    return {
        "force": ca.Function("force", [x, p, v], [ca.densify(mass), ca.densify(force)]),
        "vary": ca.Function(
            "vary", [x, p, v, a], [ca.densify(ca.jacobian(total, x)), ca.densify(ca.jacobian(total, v))]
        ),
    }


class Mapped:
    """A function of all elements of a kind on buffers of its own, which saves most of the time of a call."""

    def __init__(self, function: Any, count: int) -> None:
        self.mapped = function.map(count)
        self.buffer, self.evaluate = self.mapped.buffer()
        # Column-major (n, count) of the function is row-major (count, n) here.
        self.arguments = [np.zeros((count, function.size1_in(i))) for i in range(function.n_in())]
        self.results = [
            np.zeros((count, function.size2_out(i), function.size1_out(i))) for i in range(function.n_out())
        ]
        for i, argument in enumerate(self.arguments):
            self.buffer.set_arg(i, argument.data)
        for i, result in enumerate(self.results):
            self.buffer.set_res(i, result.data)

    def __call__(self, columns: tuple[Array, ...]) -> list[Array]:
        """Evaluate for arguments (elements, n); results are (elements, rows, columns)."""
        for argument, column in zip(self.arguments, columns, strict=True):
            argument[...] = column
        self.evaluate()
        return [result.transpose(0, 2, 1).copy() for result in self.results]


@lru_cache(maxsize=512)
def _mapped(group: str, name: str, which: str, count: int) -> Mapped:
    functions = strain_functions(name) if group == "strain" else mass_functions(name)
    return Mapped(functions[which], count)


def per_element(group: str, name: str, which: str, *columns: Array) -> list[Array]:
    """Evaluate a function for all elements of a kind.

    Parameters
    ----------
    group, name, which
        ``strain`` or ``mass``, the kind and the function.
    columns
        Arguments, (elements, n) each.

    Returns
    -------
    list of Array
        Results, (elements, rows, columns) each.

    Examples
    --------
    >>> e, A = per_element("strain", "PLTRUSS", "value", np.array([[0.0, 0.0, 3.0, 4.0]]), np.array([[4.0]]))
    >>> e.ravel().tolist(), A.tolist()
    ([1.0], [[[-0.6, -0.8, 0.6, 0.8]]])
    """
    return _mapped(group, name, which, columns[0].shape[0])(columns)
