"""Postures on the command line: listed, shown, and files to fill in."""

from __future__ import annotations

import pytest

from singletrack import InputError
from singletrack.commands import list as listing
from singletrack.commands import show
from singletrack.commands.model_options import ModelOptions
from singletrack.library import shipped
from singletrack.library.template import template
from singletrack.posture import is_posture


def test_all_shipped_postures_are_listed_and_shown(capsys):
    listing.run()
    listed = capsys.readouterr().out
    for name in shipped("posture"):
        assert f"  {name} " in listed
        show.run(name, ModelOptions())
        printed = capsys.readouterr().out
        assert "frame: " in printed
        assert "source: " in printed


def test_a_file_is_shown_with_its_laws_and_in_a_riders_numbers(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    text = template("posture").replace(
        'axis = "right elbow"', 'axis = "right elbow"\nstiffness = "20 N*m/rad"\ndamping = 3\npreload = 2', 1
    )
    path.write_text(text.replace('point = "left shoulder"', "point = { from = 22, to = 24, share = 0.1 }", 1))
    assert is_posture(path)
    show.run(str(path), ModelOptions(rider="rider-a"))
    printed = " ".join(capsys.readouterr().out.split())
    for words in (
        "posture mine",
        "stiffness 20 N m/rad, damping 3 N m s/rad, preload 2 N m",
        "0.1 from left shoulder to left elbow",
        "right grip on the link of right elbow is held to the handlebar",
        "[at (",
        "freedoms beside lean and steer: none",
    ):
        assert words in printed


def test_a_rider_known_on_no_shipped_bicycle(tmp_path):
    text = shipped("rider")["rider-a"].read_text(encoding="utf-8")
    angles = text[text.index("{ stratos") : text.index("}") + 1]
    (tmp_path / "me.toml").write_text(text.replace(angles, '{ mine = "70 deg" }'))
    with pytest.raises(InputError, match=r"upright: rider .* has a lean angle on no shipped bicycle"):
        show.run("upright", ModelOptions(rider=str(tmp_path / "me.toml")))


@pytest.mark.parametrize("name", ["stratos", "nothing", "x" * 5000, "a\0b"])
def test_what_is_no_posture(name):
    assert not is_posture(name)
