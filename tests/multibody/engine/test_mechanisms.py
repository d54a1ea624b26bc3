"""Classical mechanisms with closed loops against textbook results and published reference solutions."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest
import sympy as sp

from singletrack.errors import ModelError
from singletrack.multibody import (
    GROUND,
    Body,
    CoordinateForce,
    Spring,
    System,
    accelerations,
    assemble,
    build,
    close_distance,
    close_joint,
    close_point,
    free,
    linearise,
    move,
    prismatic,
    revolute,
    simulate,
    steady_motion,
)

Y, Z = (0, 1, 0), (0, 0, 1)
ORIGIN = (0, 0, 0)


def rod(name: Any, start: Any, end: Any, mass: Any = 1.0) -> Any:
    """A slender rod between two points."""
    start, end = np.array(start, dtype=float), np.array(end, dtype=float)
    length = np.linalg.norm(end - start)
    along = (end - start) / length
    inertia = mass * length**2 / 12 * (np.eye(3) - np.outer(along, along))
    i = inertia
    return Body(name, mass, (start + end) / 2, (i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[1, 2], i[0, 2]))


def four_bar(lengths: Any, closure: Any) -> Any:
    """Crank, coupler and rocker in the plane y = 0, drawn along x, up to the closing joint at the rocker's end."""
    crank, coupler, rocker, base = lengths
    joint = (crank + coupler, 0, 0)
    joints = [
        revolute("crank", GROUND, "crank", ORIGIN, Y),
        revolute("coupler", "crank", "coupler", (crank, 0, 0), Y),
        revolute("rocker", GROUND, "rocker", (base, 0, 0), Y),
    ]
    bodies = [
        rod("crank", ORIGIN, (crank, 0, 0)),
        rod("coupler", (crank, 0, 0), joint),
        rod("rocker", (base, 0, 0), (base + rocker, 0, 0)),
    ]
    loop = {
        "plane": close_point("pin", "coupler", "rocker", joint, second_point=(base + rocker, 0, 0), normal=Y),
        "ball": close_point("pin", "coupler", "rocker", joint, second_point=(base + rocker, 0, 0)),
        "hinge": close_joint(
            "pin", "revolute", "coupler", "rocker", point=joint, axis=Y, second_point=(base + rocker, 0, 0)
        ),
    }[closure]
    return build(System(bodies, joints, [loop]))


LENGTHS = (1.0, 3.0, 2.5, 3.5)


@pytest.mark.parametrize("closure", ["plane", "ball", "hinge"])
def test_four_bar_obeys_freudenstein_whatever_the_closing_joint(closure: Any) -> None:
    model = four_bar(LENGTHS, closure)
    a, b, c, d = LENGTHS
    for crank in np.linspace(0.2, 6.0, 7):
        state = assemble(model, {"crank": -crank}, guess={"rocker": -1.5, "coupler": crank - 0.7})
        rocker = -state["rocker"]
        freudenstein = d / a * np.cos(rocker) - d / c * np.cos(crank) + (a**2 - b**2 + c**2 + d**2) / (2 * a * c)
        assert np.cos(crank - rocker) == pytest.approx(freudenstein, abs=1e-12)
        assert len(state.freedoms) == 1
    redundant = {"plane": 0, "ball": 1, "hinge": 3}
    assert len(state.partition.redundant) == redundant[closure]


def test_redundant_constraints_are_named_and_change_nothing() -> None:
    motions = {}
    for closure in ("plane", "ball", "hinge"):
        state = assemble(four_bar(LENGTHS, closure), {"crank": -1.0}, guess={"rocker": -1.5})
        motions[closure] = accelerations(move(state, {"crank": 2.0})).a
    assert state.partition.redundant == ("pin (point 2)", "pin (angle 1)", "pin (angle 2)")
    np.testing.assert_allclose(motions["ball"], motions["plane"], rtol=1e-11)
    np.testing.assert_allclose(motions["hinge"], motions["plane"], rtol=1e-11)


