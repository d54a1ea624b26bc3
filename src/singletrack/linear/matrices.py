"""The coefficient matrices and what can be asked of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singletrack.arrays import Array
from singletrack.faults import Fault, valid_mask

if TYPE_CHECKING:
    import numpy as np
    import xarray

    from singletrack.linear.critical import CriticalSpeeds
    from singletrack.linear.modes import Modes
    from singletrack.linear.state_space import StateSpace

__all__ = ["CoefficientMatrices"]


@dataclass(frozen=True, eq=False)
class CoefficientMatrices:
    """``M q'' + v C1 q' + (g K0 + v^2 K2) q = f`` with q = (lean, steer); SI units, radians.

    Attributes
    ----------
    M, C1, K0, K2 : array, shape (..., 2, 2)
        In kg m^2, kg m, kg m and kg. M and K0 are symmetric; K0 carries no g.
    gravity : array, shape broadcastable to (...)
        In m/s^2.
    faults : tuple of Fault
        What is wrong with designs of a batch; their matrices are not to be used.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> model.eigenvalues(5.0).shape, model.critical_speeds().weave
    ((1, 4), [4.292382536...])
    """

    M: Array
    C1: Array
    K0: Array
    K2: Array
    gravity: Array
    faults: tuple[Fault, ...] = ()

    @property
    def matrices(self) -> tuple[Array, Array, Array, Array]:
        """M, C1, K0 and K2."""
        return self.M, self.C1, self.K0, self.K2

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape (...) of the batch of designs."""
        return tuple(self.M.shape[:-2])

    @property
    def valid(self) -> np.ndarray:
        """True for the designs of the batch that nothing is wrong with, shape (...)."""
        return valid_mask(self.faults, self.shape)

    def eigenvalues(self, speeds: Array) -> Array:
        """Return the eigenvalues at forward speeds, sorted by real then imaginary part.

        Parameters
        ----------
        speeds : array, shape () or (n,)
            In m/s.

        Returns
        -------
        complex array, shape (..., n, 4)
            In 1/s.
        """
        from singletrack.linear.eigenvalues import eigenvalues

        return eigenvalues(self, speeds)

    def modes(self, speeds: Array) -> Modes:
        """Return the eigenvalues as named modes, followed through the speeds (see :class:`Modes`)."""
        from singletrack.linear.modes import modes

        return modes(self, speeds)

    def critical_speeds(self) -> CriticalSpeeds:
        """Return weave and capsize speeds and the stable ranges (see :class:`CriticalSpeeds`)."""
        from singletrack.linear.critical import critical_speeds

        return critical_speeds(self)

    def state_space(self, speed: float) -> StateSpace:
        """Return the equations at one forward speed in m/s as a first-order system (see :class:`StateSpace`)."""
        from singletrack.linear.state_space import state_space

        return state_space(self, speed)

    def damping(self, speed: Array) -> Array:
        """Return v C1, shape (..., 2, 2), in N m s, at speeds (...) in m/s."""
        return _matrixwise(speed, self.C1) * self.C1

    def stiffness(self, speed: Array) -> Array:
        """Return g K0 + v^2 K2, shape (..., 2, 2), in N m, at speeds (...) in m/s."""
        return _matrixwise(self.gravity, self.K0) * self.K0 + _matrixwise(speed, self.K2) ** 2 * self.K2

    def to_dict(self) -> dict[str, Any]:
        """Return the matrices as nested lists, in full double precision (for JSON)."""
        import numpy as np

        names = ("M", "C1", "K0", "K2", "gravity")
        return {name: np.asarray(getattr(self, name), dtype=float).tolist() for name in names}

    def to_xarray(self) -> xarray.Dataset:
        """Return the matrices labelled; batch dimensions are called design_0, design_1, ..."""
        import numpy as np
        import xarray as xr

        batch = [f"design_{i}" for i in range(len(self.shape))]
        units = {"M": "kg m^2", "C1": "kg m", "K0": "kg m", "K2": "kg"}
        data = {
            name: ([*batch, "equation", "coordinate"], np.asarray(getattr(self, name)), {"units": unit})
            for name, unit in units.items()
        }
        gravity = np.broadcast_to(np.asarray(self.gravity, dtype=float), self.shape)
        data["gravity"] = (batch, gravity, {"units": "m/s^2"})
        return xr.Dataset(data, coords={"equation": ["lean", "steer"], "coordinate": ["lean", "steer"]})


def _matrixwise(factor: Array, matrix: Array) -> Array:
    from singletrack.arrays import namespace

    return namespace(factor, matrix).asarray(factor)[..., None, None]
