"""Terrains that cannot be used are refused before anything is written, with the reason."""

import json

import numpy as np
import pytest
import terrains

import mpmgeo
from mpmgeo.case.load import CaseError, load_case
from mpmgeo.cli import main

GROUND = terrains.plane(0.0, 1.0)


@pytest.fixture
def case(folder, monkeypatch):
    """A cube that lies on level ground."""
    (folder / "ground.stl").write_bytes(terrains.binary_of(GROUND))
    return {
        "time": 0.01,
        "time_step": 1e-3,
        "mesh": {"cells_number": [6, 6, 6], "cells_dimension": [0.5, 0.5, 0.5]},
        "materials": [terrains.STONE],
        "body": [
            {"type": "cuboid", "point_p1": [1, 1, 1], "point_p2": [2, 2, 2], "material_id": 1}
        ],
        "terrain_contact": {"active": True, "stl_mesh": "ground.stl"},
    }


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"stl_mesh": None}, "terrain_contact.stl_mesh"),
        ({"stl_mesh": "missing.stl"}, 'terrain_contact.stl_mesh: there is no file "missing.stl"'),
        ({"stl_mesh": 5}, "terrain_contact.stl_mesh: 5"),
        ({"friction": -0.1}, "terrain_contact.friction: -0.1"),
        ({"friction": "rough"}, 'terrain_contact.friction: "rough"'),
        ({"distance_threshold": "near"}, 'terrain_contact.distance_threshold: "near"'),
        ({"penalty_stiffness": -1}, "terrain_contact.penalty_stiffness: -1"),
        ({"penalty_contact_active": 1}, "terrain_contact.penalty_contact_active: 1"),
        ({"active": "yes"}, 'terrain_contact.active: "yes"'),
    ],
    ids=str,
)
def test_bad_keys(case, keys, message):
    case["terrain_contact"] |= keys
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert caught.value.problems[0].startswith(message)


def test_file_is_required(case):
    del case["terrain_contact"]["stl_mesh"]
    with pytest.raises(CaseError, match="stl_mesh: is required when active is true"):
        load_case(case)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the file is empty"),
        (terrains.binary_of(GROUND)[:-20], "cut short"),
        (terrains.text_of(GROUND)[:200].encode(), "cut short"),
        (b"\x89PNG\r\n\x1a\n", "no STL file"),
        (terrains.binary_of(np.full((3, 3, 3), np.nan)), "coordinates that are no numbers"),
        (terrains.binary_of(np.ones((3, 3, 3))), "none of the 3 triangles has an area"),
    ],
    ids=["empty", "short binary", "short text", "picture", "nan", "flat"],
)
def test_bad_files(case, folder, content, message):
    (folder / "ground.stl").write_bytes(content)
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert caught.value.problems[0].startswith("terrain_contact.stl_mesh: ")
    assert message in caught.value.problems[0]


@pytest.mark.parametrize(
    ("triangles", "message"),
    [
        (GROUND[:, ::-1], "is the surface inside out?"),
        (GROUND + [0, 0, 100], "no triangle in the mesh"),
    ],
)
def test_bad_places_end_the_run_before_it_begins(case, folder, triangles, message, capsys):
    (folder / "ground.stl").write_bytes(terrains.binary_of(triangles))
    (folder / "case.json").write_text(json.dumps(case))
    assert main(["--input", "case.json", "--output", "results"]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert "Traceback" not in error
    assert not (folder / "results").exists()


def test_a_few_particles_below_are_told(case):
    case["body"][0] |= {"point_p1": [1, 1, 0.5]}
    simulation = mpmgeo.Simulation(load_case(case))
    [message] = [m for m in simulation.messages if "below the surface" in m]
    assert "16 of 96 particles begin below the surface" in message


def test_a_radius_of_nothing_is_the_usual_one(case):
    case["terrain_contact"]["distance_threshold"] = 0
    loaded = load_case(case)
    assert loaded.terrain_contact.distance_threshold == 2.0
    assert "stands for the usual radius" in loaded.notes[0]


def test_a_terrain_that_is_off_need_not_exist(case):
    case["terrain_contact"] = {"active": False, "stl_mesh": "missing.stl", "friction": "any"}
    assert load_case(case, strict=True).terrain_contact is None
    del case["terrain_contact"]["active"]
    assert "without effect" in load_case(case).warnings[0]
