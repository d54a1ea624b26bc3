"""Certificates of designs in decimals, of intervals of parameters, and of matrices."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.certify.balls import fraction_ball, precision
from singletrack.certify.certificate import MOST_BOXES, certified, eigenvalues_at
from singletrack.certify.designs import TracedDesigns
from singletrack.certify.problems import MATRICES, ExactMatrices
from singletrack.certify.program import Program, reads_of, traced
from singletrack.errors import InputError
from singletrack.parameters.exact import Exact, exact_of_double, exact_quantity, exact_value
from singletrack.parameters.hints import unknown_parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from singletrack.certify.problems import Problem
    from singletrack.certify.record import Certificate, Eigenvalue
    from singletrack.model import LinearModel
    from singletrack.parameters import Bicycle, Rider
    from singletrack.posture import Options

__all__ = [
    "certify_design",
    "certify_matrices",
    "design_problem",
    "eigenvalue_balls",
    "intervals_of",
    "matrices_problem",
]

Intervals = dict[str, tuple[Exact, Exact]]


def intervals_of(over: Mapping[str, Sequence[str | float]], units: Mapping[str, str]) -> Intervals:
    """Return intervals of parameters as they were written.

    Parameters
    ----------
    over : mapping of str to (str or float, str or float)
        Bounds by parameter: text such as ``"55 mm"``, or a number in SI, taken as its shortest decimal.
    units : mapping of str to str
        SI units of the parameters that there are.

    Raises
    ------
    InputError
        For a parameter that is not there, bounds that are not two, or no numbers.

    Examples
    --------
    >>> [bound.fraction for bound in intervals_of({"trail": ("55 mm", 0.057)}, {"trail": "m"})["trail"]]
    [Fraction(11, 200), Fraction(57, 1000)]
    """
    found = {}
    for name, bounds in over.items():
        if name not in units:
            raise unknown_parameter("", name, list(units)).at("over")
        if isinstance(bounds, str) or len(bounds) != 2:
            reason = f"over {name} = {bounds!r:.60}, must be two bounds, from and to"
            raise InputError(reason, parameters=(name,), found=bounds, allowed="two bounds")
        try:
            low, high = (exact_quantity(b if isinstance(b, str) else repr(float(b)), units[name]) for b in bounds)
        except InputError as error:
            raise error.of(f"over {name}") from None
        found[name] = low, high
    return found


def matrices_problem(model: LinearModel) -> ExactMatrices:
    """Return the problem of a single model's matrices, each entry the shortest decimal that reads as its double.

    Parameters
    ----------
    model : LinearModel

    Raises
    ------
    InputError
        For a batch, or entries that are not finite.
    """
    if model.shape != ():
        raise InputError(
            f"is a batch of shape {model.shape}, must be a single design: certificates are for one at a time"
        )
    arrays = {name: np.asarray(getattr(model, name), dtype=float) for name in MATRICES}
    gravity = float(model.gravity)
    if not all(np.isfinite(array).all() for array in (*arrays.values(), np.array(gravity))):
        raise InputError("matrices have entries that are not finite: nothing can be certified")
    exact = np.vectorize(lambda entry: exact_of_double(entry).fraction, otypes=[object])
    return ExactMatrices({name: exact(array) for name, array in arrays.items()}, exact_of_double(gravity).fraction)


def certify_matrices(model: LinearModel) -> Certificate:
    """Return the certificate of a single model's matrices, taken in shortest decimals; errors as above.

    Parameters
    ----------
    model : LinearModel
    """
    names = ", ".join((*MATRICES, "gravity"))
    return certified(matrices_problem(model), {names: "entries as the shortest decimals of their doubles"})


def design_problem(
    bicycle: Bicycle,
    rider: Rider | None,
    options: Options,
    over: Mapping[str, Sequence[str | float]] | None = None,
    added: Mapping[str, np.ndarray] | None = None,
) -> TracedDesigns:
    """Return the problem of a design, or of all designs between bounds.

    Parameters
    ----------
    bicycle : Bicycle
        A single design.
    rider : Rider, or None
    options : Options
    over : mapping of str to (str or float, str or float), optional
        Parameters that take every value between two bounds: text such as ``"55 mm"``, or numbers in SI.
    added : mapping of str to array, shape (n, n), optional
        What is added to matrices (N m and its like, SI), such as by feedback, in shortest decimals.

    Raises
    ------
    InputError
        For a batch, a parameter that is not there, an interval that has no inside.
    """
    for record in (bicycle, rider):
        if record is not None and record.shape != ():
            raise InputError(
                f"{record.name or record.kind}: is a batch of shape {record.shape}, must be a single design"
            )
    rider = None if rider is None else rider.on(bicycle)
    values = _exact_values(bicycle, rider, options)
    intervals = intervals_of(over or {}, _units(bicycle, rider, values))
    for name, (low, high) in intervals.items():
        if float(low) >= float(high):
            raise InputError(
                f"over {name}: from {low.text} to {high.text}, must go from less to more", parameters=(name,)
            )
    exact = {name: value for name, value in values.items() if name not in intervals}
    program = traced(bicycle, rider, options)
    designs = TracedDesigns(program, exact, intervals, added or {})
    if not _is_finite(designs):  # pivots chosen for another design may vanish for this one
        program = traced(bicycle, rider, options, anew=True)
        designs = TracedDesigns(program, exact, intervals, added or {})
    return designs


def _units(bicycle: Bicycle, rider: Rider | None, values: Mapping[str, Exact]) -> dict[str, str]:
    """Return the SI units of what can be an interval: parameters that have a value."""
    described = {**({} if rider is None else rider.descriptions()), **bicycle.descriptions()}
    return {name: described[name].unit for name in values if name in described}


def _exact_values(bicycle: Bicycle, rider: Rider | None, options: Options) -> dict[str, Exact]:
    values: dict[str, Exact] = {}
    for name, value in reads_of(bicycle, rider, options).items():
        record: Any = next((r for r in (bicycle, rider) if r is not None and name in r.values()), None)
        values[name] = exact_of_double(value) if record is None else exact_value(record, name)
    return values


def _is_finite(designs: TracedDesigns) -> bool:
    middle = ((Fraction(1, 2),) * 2,) * designs.dimensions
    with precision(128):
        return all(entry.is_finite() for matrix in designs.matrices(middle).values() for entry in matrix.ravel())


def certify_design(
    bicycle: Bicycle,
    rider: Rider | None,
    options: Options,
    over: Mapping[str, Sequence[str | float]] | None = None,
    added: Mapping[str, np.ndarray] | None = None,
    most_boxes: int = MOST_BOXES,
    progress: Callable[[int], object] | None = None,
) -> Certificate:
    """Return the certificate of a design, or of all designs between bounds.

    Arguments as for :func:`design_problem`, errors likewise.

    Parameters
    ----------
    bicycle, rider, options, over, added : as there
        Matrices are of shape (n, n).
    most_boxes : int
        Boxes of designs that are looked at before the rest is left undecided.
    progress : callable, optional
        Called with the number of boxes looked at so far.
    """
    designs = design_problem(bicycle, rider, options, over, added)
    return certified(designs, _as_text(designs, designs.program), most_boxes, progress)


def _as_text(designs: TracedDesigns, program: Program) -> dict[str, str]:
    texts = {}
    for name in program.reads:
        if name in designs.intervals:
            low, high = designs.intervals[name]
            texts[name] = f"from {low.text} to {high.text}"
        else:
            texts[name] = designs.values[name].text
    return texts


def eigenvalue_balls(problem: Problem, speeds: Sequence[float]) -> list[tuple[Eigenvalue, ...]]:
    """Return the eigenvalues at speeds in m/s, each in a rectangle; () where they cannot be told apart.

    Parameters
    ----------
    problem : Problem
        Of a design or of matrices.
    speeds : sequence of float, shape (k,)
        Taken as their shortest decimals.
    """
    found = []
    for speed in speeds:
        with precision(128):
            at = fraction_ball(exact_of_double(speed).fraction)
        found.append(eigenvalues_at(problem, at))
    return found
