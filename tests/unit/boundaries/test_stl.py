"""Triangles come back from files of every writer, or the file is refused with the reason."""

import meshio
import numpy as np
import pytest
import pyvista
import terrains

from mpmgeo.boundaries.stl import read_stl

HILL = terrains.patch(lambda x, y: np.sin(x) + 0.1 * y, 0.0, 3.0, 4)


def as_mesh():
    points, index = np.unique(HILL.reshape(-1, 3), axis=0, return_inverse=True)
    return points, index.reshape(-1, 3)


def by_meshio(path, binary):
    points, cells = as_mesh()
    meshio.write(path, meshio.Mesh(points, [("triangle", cells)]), "stl", binary=binary)


def by_vtk(path, binary):
    points, cells = as_mesh()
    pyvista.PolyData.from_regular_faces(points, cells).save(path, binary=binary)


def by_hand(path, binary):
    path.write_bytes(terrains.binary_of(HILL) if binary else terrains.text_of(HILL).encode())


def by_hand_like_a_text(path, binary):
    """Binary with the word solid in front, or text with odd case, blanks and line ends."""
    text = terrains.text_of(HILL).upper().replace("\n", "\r\n   ").replace("VERTEX ", "VERTEX\t ")
    path.write_bytes(
        terrains.binary_of(HILL, b"solid ground") if binary else b"\n " + text.encode()
    )


@pytest.mark.parametrize("binary", [True, False], ids=["binary", "text"])
@pytest.mark.parametrize("write", [by_meshio, by_vtk, by_hand, by_hand_like_a_text])
def test_all_writers_are_understood(tmp_path, write, binary):
    path = tmp_path / "hill.stl"
    write(path, binary)
    found = read_stl(path)
    assert found.warnings == ()
    order = [np.lexsort(c.reshape(-1, 9).T.round(3)) for c in (found.corner, HILL)]
    assert found.corner[order[0]] == pytest.approx(HILL[order[1]], abs=1e-6)
    assert found.normal.shape == (len(HILL), 3)


def test_several_solids_are_one_surface(tmp_path):
    path = tmp_path / "two.stl"
    path.write_text(terrains.text_of(HILL[:5], "one") + terrains.text_of(HILL[5:], "two"))
    assert read_stl(path).corner == pytest.approx(HILL)


NAMES = ("facet model", "vertex 1 2 3", "endfacet", "end facet of it", "a facet normal 0 0 1")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=repr)
def test_words_of_the_format_in_a_name_are_a_name(tmp_path, name, end):
    path = tmp_path / "hill.stl"
    path.write_bytes(terrains.text_of(HILL, name).replace("\n", end).encode())
    found = read_stl(path)
    assert found.corner == pytest.approx(HILL)
    assert found.warnings == ()


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("endfacet", "end facet"),
        lambda text: text.replace("endfacet", "END FACET").replace("endsolid", "end solid"),
        lambda text: "\ufeff" + text,
        lambda text: "\ufeff\n " + text,
        lambda text: " ".join(text.split()),
    ],
    ids=["end facet", "END FACET", "byte order mark", "mark and blanks", "one line"],
)
def test_ways_to_write_a_text(tmp_path, change):
    path = tmp_path / "hill.stl"
    path.write_bytes(change(terrains.text_of(HILL)).encode())
    found = read_stl(path)
    assert found.corner == pytest.approx(HILL)
    assert found.warnings == ()


TEXT, BINARY = terrains.text_of(HILL).encode(), terrains.binary_of(HILL)
LINES = TEXT.splitlines(keepends=True)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the file is empty"),
        (b" \n", "the file is empty"),
        (b"solid nothing\nendsolid nothing\n", "no triangles"),
        (BINARY[:80] + bytes(4), "no triangles"),
        (b"P\x00NG", "no STL file"),
        (b"# a comment\n", "no STL file"),
        (BINARY[:60], "no STL file"),
        (BINARY[:1000], "32 triangles in 1684 bytes; it has 1000 bytes, 18 triangles"),
        (b"".join(LINES[:11]), "cut short or damaged: 2 facets begin, 1 end, and 4 vertices"),
        (TEXT.replace(b"vertex", b"point", 1), "95 vertices were found where 96 are needed"),
        (TEXT.replace(b"vertex 0.0", b"vertex zero", 1), "vertex 1 is no three numbers: zero"),
        (TEXT.replace(b"vertex 0.0", b"vertex nan", 1), "triangle 1 has coordinates that are no"),
        (TEXT.replace(b"vertex 0.0", b"vertex 1e999", 1), "triangle 1 has coordinates that are no"),
    ],
    ids=str,
)
def test_what_is_no_surface_is_refused(tmp_path, content, message):
    path = tmp_path / "broken.stl"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r"broken\.stl: ") as caught:
        read_stl(path)
    assert message in str(caught.value)


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(ValueError, match="cannot be read"):
        read_stl(tmp_path)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"".join(LINES[:-1]), "may be cut short"),
        (BINARY + b"more", "4 bytes behind the last triangle"),
    ],
)
def test_what_is_odd_is_told(tmp_path, content, message):
    path = tmp_path / "odd.stl"
    path.write_bytes(content)
    found = read_stl(path)
    assert len(found.corner) == len(HILL)
    assert message in found.warnings[0]
