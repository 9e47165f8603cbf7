"""A case in coordinates of the mesh: what moves, what stays, what is read from files."""

import json
from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest
import terrains
from assembly import two_blocks

import mpmgeo
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.case.kinds import declared
from mpmgeo.case.load import resolved
from mpmgeo.case.spec import Case, Mesh
from mpmgeo.parameters import HEIGHT

ORIGIN = (500_000.0, 4_500_000.0, -3.0)
EXTENTS = {(Mesh, "cells_dimension")}
"""Three lengths that are no position."""


def classes(cls, seen=None):
    """Return a class of a case and all classes of what it holds."""
    seen = set() if seen is None else seen
    if cls not in seen:
        seen.add(cls)
        for _, kind, _ in declared(cls):
            while kind.item is not None:
                kind = kind.item
            for inner in kind.classes:
                classes(inner, seen)
    return seen


def test_every_position_is_marked():
    """Three lengths are a position, or a list of them is of positions; heights say so."""
    marked = 0
    for cls in classes(Case):
        for _, kind, field in declared(cls):
            vector = kind.item if kind.name == "list" else kind
            is_vector = vector.name == "fixed" and vector.length == 3
            is_place = is_vector and field.metadata["unit"] == "m"
            if field.metadata["place"] == HEIGHT:
                assert kind.name == "number" and field.metadata["unit"] == "m"
                continue
            assert field.metadata["place"] == (is_place and (cls, field.name) not in EXTENTS)
            marked += field.metadata["place"]
    assert marked > 10


def case(**keys):
    made = two_blocks(**keys)
    made["mesh"]["origin"] = list(ORIGIN)
    for body in made["body"]:
        for corner in ("point_p1", "point_p2"):
            body[corner] = (np.array(body[corner]) + ORIGIN).tolist()
    return mpmgeo.load_case(made)


@pytest.mark.parametrize("gravity", [[-10, 0, 0], {"value": [-10, 0, 0]}])
def test_a_height_moves_along_gravity(gravity):
    user = case(gravity=gravity, initial_stress={"water_table": 500_001.5})
    inside = in_mesh(user, user.mesh.origin)
    assert inside.initial_stress.water_table == 1.5
    back = in_mesh(inside, tuple(-o for o in ORIGIN))
    assert back.initial_stress == user.initial_stress
    assert in_mesh(inside, (0.0, 5.0, 5.0)).initial_stress is inside.initial_stress


def test_positions_move_and_nothing_else():
    user = case(nodal_point_load=[[[500_001.0, 4_500_001.0, -2.0], [1.0, 2.0, 3.0]]])
    inside = in_mesh(user, user.mesh.origin)
    assert inside.mesh.origin == (0.0, 0.0, 0.0) and inside.mesh.upper == (4.0, 3.0, 5.0)
    assert inside.body[0].point_p1 == (1.0, 1.0, 1.0)
    assert inside.nodal_point_load[0].point == (1.0, 1.0, 1.0)
    assert inside.nodal_point_load[0].force == (1.0, 2.0, 3.0)
    assert inside.body[1].initial_velocity == user.body[1].initial_velocity
    assert inside.materials is user.materials and inside.results is user.results
    for part in (inside.mesh, *inside.body, *inside.nodal_point_load):
        assert part.zero == ORIGIN


def test_the_users_case_stays_what_it_is():
    user = case()
    mpmgeo.Simulation(user)
    assert user == case() and user.body[0].zero == (0.0, 0.0, 0.0)
    assert mpmgeo.load_case(resolved(user)) == user


def test_a_mesh_at_zero_needs_no_other_case():
    user = mpmgeo.load_case(two_blocks())
    assert in_mesh(user, user.mesh.origin) is user


def test_files_are_read_once(tmp_path):
    """In coordinates of the mesh, whatever the case says of itself."""
    path = tmp_path / "ground.stl"
    path.write_text(terrains.text_of(terrains.box([0, 0, -5], [9, 9, 0.5]) + np.array(ORIGIN)))
    points = tmp_path / "pressures.json"
    place = np.add(ORIGIN, 1.0).tolist()
    points.write_text(json.dumps([{"position": place, "pressure": 1.0}]))
    user = case(
        terrain_contact={"active": True, "stl_mesh": str(path)},
        hydro_mechanical_coupling={"enabled": True, "pore_pressure_field": str(points)},
    )
    inside = in_mesh(user, user.mesh.origin)
    assert inside.terrain_contact is user.terrain_contact
    assert inside.terrain_contact.surface.corner.min(axis=(0, 1)).tolist() == [0.0, 0.0, -5.0]
    assert inside.hydro_mechanical_coupling is user.hydro_mechanical_coupling
    assert inside.hydro_mechanical_coupling.points.position.tolist() == [[1.0, 1.0, 1.0]]
    rougher = replace(user, terrain_contact=replace(user.terrain_contact, friction=0.7))
    found = in_mesh(rougher, user.mesh.origin).terrain_contact
    assert found.friction == 0.7 and found.surface.corner.max() == 9.0


@pytest.mark.parametrize("cls", sorted(classes(Case), key=lambda c: c.__name__))
def test_parts_are_dataclasses_without_hidden_fields(cls):
    """So that they move whole: what a case is made of is what it declares."""
    hidden = {"notes", "warnings", "folder"} if cls is Case else set()
    assert is_dataclass(cls)
    assert {f.name for f in fields(cls) if "doc" not in f.metadata} == hidden
