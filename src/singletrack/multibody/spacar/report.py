"""What a run gives, as plain data: the state at its end, and its small motions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from singletrack.errors import ModelError

if TYPE_CHECKING:
    from singletrack.multibody.spacar.linearise import SmallMotions
    from singletrack.multibody.spacar.model import Spacar
    from singletrack.multibody.spacar.state import Motion

__all__ = ["columns", "linear_dict", "report", "statics"]


def linear_dict(small: SmallMotions) -> dict[str, Any]:
    """Return small motions as plain data; what multiplies kinematic coordinates stands apart.

    Parameters
    ----------
    small
        The small motions.
    """
    q = len(small.M)
    values = {
        "coordinates": list(small.coordinates[:q]),
        "kinematic": list(small.coordinates[q:]),
        "inputs": list(small.inputs),
        "outputs": list(small.outputs),
        "M": small.M,
        "C": small.C,
        "K": small.K[:, :q],
        "K_kinematic": small.K[:, q:],
        "B": small.B,
        "A_matrix": small.A_matrix,
        "B_matrix": small.B_matrix,
        "C_matrix": small.C_matrix,
        "D_matrix": small.D_matrix,
        "eigenvalues": np.stack([small.eigenvalues().real, small.eigenvalues().imag], axis=1),
    }
    return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in values.items()}


def columns(model: Spacar, motions: list[Motion]) -> tuple[list[str], list[list[float]]]:
    r"""Return a motion as a table: names of columns, and a row for each time.

    Parameters
    ----------
    model, motions
        The model and its motion.

    Examples
    --------
    >>> from singletrack.multibody.spacar.model import read_text
    >>> model = read_text("PLHINGE 1 1 2\nFIX 1\nDYNE 1 1\nMASS 2 4.0\nED 1 1 3.0")
    >>> names, rows = columns(model, model.run([0.0, 0.5]))
    >>> names, rows[0]
    (['time', 'x 1 1', 'x 2 1', 'e 1 1', 'ed 1 1', 'edd 1 1'], [0.0, 0.0, 0.0, 0.0, 3.0, 0.0])
    """
    layout = model.layout
    header = ["time", *(f"x {node} {i}" for node, i in layout.x_index)]
    header += [f"{what} {element} {i}" for what in ("e", "ed", "edd") for element, i in layout.e_index]
    count = len(layout.e_index)
    rows = [[m.state.time, *m.state.x, *m.state.e[:count], *m.rates[:count], *m.accelerations[:count]] for m in motions]
    return header, [[float(value) + 0.0 for value in row] for row in rows]


def report(model: Spacar, motion: Motion, small: SmallMotions) -> dict[str, Any]:
    r"""Return a motion and its small motions as plain data.

    Parameters
    ----------
    model, motion, small
        The model, its motion at a time, and the small motions about that.

    Examples
    --------
    >>> from singletrack.multibody.spacar.model import read_text
    >>> model = read_text("PLHINGE 1 1 2\nFIX 1\nDYNE 1 1\nMASS 2 4.0\nESTIFF 1 9.0\nED 1 1 3.0")
    >>> motion = model.motion()
    >>> data = report(model, motion, model.linearise(motion))
    >>> data["ed"], data["linear"]["M"], data["linear"]["K"]
    ({1: [3.0]}, [[4.0]], [[9.0]])
    """
    return {
        "time": motion.state.time,
        "x": model.by_node(motion.state.x),
        "xd": model.by_node(motion.state.v),
        "xdd": model.by_node(motion.a),
        "e": model.by_element(motion.state.e),
        "ed": model.by_element(motion.rates),
        "edd": model.by_element(motion.accelerations),
        "stresses": model.by_element(motion.stresses),
        "freedoms": list(model.freedoms),
        "linear": linear_dict(small),
        "remarks": list(model.description.remarks),
    }


def statics(model: Spacar, *, equilibrium: bool = True, buckling: bool = False) -> dict[str, Any]:
    r"""Return what a model does at rest, as plain data.

    Parameters
    ----------
    model
        The model.
    equilibrium
        Whether to give the equilibrium under the loads, its stresses, and natural frequencies (rad/s) about it, where
        all freedoms move mass.
    buckling
        Whether to give the factors of the loads at which the drawn equilibrium buckles.

    Raises
    ------
    ModelError
        Where no equilibrium is found, or there are no loads to buckle under.

    Examples
    --------
    >>> from singletrack.multibody.spacar.model import read_text
    >>> model = read_text("PLHINGE 1 1 2\nFIX 1\nDYNE 1 1\nMASS 2 4.0\nESTIFF 1 9.0\nFORCE 2 4.5")
    >>> data = statics(model)
    >>> data["e"], data["frequencies"]
    ({1: [0.5]}, [1.5])
    """
    data: dict[str, Any] = {"freedoms": list(model.freedoms)}
    if equilibrium:
        motion = model.equilibrium()
        data |= {
            "x": model.by_node(motion.state.x),
            "e": model.by_element(motion.state.e),
            "stresses": model.by_element(motion.stresses),
        }
        try:
            data["frequencies"] = model.frequencies(motion)[0].tolist()
        except ModelError as error:
            data["frequencies"] = None
            data["no_frequencies"] = str(error)
    if buckling:
        found = model.buckling()
        data["buckling"] = {"factors": found.factors.tolist(), "modes": found.modes.tolist()}
    return data
