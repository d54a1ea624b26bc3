"""Every kind of element: zero as drawn, blind to rigid motion, exact derivatives; loops of any topology."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from singletrack import spacar
from singletrack.multibody.spacar.evaluate import convective_rates, inertia, strains, vary
from singletrack.multibody.spacar.kinds import KINDS

SPATIAL = """
BEAM 1 1 2 3 4 0.2 1 0.1
BEAMNL 2 3 4 5 6 0 0 1
TRUSS 3 1 5
HINGE 4 2 6 0.3 1 0.2
BEARING 5 3 4 7 8 1 2 3
PINBODY 6 5 6 9
X 3 1 0.2 0.1
X 5 1.5 1.2 -0.3
X 7 0.3 0.4 0.5
X 9 0.1 -0.7 0.4
LAMBDA 4 0.8 0 0.6 0
EMASS 1 1.3 0.02
EMASS 2 0.7
EMASS 3 0.4
MASS 9 2
MASS 8 0.3 0.01 0.02 0.4 -0.03 0.5
FORCE 4 0.1 0.2 0.3
FORCE 9 1 2 3
TORQUEL 8 0.3 0.2 0.1
GRAVITY 0.1 0.2 -9.81
"""
PLANE = """
PLBEAM 1 1 2 3 4
PLBEAMNL 2 3 4 5 6
PLTRUSS 3 1 5
PLHINGE 4 2 6
PLBEAR 5 3 4 7 8 1 2
X 3 1 0.2
X 5 1.5 1.2
X 7 0.3 0.4
BETA 4 0.3
EMASS 1 1.3
EMASS 2 0.7
EMASS 3 0.4
GRAVITY 0.1 -9.81
"""
WHEELS = "WHEEL 1 1 2 3 0.1 1 0\nX 1 0 0 0.4\nX 3 0 0 0\n"
PLANE_WHEEL = "PLWHEEL 1 1 2 3\nX 1 2 0.4\nX 3 2 0\n"
BEAM = "BEAM 1 1 2 3 4 0.2 1 0.1\nX 3 1 0.2 0.1\nEMASS 1 1.3 0.02\n"  # where files of Twente say BEAM, BEAMNL is meant
ALL = {"beam": BEAM, "space": SPATIAL, "plane": PLANE, "wheel": WHEELS, "plane wheel": PLANE_WHEEL}


def wild(layout, rng):
    """Return random coordinates near the drawing, rates and accelerations; Euler parameters keep their length."""
    x, v, a = (rng.normal(0, scale, len(layout.drawn)) for scale in (0.15, 1.0, 1.0))
    x += layout.drawn
    for group in layout.groups:
        if group.kind == "EULER":
            for own in group.x:
                x[own] /= np.linalg.norm(x[own])
    return x, v, a


def test_all_kinds_are_tried():
    tried = {element.kind for text in ALL.values() for element in spacar.read_text(text).description.elements.values()}
    assert tried == set(KINDS)


@pytest.mark.parametrize("name", ALL)
def test_deformations_are_zero_as_drawn(name):
    layout = spacar.read_text(ALL[name]).layout
    np.testing.assert_allclose(strains(layout, layout.drawn)[0], 0.0, atol=1e-14)


@given(turn=st.tuples(*[st.floats(-3, 3)] * 3), shift=st.tuples(*[st.floats(-5, 5)] * 3), seed=st.integers(0, 1000))
@settings(max_examples=30, deadline=None)
def test_deformations_do_not_see_rigid_motion(turn, shift, seed):
    layout = spacar.read_text(SPATIAL).layout
    x, _, _ = wild(layout, np.random.default_rng(seed))
    turned, rotation = x.copy(), Rotation.from_rotvec(turn)
    for (node, component), i in layout.x_index.items():
        if component != 1:
            continue
        if layout.description.nodes[node] == "p3":
            turned[i : i + 3] = rotation.apply(x[i : i + 3]) + shift
        else:
            s, *v = x[i : i + 4]
            *v, s = (rotation * Rotation.from_quat([*v, s])).as_quat()
            turned[i : i + 4] = [s, *v]
    before, after = strains(layout, x)[0], strains(layout, turned)[0]
    np.testing.assert_allclose(np.exp(1j * after), np.exp(1j * before), atol=1e-12)


@pytest.mark.parametrize("name", ALL)
def test_derivatives_are_exact(name):
    """Rows, convective rates and everything that small motions need, against central differences."""
    layout = spacar.read_text(ALL[name]).layout
    rng = np.random.default_rng(1963)
    x, v, a = wild(layout, rng)
    s = rng.normal(0, 1, len(layout.e_is))
    step = 1e-6
    unit = np.eye(len(x))

    def by(function):
        return np.stack([(function(d) - function(-d)) / (2 * step) for d in step * unit], axis=-1)

    holonomic = layout.holonomic
    rows = strains(layout, x)[1]
    np.testing.assert_allclose(by(lambda d: strains(layout, x + d)[0])[holonomic], rows[holonomic], atol=1e-8)

    def rate(d, w):
        return strains(layout, x + d)[1] @ w

    def accelerated(d, w):
        return rate(d, a) + convective_rates(layout, x + d, w)

    def force(d, w):
        mass, convective = inertia(layout, x + d, w)
        return mass @ a + convective + strains(layout, x + d)[1].T @ s

    bent = by(lambda d: rate(d, v))
    np.testing.assert_allclose(convective_rates(layout, x, v), bent @ v, atol=1e-7)
    found = vary(layout, x, v, a, s, factor=0.0)
    np.testing.assert_allclose(found.rates, bent, atol=1e-7)
    np.testing.assert_allclose(found.accelerations_x, by(lambda d: accelerated(d, v)), atol=1e-6)
    np.testing.assert_allclose(found.accelerations_v, by(lambda d: accelerated(0 * d, v + d)), atol=1e-6)
    np.testing.assert_allclose(found.forces_x, by(lambda d: force(d, v)), atol=1e-5)
    np.testing.assert_allclose(found.forces_v, by(lambda d: force(0 * d, v + d)), atol=1e-6)


def test_kinetic_energy_changes_by_the_power_of_inertia():
    """With M a + h the forces of inertia, their power is the change of the kinetic energy and of the weight's work."""
    for text in (SPATIAL, PLANE):
        layout = spacar.read_text(text.replace("GRAVITY", "*")).layout
        x, v, a = wild(layout, np.random.default_rng(7))

        def energy(t, x=x, v=v, a=a, layout=layout):
            place, rate = x + t * v + t**2 / 2 * a, v + t * a
            return rate @ inertia(layout, place, rate)[0] @ rate / 2

        mass, convective = inertia(layout, x, v)
        assert np.linalg.eigvalsh(mass)[0] > -1e-12
        assert (mass @ a + convective) @ v == pytest.approx((energy(1e-5) - energy(-1e-5)) / 2e-5, rel=1e-7)


