"""Files are written whole or not at all, and nothing is destroyed that is not a file."""

from __future__ import annotations

import os
import stat
import threading
from pathlib import Path

import pytest

from singletrack.errors import InputError
from singletrack.output import check_writable, prepare_folder, write_whole
from singletrack.output.files import sync_folder

posix = pytest.mark.skipif(os.name != "posix", reason="permissions, links and devices of POSIX")
not_root = pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="an administrator may write everywhere")


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_text_and_bytes_in_folders_that_are_made(tmp_path):
    write_whole(tmp_path / "a" / "b" / "c.txt", "λ = 18°\n")
    assert (tmp_path / "a" / "b" / "c.txt").read_bytes() == "λ = 18°\n".encode()
    write_whole(str(tmp_path / "d.bin"), bytes(range(256)) * 1000)
    assert (tmp_path / "d.bin").read_bytes() == bytes(range(256)) * 1000
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "d.bin"]


@posix
@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002, 0o027])
def test_a_new_file_follows_the_umask(tmp_path, mask):
    before = os.umask(mask)
    try:
        write_whole(tmp_path / "new", "x")
    finally:
        os.umask(before)
    assert mode(tmp_path / "new") == 0o666 & ~mask


@posix
@pytest.mark.parametrize("permissions", [0o600, 0o640, 0o755, 0o604])
def test_an_old_file_keeps_its_permissions(tmp_path, permissions):
    path = tmp_path / "old"
    path.write_text("secret")
    path.chmod(permissions)
    write_whole(path, "new")
    assert (path.read_text(), mode(path)) == ("new", permissions)


@posix
def test_links_stay_and_their_targets_are_written(tmp_path):
    (tmp_path / "folder").mkdir()
    target = tmp_path / "folder" / "target"
    target.write_text("old")
    target.chmod(0o600)
    for name, to in (("link", "folder/target"), ("link to link", "link")):
        (tmp_path / name).symlink_to(to)
        write_whole(tmp_path / name, name)
        assert str((tmp_path / name).readlink()) == to
        assert (target.read_text(), mode(target), target.is_symlink()) == (name, 0o600, False)
    (tmp_path / "dangling").symlink_to("folder/not yet")
    write_whole(tmp_path / "dangling", "made")
    assert (tmp_path / "dangling").is_symlink()
    assert (tmp_path / "folder" / "not yet").read_text() == "made"
    assert sorted(path.name for path in (tmp_path / "folder").iterdir()) == ["not yet", "target"]


@posix
def test_a_link_in_a_circle_is_refused(tmp_path):
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    for call in (lambda: write_whole(tmp_path / "a", "x"), lambda: check_writable(tmp_path / "a")):
        with pytest.raises(InputError, match="cannot be written"):
            call()
    assert (tmp_path / "a").is_symlink()


@posix
def test_devices_and_fifos_are_written_to_and_stay(tmp_path):
    write_whole("/dev/null", "gone")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    found = []
    reader = threading.Thread(target=lambda: found.append(fifo.read_bytes()))
    reader.start()
    check_writable(fifo)
    write_whole(fifo, b"x" * 200_000)
    reader.join(timeout=10)
    assert found == [b"x" * 200_000]
    assert stat.S_ISFIFO(fifo.stat().st_mode)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_a_full_device_is_one_sentence():
    with pytest.raises(InputError, match=r"/dev/full: cannot be written \(No space left on device\)"):
        write_whole("/dev/full", "x")


def test_folders_and_impossible_names_are_refused(tmp_path):
    (tmp_path / "file").write_text("here")
    for path in (tmp_path, tmp_path / "file" / "below", tmp_path / ("x" * 300), tmp_path / "nul\0"):
        for call in (lambda path=path: write_whole(path, "x"), lambda path=path: check_writable(path)):
            with pytest.raises(InputError, match="cannot be written"):
                call()
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    assert (tmp_path / "file").read_text() == "here"


def test_checking_leaves_no_trace(tmp_path):
    (tmp_path / "old").write_text("x")
    for path in (tmp_path / "new", tmp_path / "a" / "b" / "new", tmp_path / "old"):
        check_writable(path)
    assert [path.name for path in tmp_path.iterdir()] == ["old"]
    assert (tmp_path / "old").read_text() == "x"


@not_root
def test_what_is_read_only_is_refused_and_stays(tmp_path):
    (tmp_path / "old").write_text("x")
    (tmp_path / "old").chmod(0o400)
    (tmp_path / "folder").mkdir(mode=0o500)
    for path in (tmp_path / "old", tmp_path / "folder" / "new", tmp_path / "folder" / "deep" / "new"):
        for call in (lambda path=path: write_whole(path, "y"), lambda path=path: check_writable(path)):
            with pytest.raises(InputError, match=r"cannot be written \(Permission denied\)"):
                call()
    with pytest.raises(InputError, match="cannot be used for output"):
        prepare_folder(tmp_path / "folder" / "deep")
    assert (tmp_path / "old").read_text() == "x"


def test_a_folder_that_cannot_be_synchronised_is_no_failure(tmp_path, monkeypatch):
    def refuse(_):
        raise OSError(22, "Invalid argument")

    monkeypatch.setattr(os, "fsync", refuse)
    sync_folder(tmp_path)
