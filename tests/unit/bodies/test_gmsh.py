"""Bodies from Gmsh files: groups, formats, elements, distributions."""

import re

import meshes
import meshio
import numpy as np
import pytest

from mpmgeo.bodies import Cuboid, Gmsh
from mpmgeo.bodies.elements import ELEMENTS

CELL = np.array([0.25, 0.25, 0.25])
SOIL = ("hexahedron", *meshes.box("hexahedron", (2, 2, 2), (0, 0, 0), (1, 1, 1)))
ROCK = ("tetra", *meshes.box("tetra", (1, 2, 1), (1, 0, 0), (1.5, 1, 1)))
PLATE = ("triangle", np.eye(3), np.array([[0, 1, 2]]))


def body(path, groups, **others):
    return Gmsh(mesh_file=path, physical_to_material=groups, **others)


def clouds(path, groups, cell=CELL, **others):
    made = body(path, groups, **others)
    assert list(made.complaints(cell)) == []
    return made.clouds(cell)


@pytest.fixture
def file(tmp_path):
    """A mesh of two groups of volumes and one of surfaces."""
    names = {"soil": (1, 3), "rock": (2, 3), "plate": (1, 2)}
    groups = {"soil": [SOIL], "rock": [ROCK], "plate": [PLATE]}
    return meshes.write(tmp_path / "two.msh", meshes.mesh_of(groups, names))


def test_groups_become_bodies_in_alphabetical_order(file):
    made = body(file, {"soil": 3, "rock": 7})
    assert made.labels == ('gmsh, "rock"', 'gmsh, "soil"')
    assert made.materials == {
        7: ("physical_to_material", "rock"),
        3: ("physical_to_material", "soil"),
    }
    rock, soil = made.clouds(CELL)
    assert (rock.material, soil.material) == (7, 3)
    assert (len(rock.position), len(soil.position)) == (12, 8)
    assert rock.size.prod(axis=1).sum() == pytest.approx(0.5)
    assert soil.size.prod(axis=1).sum() == pytest.approx(1.0)


def test_groups_without_material_are_left_out(file):
    (soil,) = clouds(file, {"soil": 1, "rock": 0, "plate": -1})
    assert len(soil.position) == 8
    assert list(body(file, {"soil": 0}).problems()) == [
        ("physical_to_material", "names no group with a material above 0")
    ]


def test_two_groups_of_one_material_hold_every_element_once(file):
    assert sum(len(cloud.position) for cloud in clouds(file, {"soil": 1, "rock": 1})) == 20


@pytest.mark.parametrize(("version", "is_binary"), meshes.FORMATS)
@pytest.mark.parametrize("kind", ELEMENTS)
def test_every_format_gives_the_same_particles(tmp_path, kind, version, is_binary):
    part = (kind, *meshes.box(kind, (2, 1, 1), (0, 0, 0), (1, 0.5, 0.5)))
    mesh = meshes.mesh_of({"a name with blanks": [part]})
    path = meshes.write(tmp_path / "box.msh", mesh, version, is_binary)
    (cloud,) = clouds(path, {"a name with blanks": 1})
    middle = part[1][part[2]][:, : 4 if "tetra" in kind else 8].mean(axis=1)
    np.testing.assert_allclose(cloud.position, middle, rtol=1e-12)
    np.testing.assert_allclose(cloud.size.prod(axis=1), 0.25 / len(middle), rtol=1e-12)


def test_several_blocks_of_a_group_in_a_file_where_others_have_none(tmp_path):
    """Version 4.1, saved with all elements: meshio alone refuses it."""
    tags = {"soil": (1, 3), None: (0, 3)}
    mesh = meshes.mesh_of({"soil": [SOIL, ROCK], None: [ROCK]}, tags)
    path = meshes.write(tmp_path / "all.msh", mesh, "4.1")
    text = path.read_text()
    start = text.index("$Entities")
    entities = text[start : text.index("$EndEntities")].splitlines()
    without = [
        line.replace(" 1 0 0", " 0 0") if line.startswith("3 ") else line for line in entities
    ]
    path.write_text(text.replace("\n".join(entities), "\n".join(without)))
    with pytest.raises(ValueError, match="Incompatible cell data"):
        meshio.gmsh.read(path)
    (soil,) = clouds(path, {"soil": 1})
    assert len(soil.position) == 20


def without_names(path):
    """Drop the names of the groups from a file; their numbers stay."""
    text = path.read_text()
    start, end = text.index("$PhysicalNames"), text.index("$EndPhysicalNames\n")
    path.write_text(text[:start] + text[end + len("$EndPhysicalNames\n") :])
    return path


