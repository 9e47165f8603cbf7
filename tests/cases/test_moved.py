"""Every case gives the same far from (0, 0, 0): the mesh has coordinates of its own."""

import json
from pathlib import Path

import meshes
import numpy as np
import pytest
import terrains
from moved import FAR, known_as_badly_as, moved, rounded, simulate

import mpmgeo

INPUTS = sorted((Path(__file__).parents[2] / "inputs").glob("*/case.json"))
STEPS = 30
FIELDS = ("id", "body", "mass", "volume", "displacement", "velocity", "stress")


def both(case, folder):
    """Return simulations of a case after some steps: moved, and where it was.

    The coordinates of the latter are rounded as far away from there.
    """
    far = simulate(moved(case, FAR, folder / "far"), STEPS)
    with known_as_badly_as(FAR):
        near = simulate(rounded(case, FAR, folder / "near"), STEPS)
    return far, near


def assert_same(far, near, case):
    """Compare bits, and what the case is made of with that of the case itself."""
    for key in FIELDS:
        np.testing.assert_array_equal(far.field(key), near.field(key), err_msg=key)
    at_rest = case.initial_stress is not None
    assert at_rest or np.abs(far.field("displacement")).max() > 0
    there = near.solver.population.position + far.case.mesh.origin
    assert far.field("position") - far.field("displacement") == pytest.approx(there, rel=1e-15)
    own = mpmgeo.Simulation(case)
    assert far.solver.count == own.solver.count
    assert far.field("mass") == pytest.approx(own.field("mass"), rel=1e-6)
    own.step(far.steps)  # to the same instant of loads in time
    assert far.field("external_force") == pytest.approx(own.field("external_force"), rel=1e-6)


@pytest.mark.parametrize("path", INPUTS, ids=lambda path: path.parent.name)
def test_cases_that_ship(tmp_path, path):
    case = mpmgeo.load_case(path)
    assert_same(*both(case, tmp_path), case)


def all_of_it(folder):
    """Return a case with every kind of position, in cells of ½ m whose nodes it likes to hit."""
    points = [{"position": [x, 1.0, 1.0], "pressure": 1e3 * x} for x in (1.1, 1.3, 1.7)]
    (folder / "pressures.json").write_text(json.dumps(points))
    (folder / "ground.stl").write_text(terrains.text_of(terrains.box([-1, -1, -1], [9, 9, 0.3])))
    (folder / "pebbles.json").write_text('[{"position": [6.1, 0.7, 0.4], "volume": 0.001}]')
    tetrahedra = meshes.mesh_of({"soil": [("tetra", *meshes.box("tetra", (2, 1, 1)))]})
    path = meshes.write(folder / "soil.msh", tetrahedra)
    _, nodes = np.unique(tetrahedra.points, axis=0, return_index=True)
    assert len(nodes) == len(tetrahedra.points)
    cuboid = {"type": "cuboid", "point_p1": [1.1, 0.6, 0.6], "point_p2": [2.1, 1.6, 1.6]}
    sphere = {"type": "sphere", "center": [4.1, 1.1, 1.3], "diameter": 1.0}
    corners = [[5.1, 0.6, 1.1], [6.1, 0.6, 1.1], [6.1, 0.6, 2.1]]
    prism = {"type": "polygon_2d", "points": corners, "extrude_direction": "y"}
    box = {"point_p1": [1.1, 0.6, 1.225], "point_p2": [2.1, 1.6, 1.475]}
    fields = {"fields": ["position", "displacement", "stress", "pressure"], "every": 5}
    return {
        "time": 1.0,
        "gravity": [0.3, 0.1, -9.81],
        "mesh": {"cells_number": [16, 8, 12], "cells_dimension": [0.5, 0.5, 0.5]},
        "materials": [{"type": "elastic", "id": 1, "density": 2e3, "young": 1e6, "poisson": 0.2}],
        "body": [
            cuboid | {"material_id": 1},
            sphere | {"material_id": 1, "initial_velocity": [-1.0, 0.0, 0.0]},
            prism | {"material_id": 1, "extrude_displacement": 0.5},
            {"type": "particles_from_file", "file": str(folder / "pebbles.json"), "material_id": 1},
            {
                "type": "particles",
                "material_id": 1,
                "particles": {"position": [[2.6, 2.6, 2.6]], "volume": [0.02]},
            },
            {
                "type": "gmsh",
                "mesh_file": str(path),
                "physical_to_material": {"soil": 1},
                "particle_distribution": "per_cell",
                "initial_velocity": [0.0, 0.0, 1.0],
            },
        ],
        "nodal_point_load": [[[1.75, 1.25, 1.25], [10.0, 0.0, 0.0]]],
        "load_distributed_box": [box | {"load": [0.0, 50.0, 0.0]}],
        "prescribed_velocity": [
            {"point_p1": [4.1, 0.6, 1.3], "point_p2": [4.6, 1.6, 1.8], "velocity": [-1, 0, None]}
        ],
        "hydro_mechanical_coupling": {
            "enabled": True,
            "pore_pressure_field": str(folder / "pressures.json"),
            "interpolation": "linear",
        },
        "terrain_contact": {
            "active": True,
            "stl_mesh": str(folder / "ground.stl"),
            "friction": 0.3,
        },
        "results": {
            "print": 1,
            "material_point_results": ["displacement", "distance_levelset"],
            "probes": [
                {"type": "points", "points": [[1.6, 1.1, 1.1], [4.1, 1.1, 1.3]]} | fields,
                {"type": "points", "points": [[1.3, 0.9, 1.4]], "interpolation": "nearest"}
                | fields,
                {"type": "box", "reduction": "sum"} | box | fields,
            ],
        },
    }


