"""From pendulum periods, angles and lengths to parameters with uncertainties."""