def test_a_turning_four_bar_changes_its_independent_speed_when_it_must() -> None:
    model = four_bar(LENGTHS, "plane")
    state = move(assemble(model, {"crank": -1.0}, guess={"rocker": -1.5}, independent=["rocker"]), {"rocker": 3.0})
    run = simulate(state, np.linspace(0.0, 6.0, 61))
    assert np.ptp(run.q.sel(coordinate="crank").to_numpy()) > 2 * np.pi  # the rocker passes its dead points
    np.testing.assert_allclose(
        run.energy.to_numpy(), float(run.energy[0]), rtol=0, atol=1e-8 * float(run.kinetic_energy.max())
    )
    assert run.residual.max() < 1e-12


def test_a_flat_parallelogram_is_singular() -> None:
    with pytest.raises(ModelError, match="singular configuration: pin"):
        assemble(four_bar((1.0, 3.0, 1.0, 3.0), "plane"), {"crank": 0.0, "rocker": 0.0, "coupler": 0.0})


def test_a_parallelogram_that_turns_becomes_singular_when_flat() -> Any:
    model = four_bar((1.0, 3.0, 1.0, 3.0), "plane")
    state = move(assemble(model, {"crank": -1.0}, guess={"rocker": -1.0, "coupler": 1.0}), {"crank": -5.0})
    assert state["rocker"] == pytest.approx(-1.0, abs=1e-12)
    with pytest.raises(ModelError, match=r"singular (at|between) t = .*more than one way"):
        simulate(state, np.linspace(0.0, 3.0, 11))


def test_slider_crank() -> None:
    r, l = 0.3, 1.0
    joints = [
        revolute("crank", GROUND, "crank", ORIGIN, Y),
        revolute("rod", "crank", "rod", (r, 0, 0), Y),
        prismatic("slide", GROUND, "piston", (1, 0, 0)),
    ]
    bodies = [rod("crank", ORIGIN, (r, 0, 0)), rod("rod", (r, 0, 0), (r + l, 0, 0)), Body("piston", 2.0, (r + l, 0, 0))]
    pin = close_point("pin", "rod", "piston", (r + l, 0, 0), normal=Y)
    model = build(
        System(bodies, joints, [pin], inputs=[CoordinateForce("gas", "slide")], gravity=0.0, independent=["crank"])
    )
    assert assemble(model).partition.redundant == ()
    for angle in (0.4, 1.3, 2.9, 4.4):
        state = move(assemble(model, {"crank": angle}, guess={"rod": -angle}), {"crank": 5.0})
        root = np.sqrt(l**2 - (r * np.sin(angle)) ** 2)
        assert state["slide"] == pytest.approx(r * np.cos(angle) + root - r - l, abs=1e-12)
        ratio = -r * np.sin(angle) * (1 + r * np.cos(angle) / root)
        assert state.rate("slide") == pytest.approx(5.0 * ratio, rel=1e-12)
        still = assemble(model, {"crank": angle}, guess={"rod": -angle})
        turning = np.linalg.inv(linearise(still, keep=[]).M)[0, 0]
        assert accelerations(still, {"gas": 1.0}).a[0] == pytest.approx(turning * ratio, rel=1e-12)


