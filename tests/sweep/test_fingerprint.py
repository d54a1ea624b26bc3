"""A changed study is another study: every field in turn, and the order of [vary]; the message says what changed."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

pytest.importorskip("zarr")

from singletrack import InputError, load_bicycle, load_rider
from singletrack.parameters import Bicycle, Rider
from singletrack.posture import Options
from singletrack.sweep import open_sweep, provenance, run_sweep
from singletrack.sweep.provenance import differences
from sweep_helpers import CHUNK, SMALL, chunks_of, interrupted, small_study

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from singletrack.sweep import Study


@pytest.fixture(autouse=True)
def small_chunks() -> Iterator[None]:
    with chunks_of(CHUNK):
        yield


@pytest.fixture
def study(tmp_path: Path) -> Study:
    return small_study(tmp_path)


def nudged(value: Any) -> Any:
    return np.nextafter(float(value), np.inf)


@pytest.mark.parametrize("name", list(load_bicycle("browser").values()))
def test_each_parameter_of_the_bicycle_to_its_last_bit(study: Study, name: str) -> None:
    bicycle = study.bicycle.replace(**{name: nudged(getattr(study.bicycle, name))})
    changed = dataclasses.replace(study, bicycle=bicycle)
    assert changed.fingerprint != study.fingerprint
    assert differences(study.to_dict(), changed.to_dict()).startswith(f"bicycle.{name} was ")


@pytest.mark.parametrize("name", list(load_rider("rider-a").on(load_bicycle("browser")).values()))
def test_each_parameter_of_the_rider_to_its_last_bit(study: Study, name: str) -> None:
    assert study.rider is not None
    rider = study.rider.replace(**{name: nudged(getattr(study.rider, name))})
    changed = dataclasses.replace(study, rider=rider)
    assert changed.fingerprint != study.fingerprint
    assert f"rider.{name} was " in differences(study.to_dict(), changed.to_dict())


def test_every_parameter_there_is_stands_in_the_description(study: Study) -> None:
    described = study.to_dict()
    assert study.rider is not None
    for record, part in ((study.bicycle, "bicycle"), (study.rider, "rider")):
        for name in type(record).descriptions():
            assert (getattr(record, name) is None) == (name not in described[part])
    assert set(described["options"]) == {field.name for field in dataclasses.fields(Options)}
    assert {Bicycle.kind, Rider.kind} == {"bicycle", "rider"}


@pytest.mark.parametrize(
    "options",
    [
        Options("leaned"),
        Options("upright", "abduction"),
        Options("leaned", arms="bent"),
        Options("upright", torso_lean=True),
        Options("upright", springs={"steer": 1.0}),
        Options("upright", springs={"steer": 2.0}),
        Options("upright", dampers={"steer": 1.0}),
    ],
)
def test_each_option_of_the_model(study: Study, options: Options) -> None:
    changed = dataclasses.replace(study, options=options)
    assert changed.fingerprint != study.fingerprint
    assert "options." in differences(study.to_dict(), changed.to_dict())


CHANGES = {
    'bicycle = "browser"': ('bicycle = "stratos"', "bicycle.name was"),
    'rider = "rider-a"\nposture = "upright"\n': ("", "rider is"),
    'posture = "upright"': ('posture = "leaned"', 'options.posture was "upright", is "leaned"'),
    "speeds = [2, 5]": ("speeds = [5, 2]", "speeds was [2.0, 5.0], is [5.0, 2.0]"),
    '"critical_speeds", ': ("", "keep was"),
    '"-200 mm"': ('"-201 mm"', "designs.vary.trail.numbers was"),
    "count = 5": ("count = 6", "designs.count was 20, is 24"),
    '"29 cm", "30 cm"': ('"30 cm", "29 cm"', "designs.vary.upper_arm_length.numbers was"),
}


@pytest.mark.parametrize("old", CHANGES)
def test_each_entry_of_the_file(study: Study, tmp_path: Path, old: str) -> None:
    new, said = CHANGES[old]
    text = SMALL.replace(old, new)
    assert text != SMALL
    if "rider-a" not in text:
        text = text[: text.index("upper_arm_length")]
        said = "rider was"
    changed = small_study(tmp_path, text)
    assert changed.fingerprint != study.fingerprint
    found = differences(study.to_dict(), changed.to_dict())
    assert said in found or "more" in found


def exchanged(text: str) -> str:
    head, _, vary = text.partition("[vary]\n")
    return head + "[vary]\n" + "\n".join(reversed(vary.strip().splitlines())) + "\n"


def test_the_order_of_vary_numbers_the_designs(study: Study, tmp_path: Path) -> None:
    output = tmp_path / "out.zarr"
    interrupted(study, output, CHUNK)
    turned = small_study(tmp_path, exchanged(SMALL))
    assert turned.designs.rows(0, 20).tolist() != study.designs.rows(0, 20)[:, ::-1].tolist()
    assert turned.fingerprint != study.fingerprint
    with pytest.raises(InputError, match=r'designs.order was \["trail", "upper_arm_length"\], is \["upper_arm'):
        run_sweep(turned, output, workers=1)
    run_sweep(study, output, workers=1)
    run_sweep(turned, tmp_path / "turned.zarr", workers=1)
    one, other = open_sweep(output), open_sweep(tmp_path / "turned.zarr")
    # Elsewhere in a batch the last bit may differ; in the same place of the same chunk it does not (test_kills.py).
    np.testing.assert_allclose(one.M.values, other.M.transpose(*one.M.dims).values, rtol=1e-12)


@pytest.mark.parametrize("name", ["singletrack", "numpy", "scipy"])
def test_another_version_does_not_go_on(study: Study, tmp_path: Path, monkeypatch: Any, name: str) -> None:
    output = tmp_path / "out.zarr"
    interrupted(study, output, CHUNK)
    others = {**provenance.programs(), name: "99.1"}
    monkeypatch.setattr("singletrack.sweep.study.programs", lambda: others)
    with pytest.raises(InputError, match=rf'programs.{name} was ".*", is "99.1"'):
        run_sweep(study, output, workers=1)


def test_another_size_of_chunks_does_not_go_on(study: Study, tmp_path: Path) -> None:
    output = tmp_path / "out.zarr"
    interrupted(study, output, CHUNK)
    with chunks_of(CHUNK + 1), pytest.raises(InputError, match=f"chunk was {CHUNK}, is {CHUNK + 1}"):
        run_sweep(study, output, workers=1)


def test_remarks_and_names_decide_no_number(study: Study, tmp_path: Path) -> None:
    text = "# a remark\n" + SMALL.replace('"small"', '"another"') + "\n"
    assert small_study(tmp_path, text).fingerprint == study.fingerprint
