"""What follows from the equations: uncertainties, responses, sensitivities."""