@pytest.mark.parametrize("version", ["2.2", "4.1"])
def test_groups_without_a_name_are_called_by_their_number(tmp_path, version):
    names = {"soil": (5, 3), "rock": (12, 3)}
    mesh = meshes.mesh_of({"soil": [SOIL], "rock": [ROCK]}, names)
    path = without_names(meshes.write(tmp_path / "m.msh", mesh, version))
    rock, soil = clouds(path, {"5": 1, "12": 2})
    assert (len(rock.position), len(soil.position)) == (12, 8)
    assert (rock.material, soil.material) == (2, 1)
    complaints = dict(body(path, {"soil": 1}).complaints(CELL))
    assert complaints["mesh_file",].endswith(
        "m.msh has no physical group of volumes with a name, but with a number alone, which can be "
        'used as its name: "5", "12"'
    )


@pytest.mark.parametrize("version", ["2.2", "4.1"])
def test_some_groups_have_names_and_some_numbers(tmp_path, version):
    names = {"soil": (5, 3), "rock": (12, 3)}
    mesh = meshes.mesh_of({"soil": [SOIL], "rock": [ROCK]}, names)
    path = meshes.write(tmp_path / "m.msh", mesh, version)
    lines = [line for line in path.read_text().splitlines() if '"rock"' not in line]
    lines[lines.index("$PhysicalNames") + 1] = "1"
    path.write_text("\n".join(lines) + "\n")
    assert [len(cloud.position) for cloud in clouds(path, {"soil": 1, "12": 2})] == [12, 8]
    ((place, message),) = body(path, {"rock": 1}).complaints(CELL)
    assert place == ("physical_to_material", "rock")
    assert message == 'no physical group of the mesh, which has "soil", "12"'


@pytest.mark.parametrize("version", ["2.2", "4.1"])
def test_messages_do_not_speak_python(tmp_path, version):
    """Every number of the file in turn is made one that nothing else in it knows."""
    mesh = meshes.mesh_of({"soil": [(ROCK[0], ROCK[1], ROCK[2][:1])]})
    whole = meshes.write(tmp_path / "m.msh", mesh, version).read_text().split(" ")
    for index, text in enumerate(whole):
        if text.strip().isdecimal():
            changed = [*whole[:index], text.replace(text.strip(), "97"), *whole[index + 1 :]]
            (tmp_path / "m.msh").write_text(" ".join(changed))
            for _, message in body(tmp_path / "m.msh", {"soil": 1}).complaints(CELL):
                assert not re.search(r"np\.|int32|NoneType|object", message)


def test_an_element_of_two_groups_belongs_to_the_first(tmp_path):
    """As in version 2.2, where Gmsh writes such an element once for each group."""
    half = (SOIL[0], SOIL[1], SOIL[2][:4])
    mesh = meshes.mesh_of({"all": [SOIL], "half": [half]})
    mesh.cells[1].data -= len(SOIL[1])
    path = meshes.write(tmp_path / "shared.msh", mesh)
    whole, rest = clouds(path, {"half": 1, "all": 1})
    assert len(whole.position) == 8
    assert len(rest.position) == 0
    assert rest.notes == ("4 of its elements belong to a body before it, too",)


def test_gauss_points_share_the_volume_of_the_element(file):
    rock, soil = clouds(file, {"soil": 1, "rock": 2}, particle_distribution="gaussian")
    assert (len(rock.position), len(soil.position)) == (48, 64)
    np.testing.assert_allclose(rock.size.prod(axis=1), 0.5 / 48, rtol=1e-12)
    np.testing.assert_allclose(soil.size.prod(axis=1), 1 / 64, rtol=1e-12)
    first = 0.25 * (1 + np.array([-1, -1, -1]) / 3**0.5)
    np.testing.assert_allclose(soil.position[0], first, rtol=1e-12)


def test_inside_out_elements_weigh_the_same(tmp_path):
    kind, points, elements = ROCK
    mesh = meshes.mesh_of({"rock": [(kind, points, elements[:, [1, 0, 2, 3]])]})
    (cloud,) = clouds(meshes.write(tmp_path / "mirror.msh", mesh), {"rock": 1})
    assert cloud.size.prod(axis=1).sum() == pytest.approx(0.5)


def test_particles_have_the_form_of_a_cell(file):
    (soil,) = clouds(file, {"soil": 1}, cell=np.array([1.0, 0.5, 0.5]))
    np.testing.assert_allclose(soil.size / soil.size[:, :1], np.tile([1, 0.5, 0.5], (8, 1)))


def test_coarse_elements_are_told_of(file):
    (soil,) = clouds(file, {"soil": 1})
    assert "8 of 8 particles have more volume than a cell" in soil.notes[0]
    (soil,) = clouds(file, {"soil": 1}, cell=np.array([0.5, 0.5, 0.5]))
    assert soil.notes == ()


