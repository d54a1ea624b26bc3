"""A linear model with its questions as methods: the thin face above the rooms that answer them."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, Self, overload

from singletrack import closed_form
from singletrack.body.oddities import warn_of_oddities
from singletrack.errors import InputError
from singletrack.linear import CriticalSpeeds, Modes, StateSpace, critical_speeds, eigenvalues, modes
from singletrack.model import LinearModel, Outputs
from singletrack.posture import Options, named_posture, require_posture, require_records
from singletrack.present.latex import latex_table
from singletrack.public.certifying import certifier
from singletrack.public.display import lines_of_model, table_of_model
from singletrack.public.origin import Origin, observed
from singletrack.public.plotting import figure_of_model

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from matplotlib.figure import Figure

    from singletrack.analysis.uncertainty import EigenvalueUncertainty
    from singletrack.arrays import Array, ArrayLike, Number
    from singletrack.certify import Certificate
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Mechanism

__all__ = ["CoefficientMatrices", "coefficients"]


@dataclass(frozen=True, eq=False, repr=False)
class CoefficientMatrices(LinearModel):
    """A :class:`~singletrack.model.LinearModel` that can be asked directly; attributes as there.

    Attributes
    ----------
    origin : Origin, optional
        Bicycle, rider and posture that it was made from.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle
    >>> model = coefficients(load_bicycle("benchmark"))
    >>> model.eigenvalues(5.0).shape, model.critical_speeds().weave
    ((1, 4), [4.292382536...])
    """

    origin: Origin | None = field(default=None, kw_only=True)

    @classmethod
    def of(cls, model: LinearModel, origin: Origin | None = None) -> Self:
        """Return a model of any maker as one that can be asked.

        Parameters
        ----------
        model : LinearModel
        origin : Origin, optional
            What it was made from, of which the rider's joints and hands can be asked.
        """
        asked = object.__new__(cls)
        asked.__dict__.update(model.__dict__, origin=origin)  # what is a model already need not be looked at again
        return asked

    def __repr__(self) -> str:
        return lines_of_model(self)

    def _repr_html_(self) -> str:
        """Return the matrices as a table, for notebooks."""
        return table_of_model(self)

    def eigenvalues(self, speeds: ArrayLike) -> Array:
        """Return the eigenvalues at forward speeds, sorted by real then imaginary part.

        Parameters
        ----------
        speeds : array, shape () or (k,)
            In m/s.

        Returns
        -------
        complex array, shape (..., k, 2 n)
            In 1/s.
        """
        return eigenvalues(self, speeds)

    def modes(self, speeds: ArrayLike) -> Modes:
        """Return the eigenvalues as named modes, followed through the speeds, in m/s (see :class:`Modes`)."""
        return modes(self, speeds)

    @overload
    def critical_speeds(self, *, certify: Literal[False] = False) -> CriticalSpeeds: ...

    @overload
    def critical_speeds(
        self, *, certify: Literal[True], over: Mapping[str, Sequence[str | float]] | None = None
    ) -> Certificate: ...

    def critical_speeds(
        self, *, certify: bool = False, over: Mapping[str, Sequence[str | float]] | None = None
    ) -> CriticalSpeeds | Certificate:
        """Return weave and capsize speeds and the stable ranges (see :class:`CriticalSpeeds`).

        Parameters
        ----------
        certify : bool
            Prove them, by ball arithmetic: a :class:`~singletrack.certify.Certificate`. The parameters of the bicycle
            and rider are taken as files wrote them, doubles as their shortest decimals; of a model that was not made by
            :func:`coefficients` (or changed since), each entry of the matrices as its shortest decimal.
        over : mapping of str to (str or float, str or float), optional
            With ``certify``: parameters that take every value between two bounds, such as
            ``{"trail": ("55 mm", "57 mm")}``; numbers in SI.

        Raises
        ------
        InputError
            Certificates: for a batch of designs, a parameter that is not there, without the libraries needed.
        """
        if not certify:
            if over is not None:
                raise InputError("over: says which designs are certified, and needs certify=True")
            return critical_speeds(self)
        room, design = certifier(), self.__dict__.get("design")
        if design is None and over:
            raise InputError("over: needs a model of a bicycle, as coefficients makes it; this one has matrices alone")
        found: Certificate = room.certify_matrices(self) if design is None else room.certify_design(*design, over)
        return found

    def plot(
        self,
        speeds: ArrayLike = (0.0, 10.0),
        *,
        width: float = 84.0,
        title: str = "",
        kmh: bool = False,
        limit: float = 10.0,
        uncertainty: EigenvalueUncertainty | None = None,
    ) -> Figure:
        """Return a figure of the eigenvalues over the forward speed; notebooks show it.

        Parameters
        ----------
        speeds : array, shape (k,)
            The lowest and the highest speed, or all speeds to compute, in m/s.
        width : float
            In mm: 84 for one column of a journal, 174 for two.
        title : str
            By default none.
        kmh : bool
            Show speeds in km/h.
        limit : float
            The vertical axis runs from -limit to limit, in 1/s.
        uncertainty : EigenvalueUncertainty, optional
            Of a single design, whose central 95 % are shaded: see
            :func:`~singletrack.analysis.uncertainty.eigenvalue_uncertainty`.

        Returns
        -------
        matplotlib Figure
            Of a single design; a batch of m designs (up to a few dozen) is overlaid.

        Raises
        ------
        InputError
            For a batch of more than one axis, or one with ``uncertainty``; for a speed that is negative or not finite.

        Examples
        --------
        >>> from singletrack import coefficients, load_bicycle
        >>> figure = coefficients(load_bicycle("benchmark")).plot(title="benchmark")
        >>> [text.get_text() for text in figure.axes[0].texts][0]
        'weave speed 4.29 m/s'
        """
        return figure_of_model(self, speeds, width=width, title=title, kmh=kmh, limit=limit, uncertainty=uncertainty)

    def to_latex(self, caption: str = "", digits: int = 5) -> str:
        """Return the matrices and critical speeds of a single design as a table of LaTeX.

        Parameters
        ----------
        caption : str
            Plain text; empty for none.
        digits : int
            Significant digits.
        """
        return latex_table(self, self.critical_speeds(), caption, digits)

    def state_space(self, speed: ArrayLike, outputs: Sequence[str] | Outputs | None = None) -> StateSpace:
        """Return the equations at one or several forward speeds as first-order systems (:class:`StateSpace`).

        Parameters
        ----------
        speed : array, shape () or (k,)
            In m/s.
        outputs : sequence of str or Outputs, optional
            What is seen; by default the states. Names of states (``lean``, ``steer rate``), of accelerations
            (``lean acceleration``), and, with a rider, of joint angles (``right elbow``), their rates, and forces of
            the hands (``right hand force y``; see :func:`singletrack.closed_form.rider_outputs`); or a record of such
            outputs, which follow after the states.

        Raises
        ------
        InputError
            For an unknown name, or an input of which it is not known what it does to a hand.

        Examples
        --------
        >>> from singletrack import coefficients, load_bicycle, load_rider
        >>> model = coefficients(load_bicycle("browser"), load_rider("rider-a"), "upright")
        >>> model.state_space([4.0, 6.0], ["lean", "right elbow", "right hand force x"]).C.shape
        (2, 3, 4)
        """
        return observed(self, speed, outputs, self.origin)

    def __getitem__(self, index: Any) -> Self:
        """Return some designs of a batch: an index, slice or mask of the batch's axes."""
        some = super().__getitem__(index)
        return some if self.origin is None else dataclasses.replace(some, origin=self.origin.at(index))


