"""The command line, as a user runs it."""

from __future__ import annotations

import csv
import io
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from singletrack import coefficients, load_bicycle, load_rider
from singletrack.commands import app as cli


@pytest.fixture
def run(monkeypatch, capsys):
    """Run the command line in this process; return exit code, standard output, standard error."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["singletrack", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        captured = capsys.readouterr()
        return stop.value.code, captured.out, captured.err

    return run


def test_installed_command_without_arguments_helps():
    command = [str(Path(sys.executable).parent / "singletrack"), "--help"]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    for name in ("reproduce", "coefficients", "eigenvalues", "critical-speeds", "list", "show", "template"):
        assert name in result.stdout


def test_coefficients_json_has_every_digit(run):
    code, out, err = run("coefficients", "stratos", "--rider", "rider-a", "--posture", "leaned", "--json")
    assert (code, err) == (0, "")
    model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned")
    found = json.loads(out)
    assert list(found)[:5] == ["M", "C1", "K0", "K2", "gravity"]
    assert (found["coordinates"], found["inputs"]) == (["lean", "steer"], ["lean torque", "steer torque"])
    for name in ("M", "C1", "K0", "K2"):
        np.testing.assert_array_equal(found[name], getattr(model, name))


@pytest.mark.parametrize("command", ["coefficients", "eigenvalues", "critical-speeds"])
def test_engines_agree(run, command):
    arguments = [command, "browser", "--rider", "rider-a", "--posture", "upright", "--json", "--engine"]
    one, two = (json.loads(run(*arguments, engine)[1]) for engine in ("closed-form", "multibody"))
    assert one.keys() == two.keys()
    for crossing, other in zip(one.pop("crossings", []), two.pop("crossings", []), strict=True):
        assert crossing.pop("speed") == pytest.approx(other.pop("speed"), rel=1e-9)
        assert crossing == other
    for key in one:
        if key in {"modes", "coordinates", "inputs", "status"}:
            assert two[key] == one[key]
        else:
            np.testing.assert_allclose(two[key], one[key], rtol=1e-9, atol=1e-12)


def test_what_is_never_stable_says_what_falls(run):
    """The torso falls whatever the speed; the growth told is that of the eigenvalues."""
    arguments = ("critical-speeds", "stratos", "--rider", "rider-a", "--posture", "leaned", "--torso-lean")
    (found,) = json.loads(run(*arguments, "--json")[1])["unstable"]
    assert (found["mode"], found["oscillates"]) == ("torso lean", False)
    model = coefficients(load_bicycle("stratos"), load_rider("rider-a"), "leaned", torso_lean=True)
    largest = model.eigenvalues(np.linspace(0.1, 10.0, 100)).real.max(axis=-1)
    np.testing.assert_allclose(found["growth"], [largest.min(), largest.max()], rtol=1e-9)
    words = f"torso lean falls at every speed (+{largest.min():.2f} to +{largest.max():.2f} 1/s below 10 m/s)"
    assert words in " ".join(run(*arguments)[1].split())
    sprung = json.loads(run(*arguments, "--spring", "torso lean=2000 N*m/rad", "--json")[1])
    assert sprung["stable_ranges"]
    assert "unstable" not in sprung


def test_coefficients_table(run):
    code, out, _ = run("coefficients", "stratos", "--rider", "rider-a", "--posture", "leaned")
    assert code == 0
    assert f"{coefficients(load_bicycle('stratos'), load_rider('rider-a'), 'leaned').M[1, 1]:.6f}" in out
    assert "kg m²" in out


def test_shoulder_option(run):
    _, out, _ = run(
        "coefficients", "stratos", "--rider", "rider-a", "--posture", "leaned", "--shoulder", "axial", "--json"
    )
    assert f"{json.loads(out)['M'][1][1]:.4f}" == "0.7371"


def test_eigenvalues_json(run):
    code, out, _ = run("eigenvalues", "benchmark", "--speeds", "0:10:11", "--json")
    found = json.loads(out)
    assert code == 0
    assert found["speeds"] == list(range(11))
    assert found["modes"] == ["weave", "weave", "capsize", "castering"]
    assert np.shape(found["eigenvalues"]) == (11, 4, 2)


def test_eigenvalues_csv(run):
    code, out, _ = run("eigenvalues", "benchmark", "--speeds", "5", "--csv")
    (row,) = csv.DictReader(io.StringIO(out))
    assert code == 0
    assert float(row["capsize_real"]) == pytest.approx(-0.3228664290040887, rel=1e-12)


def test_eigenvalues_table(run):
    code, out, _ = run("eigenvalues", "benchmark", "--speeds", "4:6:3")
    assert code == 0
    assert "stable" in out
    assert "-0.775 ± 4.465i" in out


def test_critical_speeds(run):
    _, out, _ = run("critical-speeds", "benchmark", "--json")
    found = json.loads(out)
    assert found["stable_ranges"] == [[found["weave"][0], found["capsize"][0]]]
    _, out, _ = run("critical-speeds", "browser", "--rider", "rider-a", "--posture", "upright", "--json")
    assert json.loads(out) == {"weave": [], "capsize": [], "stable_ranges": []}
    _, out, _ = run("critical-speeds", "browser", "--rider", "rider-a", "--posture", "upright")
    assert out.count("never") == 3


def test_set_changes_bicycle_and_rider(run):
    _, out, _ = run(
        "coefficients", "stratos", "--rider", "rider-a", "--set", "steer_axis_tilt=18.5 deg", "--set",
        "rider_mass=60 kg", "--set", "forward_lean_angle=62 deg", "--json",
    )  # fmt: skip
    bicycle = load_bicycle("stratos").replace(steer_axis_tilt=np.radians(18.5))
    rider = load_rider("rider-a").replace(rider_mass=60.0, forward_lean_angle=np.radians(62.0))
    np.testing.assert_allclose(json.loads(out)["M"], coefficients(bicycle, rider).M, rtol=1e-14)


def test_list_show_template(run):
    _, out, _ = run("list")
    assert all(name in out for name in ("benchmark", "browser", "stratos", "rider-a"))
    _, out, _ = run("show", "stratos")
    assert "wheel_base" in out
    assert "16.9" in out
    _, out, _ = run("template", "rider")
    assert 'kind = "rider"' in out


STRATOS_FILE = Path(cli.__file__).parents[1] / "data" / "bicycles" / "stratos.toml"

BAD = {
    "NaN": (["coefficients", "stratos", "--set", "trail=nan"], ["--set", "trail", "nan", "finite"]),
    "negative mass": (["coefficients", "stratos", "--set", "rear_wheel_mass=-1 kg"], ["rear_wheel_mass", "-1", "zero"]),
    "tilt in radians meant as degrees": (
        ["coefficients", "stratos", "--set", "steer_axis_tilt=16.9"],
        ["steer_axis_tilt", "16.9", "0 and 90 deg"],
    ),
    "tilt in metres": (
        ["coefficients", "stratos", "--set", "steer_axis_tilt=16.9 mm"],
        ["steer_axis_tilt", "no angle"],
    ),
    "unreachable grip": (
        ["coefficients", "stratos", "--rider", "rider-a", "--posture", "upright", "--set", "lower_arm_length=0.2"],
        ["0.6067", "0.4800", "shoulder-grip"],
    ),
    "misspelt --set": (["coefficients", "stratos", "--set", "trial=0.05"], ["trial", "did you mean trail"]),
    "--set without value": (["coefficients", "stratos", "--set", "trail"], ["NAME=VALUE"]),
    "--set of a rider without rider": (["coefficients", "stratos", "--set", "rider_mass=3"], ["rider_mass", "--rider"]),
    "unknown bicycle": (["coefficients", "strato"], ["strato", "did you mean stratos", "benchmark"]),
    "unknown rider": (["coefficients", "stratos", "--rider", "rider-b"], ["rider-b", "rider-a"]),
    "unknown posture": (["coefficients", "stratos", "--posture", "sitting"], ["sitting", "rigid"]),
    "posture without rider": (["coefficients", "stratos", "--posture", "leaned"], ["leaned", "needs a rider"]),
    "unknown engine": (["coefficients", "stratos", "--engine", "foo"], ["--engine': 'foo' is not one of"]),
    "torso lean without rider": (["coefficients", "stratos", "--torso-lean"], ["needs a rider", "no torso lean"]),
    "spring of a rider without one": (
        ["coefficients", "stratos", "--spring", "hands=3 N/m"],
        ["a spring or damper at hands needs a rider", "allowed without one: one at steer"],
    ),
    "standstill on tyres": (
        ["eigenvalues", "stratos", "--tyres", "9000,500,0.1", "--speeds", "0,5"],
        ["speeds: found 0 m/s", "greater than zero on tyres"],
    ),
    "no folder of a sweep": (["sweep", "--check", "."], [".: is not a finished sweep"]),
    "impossible inertia": (
        ["coefficients", "stratos", "--set", "front_frame_inertia_xz=0.2"],
        ["front_frame_inertia", "no body's"],
    ),
    "no frame geometry": (
        ["coefficients", "benchmark", "--rider", "rider-a"],
        ["benchmark", "bottom_bracket_height", "stem_length"],
    ),
    "directory": (["coefficients", "/"], ["/", "is a directory"]),
    "odd speeds": (["eigenvalues", "stratos", "--speeds", "0:10"], ["--speeds", "START:STOP:COUNT"]),
    "speeds backwards": (["eigenvalues", "stratos", "--speeds", "10:0:5"], ["--speeds"]),
    "no speeds": (["eigenvalues", "stratos", "--speeds", "0:10:0"], ["--speeds"]),
    "infinite speed": (["eigenvalues", "stratos", "--speeds", "inf"], ["--speeds"]),
    "negative speed": (["eigenvalues", "stratos", "--speeds=-3"], ["--speeds"]),
    "word for speed": (["eigenvalues", "stratos", "--speeds", "fast"], ["fast", "--speeds"]),
    "json and csv": (["eigenvalues", "stratos", "--json", "--csv"], ["--json", "--csv"]),
    "unknown command": (["eigenvalue", "stratos"], ["eigenvalue"]),
    "unknown option": (["coefficients", "stratos", "--speed", "3"], ["--speed"]),
    "unknown kind": (["template", "car"], ["car"]),
    "unknown name to show": (["show", "strato"], ["did you mean stratos"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_one_message_and_exit_code_2(run, case):
    arguments, expected = BAD[case]
    code, out, err = run(*arguments)
    assert code == 2
    assert out == ""
    assert err.startswith("singletrack: ")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    for part in expected:
        assert part in err


BAD_FILES = {
    "empty": (b"", "is empty"),
    "binary": (bytes(range(256)), "line 2: is not UTF-8 text"),
    "broken": (b'kind = "bicycle"\n[parameters\n', "line 2"),
    "not a number": (STRATOS_FILE.read_bytes().replace(b'"1.037 m"', b'"long"'), "line 7: wheel_base"),
}


@pytest.mark.parametrize("case", BAD_FILES)
def test_bad_files_are_one_message_and_exit_code_2(run, tmp_path, case):
    content, expected = BAD_FILES[case]
    path = tmp_path / "mine.toml"
    path.write_bytes(content)
    for command in ("coefficients", "eigenvalues", "critical-speeds", "show"):
        code, out, err = run(command, str(path))
        assert (code, out) == (2, "")
        assert str(path) in err
        assert expected in err
        assert err.count("\n") == 1


def test_output_that_cannot_be_written(run, tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    for output in (blocked, blocked / "below", "/proc/none"):
        code, out, err = run("reproduce", "--output", str(output))
        assert (code, out) == (2, "")
        assert str(output) in err
        assert "cannot be used for output" in err
    assert blocked.read_text() == ""


def test_files_from_the_command_line(run, tmp_path):
    """Convert to another tool's text and back, then compute from it."""
    text, toml = tmp_path / "stratos.txt", tmp_path / "stratos.toml"
    assert run("convert", "stratos", str(text))[0] == 0
    assert run("convert", str(text), str(toml))[0] == 0
    _, out, _ = run("coefficients", str(toml), "--json")
    np.testing.assert_allclose(json.loads(out)["M"], coefficients(load_bicycle("stratos")).M, rtol=1e-14)
    code, out, _ = run("schema", "bicycle")
    assert code == 0
    assert json.loads(out)
    assert run("template", "measurements")[1]
    assert run("show", "stratos", "--rider", "rider-a", "--posture", "leaned")[0] == 0