def test_a_disc_rolls_down_in_the_plane():
    text = PLANE_WHEEL + "DYNX 2 1\nKINX 1 1\nMASS 1 2\nMASS 2 0.16\nGRAVITY 3 -9\n"
    model = spacar.read_text(text)
    motion = model.motion()
    # Down a slope by a tilted gravity: m g_x / (m + I / R^2).
    assert model.by_node(motion.a)[1][0] == pytest.approx(2 * 3 / (2 + 0.16 / 0.4**2))
    assert model.by_node(motion.a)[3][0] == pytest.approx(model.by_node(motion.a)[1][0])


def test_planar_loops_in_space_are_overconstrained_and_move():
    """A parallelogram of hinges in space has three redundant constraints and one freedom; as a pendulum it is exact."""
    text = """
    PINBODY 1 1 2 3
    PINBODY 2 3 4 5
    PINBODY 3 5 6 7
    HINGE 4 10 2 0 1 0
    HINGE 5 2 4 0 1 0
    HINGE 6 4 6 0 1 0
    HINGE 7 6 10 0 1 0
    X 3 0 0 -1
    X 5 2 0 -1
    X 7 2 0 0
    FIX 1
    FIX 7
    FIX 10
    DYNE 4 1
    RLSE 5 1
    RLSE 6 1
    RLSE 7 1
    MASS 3 1.5
    MASS 5 1.5
    GRAVITY 0 0 -9.81
    """
    model = spacar.read_text(text)
    assert "4 of them redundant" not in model.listing()
    assert "3 of them redundant" in model.listing()
    found = model.accelerations({(4, 1): 0.7}, {(4, 1): 1.0})
    assert found[4, 1] == pytest.approx(-9.81 * np.sin(0.7), rel=1e-10)


