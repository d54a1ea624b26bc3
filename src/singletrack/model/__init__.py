"""The record at the heart: one linear model, whoever made it and whoever asks it."""

from singletrack.model.record import COORDINATES, INPUTS, LinearModel, concatenate

__all__ = ["COORDINATES", "INPUTS", "LinearModel", "concatenate"]
