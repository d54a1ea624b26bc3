"""Flexible beams converge, at the order they should, to what beam theory says."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc

from singletrack import spacar
from singletrack.errors import ModelError
from singletrack.multibody.spacar.evaluate import inertia

LENGTH, BENDING, LINE_MASS = 2.0, 3.0, 1.7
ENDS = ("clamped-free", "supported-supported", "clamped-clamped")


def planar(count, ends, kind="PLBEAM", more=""):
    """Return a beam along x whose nodes' y and angles are the freedoms."""
    left, right = ends.split("-")
    lines = [f"{kind} {k + 1} {2 * k + 1} {2 * k + 2} {2 * k + 3} {2 * k + 4}" for k in range(count)]
    lines += [f"X {2 * k + 1} {LENGTH * k / count!r} 0" for k in range(count + 1)]
    last = 2 * count + 1
    lines += ["FIX 1"] + ["FIX 2"] * (left == "clamped")
    lines += [f"FIX {last} 2"] * (right != "free") + [f"FIX {last + 1}"] * (right == "clamped")
    for k in range(count):
        lines += [f"RLSE {k + 1} 2 3", f"EMASS {k + 1} {LINE_MASS}", f"ESTIFF {k + 1} 0 {BENDING}"]
    for k in range(count + 1):
        held = {0: left, count: right}.get(k, "free")
        lines += [f"DYNX {2 * k + 1} 2"] * (held == "free") + [f"DYNX {2 * k + 2} 1"] * (held != "clamped")
    return spacar.read_text("\n".join([*lines, more]))


def orders(errors):
    """Return the orders of convergence of errors (k, ...) for elements halved k - 1 times."""
    return np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))


#: Roots of the frequency equations: cos cosh = -1, sin = 0, cos cosh = 1.
ROOTS = {
    "clamped-free": [brentq(lambda b: np.cos(b) + 1 / np.cosh(b), lo, lo + 1.5) for lo in (1.0, 4.0, 7.0, 10.5)],
    "supported-supported": [np.pi * k for k in (1, 2, 3, 4)],
    "clamped-clamped": [brentq(lambda b: np.cos(b) - 1 / np.cosh(b), lo, lo + 1.5) for lo in (4.0, 7.0, 10.5, 13.5)],
}


@pytest.mark.parametrize("ends", ENDS)
def test_first_four_frequencies_converge_at_order_four(ends):
    exact = np.square(ROOTS[ends]) * np.sqrt(BENDING / LINE_MASS) / LENGTH**2
    found = np.array([planar(count, ends).frequencies()[0][:4] for count in (6, 12, 24)])
    errors = found / exact - 1
    assert np.all(errors > 0)  # stiffer than the beam: conforming elements, consistent mass
    np.testing.assert_allclose(orders(errors)[1], 4.0, atol=0.2)
    assert np.max(errors[2]) < 1e-4


def test_lumped_mass_converges_at_order_two_from_below():
    exact = ROOTS["supported-supported"][0] ** 2 * np.sqrt(BENDING / LINE_MASS) / LENGTH**2
    text = [planar(count, "supported-supported").text() for count in (4, 8, 16)]
    found = []
    for one in text:
        # Without rotary inertia the angles move no mass: a little on each makes them freedoms.
        count = one.count("EMASS")
        small = "\n".join(f"MASS {2 * k + 2} 1e-9" for k in range(count + 1))
        lumped = spacar.read_text(one.replace("END\nEOF\n", small), mass="lumped")
        found.append(lumped.frequencies()[0][0])
    errors = np.array(found) / exact - 1
    assert np.all(abs(errors) < 1e-2)


@pytest.mark.parametrize("ends", ENDS)
@pytest.mark.parametrize(("kind", "order"), [("PLBEAM", 2), ("PLBEAMNL", 4)])
def test_euler_loads_converge(ends, kind, order):
    effective = {"clamped-free": 2.0, "supported-supported": 1.0, "clamped-clamped": 0.5}[ends]
    exact = np.pi**2 * BENDING / (effective * LENGTH) ** 2
    found = [planar(count, ends, kind, f"FORCE {2 * count + 1} -1 0").buckling().factors[0] for count in (4, 8, 16)]
    errors = np.array(found) / exact - 1
    np.testing.assert_allclose(orders(errors)[-1], order, atol=0.15)
    assert abs(errors[-1]) < {2: 0.02, 4: 1e-4}[order]


