"""Masses given their sum, and bodies from components: against closed forms."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from singletrack import InputError, OddityWarning, catalogue
from singletrack.catalogue.geometry import resolve
from singletrack.catalogue.masses import Prior, Weighing, sample_masses
from singletrack.catalogue.points import points_of
from singletrack.catalogue.shapes import assemble, place, wheel_inertias
from singletrack.catalogue.sheet import Sheet
from singletrack.catalogue.tables import components, entries, sources

BASE = {"head_angle": "70 deg", "fork_offset": "50 mm", "wheel_size": "37-622", "wheel_base": "1.08 m"}


def prior(mean, own, common=None, parts=None, probability=None):
    count = len(mean)
    return Prior(
        tuple("abcdef"[:count]),
        np.array(mean),
        np.array(own),
        np.array(common or [0.0] * count),
        tuple(parts or [""] * count),
        ("",) * count,
        ("",) * count,
        np.array(probability or [1.0] * count),
    )


def test_gaussian_masses_given_their_sum():
    """Mean and covariance of a Gaussian given a sum: m + C1 (M - 1m)/(1C1), C - C1 1C/(1C1)."""
    known = prior([2.0, 3.0, 5.0], [0.1, 0.2, 0.3], [0.2, 0.3, 0.0], ["frame", "frame", ""])
    masses, odd = sample_masses(known, [Weighing("all", np.arange(3), 10.5)], 40_000, np.random.default_rng(1))
    covariance = known.covariance()
    along = covariance.sum(1)
    np.testing.assert_allclose(masses.sum(1), 10.5, atol=1e-9)
    np.testing.assert_allclose(masses.mean(0), known.mean + along * 0.5 / along.sum(), atol=0.005)
    np.testing.assert_allclose(np.cov(masses.T), covariance - np.outer(along, along) / along.sum(), atol=0.002)
    assert odd == []


def test_what_may_be_there_given_the_sum():
    """Bayes: odds of presence times the ratio of the densities of the weighed sum."""
    known = prior([2.0, 0.5], [0.2, 0.1], probability=[1.0, 0.5])
    masses, _ = sample_masses(known, [Weighing("all", np.arange(2), 2.2)], 20_000, np.random.default_rng(2))

    def density(mean, variance):
        return np.exp(-((2.2 - mean) ** 2) / (2 * variance)) / np.sqrt(variance)

    covariance = known.covariance()
    there, not_there = density(2.5, covariance.sum()), density(2.0, covariance[0, 0])
    assert (masses[:, 1] > 0).mean() == pytest.approx(there / (there + not_there), abs=0.01)


def test_masses_are_never_negative_and_add_up():
    made = catalogue.estimate(400, **BASE, rear_wheel_mass="3 kg", total_mass="18 kg", parts={"saddle": "0.7 kg"})
    batch = made.sample
    total = sum(
        np.asarray(getattr(batch, f"{end}_mass")) for end in ("rear_frame", "front_frame", "rear_wheel", "front_wheel")
    )
    np.testing.assert_allclose(total, 18.0, atol=1e-6)
    assert made.masses["rear frame: saddle"] == pytest.approx((0.7, 0.0), abs=1e-6)
    assert not any(np.any(fault.bad) for fault in batch.faults())


def test_shapes_against_point_masses():
    """A rod, an arc and a lump as clouds of points have the same inertia."""
    points = {
        "a": np.array([[0.1, 0.02, -0.3]]),
        "b": np.array([[0.5, 0.06, -0.9]]),
        "hub": np.array([[1.0, 0.0, -0.35]]),
    }
    still, zero = np.zeros((1, 3)), np.zeros(1)
    along = (np.arange(4000) + 0.5) / 4000
    rod = points["a"] + along[:, None] * (points["b"] - points["a"])
    angles = np.radians(np.linspace(65, 210, 19))
    arc = np.stack([1.0 + 0.365 * np.cos(angles), 0.0 * angles, -0.35 - 0.365 * np.sin(angles)], 1)
    for shape, form, cloud in (
        ("rod", {"from": "a", "to": "b", "thick": 0.0}, rod),
        ("arc", {"about": "hub", "arc": [65, 210]}, arc),
    ):
        found = assemble([np.array([2.0])], [place(shape, form, points, still, zero)])
        centre = cloud.mean(0) * [1, 0, 1]
        x, y, z = (cloud - centre).T
        thick = 0.025**2 if shape == "arc" else 0.0
        expected = [
            2 * (y**2 + z**2 + thick).mean(),
            2 * (x**2 + z**2).mean(),
            2 * (x**2 + y**2 + thick).mean(),
            -2 * (x * z).mean(),
        ]
        np.testing.assert_allclose([float(e[0]) for e in (found.xx, found.yy, found.zz, found.xz)], expected, rtol=1e-6)
        np.testing.assert_allclose([found.x[0], found.z[0]], centre[[0, 2]], rtol=1e-9)


def test_a_hoop_and_a_disc():
    radii = {"hub": np.zeros(1), "bead": np.array([0.3]), "outside": np.array([0.34])}
    hoop = {"from": ["bead", 0.0], "to": ["bead", 0.0], "across": 0.0, "spread": 0.0}
    spokes = {"from": ["hub", 0.0], "to": ["bead", 0.0], "across": 0.02, "spread": 0.0}
    across, about = wheel_inertias([np.array([1.5])], [hoop], radii, np.zeros((1, 1)))
    assert (about[0], across[0]) == pytest.approx((1.5 * 0.09, 0.75 * 0.09))
    across, about = wheel_inertias([np.array([0.3])], [spokes], radii, np.zeros((1, 1)))
    assert (about[0], across[0]) == pytest.approx((0.3 * 0.03, 0.3 * 0.015 + 0.3 * 0.0004))


def test_every_component_has_a_source_and_fits_a_shape():
    names = {component.name for component in components()}
    assert len(names) > 40
    for component in components():
        assert component.form["source"], component.name
        assert (component.mass is None) != (component.tube is None), component.name


KINDS = ("published", "weighed", "dimensions", "judgement")


def test_every_source_says_of_which_kind_it_is():
    """And components name one that there is; numbers of documents name the document."""
    assert {component.form["source"] for component in components()} == set(sources())
    for key, text in sources().items():
        kind = text.partition(":")[0]
        assert set(kind.split(" and ")) <= set(KINDS), key
        assert re.search(r"\d", text), key
    typical = [entry for entry in entries().values() if entry.typical]
    assert all(entry.source.partition(":")[0] in KINDS for entry in typical)


def test_a_component_may_be_missing_where_its_kind_is():
    """Of one choice of two kinds: brake levers are on nine bars of ten of one kind, on none of the other."""
    made = replace(
        prior([1.0, 1.0, 1.0], [0.1, 0.1, 0.1], probability=[0.5, 0.5, 0.5]),
        choices=("bar", "bar", "bar"),
        kinds=("flat", "flat", "drop"),
        fitted=np.array([1.0, 0.9, 1.0]),
    )
    masses, _ = sample_masses(made, [Weighing("all", np.arange(3))], 20_000, np.random.default_rng(0))
    flat, levers, drop = (masses > 0).T
    assert not (flat & drop).any()
    assert not (levers & drop).any()
    assert levers[flat].mean() == pytest.approx(0.9, abs=0.01)


def test_brake_levers_are_there_on_any_bar_or_on_none():
    for bar in ("flat", "city"):
        some = catalogue.estimate(200, **BASE, bar=bar, with_parts=["brake levers"])
        none = catalogue.estimate(200, **BASE, bar=bar, without_parts=["brake levers"])
        assert some.masses["front frame: brake levers"][0] > 0.15
        assert "front frame: brake levers" not in none.masses
        assert none.bicycle.front_frame_inertia_xx < some.bicycle.front_frame_inertia_xx


def test_legs_that_slide_are_parallel_to_the_steer_axis():
    points = points_of(resolve(Sheet.of(BASE), lambda: np.zeros(2)))
    axis = points["steerer top"][0] - points["crown"][0]
    leg = points["crown ahead"][0] - points["front drop-out"][0]
    sin = abs(axis[0] * leg[2] - axis[2] * leg[0]) / np.hypot(axis[0], axis[2]) / np.hypot(leg[0], leg[2])
    assert sin < 0.03  # the drop-outs have a fifth of the offset
    assert points["crown ahead"][0, 0] > points["crown"][0, 0]


def test_more_that_is_known_leaves_less_uncertain():
    vague = catalogue.bicycle(**BASE).standard_deviations
    known = catalogue.bicycle(
        **BASE,
        rear_frame_mass=7.0,
        front_frame_mass=3.0,
        rear_wheel_mass=2.9,
        front_wheel_mass=2.2,
        stack="0.6 m",
        bar="city",
        bar_width="0.6 m",
    ).standard_deviations
    for name in ("front_frame_z", "front_frame_inertia_xx", "rear_frame_inertia_zz", "rear_frame_inertia_xx"):
        assert known[name] < vague[name], name
    assert "rear_frame_mass" not in known


def test_a_load_is_where_it_is_said_to_be():
    """Ten kilograms more on the carrier move the centre of mass as a point mass would."""
    bare = catalogue.bicycle(**BASE, rear_frame_mass=7.0)
    box = {"name": "box", "mass": "10 kg", "x": "-0.1 m", "z": "-0.8 m", "length": 0.0, "width": 0.0, "height": 0.0}
    full = catalogue.bicycle(**BASE, rear_frame_mass=17.0, loads=[box])
    assert float(full.rear_frame_x) == pytest.approx((7 * float(bare.rear_frame_x) - 1.0) / 17, abs=0.004)
    assert float(full.rear_frame_z) == pytest.approx((7 * float(bare.rear_frame_z) - 8.0) / 17, abs=0.004)


@pytest.mark.parametrize(
    ("entries", "text"),
    [
        ({"front_frame_mass": "11 kg"}, "usually weigh"),
        ({"total_mass": "9 kg", "rear_frame_mass": "10 kg"}, "contradicts"),
        (
            {
                "total_mass": 20,
                "rear_frame_mass": 7,
                "front_frame_mass": 3,
                "rear_wheel_mass": 3,
                "front_wheel_mass": 2,
            },
            "contradicts.*20.000.*15.000",
        ),
        ({"parts": {"sadle": 0.5}}, "did you mean saddle"),
        ({"parts": {"bar": 0.5}}, "of which kind"),
        ({"parts": {"tyre": 0.5}}, "both wheels"),
        ({"with_parts": ["carier"]}, "did you mean carrier"),
        ({"with_parts": ["carrier"], "without_parts": ["carrier"]}, "both in"),
        ({"loads": [{"mass": 3}]}, "lacks x, z"),
        ({"loads": [{"mass": 3, "x": 0, "z": -1, "on": "roof"}]}, "unknown assembly"),
        ({"loads": [{"mass": 3, "x": 0, "z": 0.8}]}, "heights are negative"),
        ({"loads": [{"mass": 3, "x": 0, "z": "nan m"}]}, "heights are negative"),
        ({"loads": [{"mass": 3, "x": 0, "z": -1, "length": -1}]}, "length = -1, must be from 0 to 5 m"),
        ({"loads": [{"mass": 0, "x": 0, "z": -1}]}, "greater than zero"),
    ],
)
def test_what_is_wrong_with_masses_is_told(entries, text):
    with pytest.raises(InputError, match=text):
        catalogue.bicycle(**BASE, **entries)


def test_a_load_weighs_what_is_told():
    """Whatever the rest weighs: a battery on the scale is not light because the bicycle is."""
    battery = {"name": "battery", "mass": "2.8 kg", "x": "0.1 m", "z": "-0.75 m"}
    for total in ("16 kg", "24 kg"):
        made = catalogue.estimate(200, **BASE, total_mass=total, loads=[battery])
        assert made.masses["rear frame: battery"] == pytest.approx((2.8, 0.0), abs=1e-4)


def test_an_odd_mass_is_said():
    with pytest.warns(OddityWarning, match="rear_frame_mass = 12.000 kg is odd"):
        catalogue.bicycle(**BASE, rear_frame_mass="12 kg")


def test_the_same_sheet_gives_the_same_bicycle():
    assert catalogue.bicycle(**BASE).values() == catalogue.bicycle(**BASE).values()
