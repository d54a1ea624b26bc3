"""Rigid models equal the multibody engine, and recordings of the program itself."""

from __future__ import annotations

import numpy as np
import pytest

from singletrack import InputError, spacar
from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    System,
    accelerations,
    assemble,
    build,
    close_point,
    move,
    prismatic,
    revolute,
    simulate,
)

Y = (0, 1, 0)  # turning from x to up: the engine's z points down


def acceleration(state, name):
    return accelerations(state).a[state.model.system.coordinates.index(name)]


CHAIN = """
PLHINGE 1 10 2
PLBEAM 2 1 2 3 4
PLHINGE 3 2 14
PLBEAM 4 3 14 5 6
X 3 0.8 0.0
X 5 1.3 0.0
FIX 1
FIX 10
DYNE 1 1
DYNE 3 1
EMASS 2 1.5
EMASS 4 0.7
MASS 5 0.4
MASS 14 0.02
GRAVITY 0.0 -9.81
EDAMP 3 0.3
ESTIFF 1 2.0
"""


def rod(name, start, end, mass):
    length = end - start
    return Body(name, mass, ((start + end) / 2, 0, 0), (0.0, mass * length**2 / 12, mass * length**2 / 12))


def test_double_pendulum_equals_the_engine():
    # The rotor on node 14 is a thin disc: the engine's second rod gets its moment of inertia.
    system = System(
        bodies=[
            rod("first", 0, 0.8, 1.2),
            Body("second", 0.75, ((0.35 * 1.05 + 0.4 * 1.3) / 0.75, 0, 0), (0.03, _second_inertia(), 0.03)),
        ],
        joints=[
            revolute("one", GROUND, "first", (0, 0, 0), Y, stiffness=2.0),
            revolute("two", "first", "second", (0.8, 0, 0), Y, damping=0.3),
        ],
    )
    theirs, ours = build(system), spacar.read_text(CHAIN)
    rng = np.random.default_rng(1990)
    for q, u in zip(rng.uniform(-2, 2, (8, 2)), rng.uniform(-4, 4, (8, 2)), strict=True):
        state = move(assemble(theirs, {"one": q[0], "two": q[1]}), {"one": u[0], "two": u[1]})
        found = ours.accelerations({(1, 1): q[0], (3, 1): q[1]}, {(1, 1): u[0], (3, 1): u[1]})
        assert found[1, 1] == pytest.approx(acceleration(state, "one"), rel=1e-10, abs=1e-10)
        assert found[3, 1] == pytest.approx(acceleration(state, "two"), rel=1e-10, abs=1e-10)


def test_small_motions_are_the_derivative_of_accelerations():
    model = spacar.read_text(CHAIN)
    q, u, step = np.array([0.4, -1.1]), np.array([2.0, -3.0]), 1e-5
    small = model.linearise(model.motion(model.state(*_dicts(q, u))))

    def found(y):
        values = model.accelerations(*_dicts(y[:2], y[2:]))
        return np.array([values[1, 1], values[3, 1]])

    columns = [(found(np.r_[q, u] + d) - found(np.r_[q, u] - d)) / (2 * step) for d in step * np.eye(4)]
    np.testing.assert_allclose(small.A_matrix[2:], np.transpose(columns), rtol=1e-7, atol=1e-6)


def _dicts(q, u):
    return {(1, 1): q[0], (3, 1): q[1]}, {(1, 1): u[0], (3, 1): u[1]}


def _second_inertia():
    centre = (0.35 * 1.05 + 0.4 * 1.3) / 0.75
    return 0.35 * (0.25 / 12 + (centre - 1.05) ** 2) + 0.4 * (1.3 - centre) ** 2 + 0.02


RIGID_CRANK = """
PLHINGE 9 10 2
PLBEAM 1 1 2 3 4
PLBEAM 2 3 5 6 7
X 3 0.15 0.
X 6 0.5 0.
FIX 1
FIX 10
FIX 6 2
DYNE 9 1
EMASS 1 2.0
EMASS 2 1.0
MASS 6 0.3
GRAVITY 0. -9.81
"""


def engine_crank():
    return build(
        System(
            bodies=[
                rod("crank", 0, 0.15, 0.3),
                rod("rod", 0.15, 0.5, 0.35),
                Body("slider", 0.3, (0.5, 0, 0)),
            ],
            joints=[
                revolute("crank", GROUND, "crank", (0, 0, 0), Y),
                revolute("rod", "crank", "rod", (0.15, 0, 0), Y),
                prismatic("slide", GROUND, "slider", (1, 0, 0)),
            ],
            closures=[close_point("pin", "rod", "slider", (0.5, 0, 0), normal=Y)],
            independent=("crank",),
        )
    )


