"""Throw mutated files at a reader, in a process of its own: `python mutations.py READER COUNT SEED FOLDER`.

Prints JSON: how many files were read, how many refused, messages that are not good enough, and the memory used on top
of what the process had before the first file. Anything but a record or a refusal ends the process with a traceback.
"""

import json
import random
import re
import resource
import sys
import warnings
from pathlib import Path

from singletrack import load_bicycle, load_rider
from singletrack.errors import InputError
from singletrack.files.parameter_sets import write_parameter_set
from singletrack.files.signals import read_signal
from singletrack.files.source import read_text
from singletrack.files.text import write_bicycle_text
from singletrack.files.toml_read import parse_record
from singletrack.files.toml_write import write_toml
from singletrack.files.yeadon import MEASUREMENTS, read_configuration
from singletrack.library.load import load_any
from singletrack.measuring.oscillation import fit_oscillation
from singletrack.parameters.record import Record

BAD_NUMBERS = (
    *("nan", "NaN", "inf", "-inf", "-1", "0", "-0.0", "1e308", "1e-308", "1e400", "9" * 400, "0x10", "1_000", "1,5"),
    *("", "--3", "1e", "..", "true", "null", "~", "1 2", "٣", "½", "1.0+/-nan", "1.0+/--1", "1.0+/-1e300"),
)
UNITS = ("m", "mm", "kg", "deg", "rad", "s", "kg*m^2", "m/s^2", "furlong", "m**9**9**9", "%", "°", "1/m", "", "kg/")
# What a refusal of the file as a whole says; every other refusal names a line.
WHOLE = re.compile(
    r"lacks |holds only |is empty|has no \[parameters\]|looks like|is larger than|characters, must have"
    r"|end of document|nested too deeply|make no body|holds .* periods|explains .* of the signal|does not change"
    r"|has \(\d*,\) times|time does not increase|not finite \(or beyond"
)


def raw_measurements():
    """Periods of an imagined bicycle: lines through (0.3, -0.5) and (0.9, -0.7), round numbers elsewhere."""
    text = """
        w=1.0 gamma=72.0 f=0.05 g=9.81 mP=5.0 lP=1.0 dP=0.03 TtP1=2.0 dR=28.0 nR=13 mR=3.0 lR=0.29 TcR1=1.33
        TtR1=0.9 hbb=0.29 lcs=0.45 dF=28.0 nF=13 mF=2.5 lF=0.29 TcF1=1.35 TtF1=0.9 whb=0.58 lamst=1.2 mB=8.0
        TcB1=1.5 alphaB1=10.0 aB1=0.06 TtB1=1.9 alphaB2=130.0 aB2=0.15 TtB2=1.8 alphaB3=230.0 aB3=-0.29
        TtB3=1.6 mH=3.0 TcH1=1.5 alphaH1=350.0 aH1=0.43 TtH1=1.2 alphaH2=30.0 aH2=0.31 TtH2=1.1
        alphaH3=290.0 aH3=0.28 TtH3=0.9 lst=0.5 lsp=0.2 LhbR=1.05 LhbF=0.7
    """
    values = dict(pair.split("=") for pair in text.split())
    return "# raw\n" + "\n".join(f"{name} = {value}+/-0.001" for name, value in values.items()) + "\n"


def yeadon_measurements():
    """A body of round numbers, in cm."""
    trunk = {"L": [18, 28, 39, 50, 55, 15, 21, 31], "p": [97, 86, 84, 90, 38, 53, 60], "w": [35, 32, 30, 30, 35]}
    arm = {"L": [30, 35, 56, 5, 8, 15], "p": [33, 29, 28, 28, 17, 24, 23, 12], "w": [6, 10, 9, 5]}
    leg = {"L": [6, 45, 56, 88, 5, 15, 22], "p": [61, 58, 39, 36, 25, 34, 25, 24, 21], "w": [10, 9], "d": [12]}
    lists = {"s": {**trunk, "d": [22]}, "a": arm, "b": arm, "j": leg, "k": leg}
    rest = {limb: {kind: list(values) for kind, values in kinds.items()} for limb, kinds in lists.items()}
    lines = ["measurementconversionfactor: 0.01", "totalmass: 80 # with shoes"]
    lines += [f"{name}: {rest[name[1]][name[3]].pop(0)}" for name in MEASUREMENTS]
    return "\n".join(lines) + "\n"


def signal():
    import math

    rows = [
        f"{0.05 * i:.2f},{math.exp(-0.01 * i) * math.sin(0.4 * i) + 0.01 * math.sin(7 * i):.6f}" for i in range(120)
    ]
    return "time,rate\n" + "\n".join(rows) + "\n"


def _configuration(path):
    read_configuration(read_text(path), str(path))


def _signal(path):
    fit_oscillation(*read_signal(read_text(path), str(path)), str(path))


