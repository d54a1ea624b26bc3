"""Read hostile files, in a process of its own: `python hostile.py FOLDER`.

Prints JSON: for each file what became of it ("read" or the refusal), the seconds of processor time it took, and in the
end the largest memory of the process in MB. Anything but a record or a refusal ends the process with a traceback.
"""

import json
import math
import os
import re
import resource
import socket
import sys
import threading
import time
import warnings
from pathlib import Path

from singletrack import InputError, load_bicycle
from singletrack.errors import OddityWarning
from singletrack.files.parameter_sets import write_parameter_set
from singletrack.files.signals import read_signal
from singletrack.files.source import read_text
from singletrack.files.text import write_bicycle_text
from singletrack.files.toml_write import write_toml
from singletrack.library.load import load_any
from singletrack.measuring.oscillation import fit_oscillation

ADDRESS_SPACE = 2 << 30
SWING = "".join(f"{0.01 * i:.2f},{math.sin(0.3 * i):.3f}\n" for i in range(60_000))


def texts():
    """Return hostile texts by file name; the largest that are read at all, and larger ones."""
    stratos = load_bicycle("stratos")
    toml, text, yaml = write_toml(stratos), write_bicycle_text(stratos), write_parameter_set(stratos)
    parts = ["a"] * 95_000
    return {
        # Blank space
        "blank.txt": "\n" * 100_000 + text,
        "only-blank.txt": "\n" * 199_000,
        "carriage.txt": "\r" * 150_000 + text,
        "spaces.txt": " " * 190_000 + text,
        "tabs.yml": "\t" * 29_000,
        "blank.csv": "\n" * 900_000,
        "before-empty-key.toml": " " * 150_000 + '"" = 5\n',
        "after-empty-key.toml": f'{toml}""{" " * 150_000}= 5\n',
        "bare-space.toml": toml + " " * 150_000 + "x",
        # Depth
        "dots.toml": ".".join(parts) + " = 1",
        "heading.toml": f"[{'.'.join(parts)}]",
        "inline-dots.toml": f"x = {{{'.'.join(parts)} = 1}}",
        "quoted-dots.toml": '"a" . ' * 33_000 + "a = 1",
        "400000-dots.toml": "a." * 400_000 + "a = 1",
        "shallow-dots.toml": "".join(f"a{i}.b.c.d.e.f.g.h.i.j.k.l.m.n.o = 1\n" for i in range(5000)),
        "brackets.toml": "x = " + "[" * 190_000,
        "tables.toml": "x = [" + "{}," * 60_000 + "]",
        "arrays-of-tables.toml": "[[a]]\n" * 33_000,
        "flow.yml": "{" * 29_000,
        "inner-flow.yml": "a: " + "{a: " * 7000,
        "dashes.yml": "- " * 14_000,
        "questions.yml": "? " * 14_000,
        "indented.yml": "".join(f"{' ' * i}a:\n" for i in range(240)),
        # Numbers of things
        "unknown.toml": "[parameters]\n" + "".join(f"x{i} = 1\n" for i in range(16_000)),
        "90000-unknown.toml": "[parameters]\n" + "".join(f"x{i} = 1\n" for i in range(90_000)),
        "unknown.txt": "".join(f"x{i} = 1\n" for i in range(16_000)),
        "90000-unknown.txt": "".join(f"x{i} = 1\n" for i in range(90_000)),
        "unknown.yml": "".join(f"x{i}: 1\n" for i in range(3000)),
        "90000-unknown.yml": "".join(f"x{i}: 1\n" for i in range(90_000)),
        "extras.toml": toml + "\n[extras]\n" + "".join(f"x{i} = 1\n" for i in range(15_000)),
        "averages.txt": "w = " + "1, " * 60_000 + "1",
        "references.yml": "a: &a [x]\n" + "b: [*a]\n" * 3000,
        # Length
        "name.txt": "w" * 199_000 + " = 1",
        "no-sign.txt": "w" * 199_000,
        "digits.txt": "w = " + "9" * 199_000,
        "name.toml": "[parameters]\n" + "a" * 190_000 + " = 1",
        "description.toml": toml.replace('description = "', 'description = "' + "x" * 150_000),
        "digits.toml": "x = " + "1" * 199_000,
        "hexadecimal.toml": "[parameters]\nwheel_base = 0x" + "f" * 190_000,
        "hexadecimal-name.toml": "name = 0x" + "f" * 190_000 + "\n[parameters]\n",
        "digits.yml": "w: " + "9" * 29_000,
        "key.yml": "a" * 29_000 + ": 1",
        "block.yml": "a: |\n" + " x\n" * 9000,
        "large.toml": "# " + "x" * 3_000_000,
        "hashes.toml": "#" * 199_000,
        "quotes.toml": "'" * 199_000,
        "double-quotes.toml": '"' * 199_000,
        "escaped-quotes.toml": 'x = """' + '\\"""' * 45_000,
        "unterminated.toml": "x = '''" + "a" * 190_000,
        # Encodings
        "utf-16.txt": text.encode("utf-16"),
        "utf-16-be.txt": text.encode("utf-16-be"),
        "utf-32.toml": toml.encode("utf-32"),
        "latin-1.yml": (yaml + "# é\n").encode("latin-1"),
        "ebcdic.txt": text.encode("cp037"),
        "nul.txt": "\0" * 199_000,
        "separators.txt": "\u2028" * 60_000,
        "surrogate.toml": b"\xed\xa0\x80",
        "random.toml": bytes(range(256)) * 700,
        # Signals
        "swing.csv": SWING,
        "one-line.csv": "1 2 " * 200_000,
        "same-time.csv": "0,1\n" * 200_000,
        "alternating.csv": "".join(f"{i},{i % 2}\n" for i in range(100_000)),
        "large.csv": SWING * 10,
    }


