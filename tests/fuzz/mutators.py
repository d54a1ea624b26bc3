"""Changes of documents, entry by entry, and of the bytes they become. Every one takes a random generator first."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from documents import Document, Entry

if TYPE_CHECKING:
    import random

__all__ = ["BYTES", "STRUCTURE"]

NUMBERS = (
    *("nan", "NaN", "inf", "-inf", "-1", "0", "-0.0", "1e308", "1e-308", "5e-324", "1e400", "9" * 400, "0x10", "0b1"),
    *("1_000", "1,5", "", "--3", "1e", "..", "true", "null", "~", "1 2", "٣", "৪.৪", "½", "Ⅷ", "1.0+/-nan", "1/3"),
    *("1.0, 2.0", "10, 10, 13", "1,2,3", "1e5", "1e-5", "1.7976931348623157e308", "0.1e1", ".5", "5.", "+1", "1e+2"),
)
UNITS = (
    *(
        "m",
        "mm",
        "kg",
        "g",
        "deg",
        "rad",
        "s",
        "kg*m^2",
        "m/s^2",
        "N/kg",
        "in",
        "lb",
        "furlong",
        "m**9**9**9",
        "%",
        "°",
    ),
    *("1/m", "", "kg/", "m m", "(m)", "m^-3", "kg m^2", "µm", "Mg", "m·kg", "m\u00b2"),
)
OTHER_NAMES = (
    *(
        "w",
        "c",
        "lam",
        "mG",
        "IGxx",
        "xS",
        "trail",
        "wheel_base",
        "rider_mass",
        "head_angle",
        "kDaa",
        "TcB1",
        "alphaB4",
    ),
    *("Ls1L", "somersault", "parameters", "values", "kind", "name", "v", "h1", "nF", "gravity", "forward_lean_angle"),
)


def _some(rng: random.Random, document: Document) -> int:
    """Return the number of an entry that says something, mostly."""
    saying = [i for i, entry in enumerate(document.entries) if entry.name]
    return rng.choice(saying) if saying and rng.random() < 0.95 else rng.randrange(len(document.entries))


def _changed(document: Document, place: int, **changes: str) -> Document:
    entries = list(document.entries)
    entries[place] = replace(entries[place], raw=None, **changes)
    return document.with_entries(entries)


def strange_value(rng, document):
    return _changed(document, _some(rng, document), value=rng.choice(NUMBERS))


def scaled_value(rng, document):
    place = _some(rng, document)
    try:
        value = float(document.entries[place].value)
    except ValueError:
        return document
    factor = rng.choice([10.0 ** rng.randint(-40, 40), -1.0, 1000.0, 0.001, 57.29577951308232, 1 + rng.gauss(0, 0.5)])
    return _changed(document, place, value=repr(value * factor))


def all_scaled(rng, document):
    """Scale every value whose name starts alike: all masses, all moments, all lengths."""
    start = document.entries[_some(rng, document)].name[:1]
    factor = 10.0 ** rng.randint(-40, 40)
    entries = []
    for entry in document.entries:
        number = re.fullmatch(r"[-+.\de]+", entry.value)
        alike = number and entry.name.startswith(start) and entry.value not in {"-", "+", ".", "e"}
        try:
            entries.append(replace(entry, value=repr(float(entry.value) * factor)) if alike else entry)
        except ValueError:
            entries.append(entry)
    return document.with_entries(entries)


def swapped_values(rng, document):
    one, other = _some(rng, document), _some(rng, document)
    entries = list(document.entries)
    entries[one], entries[other] = (
        replace(entries[one], value=entries[other].value, raw=None),
        replace(entries[other], value=entries[one].value, raw=None),
    )
    return document.with_entries(entries)


def deviation(rng, document):
    return _changed(
        document, _some(rng, document), deviation=rng.choice(["0.1", "0", "-1", "nan", "1e300", "x", "1e-320"])
    )


def unit(rng, document):
    return _changed(document, _some(rng, document), unit=rng.choice(UNITS))


def removed(rng, document):
    entries = list(document.entries)
    start = rng.randrange(len(entries))
    del entries[start : start + rng.randint(1, 3)]
    return document.with_entries(entries or document.entries)


def repeated(rng, document):
    entries = list(document.entries)
    entries.insert(rng.randrange(len(entries) + 1), rng.choice(entries))
    return document.with_entries(entries)


def shuffled(rng, document):
    entries = list(document.entries)
    rng.shuffle(entries)
    return document.with_entries(entries)


def renamed(rng, document):
    place = _some(rng, document)
    name = document.entries[place].name
    at = rng.randrange(len(name) + 1) if name else 0
    new = rng.choice(
        [
            name[:at] + name[at + 1 :],
            name[:at] + rng.choice("abz_9Ié.") + name[at:],
            name.swapcase(),
            f'"{name}"',
            rng.choice(OTHER_NAMES),
            "x" * rng.choice([1, 100, 5000]),
            "",
        ]
    )
    return _changed(document, place, name=new)


def added(rng, document):
    entries = list(document.entries)
    new = Entry(rng.choice(OTHER_NAMES), rng.choice(["1.0", "0.5", *NUMBERS]))
    entries.insert(rng.randrange(len(entries) + 1), new)
    return document.with_entries(entries)


def split_fork(rng, document):
    """Give the front frame of a bicycle as a handlebar and a fork, more or less complete."""
    if document.syntax == "toml":
        return document
    kept = [entry for entry in document.entries if not re.fullmatch(r"[mxz]H|IH..", entry.name) or rng.random() < 0.3]
    values = {"m": "1.5", "x": "0.85", "z": "-0.8", "xx": "0.1", "yy": "0.09", "zz": "0.05", "xz": "-0.02"}
    names = [f"{q}{b}" if len(q) == 1 else f"I{b}{q}" for b in "GS" for q in values]
    parts = [Entry(name, values[re.sub(r"[IGS]", "", name)]) for name in names if rng.random() < 0.97]
    return document.with_entries([*kept, *parts])


def odd_line(rng, document):
    entries = list(document.entries)
    line = rng.choice(
        [
            *(
                "#" * 500,
                "= 1",
                ": 1",
                "[parameters]",
                "[segments.torso]",
                "[extras]",
                "[[a]]",
                "a.b.c = 1",
                "---",
                "...",
            ),
            *(
                'x = """',
                "x = '''",
                "x = [1, [2, [3]]]",
                "x = {a = {b = 1}}",
                "a: &b 1",
                "c: *b",
                "- 1",
                "? x",
                "!!int 1",
            ),
            *(
                "\t",
                "\x0c",
                "\u2028",
                "é = 1",
                "x = 1979-05-27",
                "x = 07:32:00",
                "x = true",
                "x = 0x" + "f" * 9000,
                "%YAML 1.1",
            ),
            *(
                ".".join("a" * rng.randint(2, 400)) + " = 1",
                "[" * rng.randint(1, 3000),
                "a: " + "{b: " * rng.randint(1, 500),
            ),
            *(" " * rng.randint(1, 50_000) + '"" = 5', "\n" * rng.randint(1, 50_000), "x = " + "1, " * 500 + "1"),
        ]
    )
    entries.insert(rng.randrange(len(entries) + 1), Entry(raw=line))
    return document.with_entries(entries)


