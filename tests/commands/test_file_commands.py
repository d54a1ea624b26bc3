"""The commands that concern files, as a user meets them."""

import json
import os
import runpy
from pathlib import Path

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle, load_rider
from singletrack.commands import convert, measure, period, schema, show, template
from singletrack.commands.model_options import ModelOptions
from singletrack.errors import OddityWarning

MUTATIONS = runpy.run_path(str(Path(__file__).parents[1] / "files" / "mutations.py"), run_name="m")


@pytest.fixture(autouse=True)
def _wide(monkeypatch):
    monkeypatch.setenv("COLUMNS", "160")


@pytest.fixture
def raw(tmp_path):
    path = tmp_path / "MyBikeMeasured.txt"
    path.write_text(MUTATIONS["raw_measurements"]())
    return path


@pytest.mark.parametrize("kind", ["bicycle", "rider", "measurements"])
def test_template_prints_and_writes_the_same(kind, tmp_path, capsys):
    template.run(kind)
    printed = capsys.readouterr().out
    template.run(kind, tmp_path / "new.toml")
    assert (tmp_path / "new.toml").read_text(encoding="utf-8") == printed


def test_schema_is_json(capsys):
    schema.run("rider")
    assert json.loads(capsys.readouterr().out)["title"] == "singletrack rider"


@pytest.mark.parametrize("name", ["benchmark", "stratos", "browser", "rider-a"])
def test_show_prints_every_parameter(name, capsys):
    show.run(name, ModelOptions())
    printed = capsys.readouterr().out
    record = load_rider(name) if name == "rider-a" else load_bicycle(name)
    assert all(parameter in printed for parameter in record.values())
    if name != "rider-a":
        weave = coefficients(record).critical_speeds().weave[0]
        assert f"weave speed     {weave:.3f} m/s" in printed
        assert "load on wheels" in printed


def test_show_with_a_rider_draws_and_gives_the_posture(capsys):
    show.run("stratos", ModelOptions(rider="rider-a", posture="leaned"))
    printed = capsys.readouterr().out
    assert "with rider-a, leaned" in printed
    assert "stable          5.99" in printed
    assert "⠁" in printed


def test_show_warns_of_odd_values_and_gives_deviations(tmp_path, capsys):
    path = tmp_path / "odd.toml"
    convert.run("stratos", path)
    path.write_text(path.read_text().replace('"0.0563 m"', '"-0.05 +/- 0.002 m"'))
    capsys.readouterr()
    with pytest.warns(OddityWarning, match="trail = -0.05 m is negative"):
        show.run(str(path), ModelOptions())
    printed = capsys.readouterr().out
    assert "± 0.002" in printed


def test_show_refuses_a_rider_on_a_rider():
    with pytest.raises(InputError, match="must be a bicycle to seat"):
        show.run("rider-a", ModelOptions(rider="rider-a"))


@pytest.mark.parametrize("suffix", [".toml", ".txt", ".yml"])
def test_convert_there_and_back(suffix, tmp_path):
    there, back = tmp_path / f"there{suffix}", tmp_path / "back.toml"
    convert.run("benchmark", there)
    convert.run(str(there), back)
    assert load_bicycle(back).values() == load_bicycle("benchmark").values()


def test_convert_puts_a_rigid_rider_on_a_bicycle(tmp_path):
    rider = tmp_path / "rider.txt"
    rider.write_text("mB = 72\nxB = 0.3\nzB = -1.1\nIBxx = 8\nIBxz = -1.9\nIByy = 8.1\nIBzz = 2.4\n")
    convert.run("browser", tmp_path / "both.toml", rigid_rider=rider)
    bare = load_bicycle("browser").rear_frame_mass
    assert load_bicycle(tmp_path / "both.toml").rear_frame_mass == pytest.approx(bare + 72)
    with pytest.raises(InputError, match="is a rider, must be a bicycle"):
        convert.run("rider-a", tmp_path / "no.toml", rigid_rider=rider)