def test_slider_crank_equals_the_engine():
    theirs, ours = engine_crank(), spacar.read_text(RIGID_CRANK)
    for angle, rate in ((0.3, 2.0), (1.2, -3.0), (2.5, 5.0), (-2.0, 1.0)):
        state = move(
            assemble(theirs, {"crank": angle}, guess={"rod": -np.arcsin(np.sin(angle) * 0.15 / 0.35) - angle}),
            {"crank": rate},
        )
        found = ours.accelerations({(9, 1): angle}, {(9, 1): rate})
        assert found[9, 1] == pytest.approx(acceleration(state, "crank"), rel=1e-10)


def test_slider_crank_moves_as_the_engine_says():
    times = np.linspace(0.0, 1.0, 11)
    theirs = simulate(move(assemble(engine_crank(), {"crank": 0.2}), {"crank": 6.0}), times, rtol=1e-12)
    ours = spacar.read_text(RIGID_CRANK + "E 9 1 0.2\nED 9 1 6.0\nEPSINT 1e-12")
    motions = ours.run(times)
    angle = [ours.by_element(motion.state.e)[9][0] for motion in motions]
    np.testing.assert_allclose(angle, theirs.q.sel(coordinate="crank"), rtol=1e-8)


SPATIAL = """
HINGE 1 10 11 1 0 0
HINGE 2 11 12 0 1 0
PINBODY 3 1 12 2
X 2 0.1 0.05 -0.7
FIX 1
FIX 10
DYNE 1 1
DYNE 2 1
MASS 2 1.3
MASS 12 0.05 0.002 -0.003 0.06 0.001 0.04
GRAVITY 0 0 -9.81
"""


def test_pendulum_in_space_equals_the_engine():
    # z points up here and down in the engine: the same motion is turned by pi about x.
    system = System(
        bodies=[Body("link"), Body("bob", 1.3, (0.1, -0.05, 0.7), (0.05, 0.06, 0.04, -0.002, 0.001, 0.003))],
        joints=[
            revolute("about x", GROUND, "link", (0, 0, 0), (1, 0, 0)),
            revolute("about y", "link", "bob", (0, 0, 0), (0, -1, 0)),
        ],
    )
    theirs, ours = build(system), spacar.read_text(SPATIAL)
    rng = np.random.default_rng(2013)
    for q, u in zip(rng.uniform(-3, 3, (6, 2)), rng.uniform(-4, 4, (6, 2)), strict=True):
        state = move(assemble(theirs, {"about x": q[0], "about y": q[1]}), {"about x": u[0], "about y": u[1]})
        found = ours.accelerations({(1, 1): q[0], (2, 1): q[1]}, {(1, 1): u[0], (2, 1): u[1]})
        assert found[1, 1] == pytest.approx(acceleration(state, "about x"), rel=1e-10, abs=1e-10)
        assert found[2, 1] == pytest.approx(acceleration(state, "about y"), rel=1e-10, abs=1e-10)


def test_manual_example_runs_as_it_stands(slider_crank):
    model = spacar.read_text(slider_crank)
    motions = model.run()
    assert len(motions) == 101
    last = motions[-1]
    assert last.state.time == 5.0
    x = model.by_node(last.state.x)
    assert x[2] == [7.5]
    np.testing.assert_allclose(x[3], 0.15 * np.array([np.cos(7.5), np.sin(7.5)]), atol=1e-12)
    assert x[8][1] == 0.0
    # The rod's halves keep their length, and its bending follows its ends' angles.
    e = model.by_element(last.state.e)
    for element, (a, turn_a, b, turn_b) in {2: (3, 5, 6, 7), 3: (6, 7, 8, 9)}.items():
        chord = np.subtract(x[b], x[a])
        assert np.hypot(*chord) == pytest.approx(0.15, abs=1e-12)
        angle = np.arctan2(chord[1], chord[0])
        assert e[element][1] == pytest.approx(0.15 * np.sin(x[turn_a][0] - angle), abs=1e-12)
        assert e[element][2] == pytest.approx(-0.15 * np.sin(x[turn_b][0] - angle), abs=1e-12)


def test_freedoms_must_be_whole():
    with pytest.raises(ModelError, match="1 freedoms are left that nothing determines, in which node"):
        spacar.read_text(CHAIN.replace("DYNE 3 1\n", "RLSE 3 1\n")).rows  # noqa: B018
    with pytest.raises(ModelError, match="cannot all move by themselves: x 4 1, e 1 1, e 3 1"):
        spacar.read_text(CHAIN + "DYNX 4 1\n").rows  # noqa: B018
    with pytest.raises(ModelError, match="e 3 1 moves no mass"):
        spacar.read_text(CHAIN.replace("MASS 14 0.02\n", "").replace("EMASS 4 0.7\nMASS 5 0.4\n", "")).motion()
    with pytest.raises(InputError, match=r"deformation \(2, 1\) is not dynamic"):
        spacar.read_text(CHAIN).accelerations({(2, 1): 0.0})
    with pytest.raises(ModelError, match="no configuration"):
        spacar.read_text("PLTRUSS 1 1 2\nX 2 1 0\nFIX 1\nFIX 2 2\nINPUTE 1 1 -3 0 0\n").state()
