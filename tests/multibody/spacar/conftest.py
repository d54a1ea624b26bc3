"""Files of models that several tests use."""

from __future__ import annotations

import pytest

#: The example of the manual of SPACAR95 (November 2000): a slider-crank with an elastic rod of two beams.
SLIDER_CRANK = """
PLBEAM 1 1 2 3 4
PLBEAM 2 3 5 6 7
PLBEAM 3 6 7 8 9
FIX 1
FIX 8 2
X 3 0.15 0.
X 6 0.30 0.
X 8 0.45 0.
INPUTX 2 1
DYNE 2 2
DYNE 2 3
DYNE 3 2
DYNE 3 3
TIMESTEP 100 5.0
MASS 8 0.033375
EMASS 1 0.2225
EMASS 2 0.2225
EMASS 3 0.2225
ESTIFF 2 0. 0.0012723
ESTIFF 3 0. 0.0012723
INPUTX 2 1
XD 2 1 1.5
END
"""

#: A bicycle robot with a leaning mass, in the dialect of Twente: the numbers of the model of RickDW/bikey (public
#: repository, bikey/bicycle.dat), whose recordings by the program itself are in test_recordings.py.
ROBOT = """
% bicycle robot
pinbody 1 1 2 3  % frame to steering head
pinbody 2 1 2 4  % rear hub
pinbody 3 1 2 5
hinge 4 2 6 1 0 0
pinbody 5 5 6 7
hinge 16 6 17 -1 0 0
beam 18 5 17 20 21
hinge 6 2 8 0.32 0 -1
pinbody 7 3 8 9
pinbody 8 3 8 10
hinge 9 8 11 0 1 0
wheel 10 10 11 12 0 1 0
hinge 11 2 13 0 1 0
wheel 12 4 13 14 0 1 0
hinge 13 2 15 0 -1 0
hinge 14 15 16 -1 0 0
hinge 15 16 18 0 0 1
x 1 0.1332 0 0.1
x 3 0.2409 0 0.2301
x 5 0.0857 0 0.2783
x 7 0.066 0 0.1538
x 4 0 0 0.1
x 9 0.2561 0 0.2395
x 10 0.2913 0 0.1
x 12 0.2913 0 0
x 14 0 0 0
x 20 0.0857 0 0.3793
fix 18
dyne 11 1
dyne 6 1
dyne 14 1
dyne 16 1
kine 9 1
kine 15 1
kinx 14 1
kinx 14 2
rlse 13 1
end
halt
xm 2 0.0122 0 0.0036 0.015 0 0.0039
xm 4 0.5122
xm 6 0.0281 0 -0.0118 0.0435 0 0.0343
xm 7 4.5897
xm 20 0.5
xm 9 1.5349
xm 10 0.5122
xm 11 0.0017 0 0 0.0033 0 0.0017
xm 13 0.0017 0 0 0.0033 0 0.0017
edamp 16 1
gravity 0 0 -9.81
inpute 11 1 0 20 0
end
halt
inputs 1 6 1
inputs 3 16 1
inputs 4 11 1
outep 1 11 1
oute 2 6 1
oute 3 14 1
oute 4 16 1
outx 5 14 1
outx 6 14 2
end
end
"""


@pytest.fixture
def slider_crank() -> str:
    """Return the manual's example."""
    return SLIDER_CRANK


@pytest.fixture
def robot() -> str:
    """Return a bicycle robot in the dialect of Twente."""
    return ROBOT