def coefficients(
    bicycle: Bicycle,
    rider: Rider | None = None,
    posture: str | Path | Mechanism = "rigid",
    shoulder: str | None = None,
    *,
    arms: str | None = None,
    torso_lean: bool = False,
    springs: Mapping[str, Number] | None = None,
    dampers: Mapping[str, Number] | None = None,
    fit: Number | None = None,
) -> CoefficientMatrices:
    """Return the linearised equations of motion of a bicycle, alone or with a rider.

    ``M q'' + (C0 + v C1) q' + (S0 + g K0 + v^2 K2) q = f`` with q = (lean, steer, ...) in rad,
    f = (lean torque, steer torque, ...) in N m.

    Parameters
    ----------
    bicycle : Bicycle
    rider : Rider, optional
        Without one, the bicycle as measured.
    posture : str, path or Mechanism
        ``rigid``: hands free; ``leaned``: stretched arms, twisting torso; ``upright``: flexed arms, still torso;
        another shipped posture, a mechanism file, or a mechanism.
    shoulder : {"abduction", "axial"}, optional
        Second axis of the shoulder joint; by default abduction for ``leaned``, axial for ``upright``.
    arms : {"straight", "bent"}, optional
        Of the leaned posture.
    torso_lean : bool
        Whether the torso may lean sideways, about a hinge along x at the hips: one more coordinate.
    springs, dampers : mapping of str to array, optional
        Stiffness in N m/rad and damping in N m s/rad by joint, or ``steer``; in N/m and N s/m by hand, or ``hands``.
    fit : array, optional
        Elbow angle in rad (pi: stretched) to which the rider's forward lean is fitted, whatever it was.

    Returns
    -------
    CoefficientMatrices
        Each matrix of shape (..., n, n), where (...) is what the parameters broadcast to.

    Raises
    ------
    InputError
        For an unknown posture or shoulder, a bicycle without frame geometry, a rider without forward lean angle;
        for JAX arrays in single precision.
    PostureError
        If arms or legs do not reach, or the arms cannot follow the steer.

    Warns
    -----
    OddityWarning
        Of what looks odd about a single bicycle, its rider or the rider's reach, once for each.

    Examples
    --------
    >>> from singletrack import coefficients, load_bicycle, load_rider
    >>> model = coefficients(load_bicycle("browser"), load_rider("rider-a"), posture="upright")
    >>> round(float(model.M[1, 1]), 4), round(float(model.gravity * model.K0[1, 1]), 4)
    (0.4614, 2.3268)
    """
    require_records(bicycle, rider)
    require_posture(posture)
    options = Options(named_posture(posture), shoulder, arms, torso_lean, springs or {}, dampers or {}, fit)
    single = closed_form.single_design(bicycle, rider, options)
    shares = None if single is None or single.margins is None else single.margins.shares
    warn_of_oddities(bicycle, rider, shares)
    model = closed_form.coefficients(bicycle, rider, options) if single is None else single.model
    made = CoefficientMatrices.of(model, None if rider is None else Origin(bicycle, rider, options))
    # What it was made of, for certificates: no field, so that no changed copy of the model inherits it.
    made.__dict__["design"] = (bicycle, rider, options)
    return made