def bricard() -> Any:
    """Six rods along the edges of a cube, hinged at right angles to both neighbours: threefold symmetric."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]], dtype=float)
    edges = np.diff(np.vstack([corners, corners[:1]]), axis=0)
    axes = [np.cross(edges[i - 1], edges[i]) for i in range(6)]
    names = [GROUND, *(f"rod {i}" for i in range(1, 6))]
    joints = [revolute(f"hinge {i}", names[i - 1], names[i], corners[i], axes[i]) for i in range(1, 6)]
    bodies = [rod(names[i], corners[i], corners[(i + 1) % 6]) for i in range(1, 6)]
    loop = close_joint("last", "revolute", names[5], GROUND, point=corners[0], axis=axes[0])
    return build(System(bodies, joints, [loop], down=(0, -1, 0)))


def test_bricards_overconstrained_loop_moves() -> None:
    model = bricard()
    state = assemble(model)
    assert len(state.partition.redundant) == 1
    assert state.partition.redundant[0].startswith("last (")
    assert len(state.freedoms) == 1
    run = simulate(state, np.linspace(0.0, 3.0, 61))
    assert np.ptp(run.q.to_numpy()) > 0.5
    assert run.residual.max() < 1e-11  # of all constraints, the redundant one too
    np.testing.assert_allclose(
        run.energy.to_numpy(), float(run.energy[0]), rtol=0, atol=1e-8 * float(run.kinetic_energy.max())
    )


def governor(ball: Any, sleeve: Any, length: Any) -> Any:
    """Porter's governor: two arms from the top of a shaft, two links from the balls to a sleeve, z down."""
    bodies, joints, loops = [Body("shaft", 0.0, inertia=(0, 0, 0.0))], [], []
    joints.append(revolute("spin", GROUND, "shaft", ORIGIN, Z))
    joints.append(prismatic("sleeve", "shaft", "sleeve", Z))
    bodies.append(Body("sleeve", sleeve, (0, 0, 2 * length)))
    for side, sign in (("left", -1.0), ("right", 1.0)):
        at = (0, 0, length)
        bodies += [Body(f"{side} arm", ball, at), Body(f"{side} link")]
        joints.append(revolute(f"{side} arm", "shaft", f"{side} arm", ORIGIN, (0, sign, 0)))
        joints.append(revolute(f"{side} link", f"{side} arm", f"{side} link", at, (0, sign, 0)))
        loops.append(close_point(f"{side} pin", f"{side} link", "sleeve", (0, 0, 2 * length), normal=Y))
    return build(System(bodies, joints, loops, independent=("spin", "right arm")))


def test_flyball_governor_height_and_oscillation() -> None:
    ball, sleeve, length, g = 1.5, 4.0, 0.3, 9.81
    rate = 1.3 * np.sqrt((1 + sleeve / ball) * g / length)
    model = governor(ball, sleeve, length)
    start = {"right arm": 0.7, "left arm": 0.7, "right link": -1.4, "left link": -1.4, "sleeve": -0.14}
    found = steady_motion(model, rates={"spin": rate}, resting=["right arm"], guess=start).state
    height = length * np.cos(found["right arm"])
    assert height == pytest.approx((ball + sleeve) * g / (ball * rate**2), rel=1e-11)  # Porter's formula
    assert found["left arm"] == pytest.approx(found["right arm"], abs=1e-12)
    t, momentum = sp.symbols("t J", positive=True)
    effective = momentum**2 / (4 * ball * length**2 * sp.sin(t) ** 2) - 2 * (ball + sleeve) * g * length * sp.cos(t)
    angle = found["right arm"]
    spin_inertia = 2 * ball * (length * np.sin(angle)) ** 2
    stiffness = float(sp.diff(effective, t, 2).subs({t: angle, momentum: spin_inertia * rate}))
    inertia = 2 * ball * length**2 + sleeve * (2 * length * np.sin(angle)) ** 2
    eigenvalues = linearise(found).eigenvalues()
    assert np.max(eigenvalues.imag) == pytest.approx(np.sqrt(stiffness / inertia), rel=1e-9)
    np.testing.assert_allclose(eigenvalues.real, 0.0, atol=1e-6)


