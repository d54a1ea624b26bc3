"""The text of a file, whatever kind of file it is."""

import os
import threading

import pytest

from singletrack import InputError
from singletrack.files import source
from singletrack.files.source import is_there, lines_of, read_text


@pytest.fixture
def pipe(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


def test_lines_end_where_editors_end_them():
    assert lines_of("a\nb\r\nc\rd\x0ce\u2028f") == ["a", "b", "c", "d\x0ce\u2028f"]


def test_a_byte_order_mark_means_nothing(tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes(b"\xef\xbb\xbfw = 1")
    assert read_text(path) == "w = 1"


@pytest.mark.parametrize("size", [0, 1, 99, 100])
def test_files_up_to_the_largest_are_read_whole(tmp_path, size):
    path = tmp_path / "a.txt"
    path.write_text("x" * size)
    assert read_text(path, 100) == "x" * size
    path.write_text("x" * 101)
    with pytest.raises(InputError, match="is larger than 0 kB"):
        read_text(path, 100)


def test_a_pipe_is_read_as_its_writer_writes(pipe):
    def write():
        with pipe.open("w") as out:
            for _ in range(3):
                out.write("w = 1\n" * 20_000)
                out.flush()

    writer = threading.Thread(target=write)
    writer.start()
    assert read_text(pipe) == "w = 1\n" * 60_000
    writer.join()


def test_a_pipe_without_a_writer_is_empty(pipe, monkeypatch):
    monkeypatch.setattr(source, "_PATIENCE", 0.05)
    assert read_text(pipe) == ""


def test_a_writer_who_says_nothing_is_given_up(pipe, monkeypatch):
    monkeypatch.setattr(source, "_PATIENCE", 0.05)
    writer = os.open(pipe, os.O_RDWR)
    with pytest.raises(InputError, match=r"pipe: says nothing for 0\.05 s; a file is needed"):
        read_text(pipe)
    os.close(writer)


@pytest.mark.parametrize("path", ["/dev/zero", "/proc/self/mem", "/", "a\0b", "x" * 5000])
def test_odd_files_are_refused(path, tmp_path):
    with pytest.raises(InputError, match=r"is larger|cannot be read|is a directory"):
        read_text(tmp_path / path)


def test_what_is_there(tmp_path):
    assert is_there(tmp_path)
    assert not any(is_there(tmp_path / name) for name in ("a", "a\0b", "x" * 5000, "x/" * 50_000))


def test_errors_while_reading_are_told(tmp_path, monkeypatch):
    path = tmp_path / "a.txt"
    path.write_text("w = 1")

    def fail(*_):
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(source.os, "read", fail)
    with pytest.raises(InputError, match=r"a\.txt: cannot be read \(Input/output error\)"):
        read_text(path)
