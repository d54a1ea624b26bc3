"""The program on terminals of all kinds, with names of all kinds, and its ends: tested as a process of its own."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import singletrack
from singletrack.present.terminal import printable, readable

posix = pytest.mark.skipif(os.name != "posix", reason="signals, pipes and terminals of POSIX")
STRATOS = (Path(singletrack.__file__).parent / "data" / "bicycles" / "stratos.toml").read_text(encoding="utf-8")
NAME = "[/v2] [red]ice[bold :bicycle: \\[x] \x1b]0;title\x07\x1b[31m\u202e\r\b"
NUMBER = re.compile(r"-?\d+\.\d+")


def run(*arguments, environment=None, **options):
    kept = {name: value for name, value in os.environ.items() if name not in {"COLUMNS", "NO_COLOR", "FORCE_COLOR"}}
    command = [sys.executable, "-m", "singletrack", *map(str, arguments)]
    return subprocess.run(
        command, capture_output=options.pop("capture", True), env=kept | (environment or {}), check=False, **options
    )


@pytest.fixture
def odd(tmp_path):
    """A bicycle whose name is markup and escapes, in a file whose name is so too, and with something to warn of."""
    path = tmp_path / "[red]\x1b[31m.toml"
    name = NAME.encode("unicode_escape").decode().replace("\\x", "\\u00")
    text = re.sub(r'name = ".*"', lambda _: f'name = "{name}"', STRATOS).replace('"0.0563 m"', '"-0.05 +/- 0.04 m"')
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("command", ["coefficients", "eigenvalues", "critical-speeds", "show"])
@posix
def test_names_are_data(command, odd):
    result = run(command, odd, environment={"COLUMNS": "200"})
    out, err = result.stdout.decode(), result.stderr.decode()
    assert result.returncode == 0
    assert "[/v2] [red]ice[bold :bicycle: \\[x] \\x1b]0;title\\x07\\x1b[31m\\u202e\\r\\x08" in out
    assert ": trail = -0.05 m is negative" in err
    assert not set("\x1b\x07\r\b\u202e") & set(out + err)


@posix
def test_names_in_messages_and_files_are_data(odd, tmp_path):
    wrong = tmp_path / "[red]\x1b[31m.txt"
    wrong.write_text("nonsense\n", encoding="utf-8")
    for arguments in (
        ["coefficients", wrong],
        ["coefficients", "no\x1b[31mthing"],
        ["coefficients", "stratos", "--set", "\x1b[31m=3"],
        ["convert", odd, tmp_path / "[red]\x1b[31m.docx"],
        ["\x1b[31m"],
    ):
        result = run(*arguments)
        assert result.returncode == 2
        assert b"\x1b" not in result.stdout + result.stderr
        assert b"\\x1b[31m" in result.stderr
    copy = tmp_path / "[/copy].toml"
    result = run("convert", odd, copy)
    assert (result.returncode, copy.exists()) == (0, True)
    assert f"wrote {copy}" in result.stdout.decode()


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "utf-8"])
@pytest.mark.parametrize(
    "arguments",
    [["show", "stratos"], ["coefficients", "stratos"], ["eigenvalues", "stratos"], ["template", "rider"], ["--help"]],
    ids=" ".join,
)
def test_terminals_of_any_encoding(arguments, encoding):
    result = run(*arguments, environment={"PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"})
    assert result.returncode == 0
    assert result.stderr == b""
    text = result.stdout.decode(encoding)
    whole = run(*arguments, environment={"PYTHONIOENCODING": "utf-8"}).stdout.decode()
    assert text.count("?") == whole.count("?")
    assert NUMBER.findall(text) == NUMBER.findall(whole)


@pytest.mark.parametrize("command", ["show", "coefficients", "eigenvalues", "critical-speeds"])
def test_no_number_is_cut_in_narrow_terminals(command):
    narrow, wide = (
        run(command, "stratos", environment={"COLUMNS": columns}).stdout.decode() for columns in ("20", "200")
    )
    assert NUMBER.findall(narrow) == NUMBER.findall(wide)


def on_a_terminal(arguments, environment, columns=100):
    """Run on a pseudo-terminal; return what it received."""
    import fcntl
    import pty
    import struct
    import termios

    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    kept = {name: value for name, value in os.environ.items() if name not in {"COLUMNS", "NO_COLOR", "FORCE_COLOR"}}
    command = [sys.executable, "-m", "singletrack", *map(str, arguments)]
    process = subprocess.Popen(
        command, stdin=slave, stdout=slave, stderr=slave, env=kept | {"TERM": "xterm-256color"} | environment
    )
    os.close(slave)
    received = b""
    while True:
        try:
            part = os.read(master, 65536)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        received += part
    os.close(master)
    return process.wait(timeout=60), received.decode()


@posix
def test_colours_unless_not_wanted(odd):
    code, coloured = on_a_terminal(["eigenvalues", "stratos"], {})
    assert code == 0
    assert "\x1b[31m" in coloured
    code, plain = on_a_terminal(["eigenvalues", "stratos"], {"NO_COLOR": "1"})
    assert code == 0
    assert "\x1b[31m" not in plain
    code, named = on_a_terminal(["show", odd], {"NO_COLOR": "1"}, columns=20)
    assert code == 0
    assert "\x1b]0;" not in named
    assert "\x1b[31m" not in named


@posix
@pytest.mark.parametrize(
    "arguments", [["show", "stratos"], ["template", "rider"], ["eigenvalues", "stratos", "--json"]]
)
def test_a_closed_pipe_ends_as_for_others(arguments):
    read, write = os.pipe()
    os.close(read)
    result = run(*arguments, capture=False, stdout=write, stderr=subprocess.PIPE)
    os.close(write)
    assert result.returncode == -signal.SIGPIPE
    assert result.stderr == b""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
@pytest.mark.parametrize("arguments", [["show", "stratos"], ["template", "rider"], ["list"], ["--help"]])
def test_a_full_disk_behind_standard_output(arguments):
    with Path("/dev/full").open("wb") as full:
        result = run(*arguments, capture=False, stdout=full, stderr=subprocess.PIPE)
    assert result.returncode == 2
    assert result.stderr == b"singletrack: standard output: No space left on device\n"


@posix
def test_closed_streams_are_no_failure():
    for closing in (">&-", "2>&-", ">&- 2>&-"):
        command = f"{sys.executable} -m singletrack critical-speeds stratos --set trail=-0.01 {closing}"
        result = subprocess.run(["/bin/sh", "-c", command], capture_output=True, check=False)
        assert result.returncode == 0, result.stderr


WAITING = """
import sys, time, types
from singletrack.commands import app, door
def run() -> None:
    print("ready", flush=True)
    time.sleep(60)