def many(rng, document):
    count = rng.choice([10, 1000, 8000])
    return document.with_entries([*document.entries, *(Entry(f"x{i}", "1.0") for i in range(count))])


def ending(rng, document):
    return replace(document, ending=rng.choice(["\r\n", "\r", "\n\n", "\n# é\n", " \n", "\u2028", ", ", ":"]))


def unquoted(rng, document):
    return replace(document, quoted=False)


def around(rng, document):
    piece = rng.choice(
        ["\ufeff", "\n" * 1000, "# " + "x" * 1000, "\x00", "{", "---\n", "values:\n", "[parameters]\n", " "]
    )
    return replace(document, **{rng.choice(["head", "tail"]): piece})


STRUCTURE = (
    *(strange_value, strange_value, scaled_value, scaled_value, all_scaled, swapped_values, deviation, unit, removed),
    *(repeated, shuffled, renamed, renamed, added, split_fork, odd_line, odd_line, many, ending, unquoted, around),
)


def flipped(rng, data):
    out = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        out[rng.randrange(len(out))] = rng.randrange(256)
    return bytes(out)


def cut_short(rng, data):
    return data[: rng.randrange(len(data))]


def encoded(rng, data):
    text = data.decode("utf-8", "replace")
    return rng.choice(
        [
            lambda: text.encode("utf-16"),
            lambda: text.encode("utf-16-be", "replace"),
            lambda: text.encode("utf-32"),
            lambda: (text + "é").encode("latin-1", "replace"),
            lambda: text.encode("cp037", "replace"),
            lambda: b"\xef\xbb\xbf" + data,
        ]
    )()


def repeated_whole(rng, data):
    return data * rng.randint(2, 60)


def noise(rng, data):
    return rng.randbytes(rng.randint(0, 5000))


BYTES = (flipped, flipped, cut_short, cut_short, encoded, repeated_whole, noise)