def test_two_loops_that_share_a_bar():
    """A lazy tongs of two crosses: height and width follow from one angle."""
    text = """
    PLBEAM 1 1 10 5 11
    PLBEAM 2 5 11 4 12
    PLBEAM 3 2 20 5 21
    PLBEAM 4 5 21 3 22
    PLBEAM 5 3 30 6 31
    PLBEAM 6 6 31 8 32
    PLBEAM 7 4 40 6 41
    PLBEAM 8 6 41 7 42
    X 1 0 0
    X 2 2 0
    X 3 0 2
    X 4 2 2
    X 5 1 1
    X 6 1 3
    X 7 0 4
    X 8 2 4
    FIX 1
    FIX 2 2
    DYNX 2 1
    MASS 8 3
    GRAVITY 0 -9.81
    """
    model = spacar.read_text(text)
    motion = model.motion()
    x, a = model.by_node(motion.state.x), model.by_node(motion.a)
    assert x[8] == [2.0, 4.0]
    # Bars of length 2 sqrt(2) at w = 2 apart: height of node 8 is 2 sqrt(8 - w^2), so that dh/dw = -2 at w = 2.
    slope = -2.0
    # One freedom w: 3 (1 + slope^2) w'' = -3 g slope at rest.
    assert a[2][0] == pytest.approx(9.81 * 2 / (1 + slope**2), rel=1e-9)
    assert a[8] == pytest.approx([a[2][0], slope * a[2][0]], rel=1e-9)


def test_lumped_mass_sits_on_the_ends():
    model = spacar.read_text(
        "PLTRUSS 1 1 2\nX 2 2 0\nFIX 1\nDYNX 2 1\nRLSE 1 1\nFIX 2 2\nEMASS 1 3\nFORCE 2 1 0", mass="lumped"
    )
    assert model.by_node(model.motion().a)[2][0] == pytest.approx(1 / 3)
    consistent = spacar.read_text(model.text())
    assert consistent.by_node(consistent.motion().a)[2][0] == pytest.approx(1 / 2)


def test_line_frees_a_deformation_in_the_linear_model_only():
    text = (
        "PLHINGE 1 1 2\nPLHINGE 2 2 3\nFIX 1\nDYNE 1 1\nINPUTE 2 1 0 0 0\nMASS 2 2\nMASS 3 1\nESTIFF 1 5\nESTIFF 2 3\n"
    )
    assert spacar.read_text(text).linearise().coordinates == ("e 1 1",)
    both = spacar.read_text(text + "LINE 2 1\n").linearise()
    assert both.coordinates == ("e 1 1", "e 2 1")
    np.testing.assert_allclose(both.M, [[3, 1], [1, 1]], atol=1e-12)
    np.testing.assert_allclose(both.K, [[5, 0], [0, 3]], atol=1e-12)


def test_redundant_loops_go_all_the_way_round():
    """A crank-rocker of hinges in space, whichever constraints were left out in the drawing; it keeps its energy."""
    text = """
    PINBODY 1 1 2 3
    PINBODY 2 3 4 5
    PINBODY 3 7 6 5
    HINGE 4 10 2 0 1 0
    HINGE 5 2 4 0 1 0
    HINGE 6 4 6 0 1 0
    HINGE 7 6 10 0 1 0
    X 3 0 0 0.3
    X 5 1 0 0.8
    X 7 1 0 0
    FIX 1
    FIX 7
    FIX 10
    DYNE 4 1
    RLSE 5 1
    RLSE 6 1
    RLSE 7 1
    MASS 3 1.5
    MASS 5 0.5
    ED 4 1 8
    """
    model = spacar.read_text(text)
    motions = model.run(np.linspace(0, 1.0, 11))
    angle = [model.by_element(motion.state.e)[4][0] for motion in motions]
    assert angle[-1] > 2 * np.pi
    energies = [m.state.v @ inertia(model.layout, m.state.x, m.state.v)[0] @ m.state.v / 2 for m in motions]
    np.testing.assert_allclose(energies, energies[0], rtol=1e-6)