def squeezer() -> Any:
    """Andrews' squeezer mechanism, drawn with all angles at zero.

    Parameters and reference solution: Mazzia, Magherini, Test Set for Initial Value Problem Solvers, release 2.4
    (University of Bari, 2008), problem Andrews' squeezing mechanism; Schiehlen (ed.), Multibody Systems Handbook,
    Springer 1990.
    """
    rr, d, e, zt, zf, u, ss = 7e-3, 28e-3, 2e-2, 4e-2, 2e-2, 4e-2, 35e-3
    ra, da, ea, fa = 92e-5, 115e-4, 1421e-5, 1421e-5
    a, b, c = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
    sc, sd = 18e-3, 2e-2

    def at(x: Any, y: Any) -> Any:
        return (x, y, 0.0)

    def link(name: Any, mass: Any, inertia: Any, centre: Any) -> Any:
        return Body(name, mass, centre, (inertia,) * 3)

    bodies = [
        link("K1", 0.04325, 2.194e-6, at(ra, 0)),
        link("K2", 0.00365, 4.410e-7, at(rr - da, 0)),
        link("K3", 0.02373, 5.255e-6, at(b[0] + 1874e-5, b[1] - 1043e-5)),
        link("K5", 0.07050, 1.169e-5, at(a[0] + 2308e-5, a[1] + 916e-5)),
        link("K4", 0.00706, 5.667e-7, at(a[0] + zt, a[1] - (e - ea))),
        link("K7", 0.05498, 1.912e-5, at(a[0] + 1228e-5, a[1] - 449e-5)),
        link("K6", 0.00706, 5.667e-7, at(a[0] + zf - fa, a[1] - u)),
    ]
    joints = [
        revolute("beta", GROUND, "K1", ORIGIN, Z),
        revolute("theta", "K1", "K2", at(rr, 0), Z),
        revolute("gamma", GROUND, "K3", at(*b), Z),
        revolute("delta", GROUND, "K5", at(*a), Z),
        revolute("phi", "K5", "K4", at(a[0] + zt, a[1]), Z),
        revolute("epsilon", GROUND, "K7", at(*a), Z),
        revolute("omega", "K7", "K6", at(a[0], a[1] - u), Z),
    ]
    meeting = at(rr - d, 0)
    ends = {
        "K3": at(b[0], b[1] - ss),
        "K4": at(a[0] + zt, a[1] - e),
        "K6": at(a[0] + zf, a[1] - u),
    }
    loops = [close_point(f"P-{k}", "K2", k, meeting, second_point=end, normal=Z) for k, end in ends.items()]
    spring = Spring("spring", GROUND, "K3", at(*c), at(b[0] + sd, b[1] - sc), stiffness=4530.0, rest=0.07785)
    drive = CoordinateForce("motor", "beta")
    return build(System(bodies, joints, loops, springs=[spring], inputs=[drive], gravity=0.0))


REFERENCE = {
    "beta": (0.1581077119629904e2, 0.1139920302151208e4),
    "theta": (-0.1575637105984298e2, -0.1424379294994111e4),
    "gamma": (0.4082224013073101e-1, 0.1103291221937134e2),
    "phi": (-0.5347301163226948e0, 0.1929337464421385e2),
    "delta": (0.5244099658805304e0, 0.5735699284790808e0),
    "omega": (0.5347301163226948e0, -0.1929337464421385e2),
    "epsilon": (0.1048080741042263e1, 0.3231791658026955e0),
}


def test_andrews_squeezer() -> None:
    guess = {"gamma": 0.45, "phi": 0.2, "delta": 0.5, "omega": -0.2, "epsilon": 1.2, "beta": -0.06}
    state = assemble(squeezer(), {"theta": 0.0}, guess=guess)
    initial = {
        "beta": -0.0617138900142764496,
        "gamma": 0.455279819163070380,
        "phi": 0.222668390165885885,
        "delta": 0.487364979543842550,
        "epsilon": 1.23054744454982119,
    }
    assert {name: state[name] for name in initial} == pytest.approx(initial, abs=1e-13)
    start = accelerations(state, {"motor": 0.033}).a
    assert start[:2] == pytest.approx([14222.4439199541138706, -10666.8329399655854029], rel=1e-12)
    run = simulate(state, [0.0, 0.03], {"motor": 0.033}, rtol=1e-12, atol=1e-12)
    q, u = run.q[-1], run.u[-1]
    for name, (angle, rate) in REFERENCE.items():
        assert float(q.sel(coordinate=name)) == pytest.approx(angle, abs=1e-9 * abs(angle) + 1e-10)
        assert float(u.sel(coordinate=name)) == pytest.approx(rate, rel=1e-7)
    assert run.residual.max() < 1e-13


