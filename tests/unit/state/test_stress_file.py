"""The stress file of MPM-Geomechanics, written and read."""

import io
import json

import numpy as np
import pytest

import mpmgeo
from mpmgeo.case.load import load_case
from mpmgeo.state.stress_file import NAME, read_stress, write_stress

CASE = {
    "time": 0.0035,
    "time_step": 1e-3,
    "gravity": [0, 0, -9.81],
    "mesh": {"cells_number": [4, 4, 4], "cells_dimension": [0.5, 0.5, 0.5]},
    "materials": [
        {"type": "elastic", "id": 1, "density": 1000.0, "young": 1e6, "poisson": 0.25},
        {"type": "elastic", "id": 2, "density": 2000.0, "young": 1e6, "poisson": 0.25},
    ],
    "body": [
        {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "material_id": 2},
        {"type": "cuboid", "point_p1": [1, 0, 0], "point_p2": [2, 1, 1], "material_id": 1},
    ],
}


def test_the_form_is_that_of_mpm_geomechanics():
    file = io.BytesIO()
    write_stress(file, np.array([[1.5, 2, 3, 4, 5, 6]]))
    text = file.getvalue().decode()
    assert "\n" not in text
    assert json.loads(text) == [
        {"index": 0, "stress": [[1.5, 4, 6], [4, 2, 5], [6, 5, 3]]},
    ]


def test_every_digit_comes_back(tmp_path):
    stress = np.random.default_rng(3).normal(size=(50, 6)) * 1e5
    with (tmp_path / NAME).open("wb") as file:
        write_stress(file, stress)
    np.testing.assert_array_equal(read_stress(tmp_path / NAME, 50), stress)


def test_entries_may_stand_in_any_order(tmp_path):
    entries = [{"index": n, "stress": (n * np.eye(3)).tolist()} for n in (2, 0, 1)]
    (tmp_path / NAME).write_text(json.dumps(entries))
    np.testing.assert_array_equal(read_stress(tmp_path / NAME, 3)[:, 0], [0, 1, 2])


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_run_saves_its_last_stresses_and_another_begins_with_them(folder):
    first = mpmgeo.Simulation(load_case(CASE | {"save_state": True}), folder).run()
    stress = first.field("stress")
    assert np.abs(stress).max() > 0
    second = mpmgeo.Simulation(load_case(CASE | {"load_state": True}))
    np.testing.assert_array_equal(second.field("stress"), stress)
    assert (second.field("velocity") == 0).all()
    assert (second.field("displacement") == 0).all()


def test_a_run_that_is_cut_short_saves_nothing(folder):
    simulation = mpmgeo.Simulation(load_case(CASE | {"save_state": True}), folder / "out")
    simulation.run(until=0.0015)
    assert not (folder / "out" / NAME).exists()
    simulation.run()
    assert (folder / "out" / NAME).exists()


def test_the_file_beside_the_case_comes_first(folder):
    (folder / "cases").mkdir()
    (folder / "cases" / "case.json").write_text(json.dumps(CASE | {"load_state": True}))
    count = 128
    for place, value in ((folder / "cases", 1.0), (folder, 2.0)):
        with (place / NAME).open("wb") as file:
            write_stress(file, np.full((count, 6), value))
    simulation = mpmgeo.Simulation(load_case(folder / "cases" / "case.json"))
    assert (simulation.field("stress") == 1.0).all()
    (folder / "cases" / NAME).unlink()
    simulation = mpmgeo.Simulation(load_case(folder / "cases" / "case.json"))
    assert (simulation.field("stress") == 2.0).all()
