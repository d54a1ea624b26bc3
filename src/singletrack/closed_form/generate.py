"""The shipped programs, traced from the equations: ``make programs`` writes them, :mod:`.programs` runs them."""

from __future__ import annotations

import sys
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
import numpy as np

from singletrack.closed_form.coefficients import by_arrays
from singletrack.closed_form.programs import ASIDE, FOLDER, LEAN, MATRICES, RIDERLESS
from singletrack.closed_form.round_tyres import load_of_rider
from singletrack.library import load_bicycle, load_rider
from singletrack.parameters.bicycle import FRAME_GEOMETRY
from singletrack.posture import Options, margins, seat
from singletrack.tracing import python_program, trace

if TYPE_CHECKING:
    from collections.abc import Callable

    from singletrack.parameters import Bicycle, Rider

__all__ = ["program_text", "structures"]

_HEADING = "# Traced from the equations by `make programs`; not to be edited.\n"
#: Files of the postures that have a program, with the bicycle at which pivots are chosen.
_POSTURES = {
    "rigid": "stratos",
    "upright-axial": "browser",
    "upright-abduction": "browser",
    "leaned-straight-abduction": "stratos",
    "leaned-bent-abduction": "stratos",
    "leaned-bent-axial": "stratos",
}
#: Those of them that have one for elbows aside.
_ELBOWS_ASIDE = ("rigid", "upright-axial", "leaned-straight-abduction")


def structures() -> dict[str, Options | None]:
    """Return the structures that have a program, by the program's name; None for a bicycle alone.

    Examples
    --------
    >>> structures()["upright-axial-torso-lean"].torso_lean
    True
    """
    found: dict[str, Options | None] = {RIDERLESS: None}
    for posture in _POSTURES:
        found[posture], found[posture + LEAN] = Options(posture), Options(posture, torso_lean=True)
    for posture in _ELBOWS_ASIDE:
        found[posture + ASIDE] = Options(posture)
    return found


def program_text(name: str) -> str:
    """Return the program of a structure as text.

    Parameters
    ----------
    name : str
        Of :func:`structures`.

    Examples
    --------
    >>> program_text("bicycle").splitlines()[1][:36]
    'def program(wheel_base, trail, steer'
    """
    options = structures()[name]
    bicycle, rider = _nominal(name, options)
    values = bicycle.values() if rider is None else bicycle.values() | rider.values()
    config: Any = jax.config
    before = config.jax_enable_x64
    config.update("jax_enable_x64", val=True)
    try:
        graph, outputs = trace(_equations(bicycle, rider, options), [float(value) for value in values.values()])
    finally:
        config.update("jax_enable_x64", val=before)
    used = {graph.nodes[node].arguments[0] for node in _inputs(graph, outputs)}
    text = python_program("program", graph, outputs, list(values))
    head, _, body = text.partition("\n")
    reads = [parameter for place, parameter in enumerate(values) if place in used]
    assert head == f"def program({', '.join(values)}):"  # noqa: S101  # what is not read is left out
    return f"{_HEADING}def program({', '.join(reads)}):\n{body}"


def _inputs(graph: Any, outputs: list[np.ndarray]) -> list[int]:
    needed = graph.needed(int(node) for array in outputs for node in np.ravel(array))
    return [node for node in needed if graph.nodes[node].operation == "input"]


def _nominal(name: str, options: Options | None) -> tuple[Bicycle, Rider | None]:
    """Return the design at which pivots are chosen, with nothing left to be derived."""
    bicycle = load_bicycle(_POSTURES.get(name.removesuffix(LEAN).removesuffix(ASIDE), "benchmark"))
    if options is None:
        return bicycle.replace(**dict.fromkeys(FRAME_GEOMETRY)), None
    rider = load_rider("rider-a").on(bicycle)
    width, thickness = rider.torso_section
    bicycle = bicycle.replace(handlebar_drop=0.0)
    rider = rider.replace(torso_width=width, torso_thickness=thickness)
    if name.endswith(ASIDE):
        bicycle = bicycle.replace(handlebar_width=rider.shoulder_to_shoulder)
        rider = rider.replace(elbow_drop_angle=pi / 3)
    return bicycle, rider


def _equations(bicycle: Bicycle, rider: Rider | None, options: Options | None) -> Callable[[Any], tuple[Any, ...]]:
    """Return the function of the parameters' values that gives matrices, the rider's load and margins."""
    count = len(bicycle.values())

    def equations(inputs: Any) -> tuple[Any, ...]:
        own = bicycle.replace(**dict(zip(bicycle.values(), inputs[:count], strict=True)))
        if rider is None or options is None:
            model = by_arrays(own, None, Options())
            return tuple(jnp.asarray(getattr(model, name)) for name in MATRICES)
        seated = rider.replace(**dict(zip(rider.values(), inputs[count:], strict=True)))
        model = by_arrays(own, seated, options)
        matrices = tuple(jnp.asarray(getattr(model, name)) for name in MATRICES)
        posture = seat(own, seated, options)
        return (*matrices, jnp.stack([*load_of_rider(posture), *margins(posture, own, seated)]))

    return equations


def main(folder: str | Path = FOLDER) -> None:
    """Write the programs of all structures into a folder."""
    for name in structures():
        (Path(folder) / f"{name}.txt").write_text(program_text(name), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