def test_every_kind_of_position(tmp_path):
    case = mpmgeo.load_case(all_of_it(tmp_path))
    far, near = both(case, tmp_path)
    assert_same(far, near, case)
    np.testing.assert_array_equal(far.field("pressure"), near.field("pressure"))
    np.testing.assert_array_equal(far.field("distance_levelset"), near.field("distance_levelset"))
    for one, other in zip(far._histories, near._histories, strict=True):
        axes = [name.partition("position_")[2] for name in one.sampler.columns]
        moves = np.array([dict(zip("xyz", FAR, strict=True)).get(axis, 0.0) for axis in axes])
        if one.path.stem == "probe_3":
            moves *= one.sampler.row()[0]  # a sum of positions
        values = [np.array(history.sampler.row(), float) for history in (one, other)]
        if one.path.parent.name == "probes":
            still = moves == 0
            np.testing.assert_array_equal(values[0][still], values[1][still])
            assert values[0] == pytest.approx(values[1] + moves, rel=1e-12)


def test_pores(tmp_path):
    pores = {"density_fluid": 1e3, "porosity": 0.4, "bulk_fluid": 5e7}
    pores |= {"hydraulic_conductivity": [1e-4, 1e-4, 1e-4]}
    soil = {"type": "elastic", "id": 1, "density": 2600.0, "young": 1e7, "poisson": 0.2}
    low = {"point_p1": [0.1, 0.1, 0.1], "point_p2": [0.2, 0.2, 0.225]}
    top = {"point_p1": [0.1, 0.1, 0.275], "point_p2": [0.2, 0.2, 0.3]}
    case = mpmgeo.load_case(
        {
            "time": 1.0,
            "n_phases": 2,
            "gravity": [0.0, 0.0, -10.0],
            "mesh": {"cells_number": [4, 4, 4], "cells_dimension": [0.1, 0.1, 0.1]},
            "materials": [soil | pores],
            "body": [
                {
                    "type": "cuboid",
                    "point_p1": [0.1, 0.1, 0.1],
                    "point_p2": [0.2, 0.2, 0.3],
                    "material_id": 1,
                }
            ],
            "initial_pressure_box": [low | {"pressure": 100.0}],
            "prescribed_pressure_box": [top | {"pressure": 7.0}],
            "pressure_force_box": [low | {"pressure_force": [0.0, 1e-3, 0.0]}],
        }
    )
    far, near = both(case, tmp_path)
    assert_same(far, near, case)
    np.testing.assert_array_equal(far.field("pressure"), near.field("pressure"))
    assert (far.field("pressure") == 7.0).sum() == 4
