"""Files of both dialects are read, written back and refused by file, line, keyword and reason."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from singletrack import InputError, spacar
from singletrack.multibody.spacar.describe import KEYWORDS, REFUSED
from singletrack.multibody.spacar.statements import parse, write


def test_round_trip(slider_crank, robot):
    for text in (slider_crank, robot):
        source = parse(text)
        assert parse(write(source)).says() == source.says()
        again = spacar.read_text(write(source))
        once = spacar.read_text(text)
        assert again.description.elements.keys() == once.description.elements.keys()
        assert again.freedoms == once.freedoms


def test_dialects_are_told_apart(slider_crank, robot):
    assert parse(slider_crank).dialect == "delft"
    assert parse(robot).dialect == "twente"


def test_case_comments_blocks_and_end():
    text = "* a comment\nplTRUSS 1 1 2\r\nx 2 .3D1 4.\nEND\nGravity 0 -9.81\nEND\nEOF\nrubbish beyond the end\n"
    source = parse(text)
    assert [s.keyword for s in source.statements] == ["PLTRUSS", "X", "GRAVITY"]
    assert source.statements[1].numbers == (2.0, 3.0, 4.0)
    assert [s.block for s in source.statements] == [0, 0, 1]
    assert [s.line for s in source.statements] == [2, 3, 5]


def test_steps_and_time_have_opposite_orders_in_the_dialects():
    delft = spacar.read_text("PLTRUSS 1 1 2\nX 2 1 0\nTIMESTEP 100 5.0").description
    twente = spacar.read_text("PLTRUSS 1 1 2 % twente\nX 2 1 0\nTIMESTEP 5.0 100").description
    assert (delft.steps, delft.duration) == (twente.steps, twente.duration) == (100, 5.0)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("PLBELT 2 1 2 3 4", "belt"),
        ("SURFACE 1", "plane"),
        ("PLBAEM 2 1 2 3 4", "did you mean PLBEAM"),
        ("PLBEAM 1 1 2 3 4", "given twice"),
        ("PLBEAM 2 1 2 3", "must have a number, 4 nodes"),
        ("PLBEAM 2 2 1 3 4", "an angle in the plane to another element"),
        ("BEAM 2 1 12 13 14 0 1 0", "a position in the plane to another element"),
        ("PLBEAM 2 3 4 3 5", "names node 3 twice"),
        ("PLBEAM 2 1 4 5 6", "drawn at the same place"),
        ("HINGE 2 12 13", "no axis"),
        ("HINGE 2 12 13 0 0 0", "axis is zero"),
        ("BEAM 2 11 12 13 14 1 0 0\nX 13 1 0 0", "along the beam"),
        ("FIX 77", "no element names node 77"),
        ("FIX 1 3", "has 2 components"),
        ("DYNE 5 1", "there is no element 5"),
        ("DYNE 1 4", "has 3 components"),
        ("RLSE 1 2\nDYNE 1 2", "already calculated"),
        ("X 3 one 2", "must be a number"),
        ("X 3 1e999 2", "too large"),
        ("X 2 1 2", "an angle in the plane"),
        ("MASS 1 -1", "must not be negative"),
        ("MASS 1 1 2", "must have one number"),
        ("EMASS 1 -1", "must not be negative"),
        ("ESTIFF 1 1 2 3", "up to 2 constants"),
        ("FORCE 1 1 2 3", "must have 1 or 2 components"),
        ("TIMESTEP 1.5 5", "steps"),
        ("TIMESTEP 10 0", "time of 0"),
        ("EPSKIN 0", "must be positive"),
        ("ENHC 1 1 1 2", "no slip"),
        ("INPUTS 1 1 1\nINPUTS 1 1 2", "given twice"),
        ("LAMBDA 2 1 0 0 0", "coordinates"),
        ("=== ===", "must begin with a keyword"),
        ("WHEEL 2 11 12 13 0 1 0\nX 11 0 0 1\nX 13 0.1 0 0", "upright on the ground"),
    ],
)
def test_refusals_name_file_line_keyword_and_reason(line, reason):
    text = f"PLBEAM 1 1 2 3 4\nX 3 1 0\n{line}\n"
    with pytest.raises(InputError, match=reason) as error:
        spacar.read_text(text, "model.dat")
    assert str(error.value).startswith("model.dat, line ")
    assert any(str(error.value).startswith(f"model.dat, line {n}: ") for n in (3, 4))


def test_every_keyword_of_the_reference_is_known():
    table = """
        BEAM BEAMNL TRUSS HINGE BEARING PINBODY WHEEL PLBEAM PLBEAMNL PLTRUSS PLHINGE PLBEAR PLBELT PLWHEEL SURFACE
        X XY XYZ BETA LAMBDA FIX RLSE DYNE DYNX KINE KINX INPUTE INPUTX LINE ENHC XD XDD E ED EDD MASS XM EMASS ESTIFF
        EDAMP EDAMPP FORCE GRAVITY TORQUEL INPUTS OUTE OUTEP OUTX TIMESTEP EPSKIN EPSINT EPSIND HMAX
    """
    assert set(table.split()) <= {*KEYWORDS, *REFUSED}


def test_unreadable_files(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        spacar.read(tmp_path / "none.dat")
    with pytest.raises(InputError, match="is empty"):
        spacar.read_text("% nothing\n")
    (tmp_path / "binary.dat").write_bytes(bytes(range(256)))
    with pytest.raises(InputError, match="keyword"):
        spacar.read(tmp_path / "binary.dat")


def test_a_line_without_effect_is_remarked(robot):
    (remark,) = spacar.read_text(robot, "robot.dat").description.remarks
    assert ": INPUTE: component 1 of 11 is dynamic" in remark
    assert "no effect" in remark


def test_the_program_of_the_page_runs(capsys):
    page = Path(__file__).parents[3] / "docs" / "reference" / "spacar.md"
    (program,) = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    exec(compile(program, str(page), "exec"), {})  # noqa: S102  # our own page
    assert "dynamic: e 1 2, e 1 3" in capsys.readouterr().out


def test_every_keyword_is_on_the_page():
    page = (Path(__file__).parents[3] / "docs" / "reference" / "spacar.md").read_text(encoding="utf-8")
    for keyword in (*KEYWORDS, *REFUSED):
        assert re.search(rf"\b{keyword}\b", page), keyword
