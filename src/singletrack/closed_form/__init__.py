"""The equations of motion in closed form: the bicycle of Meijaard et al. (2007), and bodies slaved to it."""

from singletrack.closed_form.coefficients import coefficients
from singletrack.closed_form.outputs import rider_outputs
from singletrack.closed_form.single import Single, single_design
from singletrack.closed_form.tyres import Tyre, TyreModel, tyre_model

__all__ = ["Single", "Tyre", "TyreModel", "coefficients", "rider_outputs", "single_design", "tyre_model"]
