"""The page in the browser: sliders, a rider in motion, eigenvalues, in one file."""