def test_convert_takes_yeadons_measurements_with_a_configuration(tmp_path):
    pytest.importorskip("yeadon", reason="the optional package yeadon is not installed")
    measured, configuration = tmp_path / "MeYeadonMeas.txt", tmp_path / "cfg.txt"
    measured.write_text(MUTATIONS["yeadon_measurements"]())
    configuration.write_text("somersault: 0.2\n")
    convert.run(str(measured), tmp_path / "me.toml", configuration=configuration)
    rider = load_rider(tmp_path / "me.toml")
    assert rider.forward_lean_angle == pytest.approx(np.pi / 2 - 0.2)
    assert set(rider.shapes) == {"head", "torso", "upper_arm", "lower_arm", "upper_leg", "lower_leg"}


def test_convert_says_what_a_parameter_set_does_not_hold(tmp_path, capsys, raw):
    convert.run(str(raw), tmp_path / "set.yml")
    printed = capsys.readouterr().out
    assert "holds no standard deviations" in printed
    assert "seat_tube_angle" in printed
    assert "# +/- " in (tmp_path / "set.yml").read_text()


@pytest.mark.parametrize(
    ("source", "output", "says"),
    [
        ("stratos", "a.csv", "unknown suffix '.csv'"),
        ("rider-a", "a.yml", "holds no rider"),
        ("stratus", "a.toml", "did you mean stratos?"),
        ("stratos", "missing/\0/a.toml", "cannot be written"),
    ],
)
def test_convert_refuses_and_writes_nothing(source, output, says, tmp_path):
    with pytest.raises(InputError) as refusal:
        convert.run(source, tmp_path / output)
    assert says in str(refusal.value)
    assert list(tmp_path.iterdir()) in ([], [tmp_path / "missing"])


def test_convert_never_overwrites_its_source(tmp_path):
    path = tmp_path / "a.toml"
    convert.run("stratos", path)
    before = path.read_bytes()
    with pytest.raises(InputError, match="is the file to read"):
        convert.run(str(path), path)
    assert path.read_bytes() == before


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="folders cannot be made unwritable here")
def test_output_to_an_unwritable_folder_is_refused(tmp_path):
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(InputError, match="cannot be written"):
            convert.run("stratos", tmp_path / "a.toml")
    finally:
        tmp_path.chmod(0o700)


def test_measure_prints_all_parameters_and_writes(raw, tmp_path, capsys):
    output = tmp_path / "mine.toml"
    measure.run(raw, compare="stratos", output=output)
    printed = capsys.readouterr().out
    bicycle = load_bicycle(output)
    assert all(name in printed for name in bicycle.values())
    assert "agrees" in printed
    assert "weave speed" in printed
    assert bicycle.standard_deviations["trail"] > 0


@pytest.mark.parametrize("name", ["Stratos", "Browser"])
def test_measure_compares_with_the_shipped_bicycle_of_that_name(name, shared_data, capsys):
    measure.run(shared_data / "bicycles" / f"{name}Measured.txt")
    printed = " ".join(capsys.readouterr().out.split())
    assert "_radius: rounded" in printed
    assert "exchanged" in printed


def test_period_prints_and_plots(tmp_path, capsys):
    path = tmp_path / "swing.csv"
    t = np.linspace(0, 10, 500)
    np.savetxt(path, np.stack([t, np.exp(-0.02 * t) * np.sin(2 * np.pi * t / 1.6)], axis=-1), delimiter=",")
    period.run(path, tmp_path / "swing.png")
    assert "period: 1.6" in capsys.readouterr().out
    assert (tmp_path / "swing.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(InputError, match="unknown suffix"):
        period.run(path, tmp_path / "swing.docx")


@pytest.mark.parametrize("command", [measure.run, period.run])
def test_files_that_are_not_there_are_refused(command, tmp_path):
    with pytest.raises(InputError, match="there is no such file"):
        command(tmp_path / "nothing.txt")
