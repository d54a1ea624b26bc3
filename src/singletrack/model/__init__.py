"""The record at the heart: one linear model, whoever made it and whoever asks it."""

from singletrack.model.outputs import Outputs
from singletrack.model.record import COORDINATES, GROUND_ACCELERATION, INPUTS, LinearModel, concatenate

__all__ = ["COORDINATES", "GROUND_ACCELERATION", "INPUTS", "LinearModel", "Outputs", "concatenate"]