def readers():
    stratos = load_bicycle("stratos").replace(standard_deviations={"trail": 0.0016, "steer_axis_tilt": 0.003})
    angles = "somersault: 0.175\ntilt: 0.0\ntwist: 0.0\nCA1extension: 0.0\nJ1J2flexion: 0.0\n"
    return {
        "toml bicycle": (".toml", write_toml(stratos), load_bicycle),
        "toml rider": (".toml", write_toml(load_rider("rider-a")), load_rider),
        "text": (".txt", write_bicycle_text(stratos), load_bicycle),
        "measured": (".txt", raw_measurements(), load_bicycle),
        "yaml benchmark": (".yml", write_parameter_set(stratos), load_bicycle),
        "yaml principal": (".yml", write_parameter_set(stratos, "principal"), load_bicycle),
        "yeadon": (".txt", yeadon_measurements(), load_rider),
        "configuration": (".txt", angles, _configuration),
        "signal": (".csv", signal(), _signal),
        "any": ("", write_toml(stratos), load_any),
    }


def _flip(rng, data):
    out = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        out[rng.randrange(len(out))] = rng.randrange(256)
    return bytes(out)


def _cut(rng, data):
    lines = data.split(b"\n")
    start = rng.randrange(len(lines))
    del lines[start : start + rng.randint(1, 4)]
    return b"\n".join(lines)


def _repeat_line(rng, data):
    lines = data.split(b"\n")
    lines.insert(rng.randrange(len(lines)), rng.choice(lines))
    return b"\n".join(lines)


def _number(rng, data):
    places = list(re.finditer(rb"\d+\.?\d*(e-?\d+)?", data))
    place = rng.choice(places)
    return data[: place.start()] + rng.choice(BAD_NUMBERS).encode() + data[place.end() :]


def _unit(rng, data):
    places = list(re.finditer(rb"(?<=\d) (m/s\^2|kg\*m\^2|deg|kg|m)\b|(?<=\d)(?=\s*(\+/-|#|$|\n))", data))
    place = rng.choice(places or [re.match(b"", data)])
    return data[: place.start()] + b" " + rng.choice(UNITS).encode() + data[place.end() :]


def _truncate(rng, data):
    return data[: rng.randrange(len(data))]


def _shuffle(rng, data):
    lines = data.split(b"\n")
    rng.shuffle(lines)
    return b"\n".join(lines)


def _encode(rng, data):
    text = data.decode() + "# °\n"
    return rng.choice(
        [
            lambda: text.encode("utf-16"),
            lambda: text.encode("utf-32"),
            lambda: text.encode("latin-1", "replace"),
            lambda: b"\xef\xbb\xbf" + data,
            lambda: data.replace(b"\n", b"\r\n"),
            lambda: data.replace(b"\n", b"\r"),
            lambda: data.replace(b"\n", "\u2028".encode()),
        ]
    )()


def _monster(rng, data):
    return rng.choice(
        [
            lambda: b"",
            lambda: b"\n" * rng.randint(1, 5000),
            lambda: b"\0" * rng.randint(1, 5000),
            lambda: data * rng.randint(2, 400),
            lambda: data + b"[" * rng.randint(1, 50_000),
            lambda: b"{" * rng.randint(1, 5000),
            lambda: data + b"\nx: " + b"{a: " * rng.randint(1, 3000),
            lambda: b"a: &a [x]\n" + b"\n".join(b"b%d: [*a, *a, *a]" % i for i in range(300)),
            lambda: b"x = '" + b"y" * rng.randint(1, 900_000),
            lambda: b"9" * rng.randint(1, 900_000),
            lambda: rng.randbytes(rng.randint(1, 20_000)),
            lambda: data + b"\nw = " + b"9" * 5000,
            lambda: b"- " * rng.randint(1, 20_000),
            lambda: data.replace(b" = ", b" : ").replace(b": ", b" = "),
        ]
    )()


def _insert(rng, data):
    place = rng.randrange(len(data))
    piece = rng.choice(
        ["\u202e", "\ud7ff", "😀", "\x00", "\x0c", "\x85", "=", ":", "#", "'", '"', "\n", "&a ", "!!python/x "]
    )
    return data[:place] + piece.encode() + data[place:]


MUTATIONS = (_flip, _cut, _repeat_line, _number, _number, _unit, _unit, _truncate, _shuffle, _encode, _monster, _insert)


def main(reader, count, seed, folder):
    warnings.simplefilter("error")
    suffix, text, read = readers()[reader]
    rng = random.Random(seed)
    path = Path(folder) / f"mutated{suffix}"
    path.write_bytes(text.encode())
    read(path)  # the file itself is fine, and whatever is loaded late is loaded now
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    result = {"read": 0, "refused": 0, "poor": []}
    for _ in range(count):
        path.write_bytes(rng.choice(MUTATIONS)(rng, text.encode()))
        try:
            record = read(path)
            result["read"] += 1
            if isinstance(record, Record):  # what was read can be written and means the same
                again = parse_record(type(record), write_toml(record), "again.toml")
                assert again.values() == record.values()
                assert again.shape == ()
        except InputError as error:
            result["refused"] += 1
            message = str(error)
            located = re.search(r"line \d+", message) or WHOLE.search(message)
            if not message.startswith(str(path)) or not located or len(message) > 1500 or "\x1b" in message:
                result["poor"].append(message[:300])
    result["megabytes"] = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    sys.stdout.write(json.dumps(result))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])
