"""The shipped programs are what the equations give, and what is not plainly sound goes to the equations for arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from singletrack import PostureError, SingletrackError, load_bicycle, load_rider
from singletrack.closed_form import coefficients
from singletrack.closed_form.coefficients import by_arrays
from singletrack.closed_form.programs import ASIDE, FOLDER, LEAN, program_named, program_of
from singletrack.closed_form.single import single_design
from singletrack.posture import Options

if TYPE_CHECKING:
    from singletrack import Bicycle, Rider

NAMES = sorted(path.stem for path in FOLDER.glob("*.txt"))
MATRICES = ("M", "C0", "C1", "S0", "K0", "K2")


def options_of(name: str, **more: Any) -> Options | None:
    return (
        None
        if name == "bicycle"
        else Options(name.removesuffix(LEAN).removesuffix(ASIDE), torso_lean=name.endswith(LEAN), **more)
    )


def pair(name: str) -> tuple[Bicycle, Rider | None]:
    bicycle = load_bicycle("browser" if "upright" in name else "stratos")
    return bicycle, None if name == "bicycle" else load_rider("rider-a").on(bicycle)


@pytest.mark.parametrize("name", NAMES)
def test_a_program_is_what_the_equations_give(name: str) -> None:
    pytest.importorskip("jax", reason="programs are traced by JAX, which is not installed")
    from singletrack.closed_form.generate import program_text, structures

    assert sorted(structures()) == NAMES
    assert program_text(name) == (FOLDER / f"{name}.txt").read_text(encoding="utf-8"), "run `make programs`"


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=8, deadline=None)
@given(seed=st.integers(0, 2**31))
def test_a_program_gives_the_matrices_of_the_equations_for_arrays(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    bicycle, rider = pair(name)
    # Inertias stay: most changes of one entry make them no body's. Leaned arms are nearly stretched.
    much = 10.0 ** rng.uniform(-4, -1.3)
    vary = {key: value for key, value in bicycle.values().items() if "inertia" not in key}
    bicycle = bicycle.replace(**{key: value * (1 + much * rng.uniform(-1, 1)) for key, value in vary.items()})
    if rng.random() < 0.5:
        bicycle = bicycle.replace(front_tyre_radius=0.02, handlebar_drop=0.03)
    if name.endswith(ASIDE) and rider is not None:
        # Either of the two sets the elbows free, or both.
        width, drop = ((0.45, None), (None, 1.3), (0.5, 1.4))[seed % 3]
        bicycle, rider = bicycle.replace(handlebar_width=width), rider.replace(elbow_drop_angle=drop)
    options = options_of(name)
    if rider is not None and options is not None:
        rider = rider.replace(
            **{key: value * (1 + 0.5 * much * rng.uniform(-1, 1)) for key, value in rider.values().items()}
        )
        joint = "torso lean" if options.torso_lean else "steer"
        sprung = {"springs": {joint: np.float64(3.0)}, "dampers": {"steer": 2}}
        options = Options(options.posture, torso_lean=options.torso_lean, **sprung)
    single = single_design(bicycle, rider, options or Options())
    try:
        expected = by_arrays(bicycle, rider, options or Options())
    except PostureError:
        assert single is None
        return
    assert single is not None
    assert (single.model.coordinates, single.model.inputs) == (expected.coordinates, expected.inputs)
    assert float(single.model.gravity) == expected.gravity
    for matrix in MATRICES:
        found, wanted = getattr(single.model, matrix), getattr(expected, matrix)
        np.testing.assert_allclose(found, wanted, rtol=0, atol=4e-15 * np.abs(wanted).max() + 1e-300, err_msg=matrix)


BROWSER = load_bicycle("browser")
RIDER = load_rider("rider-a").on(BROWSER)
ON_AXIS = {"trail": 0.0, "steer_axis_tilt": 0.0, "front_frame_x": BROWSER.wheel_base}
MASSLESS = {f"front_wheel_{what}": 0.0 for what in ("mass", "radius", "inertia_xx", "inertia_yy")}
MASSLESS |= {f"front_frame_inertia_{axes}": 0.0 for axes in ("xx", "yy", "zz", "xz")}
WRONG: dict[str, tuple[Bicycle, Rider | None, Options]] = {
    "arms too short": (BROWSER, RIDER.replace(lower_arm_length=0.1), Options("upright")),
    "arms too long": (BROWSER, RIDER.replace(lower_arm_length=0.05, upper_arm_length=0.9), Options("upright")),
    "legs too short": (BROWSER, RIDER.replace(lower_leg_length=0.1), Options("rigid")),
    "chain stay too short": (BROWSER.replace(chain_stay_length=0.001), RIDER, Options("leaned")),
    "fork too short": (BROWSER.replace(fork_length=0.001), RIDER, Options("leaned")),
    "no geometry": (BROWSER.replace(rear_hub_width=None), RIDER, Options("upright")),
    "no lean angle": (BROWSER.replace(name="other"), load_rider("rider-a"), Options("upright")),
    "a lean angle that is none": (
        BROWSER,
        RIDER.replace(forward_lean_angle=None, forward_lean_angles={"browser": 2.0}),
        Options("upright"),
    ),
    "no rider": (BROWSER, None, Options("upright")),
    "no rider to lean": (BROWSER, None, Options("rigid", torso_lean=True)),
    "no rider to fit": (BROWSER, None, Options("rigid", fit=2.0)),
    "a spring without rider": (BROWSER, None, Options("rigid", springs={"torso lean": 1.0})),
    "a spring at no joint": (BROWSER, RIDER, Options("upright", springs={"torso lean": 1.0})),
    "straight arms that cannot follow": (BROWSER, RIDER, Options("leaned", shoulder="axial", arms="straight")),
    "a steer that moves no mass": (BROWSER.replace(**ON_AXIS, **MASSLESS), None, Options()),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said_by_the_equations_for_arrays(name: str) -> None:
    bicycle, rider, options = WRONG[name]
    with pytest.raises(SingletrackError) as expected:
        by_arrays(bicycle, rider, options)
    with pytest.raises(type(expected.value)) as found:
        coefficients(bicycle, rider, options)
    assert str(found.value) == str(expected.value)


@pytest.mark.parametrize("posture", ["upright", "leaned"])
def test_limbs_at_the_end_of_their_reach_go_to_the_equations_for_arrays(posture: str) -> None:
    """On either side of the last place of a double, no design is let pass that the equations for arrays refuse."""
    bicycle, rider = pair(posture)
    assert rider is not None
    single = single_design(bicycle, rider, Options(posture))
    assert single is not None
    assert single.margins is not None
    span = single.margins.arm * (rider.upper_arm_length + rider.lower_arm_length)
    for length in (span - rider.upper_arm_length, rider.upper_arm_length - span):
        for steps in range(-3, 4):
            lower = float(length * (1 + steps * 2.3e-16))
            if lower <= 0:
                continue
            assert single_design(bicycle, rider.replace(lower_arm_length=lower), Options(posture)) is None


RARE: dict[str, tuple[Bicycle, Rider | None, Options]] = {
    "a batch": (BROWSER.replace(trail=[0.05, 0.06]), RIDER, Options("upright")),
    "a soft fork": (BROWSER.replace(fork_bending_stiffness=2e3), RIDER, Options("upright")),
    "a wide handlebar": (BROWSER.replace(handlebar_width=0.6), RIDER, Options("upright")),
    "elbows turned out": (BROWSER, RIDER.replace(elbow_drop_angle=1.0), Options("upright")),
    "a fitted rider": (BROWSER, RIDER, Options("upright", fit=2.5)),
    "one hand": (BROWSER, RIDER, Options("one-hand")),
    "a spring of a batch": (BROWSER, RIDER, Options("upright", springs={"steer": np.array([1.0, 2.0])})),
    "a spring at an arm": (BROWSER, RIDER, Options("upright", springs={"right elbow": 2.0})),
    "soft hands": (BROWSER, RIDER, Options("upright", springs={"hands": 2e3})),
    "a skate": (BROWSER.replace(front_wheel_radius=0.0, front_wheel_inertia_yy=0.0), None, Options()),
}


@pytest.mark.parametrize("name", RARE)
def test_what_is_rare_is_computed_all_the_same(name: str) -> None:
    bicycle, rider, options = RARE[name]
    model, expected = coefficients(bicycle, rider, options), by_arrays(bicycle, rider, options)
    for matrix in MATRICES:
        wanted = getattr(expected, matrix)
        np.testing.assert_allclose(getattr(model, matrix), wanted, rtol=0, atol=4e-15 * np.abs(wanted).max())


def test_there_is_no_program_of_a_name_that_is_none() -> None:
    assert program_named("no-such") is None
    assert program_of(BROWSER, RIDER, Options("moore-2012")) is None
    assert program_of(BROWSER, RIDER, Options("leaned", shoulder="axial", arms="straight")) is None


def test_a_program_serves_arrays_as_it_serves_numbers() -> None:
    program = program_of(BROWSER, RIDER, Options("upright"))
    assert program is not None
    values = BROWSER.values() | RIDER.values() | {"handlebar_drop": 0.0}
    values |= dict(zip(("torso_width", "torso_thickness"), RIDER.torso_section, strict=True))
    inputs = [values[name] for name in (*program.of_bicycle, *program.of_rider)]
    words = {name: getattr(np, name) for name in ("sqrt", "sin", "cos", "where", "maximum")}
    of_arrays = program.function(words)(*(np.full(3, value) for value in inputs))
    for one, other in zip(program.function()(*inputs), of_arrays, strict=True):
        np.testing.assert_allclose(other, one, rtol=1e-14, atol=1e-14)