def test_measure_and_period_from_the_command_line(run, tmp_path):
    shared = Path(__file__).parents[3] / "shared" / "data" / "bicycleparameters" / "bicycles" / "StratosMeasured.txt"
    if not shared.exists():
        pytest.skip("the measured Stratos lies outside the repository, in ../shared/data")
    code, out, _ = run("measure", str(shared), "--output", str(tmp_path / "mine.toml"))
    assert code == 0
    assert "rear_frame_inertia_xx" in out
    assert run("critical-speeds", str(tmp_path / "mine.toml"))[0] == 0
    signal = tmp_path / "swing.txt"
    time = np.linspace(0, 20, 2001)
    np.savetxt(signal, np.column_stack([time, np.exp(-0.02 * time) * np.cos(2 * np.pi * time / 1.7)]))
    code, out, _ = run("period", str(signal), "--plot", str(tmp_path / "fit.png"))
    assert code == 0
    assert out.startswith("period: 1.7")
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "arguments",
    [
        ["convert", "stratos", "out.docx"],
        ["convert", "nothing", "out.toml"],
        ["convert", "rider-a", "out.txt"],
        ["measure", "none.txt"],
        ["measure", "."],
        ["period", "none.txt"],
        ["schema", "car"],
    ],
    ids=" ".join,
)
def test_bad_files_for_the_file_commands(run, arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    assert err.startswith("singletrack: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_sweep_from_the_command_line(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    study = tmp_path / "trail.toml"
    study.write_text(
        'kind = "study"\nname = "trail"\nbicycle = "stratos"\nspeeds = "0:10:3"\nkeep = ["matrices"]\n'
        '[vary]\ntrail = { from = "50 mm", to = "60 mm", count = 3 }\n'
    )
    assert run("sweep", str(study), "--workers", "1")[0] == 0
    assert (tmp_path / "trail.zarr").is_dir()
    for wrong in (["none.toml"], ["."], [str(study), "--workers", "0"], [str(study), "--output", "/proc/none/x.zarr"]):
        code, out, err = run("sweep", *wrong)
        assert (code, out) == (2, "")
        assert "Traceback" not in err
        assert err.splitlines()[-1].startswith("singletrack: ")  # after the progress, if it had begun


def test_no_traceback_reaches_a_user(run, monkeypatch):
    def fail(_):
        raise ZeroDivisionError("what nobody thought of")

    monkeypatch.setattr("singletrack.commands.sheets.load_bicycle", fail)
    code, out, err = run("coefficients", "stratos")
    assert (code, out) == (1, "")
    assert "internal error, please report it: ZeroDivisionError: what nobody thought of" in err
    assert "Traceback" not in err


def test_what_does_not_differ_has_no_empty_table(run):
    _, out, _ = run("compare", "stratos", str(STRATOS_FILE))
    assert out.startswith("no parameter differs")


def test_a_stable_range_without_end_is_said_in_words(run):
    _, out, _ = run("compare", "stratos", "browser", "--set", "trail=60")
    assert "inf" not in out
    assert "stable above " in out