@pytest.mark.parametrize("kind", ["PLBEAM", "PLBEAMNL"])
def test_static_deflections_of_small_loads_are_exact(kind):
    load = 1e-6
    for count in (1, 2, 5):
        end = planar(count, "clamped-free", kind, f"FORCE {2 * count + 1} 0 {load}")
        x = end.by_node(end.equilibrium().state.x)
        assert x[2 * count + 1][1] == pytest.approx(load * LENGTH**3 / (3 * BENDING), rel=1e-9)
        assert x[2 * count + 2][0] == pytest.approx(load * LENGTH**2 / (2 * BENDING), rel=1e-9)
    for ends, factor in (("supported-supported", 48), ("clamped-clamped", 192)):
        middle = planar(4, ends, kind, f"FORCE 5 0 {load}")
        assert middle.by_node(middle.equilibrium().state.x)[5][1] == pytest.approx(
            load * LENGTH**3 / (factor * BENDING), rel=1e-9
        )


def test_own_weight_deflects_a_cantilever():
    found = planar(4, "clamped-free", more="GRAVITY 0 -1e-6")
    weight = LINE_MASS * 1e-6
    # The cubic elements' loads are consistent, their ends exact.
    assert found.by_node(found.equilibrium().state.x)[9][1] == pytest.approx(
        -weight * LENGTH**4 / (8 * BENDING), rel=1e-9
    )


def elastica(load):
    """Return x / L, y / L, angle of a cantilever's tip under load EI / L^2 across it (Bisshopp and Drucker 1945)."""

    def parts(angle):
        modulus = np.sqrt((1 + np.sin(angle)) / 2)
        return modulus**2, np.arcsin(1 / (modulus * np.sqrt(2)))

    def lack(angle):
        m, phi = parts(angle)
        return ellipk(m) - ellipkinc(phi, m) - np.sqrt(load)

    angle = brentq(lack, 1e-9, np.pi / 2 - 1e-12)
    m, phi = parts(angle)
    return np.sqrt(2 * np.sin(angle) / load), 1 - 2 / np.sqrt(load) * (ellipe(m) - ellipeinc(phi, m)), angle


@pytest.mark.parametrize("load", [1.0, 5.0, 10.0])
def test_elastica(load):
    exact = np.array(elastica(load))
    found = []
    for count in (4, 8):
        model = planar(count, "clamped-free", "PLBEAMNL", f"FORCE {2 * count + 1} 0 {load * BENDING / LENGTH**2!r}")
        x = model.by_node(model.equilibrium().state.x)
        found.append([*np.divide(x[2 * count + 1], LENGTH), *x[2 * count + 2]])
    errors = np.array(found) / exact - 1
    assert np.max(abs(errors[1])) < 1e-3
    assert np.all(orders(errors) > 3.3)


def chain_in_space(count, length, stiffness, more, kind="BEAMNL", mass=""):
    """Return a cantilever along x whose deformations but elongation are the freedoms."""
    lines = [f"{kind} {k + 1} {2 * k + 1} {2 * k + 2} {2 * k + 3} {2 * k + 4} 0 1 0" for k in range(count)]
    lines += [f"X {2 * k + 1} {length * k / count!r} 0 0" for k in range(count + 1)]
    lines += ["FIX 1", "FIX 2"]
    for k in range(count):
        lines += [f"DYNE {k + 1} 2 3 4 5 6", f"ESTIFF {k + 1} 0 {' '.join(map(repr, stiffness))}"]
        lines += [f"EMASS {k + 1} {mass}"] * bool(mass)
    return spacar.read_text("\n".join([*lines, more]))


# Princeton beam (Dowell and Traybar 1975): length, G J, E I for bending in the stiff and the soft plane as in Bauchau,
# Han, Mikkola, Matikainen, Gruber (2016), Multibody System Dynamics 37.
PRINCETON = (0.508, (3.103, 36.28, 2.429))


