"""The model that a command's arguments ask for, and what looks odd about it."""

from __future__ import annotations

import importlib
import warnings
from dataclasses import dataclass
from math import degrees, isfinite
from typing import TYPE_CHECKING, cast

from singletrack.body.fit import elbow_angle, fit
from singletrack.body.oddities import warn_of_oddities
from singletrack.commands.model_options import ModelOptions, pairs
from singletrack.commands.sheets import bicycle_named
from singletrack.errors import InputError, OddityWarning
from singletrack.library import load_rider
from singletrack.library.load import override
from singletrack.model import LinearModel
from singletrack.parameters import Bicycle, Rider
from singletrack.parameters.bicycle import FRAME_GEOMETRY
from singletrack.parameters.hints import unknown_parameter
from singletrack.parameters.units import parse_quantity
from singletrack.posture import Options

if TYPE_CHECKING:
    from singletrack.public import CoefficientMatrices

__all__ = ["Made", "answer_words", "model_from", "seated"]


@dataclass(frozen=True)
class Made:
    """A model, what it was made from, and a heading that says so."""

    model: LinearModel
    bicycle: Bicycle
    rider: Rider | None
    title: str
    sitting: Options

    @property
    def asked(self) -> CoefficientMatrices:
        """The model as one that can be asked for eigenvalues, modes, critical speeds: not every command does."""
        public = importlib.import_module("singletrack.public")  # a door: with all that can be asked
        origin = None if self.rider is None else public.Origin(self.bicycle, self.rider, self.sitting)
        return cast("CoefficientMatrices", public.CoefficientMatrices.of(self.model, origin))


def model_from(bicycle: str, options: ModelOptions) -> Made:
    """Return the model that a command's arguments ask for, after warning of what looks odd.

    Parameters
    ----------
    bicycle : str
        A shipped name or a file.
    options : ModelOptions

    Raises
    ------
    SingletrackError
        If there is no such thing, or a value is not allowed.
    """
    record, rider, changed = seated(bicycle_named(bicycle), options)
    maker = importlib.import_module(f"singletrack.{options.engine.name}")  # a door: the engine's libraries are heavy
    model = _answered(maker.coefficients(record, rider, options.sitting), options)
    rider = None if rider is None else rider.on(record)
    warn_of_oddities(record, rider)
    who = "" if rider is None else f" with {rider.name or 'rider'}, {options.sitting.title}"
    return Made(model, record, rider, f"{record.name}{who}{changed}{answer_words(options)}", options.sitting)


def _answered(model: LinearModel, options: ModelOptions) -> LinearModel:
    """Return the model with what is fed back to it."""
    answer = options.answer
    if answer is None:
        return model
    if isfinite(answer.limit) or answer.delay:
        _warn("--gains: a linear model takes the gains alone, without limit and delay; `singletrack ride` takes all")
    control = importlib.import_module("singletrack.control")  # a door: few commands need it
    try:
        closed: LinearModel = control.closed_loop(model, answer.gains)
    except InputError as error:
        raise error.at(str(options.gains or "--feedback")) from None
    return closed


def answer_words(options: ModelOptions) -> str:
    """Return what is fed back, for headings."""
    if options.answer is None:
        return ""
    return f", {options.gains}" if options.gains is not None else f", {'; '.join(options.feedback or [])}"


def seated(bicycle: Bicycle, options: ModelOptions) -> tuple[Bicycle, Rider | None, str]:
    """Return bicycle and rider with what ``--set`` changes, and the changes in words, for headings.

    Parameters
    ----------
    bicycle : Bicycle
        As loaded.
    options : ModelOptions

    Raises
    ------
    SingletrackError
        If a name is unknown or given twice, or a value is not allowed.
    """
    rider = None if options.rider is None else load_rider(options.rider)
    changes = pairs("--set", options.settings)
    own = bicycle.descriptions()
    theirs = Rider.descriptions()
    for name in changes:
        if rider is None and name in theirs:
            raise InputError(f"--set {name}: is a parameter of a rider, and there is no --rider")
        if name not in own and name not in theirs:
            raise unknown_parameter("", name, [*own, *(theirs if rider else [])]).at("--set")
        if rider is None and name in FRAME_GEOMETRY:
            _warn(f"--set {name}: changes no equation without a --rider (frame geometry says where a rider sits)")
    before = (bicycle, rider)
    bicycle = override(bicycle, {name: text for name, text in changes.items() if name in own})
    if rider is not None:
        rider = override(rider, {name: text for name, text in changes.items() if name not in own})
    words = "".join(f", {name} = {text}" for name, text in changes.items())
    if options.fit or options.elbow_angle is not None:
        rider = fit(bicycle, *_asked_to_fit(rider, options, before))
        words += f", forward_lean_angle = {degrees(rider.forward_lean_angle):.4g} deg to fit"
    return bicycle, rider, words


def _asked_to_fit(
    rider: Rider | None, options: ModelOptions, before: tuple[Bicycle, Rider | None]
) -> tuple[Rider, float]:
    """Return the rider and the elbow angle in rad to which he is fitted: as asked for, or as it was before changes."""
    if rider is None:
        raise InputError("--fit: needs a --rider")
    if not options.fit:
        raise InputError("--elbow-angle: says how --fit fits the rider, and there is no --fit")
    if options.elbow_angle is not None:
        try:
            return rider, parse_quantity(options.elbow_angle, "rad").value
        except InputError as error:
            raise error.at("--elbow-angle") from None
    return rider, float(elbow_angle(before[0], before[1] or rider))


def _warn(text: str) -> None:
    warnings.warn(text, OddityWarning, stacklevel=3)
