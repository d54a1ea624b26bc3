"""The equations of motion in closed form: the bicycle of Meijaard et al. (2007), and bodies slaved to it."""

from singletrack.closed_form.coefficients import coefficients

__all__ = ["coefficients"]