def curved(kind, path, number):
    """Write a ball of radius 1 made of a cube whose points are pulled out to spheres."""

    def pull(points):
        x = 2 * points - 1
        length = np.linalg.norm(x, axis=1, keepdims=True)
        return x * np.abs(x).max(axis=1, keepdims=True) / np.where(length > 0, length, 1)

    part = (kind, *meshes.box(kind, 3 * (number,)))
    return meshes.write(path, meshes.mesh_of({"ball": [part]}, lift=pull))


@pytest.mark.parametrize(("kind", "order"), [("tetra", 2), ("hexahedron", 2), ("hexahedron27", 4)])
@pytest.mark.filterwarnings("ignore")
def test_volume_of_a_ball_converges(tmp_path, kind, order):
    """With the order of the elements: the volume error is that of the curved boundary."""
    errors = []
    for number in (4, 8):
        (ball,) = clouds(curved(kind, tmp_path / f"{number}.msh", number), {"ball": 1})
        errors.append(abs(ball.size.prod(axis=1).sum() - 4 / 3 * np.pi))
    assert np.log2(errors[0] / errors[1]) > order - 0.3


class TestPerCell:
    """Filling elements with particles at the spacing of the grid."""

    def test_a_box_is_filled_as_a_cuboid(self, tmp_path):
        """Whatever the elements, if none is smaller than a particle's box."""
        path = meshes.write(tmp_path / "box.msh", meshes.mesh_of({"box": [SOIL]}))
        (cloud,) = clouds(path, {"box": 1}, particle_distribution="per_cell")
        cuboid = Cuboid(point_p1=(0, 0, 0), point_p2=(1, 1, 1), material_id=1).generate(CELL)
        order, wanted = np.lexsort(cloud.position.T), np.lexsort(cuboid.position.T)
        np.testing.assert_allclose(cloud.position[order], cuboid.position[wanted], rtol=1e-12)
        np.testing.assert_allclose(cloud.size, cuboid.size, rtol=1e-12)

    def test_particles_per_direction(self, tmp_path):
        path = meshes.write(tmp_path / "box.msh", meshes.mesh_of({"box": [SOIL]}))
        (cloud,) = clouds(
            path, {"box": 1}, particle_distribution="per_cell", particles_per_direction=(1, 2, 3)
        )
        assert len(cloud.position) == 4 * 8 * 12
        assert len(np.unique(cloud.position[:, 2].round(9))) == 12

    @pytest.mark.parametrize("number", [1, 3, 7, 20])
    def test_total_and_centre_whatever_the_size_of_the_elements(self, tmp_path, number):
        """From one element for all particles to many elements for one."""
        part = ("tetra", *meshes.box("tetra", 3 * (number,), (0, 0, 0), (0.5, 0.5, 0.5)))
        path = meshes.write(tmp_path / "box.msh", meshes.mesh_of({"box": [part]}))
        (cloud,) = clouds(path, {"box": 1}, particle_distribution="per_cell")
        volume = cloud.size.prod(axis=1)
        assert volume.sum() == pytest.approx(0.125, rel=1e-12)
        assert len(volume) == 4**3
        np.testing.assert_allclose(volume @ cloud.position / 0.125, 3 * [0.25], atol=0.01)

    def test_a_sheet_that_no_middle_lies_in_keeps_its_mass_and_place(self, tmp_path):
        part = ("tetra", *meshes.box("tetra", (8, 8, 1), (0, 0, 0), (1, 1, 0.01)))
        path = meshes.write(tmp_path / "sheet.msh", meshes.mesh_of({"sheet": [part]}))
        (cloud,) = clouds(path, {"sheet": 1}, particle_distribution="per_cell")
        assert len(cloud.position) == 64
        np.testing.assert_allclose(cloud.position[:, 2], 0.005, rtol=1e-6)
        np.testing.assert_allclose(cloud.size.prod(axis=1), 0.01 / 64, rtol=1e-9)

    @pytest.mark.parametrize("kind", ELEMENTS)
    @pytest.mark.filterwarnings("ignore")
    def test_curved_elements(self, tmp_path, kind):
        path = curved(kind, tmp_path / "ball.msh", 4)
        (cloud,) = clouds(path, {"ball": 1}, particle_distribution="per_cell")
        (single,) = clouds(path, {"ball": 1})
        volume = cloud.size.prod(axis=1)
        assert volume.sum() == pytest.approx(single.size.prod(axis=1).sum(), rel=1e-12)
        assert np.linalg.norm(cloud.position, axis=1).max() < 1
        assert len(volume) == pytest.approx(volume.sum() / 0.125**3, rel=0.05)
        assert len(np.unique(cloud.position.round(9), axis=0)) == len(volume)
