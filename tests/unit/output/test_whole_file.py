import os
from pathlib import Path

import pytest

from mpmgeo.output.whole_file import append, whole_file


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_the_file_appears_at_the_end_and_folders_are_made(tmp_path):
    path = tmp_path / "deep" / "folder" / "a.bin"
    with whole_file(path) as file:
        file.write(b"one")
        assert not path.exists()
    assert path.read_bytes() == b"one"
    assert names(path.parent) == ["a.bin"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_failure_leaves_nothing_behind_and_the_old_file_intact(tmp_path, error):
    old, new = tmp_path / "old.bin", tmp_path / "new.bin"
    old.write_bytes(b"old")
    for path in (old, new):
        with pytest.raises(type(error)), whole_file(path) as file:
            file.write(b"half of the new")
            raise error
    assert names(tmp_path) == ["old.bin"]
    assert old.read_bytes() == b"old"


def test_what_a_killed_run_left_beside_is_replaced(tmp_path):
    (tmp_path / "a.bin.part").write_bytes(b"a longer rest of a killed run")
    with whole_file(tmp_path / "a.bin") as file:
        file.write(b"new")
    assert names(tmp_path) == ["a.bin"]
    assert (tmp_path / "a.bin").read_bytes() == b"new"


def test_a_name_taken_by_a_folder_is_an_error_and_leaves_nothing_behind(tmp_path):
    (tmp_path / "a.vtu").mkdir()
    with pytest.raises(OSError), whole_file(tmp_path / "a.vtu") as file:
        file.write(b"new")
    assert names(tmp_path) == ["a.vtu"]


def test_a_link_beside_is_not_followed(tmp_path):
    outside = tmp_path / "outside"
    outside.write_bytes(b"mine")
    folder = tmp_path / "results"
    folder.mkdir()
    (folder / "a.bin.part").symlink_to(outside)
    with whole_file(folder / "a.bin") as file:
        file.write(b"new")
    assert outside.read_bytes() == b"mine"
    assert names(folder) == ["a.bin"] and (folder / "a.bin").read_bytes() == b"new"


def test_a_link_in_place_of_a_growing_file_is_not_followed(tmp_path):
    outside = tmp_path / "outside"
    outside.write_bytes(b"mine")
    append(tmp_path / "a.csv", "1\n")
    append(tmp_path / "a.csv", "2\n")
    assert (tmp_path / "a.csv").read_bytes() == b"1\n2\n"
    (tmp_path / "a.csv").unlink()
    (tmp_path / "a.csv").symlink_to(outside)
    with pytest.raises(OSError):
        append(tmp_path / "a.csv", "3\n")
    assert outside.read_bytes() == b"mine"


def test_a_full_disk_names_the_file(tmp_path):
    with pytest.raises(OSError) as error, whole_file(tmp_path / "a.bin"):
        raise OSError(28, "No space left on device")
    assert error.value.filename == str(tmp_path / "a.bin")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
def test_a_full_disk_names_a_growing_file(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "O_NOFOLLOW", 0)
    (tmp_path / "a.csv").symlink_to("/dev/full")
    with pytest.raises(OSError) as error:
        append(tmp_path / "a.csv", "1\n")
    assert error.value.filename == str(tmp_path / "a.csv")