def rod(force):
    """Return place and twist of the tip of the Princeton beam as a rod of Kirchhoff, by shooting."""
    length, stiffness = PRINCETON

    def matrix(q):
        w, v = q[0], q[1:]
        return (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * np.cross(np.eye(3), -v).T

    def slope(_, y):
        q, moment = y[3:7], y[7:10]
        turn = matrix(q)
        bend = turn.T @ moment / stiffness
        rates = [-q[1:] @ bend, *(q[0] * bend + np.cross(q[1:], bend))]
        return np.concatenate([turn[:, 0], np.divide(rates, 2), -np.cross(turn[:, 0], now)])

    def end(moment):
        return solve_ivp(slope, [0, length], [0, 0, 0, 1, 0, 0, 0, *moment], rtol=1e-9, atol=1e-11).y[:, -1]

    moment = np.zeros(3)
    for part in (0.3, 0.6, 1.0):
        now = part * force
        moment = fsolve(lambda m: end(m)[7:10], moment + 0.3 * np.cross([length, 0, 0], force), xtol=1e-9)
    tip = end(moment)
    return tip[:3] - [length, 0, 0], 2 * np.arctan2(tip[4], tip[3])


@pytest.mark.parametrize("angle", [15.0, 45.0, 90.0])
def test_princeton_beam(angle):
    load, radians = 13.345, np.radians(angle)
    force = load * np.array([0.0, np.sin(radians), -np.cos(radians)])
    exact, twist = rod(force)
    model = chain_in_space(8, *PRINCETON, f"FORCE 17 {' '.join(repr(float(f)) for f in force)}")
    x = model.by_node(model.equilibrium().state.x)
    moved = np.array(x[17]) - [PRINCETON[0], 0, 0]
    np.testing.assert_allclose(moved, exact, rtol=2e-3, atol=1e-9)
    assert 2 * np.arctan2(x[18][1], x[18][0]) == pytest.approx(twist, rel=5e-3, abs=1e-9)


def test_frequencies_in_space_are_those_of_both_planes_and_of_torsion():
    length, (torsion, stiff, soft), mass, spin = 1.3, (2.0, 9.0, 4.0), 0.8, 0.05
    model = chain_in_space(8, length, (torsion, stiff, soft), "", "BEAM", f"{mass} {spin}")
    found = model.frequencies(model.motion())[0]
    bend = np.square(ROOTS["clamped-free"][:2]) / length**2
    expected = [
        *(bend * np.sqrt(stiff / mass)),
        *(bend * np.sqrt(soft / mass)),
        np.pi / 2 / length * np.sqrt(torsion / spin),
    ]
    np.testing.assert_allclose([found[np.argmin(abs(found - one))] for one in expected], expected, rtol=3e-3)
    np.testing.assert_allclose(found[:2], np.sort(expected)[:2], rtol=1e-4)


#: First frequency across the plane of a rotating cantilever, by turning rate, both over sqrt(EI / m L^4):
#: Wright, Smith, Thresher, Wang (1982), Journal of Applied Mechanics 49.
FLAP = {2: 4.1373, 6: 7.3604, 12: 13.1702}


@pytest.mark.parametrize("rate", FLAP)
def test_a_rotating_beam_stiffens(rate):
    lines = [f"PLBEAMNL {k + 1} {2 * k + 1} {2 * k + 2} {2 * k + 3} {2 * k + 4}" for k in range(8)]
    lines += [f"X {2 * k + 1} {k / 8} 0" for k in range(9)] + ["FIX 1", "INPUTX 2 1", f"XD 2 1 {rate}"]
    lines += [f"DYNE {k} 2 3\nESTIFF {k} 0 1\nEMASS {k} 1" for k in range(1, 9)]
    values = spacar.read_text("\n".join(lines)).linearise().eigenvalues()
    lag = np.sort(values.imag[values.imag > 0])[0]
    # In the plane of rotation the square is less by that of the rate.
    assert lag**2 + rate**2 == pytest.approx(FLAP[rate] ** 2, rel=4e-4)


def test_energy_is_kept_by_a_flexible_pendulum():
    lines = ["PLBEAMNL 1 1 2 3 4", "PLBEAMNL 2 3 4 5 6", "X 3 0.5 0", "X 5 1 0", "FIX 1", "DYNX 2 1"]
    lines += [f"DYNE {k} 2 3\nESTIFF {k} 0 5\nEMASS {k} 1" for k in (1, 2)] + ["GRAVITY 0 -9.81"]
    model = spacar.read_text("\n".join(lines))
    energies = []
    for motion in model.run(np.linspace(0, 0.2, 3)):
        x, v = motion.state.x, motion.state.v
        kinetic = v @ inertia(model.layout, x, v)[0] @ v / 2
        at = model.by_node(x)
        # Weight of the cubics: their mean heights.
        height = sum(
            0.5 * ((at[a][1] + at[a + 2][1]) / 2 + 0.5 * (np.sin(at[a + 1][0]) - np.sin(at[a + 3][0])) / 12)
            for a in (1, 3)
        )
        bend = sum(_bending_energy(model, k, motion.state.e) for k in (1, 2))
        energies.append(kinetic + 9.81 * height + bend)
    np.testing.assert_allclose(energies, energies[0], atol=1e-7)


def _bending_energy(model, number, e):
    """Return the energy of the angles to fourth order, as docs/reference/spacar.md has it."""
    a, b = np.divide(model.by_element(e)[number][1:], 0.5)
    short = (2 * a * a + a * b + 2 * b * b) / 30
    a, b = a * (1 + a * a / 6 + short), b * (1 + b * b / 6 + short)
    return 5.0 * (4 * a * a - 4 * a * b + 4 * b * b) / (2 * 0.5)


def test_no_equilibrium_and_no_loads_are_said():
    with pytest.raises(ModelError, match="no equilibrium"):
        spacar.read_text("PLHINGE 1 1 2\nFIX 1\nDYNE 1 1\nMASS 2 1\nFORCE 2 1").equilibrium()
    with pytest.raises(ModelError, match="needs FORCE"):
        planar(2, "clamped-free").buckling()
