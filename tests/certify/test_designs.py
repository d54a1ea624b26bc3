"""Certificates of bicycles with riders: all that ship, exact decimals, intervals of parameters."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import flint
import numpy as np
import pytest

from singletrack import InputError, closed_form, coefficients, load_bicycle, load_rider
from singletrack.certify import certify_design, design_problem, eigenvalue_balls
from singletrack.certify.balls import Ball, constant_ball, precision
from singletrack.certify.counting import alternates
from singletrack.certify.duals import Centred, Dual
from singletrack.certify.operations import centred_operations
from singletrack.library import shipped
from singletrack.linear import critical_speeds, eigenvalues
from singletrack.posture import Options

RIDDEN = [name for name in shipped("bicycle") if name in load_rider("rider-a").forward_lean_angles]
WAYS = [Options("rigid"), Options("leaned", arms="straight"), Options("leaned", arms="bent"), Options("upright")]


def require_agreement(certificate, model):
    """The critical speeds of doubles lie in the balls, and stability is as their eigenvalues say."""
    assert certificate.status == "certified"
    computed = [crossing.speed for crossing in critical_speeds(model).crossings]
    changes = [crossing for crossing in certificate.crossings if crossing.before != crossing.after]
    for speed in computed:
        assert any(crossing.speed.contains(speed, slack=1e-9) for crossing in changes)
    for each in certificate.ranges:
        high = min(each.stop, 2 * each.start + 20)
        for speed in np.linspace(each.start, high, 7)[1:-1]:
            assert (eigenvalues(model, speed).real > 0).sum() == each.unstable


@pytest.mark.parametrize("name", shipped("bicycle"))
def test_bicycles_alone(name):
    bicycle = load_bicycle(name)
    require_agreement(certify_design(bicycle, None, Options()), closed_form.coefficients(bicycle))


@pytest.mark.parametrize("torso_lean", [False, True])
@pytest.mark.parametrize("way", WAYS, ids=lambda way: f"{way.posture} {way.arms}")
def test_every_bicycle_with_a_rider(way, torso_lean):
    rider, options = load_rider("rider-a"), replace(way, torso_lean=torso_lean)
    for name in RIDDEN:
        bicycle = load_bicycle(name)
        certificate = certify_design(bicycle, rider, options)
        require_agreement(certificate, closed_form.coefficients(bicycle, rider.on(bicycle), options))
        ends = [crossing.speed for crossing in certificate.crossings]
        assert all(float(ball.radius) < 1e-20 * ball.upper for ball in ends)


def test_springs_dampers_and_feedback():
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    dampers = {"torso lean": 20.0, "steer": 1.5}
    options = Options("rigid", torso_lean=True, springs={"torso lean": 1900.0}, dampers=dampers)
    model = closed_form.coefficients(bicycle, rider, options)
    require_agreement(certify_design(bicycle, rider, options), model)
    gain = np.zeros((3, 3))
    gain[1, 0] = -7.3
    fed_back = replace(model, C0=model.C0 + gain)
    alone = certify_design(bicycle, rider, options, added={"C0": gain})
    require_agreement(alone, fed_back)
    between = certify_design(bicycle, rider, options, {"trail": ("56.2 mm", "56.4 mm")}, added={"C0": gain})
    assert len(between.crossings) == len(alone.crossings) > 0
    for wide, narrow in zip(between.crossings, alone.crossings, strict=True):
        assert wide.speed.lower < narrow.speed.lower < narrow.speed.upper < wide.speed.upper


def test_decimals_are_meant_and_not_their_doubles():
    bicycle = load_bicycle("stratos")
    problem = design_problem(bicycle, None, Options())
    exact = problem.values["trail"].fraction
    assert exact == Fraction("0.0563") != Fraction(bicycle.trail)
    assert (problem.values["steer_axis_tilt"].fraction, problem.values["steer_axis_tilt"].pi) == (
        Fraction(169, 1800),
        1,
    )
    # The speed moves by less than a double can say if the trail is its double instead, and the balls do not meet.
    decimal = certify_design(bicycle, None, Options()).crossings[0].speed
    double = (
        certify_design(bicycle.replace(trail=float(Fraction("0.0563")) + 2**-54), None, Options()).crossings[0].speed
    )
    with precision(256):
        assert not flint.arb(decimal.middle, decimal.radius).overlaps(flint.arb(double.middle, double.radius))


@pytest.mark.parametrize(
    "over",
    [
        {"trail": ("55 mm", "57 mm")},
        {"trail": (0.056, 0.0565), "rider_mass": ("71 kg", "72 kg")},
        {"trail": ("55 mm", "57 mm"), "rider_mass": ("71.5 kg", "72.5 kg")},
    ],
)
def test_what_is_said_of_intervals_holds_for_designs_inside(over):
    bicycle, rider, options = load_bicycle("stratos"), load_rider("rider-a"), Options("leaned")
    certificate = certify_design(bicycle, rider, options, over)
    assert certificate.status == "certified"
    weave, capsize = (crossing.speed for crossing in certificate.crossings)
    rng = np.random.default_rng(1)
    speeds, corners = [], [0.0, 1.0]
    for share in [*corners, *rng.uniform(size=8)]:
        bounds = {name: design_problem(bicycle, rider, options, over).intervals[name] for name in over}
        inside = {name: float(low) + share * (float(high) - float(low)) for name, (low, high) in bounds.items()}
        own = bicycle.replace(**{name: value for name, value in inside.items() if name in bicycle.values()})
        other = rider.replace(**{name: value for name, value in inside.items() if name in rider.values()})
        found = critical_speeds(closed_form.coefficients(own, other.on(own), options))
        speeds.append((found.weave[0], found.capsize[0]))
    assert all(weave.contains(w, 1e-12) and capsize.contains(c, 1e-12) for w, c in speeds)
    # And is not much wider than it has to be.
    reached = max(w for w, _ in speeds) - min(w for w, _ in speeds)
    assert weave.width <= 1.1 * reached
    assert certificate.stable_ranges == [(each.start, each.stop) for each in certificate.ranges if each.unstable == 0]


def test_real_roots_that_add_up_to_zero_at_rest_are_no_doubt():
    """Between 70 and 72 kg two real roots to the right meet at rest: they are still two to the right."""
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    looked: list[int] = []
    over = {"rider_mass": ("70 kg", "72 kg")}
    certificate = certify_design(bicycle, rider, Options("leaned"), over, progress=looked.append)
    assert certificate.status == "certified"
    assert certificate.at_rest == (2, 2, 0, 0)
    assert [each.unstable for each in certificate.ranges] == [2, 0, 1]
    assert looked == sorted(looked)
    assert looked


@pytest.mark.parametrize(
    ("signs", "alternate"), [((1, -1, 1), True), ((-1, 1), True), ((1, 0, 1), False), ((1, 1), False)]
)
def test_signs_that_alternate(signs, alternate):
    assert alternates(signs) is alternate


def test_too_few_boxes_leave_the_rest_undecided():
    bicycle, rider = load_bicycle("stratos"), load_rider("rider-a")
    certificate = certify_design(bicycle, rider, Options("leaned"), {"trail": ("30 mm", "90 mm")}, most_boxes=3)
    assert certificate.status != "certified"
    model = closed_form.coefficients(bicycle.replace(trail=0.03), rider.on(bicycle), Options("leaned"))
    for each in certificate.ranges:
        middle = (each.start + min(each.stop, 50.0)) / 2
        assert (eigenvalues(model, middle).real > 0).sum() == each.unstable


def test_eigenvalues_in_balls():
    bicycle, rider, options = load_bicycle("stratos"), load_rider("rider-a"), Options("leaned")
    (at_six,) = eigenvalue_balls(design_problem(bicycle, rider, options), [6.0])
    computed = eigenvalues(closed_form.coefficients(bicycle, rider, options), 6.0)
    for root in computed.ravel():
        assert any(
            each.real.contains(root.real, 1e-10) and each.imaginary.contains(root.imag, 1e-10) for each in at_six
        )
    assert all(float(each.real.radius) < 1e-20 for each in at_six)


def test_the_python_way():
    model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), posture="leaned")
    assert model.critical_speeds(certify=True, over={"trail": ("55.9 mm", "56 mm")}).status == "certified"
    changed = replace(model, C0=np.eye(2))  # is no longer the bicycle's
    assert "M" in next(iter(changed.critical_speeds(certify=True).parameters))
    with pytest.raises(InputError, match="needs a model of a bicycle"):
        changed.critical_speeds(certify=True, over={"trail": (0.05, 0.06)})
    with pytest.raises(InputError, match="needs certify=True"):
        model.critical_speeds(over={"trail": (0.05, 0.06)})
    batch = coefficients(load_bicycle("benchmark").replace(trail=np.array([0.06, 0.08])))
    with pytest.raises(InputError, match="batch of shape"):
        batch.critical_speeds(certify=True)
    with pytest.raises(InputError, match="batch of shape"):
        replace(batch).critical_speeds(certify=True)


@pytest.mark.parametrize(
    ("over", "message"),
    [
        ({"trial": (0.05, 0.06)}, "trail"),
        ({"trail": ("57 mm", "55 mm")}, "must go from less to more"),
        ({"trail": "55 mm"}, "two bounds"),
        ({"trail": ("55 kg", "57 mm")}, "no length"),
    ],
)
def test_intervals_refused(over, message):
    with pytest.raises(InputError, match=message):
        certify_design(load_bicycle("benchmark"), None, Options(), over)


FUNCTIONS = {
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "exp": np.exp,
    "log": np.log,
    "abs": np.abs,
    "neg": np.negative,
}
PAIRS = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "atan2": np.arctan2,
    "max": np.maximum,
    "min": np.minimum,
}


@pytest.mark.parametrize("name", [*FUNCTIONS, *PAIRS])
def test_operations_enclose_values_and_slopes(name):
    function = {**FUNCTIONS, **PAIRS}[name]
    for place in (0.3, 0.62):
        half = flint.arb(0, 0.01)
        x = Centred(Dual(flint.arb(place, 0.01), (flint.arb(1),)), flint.arb(place))
        y = Centred(Dual(flint.arb(0.5) - x.dual.value, (flint.arb(-1),)), flint.arb(0.5) - place)
        arguments = (x,) if name in FUNCTIONS else (x, y)
        found = centred_operations([half])[name](*arguments)
        for at in np.linspace(place - 0.0099, place + 0.0099, 9):

            def of(t):
                return function(t) if name in FUNCTIONS else function(t, 0.5 - t)

            assert found.dual.value.contains(flint.arb(of(at), 1e-12)) or found.dual.value.overlaps(
                flint.arb(of(at), 1e-12)
            )
            assert found.dual.slopes[0].overlaps(flint.arb((of(at + 1e-6) - of(at - 1e-6)) / 2e-6, 1e-6))


def test_branches_that_cannot_be_told_apart_know_no_slope():
    operations = centred_operations([flint.arb(0, 1)])
    x = Centred(Dual(flint.arb(0, 1), (flint.arb(1),)), flint.arb(0))
    zero = Centred(Dual(flint.arb(0), (flint.arb(0),)), flint.arb(0))
    condition = operations["gt"](x, zero)
    chosen = operations["select"](condition, zero, x)
    assert condition is None
    assert chosen.dual.slopes[0].is_nan()
    assert operations["and"](condition, operations["lt"](x, x)) is not True
    assert operations["not"](operations["or"](condition, not False)) is False


@pytest.mark.parametrize("value", [0.1, 12.0, 1e-3, np.pi, 2 * np.pi, np.pi - 2, 1 / 3, 0.7071067811865475])
def test_constants_stand_for_what_they_were_made_from(value):
    assert constant_ball(value).overlaps(flint.arb(value, 1e-15 * value))
    with precision(128):
        assert (float(constant_ball(value).rad()) < 1e-30) == (value not in {1 / 3, 0.7071067811865475})


def test_digits_are_those_that_are_proven():
    assert Ball(4.2923825363411015, 4.2923825363411025).digits() == "4.29238253634"
    assert Ball(5.98507, 5.99719).digits() == "5.985 … 5.9972"
    assert Ball(6.0, float("inf")).digits() == "beyond 6"