def read(path):
    """Read whatever it is."""
    if Path(path).suffix == ".csv":
        return fit_oscillation(*read_signal(read_text(Path(path)), str(path)), str(path))
    return load_any(path)


def special(folder):
    """Yield names, paths of things that are no regular files, and how to stop what speaks into them."""
    folder.joinpath("folder.toml").mkdir()
    yield "folder", folder / "folder.toml"
    os.mkfifo(folder / "silent.toml")
    yield "pipe without a writer", folder / "silent.toml"
    os.mkfifo(folder / "mute.toml")
    writer = os.open(folder / "mute.toml", os.O_RDWR)
    yield "pipe with a writer who says nothing", folder / "mute.toml"
    os.close(writer)
    os.mkfifo(folder / "speaking.toml")
    text = write_toml(load_bicycle("stratos"))
    speaker = threading.Thread(target=lambda: (folder / "speaking.toml").write_text(text))
    speaker.start()
    yield "pipe that speaks", folder / "speaking.toml"
    speaker.join()
    server = socket.socket(socket.AF_UNIX)
    os.chdir(folder)  # names of sockets are short
    server.bind("socket.toml")
    yield "socket", folder / "socket.toml"
    server.close()
    yield "endless device", Path("/dev/zero")
    yield "empty device", Path("/dev/null")
    yield "memory of the process", Path("/proc/self/mem")
    yield "long name", "x" * 5000 + ".toml"
    yield "deep path", "x/" * 60_000 + "a.toml"
    yield "name with a NUL", "a\0b.toml"
    yield "no name", ""
    link = folder / "link.toml"
    link.symlink_to(link)
    yield "link to itself", link
    secret = folder / "secret.toml"
    secret.write_text(text)
    secret.chmod(0)
    yield "file without permission", secret


def peak_megabytes():
    """Return the peak of memory; where the system tells, without that of the process which started this one."""
    status = Path("/proc/self/status")
    found = re.search(r"VmHWM:\s+(\d+) kB", status.read_text()) if status.exists() else None
    return (int(found[1]) if found else resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) / 1024


def main(folder):
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
    warnings.simplefilter("error")
    warnings.simplefilter("ignore", OddityWarning)
    result = {}

    def take(name, path):
        started, began = time.process_time(), time.monotonic()
        try:
            read(path)
            found = "read"
        except InputError as error:
            found = str(error)
        result[name] = {"found": found, "cpu": time.process_time() - started, "wall": time.monotonic() - began}

    for name, text in texts().items():
        path = folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        take(name, path)
        path.unlink()
    for name, path in special(folder):
        take(name, path)
    peak = peak_megabytes()
    sys.stdout.write(json.dumps({"files": result, "megabytes": peak}))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
