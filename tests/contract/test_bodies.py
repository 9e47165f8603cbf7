"""What every body keeps: its declaration, its particles, the mass of its shape, its velocity."""

import json
from dataclasses import fields, is_dataclass
from math import pi

import meshes
import numpy as np
import pytest

import mpmgeo
from mpmgeo.bodies import BODIES
from mpmgeo.bodies.elements import ELEMENTS
from mpmgeo.case.load import load_case

DENSITY = 1700.0
SIDE = 2.0
"""Edge of the mesh [m], in whose middle all bodies are."""

BODY = pytest.mark.parametrize("body", BODIES, ids=[body.type for body in BODIES])
RNG = np.random.default_rng(7)
CENTERS = RNG.uniform(0.6, 1.4, (40, 3)).tolist()
VOLUMES = RNG.uniform(1e-4, 1e-3, 40).tolist()
ENTRIES = [
    {"position": place, "volume": volume, "material_id": 1}
    for place, volume in zip(CENTERS, VOLUMES, strict=True)
]
COLUMNS = {"position": CENTERS, "volume": VOLUMES, "material_id": 40 * [1]}
TRIANGLE = [[0.5, 0, 0.5], [1.5, 0, 0.5], [0.5, 0, 1.4]]

SHAPES = {
    "cuboid": ({"point_p1": [0.5, 0.5, 0.5], "point_p2": [1.5, 1.0, 1.5]}, 0.5, 5.0),
    "sphere": ({"center": [1, 1, 1], "diameter": 1}, pi / 6, pi),
    "polygon_2d": (
        {"points": TRIANGLE, "extrude_direction": "y", "extrude_displacement": 0.5},
        0.225,
        0.5 * (1 + 0.9 + (1 + 0.9**2) ** 0.5) + 0.9,
    ),
    "particles": ({"particles": COLUMNS}, sum(VOLUMES), 0.0),
    "particles_from_file": ({"file": "particles.json"}, sum(VOLUMES), 0.0),
    "particles_list": ({"file": "particles.json"}, sum(VOLUMES), 0.0),
    "gmsh": ({"mesh_file": "box.msh", "physical_to_material": {"box": 1}}, 0.6 * 0.5 * 0.7, 0.0),
}
"""Keys of a body of each kind, its volume [m³], and the area [m²] that may cut its particles."""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """The working directory, with the files that bodies come from."""
    (tmp_path / "particles.json").write_text(json.dumps(ENTRIES))
    write_box(tmp_path / "box.msh", "tetra")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write_box(path, kind, **options):
    part = (kind, *meshes.box(kind, (3, 2, 3), (0.5, 0.6, 0.7), (1.1, 1.1, 1.4)))
    meshes.write(path, meshes.mesh_of({"box": [part]}), **options)


def simulation(kind, keys, cell=0.25, **others):
    """Return the simulation of one body in a mesh of cubes."""
    body = {"type": kind, **keys}
    if kind in ("cuboid", "sphere", "polygon_2d"):
        body["material_id"] = 1
    law = {"type": "elastic", "id": 1, "density": DENSITY, "young": 1e6, "poisson": 0.3}
    case = {
        "time": 1.0,
        "mesh": {"cells_number": 3 * [round(SIDE / cell)], "cells_dimension": 3 * [cell]},
        "materials": [law],
        "body": [body],
        **others,
    }
    return mpmgeo.Simulation(load_case(case))


@BODY
def test_declaration(body):
    assert is_dataclass(body) and body.__dataclass_params__.frozen
    assert body.__doc__.splitlines()[0].endswith(".")
    assert all(field.metadata["doc"] for field in fields(body))


def test_type_words_differ():
    assert len({body.type for body in BODIES}) == len(BODIES)


@BODY
def test_particles(body):
    """Positions and sizes go together; the order does not depend on who asks."""
    keys = SHAPES[body.type][0]
    first, second = simulation(body.type, keys), simulation(body.type, keys)
    position = first.field("position")
    assert len(position) > 0
    assert ((position > 0) & (position < SIDE)).all()
    assert (first.solver.population.size > 0).all()
    assert (first.field("body") == 1).all()
    assert (first.field("material") == 1).all()
    np.testing.assert_array_equal(first.field("id"), np.arange(len(position)))
    np.testing.assert_array_equal(position, second.field("position"))


@BODY
@pytest.mark.parametrize("cell", [0.25, 0.125, 0.0625])
def test_mass_is_density_times_volume(body, cell):
    """Up to the layer of particles in which the surface lies, and exactly where there is none."""
    keys, volume, area = SHAPES[body.type]
    made = simulation(body.type, keys, cell)
    mass = made.field("mass")
    layer = 0.25 * area * cell / 2 if body.type != "cuboid" else 0.0
    assert abs(mass.sum() - DENSITY * volume) <= DENSITY * (layer + 1e-9 * volume)
    np.testing.assert_allclose(made.field("volume") * DENSITY, mass, rtol=1e-13)


@pytest.mark.parametrize("distribution", ["barycentric", "gaussian", "per_cell"])
@pytest.mark.parametrize("kind", ELEMENTS)
def test_mass_of_every_kind_of_element(folder, kind, distribution):
    write_box(folder / "box.msh", kind)
    keys, volume, _ = SHAPES["gmsh"]
    made = simulation("gmsh", keys | {"particle_distribution": distribution}, 0.125)
    assert made.field("mass").sum() == pytest.approx(DENSITY * volume, rel=1e-12)
    position = made.field("position")
    assert (position > (0.5, 0.6, 0.7)).all() and (position < (1.1, 1.1, 1.4)).all()
    center = (made.field("mass")[:, None] * position).sum(axis=0) / made.field("mass").sum()
    np.testing.assert_allclose(center, [0.8, 0.85, 1.05], atol=0.02)


@BODY
def test_half_size_is_at_most_half_a_cell(body):
    for cell in (0.25, 0.03125):
        made = simulation(body.type, SHAPES[body.type][0], cell)
        for particles in made.solver.sets:
            assert np.max(particles.half) <= 0.5


@BODY
def test_initial_velocity(body):
    keys = SHAPES[body.type][0] | {"initial_velocity": [1.0, -2.0, 0.5]}
    velocity = simulation(body.type, keys).field("velocity")
    np.testing.assert_array_equal(velocity, np.tile([1.0, -2.0, 0.5], (len(velocity), 1)))


@BODY
def test_resolved_case_is_the_same_case(body):
    from mpmgeo.case.load import resolved

    case = simulation(body.type, SHAPES[body.type][0]).case
    assert load_case(resolved(case)) == case
