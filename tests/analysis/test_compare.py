"""Comparisons: numbers of each design, and differences whose uncertainty knows what is shared."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from singletrack import InputError, load_bicycle, load_rider
from singletrack.analysis.compare import compare
from singletrack.analysis.derivatives import derivatives_of
from singletrack.analysis.designs import Design
from singletrack.linear import critical_speeds, eigenvalues
from singletrack.multibody.bicycle.coefficients import coefficients as by_multibody


def measure(found, name):
    return next(one for one in found.measures if one.name == name)


def with_deviations(record, **deviations):
    return dataclasses.replace(record, standard_deviations=deviations)


def test_numbers_are_those_of_each_design():
    rider = load_rider("rider-a")
    designs = [
        Design.of(load_bicycle(name), rider, "leaned" if name == "stratos" else "rigid")
        for name in ("stratos", "browser")
    ]
    found = compare(designs, [4.0, 6.0])
    for place, design in enumerate(designs):
        own = critical_speeds(design.model())
        assert measure(found, "weave speed").values[place] == pytest.approx(own.weave[0])
        roots = eigenvalues(design.model(), 6.0)[0]
        pair = roots[roots.imag > 0][0]
        assert measure(found, "frequency of weave at 6 m/s").values[place] == pytest.approx(pair.imag / 2 / np.pi)
        assert measure(found, "damping ratio of weave at 6 m/s").values[place] == pytest.approx(-pair.real / abs(pair))
    names = [one.name for one in found.parameters]
    assert "trail" in names
    assert "gravity" not in names


def test_uncertainties_of_differences():
    one = with_deviations(load_bicycle("stratos"), trail=0.002)
    two = with_deviations(load_bicycle("browser"), trail=0.003)
    rider = with_deviations(load_rider("rider-a"), rider_mass=1.0)
    found = compare([Design.of(one, rider), Design.of(two, rider)])
    weave = measure(found, "weave speed")
    slopes = []
    for bicycle in (one, two):
        derivatives = derivatives_of(Design.of(bicycle, rider), ("trail", "rider_mass"))
        slopes.append(derivatives.critical_speeds(critical_speeds(derivatives.model).weave_speeds[:1], "weave")[0])
    assert weave.deviations == pytest.approx(
        [np.hypot(s[0] * d, s[1]) for s, d in zip(slopes, (0.002, 0.003), strict=True)]
    )
    own = np.hypot(slopes[0][0] * 0.002, slopes[1][0] * 0.003)
    assert weave.difference_deviations[0] == 0.0
    assert weave.difference_deviations[1] == pytest.approx(np.hypot(own, slopes[1][1] - slopes[0][1]))


def test_the_acceleration_index_is_the_torque_of_a_steady_turn():
    # By the other derivation: what is left of the equations when nothing changes.
    bicycle = load_bicycle("benchmark")
    found = compare([Design.of(bicycle), Design.of(bicycle.replace(trail=0.05))])
    model = by_multibody(bicycle)
    K = model.stiffness(5.0)
    steer = 0.01
    lean = -K[0, 1] * steer / K[0, 0]
    torque = K[1] @ [lean, steer]
    acceleration = 25.0 * steer * np.cos(bicycle.steer_axis_tilt) / bicycle.wheel_base
    assert measure(found, "acceleration index at 5 m/s").values[0] == pytest.approx(torque / acceleration, rel=1e-6)


def test_what_does_not_exist_is_none_and_one_is_no_comparison():
    designs = [Design.of(load_bicycle("benchmark")), Design.of(load_bicycle("benchmark").replace(trail=-0.05))]
    found = compare(designs)
    assert np.isnan(measure(found, "weave speed").values).any()
    assert found.titles == ("benchmark", "benchmark")
    assert found.to_dict()["measures"][0]["values"].count(None) == 1
    with pytest.raises(InputError, match="two or more"):
        compare(designs[:1])
