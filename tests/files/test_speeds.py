"""Forward speeds as text."""

import numpy as np
import pytest

from singletrack import InputError, coefficients, load_bicycle
from singletrack.files.speeds import parse_speeds
from singletrack.linear import modes


@pytest.mark.parametrize(
    ("text", "speeds"),
    [
        ("0:10:5", [0, 2.5, 5, 7.5, 10]),
        ("4.6", [4.6]),
        ("18 km/h", [5]),
        ("4, 6, 8", [4, 6, 8]),
        ("4,6,8", [4, 6, 8]),
        ("7.2 km/h, 3 m/s, 360 m/min", [2, 3, 6]),
        ("18 km/h:36km/h:2", [5, 10]),
        (" 0 : 1e1 : 2 ", [0, 10]),
        ("8, 4", [8, 4]),
    ],
)
def test_ranges_lists_and_units(text, speeds):
    np.testing.assert_allclose(parse_speeds(text), speeds, rtol=1e-15)


def test_ranges_in_other_units_are_even():
    np.testing.assert_allclose(np.diff(parse_speeds("5 km/h:40 km/h:8")), 5 / 3.6)


@pytest.mark.parametrize(
    "text",
    [
        *("", " ", ":", "1:2", "1:2:3:4", "2:1:5", "1:1:5", "0:10:1", "0:10:-3", "0:10:1e3", "0:10:2000000"),
        *("0:10:1_0", "1_0", "nan", "inf", "0:inf:5", "1e400", "4,", ",4", "4,,6", "x", "4 kg", "0:10 kg:5", "0x10"),
        *("৪.৪", "0:৪:5", "0:10:٣", "½", "4 +/- 1", "9" * 400, "1" * 100_000, "1:" * 50_000, "4 m**9**9**9", "ınf"),
    ],
    ids=lambda text: text[:12] or "empty",
)
def test_what_is_no_speed_is_refused_in_one_short_sentence(text):
    with pytest.raises(InputError, match=r"^--speeds") as refusal:
        parse_speeds(text)
    assert len(str(refusal.value)) < 500
    assert refusal.value.parameters == ("speeds",)


@pytest.mark.parametrize("text", ["-1", "-1:5:3", "4, -6", "-0.5 km/h"])
def test_negative_speeds_are_refused_as_in_python(text):
    with pytest.raises(InputError) as typed:
        parse_speeds(text)
    value = str(typed.value).split("found ")[1].split(" m/s")[0]
    with pytest.raises(InputError) as computed:
        modes(coefficients(load_bicycle("benchmark")), [float(value)])
    assert str(typed.value).removeprefix("--speeds") == str(computed.value).removeprefix("speeds")
