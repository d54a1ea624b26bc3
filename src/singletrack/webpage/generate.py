"""The programs of the page: equations and moved skeletons, traced from this package into straight-line JavaScript.

Run as ``python -m singletrack.webpage.generate FOLDER`` it writes ``programs.js`` and ``manifest.json``; the page has
no other derivation of anything that is traced here.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp

from singletrack.body.reach import reach
from singletrack.closed_form import coefficients
from singletrack.library import load_bicycle, load_rider
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bicycle import FLATNESS_TOLERANCE
from singletrack.parameters.record import ALLOWED
from singletrack.posture import Options, loop_residual, moved_skeleton, seat
from singletrack.tracing import javascript_function, trace
from singletrack.webpage.records import page_records
from singletrack.webpage.sheets import page_sheets

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["Variant", "manifest", "programs", "variants"]

MATRICES = ("M", "C0", "C1", "S0", "K0", "K2")


@dataclass(frozen=True)
class Variant:
    """One way to ride: a model's options and the design at which pivots are chosen while tracing.

    Attributes
    ----------
    options : Options, or None for a bicycle without rider
    bicycle : Bicycle
    rider : Rider, or None
    """

    options: Options | None
    bicycle: Bicycle
    rider: Rider | None

    @property
    def name(self) -> str:
        """A name for functions, such as ``leaned_bent``."""
        if self.options is None:
            return "bare"
        parts = (str(self.options.posture), self.options.arms, "torso_lean" if self.options.torso_lean else None)
        return "_".join(part for part in parts if part)

    @property
    def reads(self) -> list[str]:
        """Names of the parameters that its programs read, in order."""
        own = [*self.bicycle.values()]
        return own if self.rider is None else [*own, *self.rider.values()]

    @property
    def nominal(self) -> list[float]:
        """The values at which pivots are chosen."""
        own = [*self.bicycle.values().values()]
        return [float(value) for value in (own if self.rider is None else [*own, *self.rider.values().values()])]

    def records(self, inputs: Any) -> tuple[Bicycle, Rider | None]:
        """Return bicycle and rider with the values of an array of inputs (n,)."""
        named = dict(zip(self.reads, inputs, strict=False))
        bicycle = self.bicycle.replace(**{name: named[name] for name in self.bicycle.values()})
        if self.rider is None:
            return bicycle, None
        return bicycle, self.rider.replace(**{name: named[name] for name in self.rider.values()})


def variants() -> list[Variant]:
    """Return all ways to ride that the page knows, each traced at a design of the paper."""
    found = [Variant(None, load_bicycle("benchmark"), None)]
    rider = load_rider("rider-a")
    for posture, arms, bicycle_name in _POSTURES:
        bicycle = load_bicycle(bicycle_name).replace(handlebar_drop=0.0)  # read, so that bicycles may have it
        for torso_lean in (False, True):
            options = Options(posture, arms=arms, torso_lean=torso_lean)
            found.append(Variant(options, bicycle, rider.on(bicycle)))
    return found


_POSTURES = (
    ("rigid", None, "stratos"),
    ("leaned", "straight", "stratos"),
    ("leaned", "bent", "stratos"),
    ("upright", None, "browser"),
)


def _equations(variant: Variant) -> Callable[[Any], tuple[Any, ...]]:
    """Return the function of the inputs that gives the matrices, how far limbs are stretched, the residual."""

    def equations(inputs: Any) -> tuple[Any, ...]:
        bicycle, rider = variant.records(inputs)
        model = coefficients(bicycle, rider, variant.options or Options())
        matrices = tuple(jnp.asarray(getattr(model, name)) for name in MATRICES)
        if rider is None or variant.options is None:
            return (*matrices, jnp.zeros(3))
        seated = seat(bicycle, rider, variant.options)
        shares = reach(seated.skeleton, rider)
        return (*matrices, jnp.stack([shares["arm"], shares["leg"], loop_residual(seated, bicycle)]))

    return equations


def _skeleton(variant: Variant) -> Callable[[Any], Any]:
    """Return the function of inputs and freedoms (but lean) that gives the 31 points."""
    count = len(variant.reads)

    def skeleton(inputs: Any) -> Any:
        bicycle, rider = variant.records(inputs[:count])
        assert rider is not None  # noqa: S101  # only riders have a skeleton
        seated = seat(bicycle, rider, variant.options or Options())
        return moved_skeleton(seated, bicycle, inputs[count:])

    return skeleton


def programs(all_variants: Iterable[Variant]) -> str:
    """Return the JavaScript module with the programs of all variants.

    Parameters
    ----------
    all_variants : iterable of Variant
    """
    config: Any = jax.config
    before = config.jax_enable_x64
    config.update("jax_enable_x64", val=True)
    try:
        parts = ["// Traced from the equations of the Python package by `make page-programs`; not to be edited.\n"]
        for variant in all_variants:
            parts.append(javascript_function(f"equations_{variant.name}", *trace(_equations(variant), variant.nominal)))
            if variant.rider is not None:
                moved = [*variant.nominal, *_freedoms(variant)]
                parts.append(javascript_function(f"skeleton_{variant.name}", *trace(_skeleton(variant), moved)))
        parts += [
            javascript_function(sheet.name, *trace(sheet.program, list(sheet.inputs.values())))
            for sheet in page_sheets()
        ]
    finally:
        config.update("jax_enable_x64", val=before)
    return "\n".join(parts)


def _freedoms(variant: Variant) -> list[float]:
    model = coefficients(variant.bicycle, variant.rider, variant.options or Options())
    return [0.1] * (model.freedoms - 1)


def manifest(all_variants: Iterable[Variant]) -> dict[str, Any]:
    """Return what the page has to know beside the programs: parameters, variants, and records to begin with.

    Parameters
    ----------
    all_variants : iterable of Variant
    """
    parameters = [
        {"name": name, "of": record.kind, **{key: getattr(p, key) for key in _DESCRIBED}}
        for record in (Bicycle, Rider)
        for name, p in record.descriptions().items()
    ]
    parameters += [
        {"name": f"{kind} at {joint}", "of": "posture", **_ANSWERS[kind], **_POSTURE}
        for joint in _JOINTS
        for kind in _ANSWERS
    ]
    return {
        "parameters": parameters,
        "allowed": {kind: words for kind, (words, _) in ALLOWED.items()},
        "flatness": FLATNESS_TOLERANCE,
        "variants": [_described(variant) for variant in all_variants],
        "sheets": [sheet.described() for sheet in page_sheets()],
        "example": page_records(),
    }


#: What may answer at a joint that is a freedom: on the diagonals of S0 and C0.
_JOINTS = ("steer", "torso lean")
_ANSWERS = {
    "spring": {"unit": "N*m/rad", "meaning": "stiffness of a spring at the joint"},
    "damper": {"unit": "N*m*s/rad", "meaning": "damping of a damper at the joint"},
}
_POSTURE = {"symbol": "", "group": "posture", "allowed": "not negative", "optional": True}
_DESCRIBED = ("unit", "symbol", "meaning", "group", "allowed", "optional")


def _described(variant: Variant) -> dict[str, Any]:
    model = coefficients(variant.bicycle, variant.rider, variant.options or Options())
    options = variant.options
    return {
        "posture": "bare" if options is None else options.posture,
        "arms": None if options is None else options.arms,
        "torso_lean": options is not None and options.torso_lean,
        "coordinates": list(model.coordinates),
        "inputs": list(model.inputs),
        "equations": f"equations_{variant.name}",
        "skeleton": None if variant.rider is None else f"skeleton_{variant.name}",
        "reads": variant.reads,
    }


def main(folder: str) -> None:
    """Write ``programs.js`` and ``manifest.json`` into a folder."""
    all_variants = variants()
    target = Path(folder)
    (target / "programs.js").write_text(programs(all_variants), encoding="utf-8")
    text = json.dumps(manifest(all_variants), indent=1, ensure_ascii=False)
    (target / "manifest.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1])
