"""Bodies that cannot fit are refused before any of their particles is made."""

from time import perf_counter

import meshes
import numpy as np
import pytest

import mpmgeo
from mpmgeo.bodies.lattice import Lattice
from mpmgeo.case.load import CaseError, load_case
from mpmgeo.case.meaning import sizes


def problems(case):
    start = perf_counter()
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert perf_counter() - start < 1
    return caught.value.problems


def test_a_body_of_millions_of_cells_in_a_small_mesh(case, monkeypatch):
    monkeypatch.setattr(Lattice, "coordinates", lambda lattice: pytest.fail("made"))
    case["body"]["block"]["point_p2"] = [200, 200, 100]
    assert problems(case) == [
        "body.block: needs 2.56e+08 particle positions, of which 512 can lie in the mesh; the body "
        "reaches from (0, 0, 0) m to (200, 200, 100) m, the mesh from (0, 0, 0) m to (2, 2, 2) m"
    ]
    ball = {"type": "sphere", "center": [1, 1, 1], "diameter": 100, "material_id": 1}
    case["body"] = {"ball": ball}
    assert problems(case)[0].startswith("body.ball: needs 6.4e+07 particle positions")


def test_a_large_body_beside_the_mesh(case):
    case["body"]["block"] |= {"point_p1": [500, 0, 0], "point_p2": [600, 100, 100]}
    assert "of which 0 can lie in the mesh" in problems(case)[0]


def test_memory_of_all_bodies_together(case, monkeypatch):
    case["body"]["block"]["particles_per_direction"] = [20, 20, 20]
    case["body"]["twin"] = case["body"]["block"]
    monkeypatch.setattr(sizes, "memory_of_machine", lambda: 1e8)
    load_case(case)
    monkeypatch.setattr(sizes, "memory_of_machine", lambda: 5e7)
    assert problems(case) == [
        "body: the particles need about 0.0653 GB of memory, more than the 0.05 GB there are"
    ]
    monkeypatch.setattr(sizes, "memory_of_machine", lambda: None)
    load_case(case)


def test_memory_of_elements_that_are_filled(case, tmp_path, monkeypatch):
    part = ("hexahedron", *meshes.box("hexahedron"))
    path = meshes.write(tmp_path / "m.msh", meshes.mesh_of({"soil": [part]}))
    body = {"type": "gmsh", "mesh_file": str(path), "physical_to_material": {"soil": 1}}
    case["body"] = {"mesh": body}
    monkeypatch.setattr(sizes, "memory_of_machine", lambda: 1e6)
    load_case(case)
    body |= {"particle_distribution": "per_cell", "particles_per_direction": [10, 10, 10]}
    assert problems(case)[0].startswith("body: the particles need about 0.00408 GB of memory")


def test_memory_of_this_machine():
    memory = sizes.memory_of_machine()
    assert memory is None or 2**28 < memory < 2**50


def test_a_thin_polygon_counts_what_it_holds(case):
    case["body"] = {
        "dyke": {
            "type": "polygon_2d",
            "points": [[0, 0, 0], [2, 0, 2], [2, 0, 1.9]],
            "extrude_direction": "y",
            "extrude_displacement": 1,
            "material_id": 1,
        }
    }
    (body,) = load_case(case).body
    cell = np.array([0.01, 0.01, 0.01])
    kept = len(body.generate(cell).position)
    assert body.fullness * body.lattice(cell).number == pytest.approx(kept, rel=0.1)


def test_a_case_whose_particles_are_all_outside_the_mesh_is_refused(case):
    case["mesh"]["origin"] = [10.0, 0.0, 0.0]
    with pytest.raises(ValueError, match="none of the 64 particles lies in the mesh") as caught:
        mpmgeo.Simulation(load_case(case))
    assert str(caught.value).endswith(
        "they reach from (0.125, 0.125, 0.125) m to (0.875, 0.875, 0.875) m, "
        "the mesh from (10, 0, 0) m to (12, 2, 2) m"
    )
    case["mesh"]["origin"] = [0.8, 0.0, 0.0]
    mpmgeo.Simulation(load_case(case))