sys.modules["singletrack.commands.wait"] = types.SimpleNamespace(run=run)
door.COMMANDS["wait"] = "Wait."
sys.argv = ["singletrack", "wait"]
app.main()
"""


@posix
@pytest.mark.parametrize(
    ("number", "code", "word"), [(signal.SIGINT, 130, b"interrupted"), (signal.SIGTERM, 143, b"terminated")]
)
def test_signals_end_with_one_sentence(number, code, word):
    process = subprocess.Popen([sys.executable, "-c", WAITING], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdout.readline() == b"ready\n"
    process.send_signal(number)
    _, said = process.communicate(timeout=30)
    assert (process.returncode, said) == (code, b"singletrack: " + word + b"\n")


def test_what_is_not_printable_is_shown():
    assert printable("a\tb\nλ²") == "a\tb\nλ²"
    assert printable("\x9b31m\u2066x\ud800") == "\\x9b31m\\u2066x\\ud800"


def test_what_an_encoding_lacks_is_written_otherwise():
    assert readable("λ = 18° ± 2, 5 m²", "ascii") == "lambda = 18 deg +/- 2, 5 m^2"
    assert readable("λ = 18° ± 2, 5 m²", "latin-1") == "lambda = 18° ± 2, 5 m²"
    assert readable("é⠀⣿漢", "ascii") == "e #?"
