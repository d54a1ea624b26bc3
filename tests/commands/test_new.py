"""``singletrack new``: sheet or options in, our file out, what is wrong told with its line."""

from __future__ import annotations

import re
import sys

import pytest

from singletrack import load_bicycle
from singletrack.catalogue import read_sheet, sheet_template
from singletrack.catalogue.tables import entries
from singletrack.commands import app as cli

OPTIONS = [
    "new",
    "--head-angle",
    "70 deg",
    "--fork-offset",
    "50 mm",
    "--wheel-size",
    "37-622",
    "--wheel-base",
    "1.08 m",
]


def main(arguments: list[str]) -> int:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["singletrack", *arguments])
        with pytest.raises(SystemExit) as stop:
            cli.main()
    return int(stop.value.code or 0)


def filled(text: str, **entries: str) -> str:
    for name, value in entries.items():
        text = re.sub(rf"^# {name} = .*$", f'{name} = "{value}"', text, flags=re.MULTILINE)
    return text


def test_options_give_a_file_that_reads_back(capsys, tmp_path):
    out = tmp_path / "mine.toml"
    assert main([*OPTIONS, "--name", "mine", "--front-frame-mass", "3 kg", "--with", "carrier", "-o", str(out)]) == 0
    assert re.search(r"weave speed +[0-9.]+ ± [0-9.]+ m/s", capsys.readouterr().out)
    bicycle = load_bicycle(out)
    assert bicycle.name == "mine"
    assert bicycle.front_frame_mass == pytest.approx(3.0)
    assert bicycle.standard_deviations["front_frame_inertia_zz"] > 0
    assert not bicycle.missing_geometry()
    # Every number is explained.
    lines = [line for line in out.read_text(encoding="utf-8").splitlines() if " = " in line and "kg*m^2" in line]
    assert len(lines) == 12
    assert all(";" in line.partition("#")[2] for line in lines)
    assert "carrier" in out.read_text(encoding="utf-8")


def test_a_template_filled_in(capsys, tmp_path):
    assert main(["new", "--template"]) == 0
    text = capsys.readouterr().out
    sheet = tmp_path / "stadsfiets.toml"
    sheet.write_text(filled(text, head_angle="70 deg", trail="70 mm", wheel_size="37-622", wheel_base="1.08 m"))
    assert main(["new", str(sheet), "-o", str(tmp_path / "out.toml")]) == 0
    assert load_bicycle(tmp_path / "out.toml").name == "stadsfiets"


def test_every_line_of_the_template_is_read():
    text = re.sub(r"^# (?=[a-z_]+ = |\[)", "", sheet_template(), flags=re.MULTILINE)
    sheet = read_sheet(text, "template.toml")
    assert set(entries()) < set(sheet)
    assert sheet["loads"][0]["name"] == "battery"
    assert sheet["parts"] == {"saddle": "600 g"}


@pytest.mark.parametrize(
    ("entries", "text"),
    [
        ({"wheel_base": "10 kg"}, r"sheet.toml, line \d+: wheel_base = '10 kg' has a unit that is no length"),
        ({"fork_offset": "10 mm"}, r"sheet.toml, line \d+: trail contradicts itself: 70.0 mm .* 114.* mm"),
    ],
)
def test_errors_name_file_line_and_both_values(capsys, tmp_path, entries, text):
    sheet = tmp_path / "sheet.toml"
    known = {"head_angle": "70 deg", "trail": "70 mm", "wheel_size": "37-622", "wheel_base": "1.08 m"}
    sheet.write_text(filled(sheet_template(), **{**known, **entries}))
    out = tmp_path / "out.toml"
    assert main(["new", str(sheet), "-o", str(out)]) == 2
    assert re.search(text, capsys.readouterr().err)
    assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["new"], "--template"),
        ([*OPTIONS, "--part", "saddle"], "PART=MASS"),
        ([*OPTIONS, "--with", "wings"], "unknown part"),
        (["new", "nothing.toml"], "nothing.toml"),
    ],
)
def test_bad_input_is_one_message(capsys, arguments, text):
    assert main(arguments) == 2
    assert text in capsys.readouterr().err