def test_a_rod_of_fixed_length_keeps_it() -> None:
    bodies = [Body("one", 1.0, (0, 0, 1)), Body("two", 2.0, (1, 0, 1))]
    joints = [revolute("a", GROUND, "one", ORIGIN, Y), revolute("b", GROUND, "two", (1, 0, 0), Y)]
    model = build(System(bodies, joints, [close_distance("rod", "one", "two", ((0, 0, 1), (1, 0, 1)), 1.0)]))
    state = assemble(model, {"a": 0.5})
    assert state["b"] == pytest.approx(0.5, abs=1e-12)
    # a parallelogram of point masses swings as one pendulum; the rod carries what the masses do not share
    assert accelerations(state).a == pytest.approx([-9.81 * np.sin(0.5)] * 2)
    assert accelerations(state).multipliers == pytest.approx([0.0], abs=1e-12)


CLOSINGS = {"fixed": 0, "revolute": 1, "prismatic": 1, "cylindrical": 2, "universal": 2, "planar": 3}


@pytest.mark.parametrize("kind", CLOSINGS)
def test_a_loop_closed_by_a_joint_leaves_that_joints_freedoms(kind: Any) -> Any:
    body = Body("body", 1.0, (0.3, 0, 0), (0.1, 0.2, 0.2))
    second_axis = (1, 0, 0) if kind == "universal" else None
    closure = close_joint("end", kind, GROUND, "body", point=(0.1, 0.2, 0.3), axis=(0, 1, 2), second_axis=second_axis)
    model = build(System([body], [free("j", GROUND, "body")], [closure]))
    state = assemble(model, guess={"j.x": 0.2, "j.y": -0.1, "j.1": 0.3, "j.2": -0.2, "j.3": 0.1})
    assert len(state.freedoms) == CLOSINGS[kind]
    assert state.partition.redundant == ()
    assert f"{CLOSINGS[kind]} degrees of freedom" in state.summary()


@pytest.mark.parametrize("kind", [*CLOSINGS, "point", "distance"])
def test_closures_their_rates_and_their_forces_belong_together(kind: Any) -> Any:
    points = (0.1, 0.2, 0.3), (0.5, -0.2, 0.4)
    closure = {
        "point": close_point("end", "one", "two", points[0], second_point=points[1]),
        "distance": close_distance("end", "one", "two", points, 0.7),
    }.get(kind) or close_joint(
        "end", kind, "one", "two", point=points[0], axis=(0, 1, 2), second_point=points[1], second_axis=(1, 0, 1)
    )
    bodies = [Body("one", 1.0), Body("two", 1.0)]
    joints = [free("i", GROUND, "one"), free("j", GROUND, "two")]
    model = build(System(bodies, joints, [closure]))
    rng = np.random.default_rng(5)
    q, multipliers = rng.uniform(-1, 1, 12), rng.uniform(-1, 1, len(closure.rows))
    p = model.parameters()
    q_symbol = ca.MX.sym("q", 12)
    gradient = ca.Function("g", [q_symbol], [ca.jacobian(model.equations.holonomic(q_symbol, p)[0], q_symbol)])
    np.testing.assert_allclose(model.holonomic(q, p)[1], gradient(q).full(), atol=1e-13)
    force, torque = (value.full().ravel() for value in model.equations.loop_wrenches(q, multipliers, p))
    pushed = model.holonomic(q, p)[1].T @ multipliers  # forces on x, y, z, yaw, lean, pitch of both bodies
    np.testing.assert_allclose(pushed[6:9], force, atol=1e-13)
    np.testing.assert_allclose(pushed[:3], -force, atol=1e-13)
    c, s = np.cos(q[9:]), np.sin(q[9:])
    Zr = np.array([[c[0], -s[0], 0], [s[0], c[0], 0], [0, 0, 1]])
    Xr = np.array([[1, 0, 0], [0, c[1], -s[1]], [0, s[1], c[1]]])
    Yr = np.array([[c[2], 0, s[2]], [0, 1, 0], [-s[2], 0, c[2]]])
    turns = np.array([[0, 0, 1], Zr[:, 0], (Zr @ Xr)[:, 1]])  # the axes of yaw, lean and pitch
    moment = np.cross(Zr @ Xr @ Yr @ np.array(points[1]), force) + torque
    np.testing.assert_allclose(pushed[9:], turns @ moment, atol=1e-12)
