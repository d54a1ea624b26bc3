"""A bicycle from a geometry sheet and a kitchen scale: what is not measured is estimated, with its uncertainty."""

from singletrack.catalogue.estimate import Estimate, bicycle, estimate
from singletrack.catalogue.expected import Expected, expected
from singletrack.catalogue.sheet_file import read_sheet, sheet_template

__all__ = ["Estimate", "Expected", "bicycle", "estimate", "expected", "read_sheet", "sheet_template"]
