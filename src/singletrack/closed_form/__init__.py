"""The equations of motion in closed form: the bicycle of Meijaard et al. (2007), and bodies slaved to it."""

from singletrack.closed_form.coefficients import coefficients
from singletrack.closed_form.outputs import rider_outputs
from singletrack.closed_form.tyres import Tyre, TyreModel, tyre_model

__all__ = ["Tyre", "TyreModel", "coefficients", "rider_outputs", "tyre_model"]
