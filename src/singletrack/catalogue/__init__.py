"""A bicycle from a geometry sheet and a kitchen scale: what is not measured is estimated, with its uncertainty."""

from singletrack.catalogue.estimate import Estimate, bicycle, estimate
from singletrack.catalogue.sheet_file import read_sheet, sheet_template

__all__ = ["Estimate", "bicycle", "estimate", "read_sheet", "sheet_template"]
