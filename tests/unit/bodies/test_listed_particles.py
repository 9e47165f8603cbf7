import json

import numpy as np
import pytest

import mpmgeo
from mpmgeo.case.load import CaseError, load_case

LAWS = [
    {"type": "elastic", "id": 1, "density": 1000, "young": 1e6, "poisson": 0.3},
    {"type": "elastic", "id": 2, "density": 2000, "young": 1e6, "poisson": 0.3},
]
COLUMNS = {
    "id": [10, 20, 30],
    "position": [[1, 1, 1], [2, 1, 1], [3, 1, 1.5]],
    "volume": [0.125, 1.0, 8.0],
    "material_id": [1, 2, 1],
}


def simulation(*bodies, materials=LAWS):
    mesh = {"cells_number": [5, 5, 5], "cells_dimension": [1, 1, 0.5]}
    return mpmgeo.Simulation(
        load_case({"time": 1, "mesh": mesh, "materials": materials, "body": list(bodies)})
    )


def listed(**others):
    return {"type": "particles", "particles": COLUMNS, **others}


def test_particles_are_cubes_of_their_volume_and_material():
    made = simulation(listed())
    np.testing.assert_array_equal(made.field("position"), COLUMNS["position"])
    np.testing.assert_allclose(made.field("volume"), COLUMNS["volume"], rtol=1e-15)
    np.testing.assert_allclose(made.field("mass"), [125, 2000, 8000], rtol=1e-15)
    assert made.field("material").tolist() == [1, 2, 1]
    assert (np.ptp(made.solver.population.size, axis=1) == 0).all()


def test_large_particles_interpolate_as_one_cell():
    made = simulation(listed())
    halves = np.concatenate([np.reshape(s.half, (-1, 3)) for s in made.solver.sets])
    np.testing.assert_allclose(np.sort(halves[:, 0]), [0.25, 0.5, 0.5])
    np.testing.assert_allclose(np.sort(halves[:, 2]), [0.5, 0.5, 0.5])
    assert "particles larger than a cell interpolate" in " ".join(made.messages)


def test_one_material_counts_before_those_of_the_particles():
    assert simulation(listed(material_id=2)).field("material").tolist() == [2, 2, 2]


def test_one_material_in_the_list_is_that_of_the_body():
    body = listed(particles=COLUMNS | {"material_id": 2})
    made = simulation(body)
    assert made.field("material").tolist() == [2, 2, 2]
    assert "body[0].particles.material_id: read as the material of the body" in made.messages


def test_id_says_how_many_and_the_rest_is_left():
    made = simulation(listed(particles=COLUMNS | {"id": [7, 7]}))
    assert len(made.field("position")) == 2
    assert "particles.position has 3 entries, of which the first 2 count" in made.messages[0]
    assert made.field("id").tolist() == [0, 1]


def test_id_may_be_absent():
    columns = {key: value for key, value in COLUMNS.items() if key != "id"}
    assert len(simulation(listed(particles=columns)).field("position")) == 3


def test_of_materials_with_one_id_the_last_counts_for_listed_particles():
    block = {"type": "cuboid", "point_p1": [0, 3, 0], "point_p2": [1, 4, 0.5], "material_id": 1}
    heavy = LAWS[0] | {"density": 5000}
    made = simulation(block, listed(), materials=[*LAWS, heavy])
    density = made.field("mass") / made.field("volume")
    np.testing.assert_allclose(density, 8 * [1000] + [5000, 2000, 5000], rtol=1e-12)
    assert "the last one" in made.messages[0]


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    entries = [
        {"id": 9, "position": [1, 1, 1], "volume": 0.5, "material_id": 2, "name": "ignored"},
        {"position": [2, 1, 1], "volume": 0.25, "material_id": 1.0},
    ]
    path = tmp_path / "list.json"
    path.write_text(json.dumps(entries))
    return path


@pytest.mark.parametrize("kind", ["particles_from_file", "particles_list"])
def test_a_file_lists_particles(file, kind):
    made = simulation({"type": kind, "file": "list.json"})
    np.testing.assert_array_equal(made.field("position"), [[1, 1, 1], [2, 1, 1]])
    np.testing.assert_allclose(made.field("volume"), [0.5, 0.25], rtol=1e-15)
    assert made.field("material").tolist() == [2, 1]


def test_a_file_needs_no_materials_if_the_body_has_one(file):
    file.write_text('[{"position": [1, 1, 1], "volume": 1}]')
    made = simulation({"type": "particles_list", "file": "list.json", "material_id": 2})
    assert made.field("material").tolist() == [2]


def test_a_file_may_begin_with_a_byte_order_mark(file):
    file.write_bytes(b"\xef\xbb\xbf" + file.read_bytes())
    assert len(simulation({"type": "particles_list", "file": "list.json"}).field("id")) == 2


def test_an_empty_file_makes_an_empty_body(file):
    file.write_text("[]")
    made = simulation({"type": "particles_list", "file": "list.json"}, listed())
    assert made.field("body").tolist() == [2, 2, 2]


def test_an_unknown_material_is_told_with_its_place(file):
    file.write_text('[{"position": [1, 1, 1], "volume": 1, "material_id": 8}]')
    with pytest.raises(CaseError, match=r"body\[0\].file: 8 is no id of a material; defined: 1, 2"):
        simulation({"type": "particles_list", "file": "list.json"})
    with pytest.raises(CaseError, match=r"body\[0\].particles.material_id\[1\]: 4 is no id"):
        simulation(listed(particles=COLUMNS | {"material_id": [1, 4, 4]}))


def test_inactive_bodies_need_no_file():
    made = simulation({"type": "gmsh", "active": False, "mesh_file": "none.msh"}, listed())
    assert made.field("body").tolist() == [1, 1, 1]
