"""Bodies, joints, loops and rolling wheels: equations, linearisation, simulation."""
