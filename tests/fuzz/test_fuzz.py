"""A short run of the fuzzers (`make fuzz` is a long one), and that they see what they should."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import run

from singletrack import InputError, load_bicycle

FOLDER = Path(__file__).parent


def test_480_generated_files_are_read_or_refused_as_they_must_be(tmp_path):
    done = subprocess.run(
        [sys.executable, str(FOLDER / "run.py"), "--count", "480", "--seed", "7", "--keep", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,  # far beyond what it takes: only a hang gets there
    )
    assert done.stdout, done.stderr[-2000:]
    summary = json.loads(done.stdout)
    assert summary["wrong"] == []
    assert done.returncode == 0
    # The changes neither kill nor spare all.
    read, refused = (sum(found[key] for found in summary["readers"].values()) for key in ("read", "refused"))
    assert min(read, refused) > 40


def test_a_seed_makes_the_same_files():
    one, other, another = ([run.make(run.random.Random(seed), "text") for _ in range(20)] for seed in (1, 1, 2))
    assert one == other != another


def raising(error):
    def read(path):
        raise error(f"{path}")

    return read


@pytest.mark.parametrize(
    ("read", "says"),
    [
        (raising(KeyError), "KeyError"),
        (raising(InputError), "poor message"),
        (lambda _: raising(InputError)("somewhere, line 3"), "poor message"),
        (lambda path: raising(InputError)(f"{path}, line 3: \x1b[31m"), "poor message"),
        (lambda path: raising(InputError)(f"{path}, line 3: " + "x" * 2000), "poor message"),
        (lambda _: float("nan"), "SilentError"),
        (lambda _: np.array([1.0, np.inf]), "SilentError"),
    ],
)
def test_what_is_wrong_is_seen(read, says, tmp_path):
    wrong, _ = run.trouble_with(tmp_path / "a.txt", read)
    assert says in wrong


def test_what_is_right_passes(tmp_path):
    assert run.trouble_with(tmp_path / "a.txt", lambda _: load_bicycle("browser")) == ("", True)
    assert run.trouble_with(tmp_path / "a.txt", lambda path: raising(InputError)(f"{path}, line 3: no")) == ("", False)


def test_slow_ones_are_seen(tmp_path, monkeypatch):
    monkeypatch.setattr(run, "SECONDS", -1.0)
    assert "s" in run.trouble_with(tmp_path / "a.txt", lambda _: 1.0)[0]


@pytest.mark.parametrize("path", sorted(run.CORPUS.iterdir()), ids=lambda path: path.stem)
def test_files_of_the_corpus_are_taken_well(path):
    reader = path.stem.rpartition("-")[0].replace("-", " ")
    reader = next(name for name in run.READERS if reader.startswith(name))
    if reader == "yeadon":
        pytest.importorskip("yeadon", reason="the optional package yeadon is not installed")
    assert run.trouble_with(path, run.READERS[reader][3])[0] == ""
