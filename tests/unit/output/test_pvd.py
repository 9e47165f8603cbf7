import numpy as np
import pytest
import pyvista

from mpmgeo.output.pvd import Collection, previous_files, remove_previous
from mpmgeo.output.vtu import write_points

TIMES = [0.0, 0.1 + 0.2, 1 / 3, 1e-17, 12345.678901234567]


def a_run(folder, number=3, name="particles"):
    collection = Collection(folder / "series.pvd")
    for k in range(number):
        file = folder / f"{name}_{k + 1}.vtu"
        write_points(file, np.full((1, 3), float(k)), {})
        collection.add(0.1 * k, file)
    collection.write()
    return collection.path


def names(paths):
    return [path.name for path in paths]


def test_pyvista_reads_times_with_all_digits_and_the_files(tmp_path):
    collection = Collection(tmp_path / "particles" / "series.pvd")
    for k, time in enumerate(sorted(TIMES)):
        file = tmp_path / "particles" / f"a & b_{k}.vtu"
        write_points(file, np.full((1, 3), time), {})
        collection.add(np.float64(time), file)
    collection.write()
    reader = pyvista.get_reader(collection.path)
    assert list(reader.time_values) == sorted(TIMES)
    for time in sorted(TIMES):
        reader.set_active_time_value(time)
        assert reader.read()[0].points[0, 0] == time


def test_names_are_relative_with_forward_slashes(tmp_path):
    collection = Collection(tmp_path / "series.pvd")
    collection.add(0, tmp_path / "deeper" / "a.vtu")
    collection.add(1, tmp_path / "b.vtu")
    assert collection.entries == [(0.0, "deeper/a.vtu"), (1.0, "b.vtu")]


def test_an_empty_collection_is_valid(tmp_path):
    Collection(tmp_path / "series.pvd").write()
    assert previous_files(tmp_path / "series.pvd") == []


def test_writing_again_shows_the_files_added_since(tmp_path):
    collection = Collection(tmp_path / "series.pvd")
    write_points(tmp_path / "a.vtu", np.zeros((1, 3)), {})
    for time in range(3):
        collection.add(time, tmp_path / "a.vtu")
        collection.write()
        assert collection.path.read_text().count("<DataSet") == time + 1


def test_previous_files_are_those_that_exist_inside_the_folder(tmp_path):
    folder = tmp_path / "run"
    folder.mkdir()
    path = a_run(folder)
    (folder / "particles_2.vtu").unlink()
    outside = tmp_path / "precious.vtu"
    outside.write_text("mine")
    (folder / "notes.txt").write_text("mine")
    (folder / "link.vtu").symlink_to(outside)
    entries = ["../precious.vtu", str(outside), "notes.txt", "link.vtu", "particles_1.vtu", ".", ""]
    more = "".join(f'<DataSet timestep="0" file="{name}"/>' for name in entries) + "<DataSet/>"
    path.write_text(path.read_text().replace("</Collection>", more + "</Collection>"))
    assert names(previous_files(path)) == ["particles_1.vtu", "particles_3.vtu"]
    assert all(file.parent == folder for file in previous_files(path))


@pytest.mark.parametrize("content", [b"", b"no xml", b"<VTKFile><Collection>", b"\xff\x00"])
def test_a_collection_that_cannot_be_read_lists_nothing(tmp_path, content):
    path = tmp_path / "series.pvd"
    assert previous_files(path) == []
    path.write_bytes(content)
    assert previous_files(path) == []


def test_remove_previous_deletes_what_is_listed_and_tells_of_the_rest(tmp_path):
    path = a_run(tmp_path)
    for stray in ("particles_10.vtu", "particles_9.vtu", "other.vtu", "notes.txt"):
        (tmp_path / stray).write_text("mine")
    removed, left = remove_previous(path, "particles_*.vtu")
    assert names(removed) == ["particles_1.vtu", "particles_2.vtu", "particles_3.vtu"]
    assert names(left) == ["particles_9.vtu", "particles_10.vtu"]
    assert sorted(names(tmp_path.iterdir())) == [
        "notes.txt", "other.vtu", "particles_10.vtu", "particles_9.vtu",
    ]  # fmt: skip


def test_remove_previous_without_an_earlier_run(tmp_path):
    assert remove_previous(tmp_path / "missing" / "series.pvd") == ([], [])
    (tmp_path / "stray_1.vtu").write_text("mine")
    removed, left = remove_previous(tmp_path / "series.pvd")
    assert (removed, names(left)) == ([], ["stray_1.vtu"])
