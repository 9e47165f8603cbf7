"""From a valid file to a Case: values, defaults, order, files."""

import json
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from mpmgeo.bodies import Cuboid
from mpmgeo.boundaries.planes import BoundaryConditions
from mpmgeo.case.load import CaseError, load_case
from mpmgeo.damping import NoDamping
from mpmgeo.loads import PointLoad
from mpmgeo.materials import Elastic

ORACLES = Path(__file__).parents[4] / "shared" / "oracles"
SUPPORTED = (
    "boussinesq",
    "bouncing_cuboid_musl",
    "external_force",
    "initial_velocity",
    "seismic_column",
    "slope_kinetic_damping",
    "slope_local_damping",
    "vibrating_base",
)


def test_values_and_defaults(case):
    loaded = load_case(case)
    assert loaded.time == 0.1
    assert loaded.gravity == (0.0, 0.0, 0.0)
    assert loaded.mesh.cells_number == (4, 4, 4)
    assert loaded.mesh.upper == (2.0, 2.0, 2.0)
    assert loaded.mesh.boundary_conditions == BoundaryConditions()
    assert loaded.materials == (Elastic(id=1, density=2000.0, young=1e6, poisson=0.3),)
    assert loaded.body == (Cuboid(point_p1=(0, 0, 0), point_p2=(1, 1, 1), material_id=1),)
    assert loaded.damping == NoDamping()
    assert loaded.earthquake is None
    assert loaded.compatibility is None
    assert loaded.results.print == 10
    assert loaded.results.particle_fields == ("id", "displacement")
    assert (loaded.notes, loaded.warnings) == ((), ())
    assert loaded.folder == Path.cwd()


def test_numbers_have_the_declared_types(case):
    case["time"] = 1
    case["mesh"]["cells_number"] = [4.0, 4, 4]
    loaded = load_case(case)
    assert type(loaded.time) is float
    assert [type(n) for n in loaded.mesh.cells_number] == [int] * 3
    assert [type(x) for x in loaded.body[0].point_p1] == [float] * 3


def test_a_case_is_frozen(case):
    with pytest.raises(FrozenInstanceError):
        load_case(case).time = 2


def test_the_source_is_left_alone(case):
    before = json.dumps(case)
    load_case(case | {"gravity": None})
    assert json.dumps(case) == before


def test_entries_of_objects_come_in_alphabetical_order(case):
    block = case["body"]["block"]
    case["body"] = {
        "zz": block | {"initial_velocity": [1, 0, 0]},
        "Aa": block | {"initial_velocity": [2, 0, 0]},
        "aa": block | {"initial_velocity": [3, 0, 0]},
    }
    assert [body.initial_velocity[0] for body in load_case(case).body] == [2, 3, 1]
    case["body"] = list(case["body"].values())
    assert [body.initial_velocity[0] for body in load_case(case).body] == [1, 2, 3]


def test_loads_in_either_form(case):
    load = PointLoad(point=(1, 1, 1), force=(0, 0, -1))
    for form in (
        [[[1, 1, 1], [0, 0, -1]]],
        {"a": [[1, 1, 1], [0, 0, -1]]},
        [{"position": [1, 1, 1], "force": [0, 0, -1]}],
        [{"point": [1, 1, 1], "force": [0, 0, -1]}],
    ):
        assert load_case(case | {"nodal_point_load": form}).nodal_point_load == (load,)


def test_two_materials_of_one_id_are_warned_of(case):
    soil = case["materials"]["soil"]
    case["materials"] = [soil, soil | {"young": 2e6}]
    loaded = load_case(case)
    assert [law.young for law in loaded.materials] == [1e6, 2e6]
    assert loaded.warnings == (
        "materials[1].id: 1 is taken by materials[0], which counts, "
        "but for single particles, which take the last one",
    )


RECORD = "t,ax,ay,az\n0,0,0,0\n1,1,0,0\n"


@pytest.fixture
def folders(tmp_path, monkeypatch):
    """A folder for the case and another one as working directory."""
    beside, work = tmp_path / "beside", tmp_path / "work"
    beside.mkdir()
    work.mkdir()
    monkeypatch.chdir(work)
    return beside, work


def load_with_record(case, folder, name="record.csv"):
    case["earthquake"] = {"active": True, "file": name}
    (folder / "case.json").write_text(json.dumps(case))
    return load_case(folder / "case.json")


def test_files_beside_the_case_come_first(case, folders):
    for folder in folders:
        (folder / "record.csv").write_text(RECORD)
    loaded = load_with_record(case, folders[0])
    assert loaded.earthquake.file == folders[0] / "record.csv"
    assert loaded.folder == folders[0]


def test_files_of_the_working_directory_come_second(case, folders):
    (folders[1] / "record.csv").write_text(RECORD)
    assert load_with_record(case, folders[0]).earthquake.file == folders[1] / "record.csv"


def test_full_paths_are_taken_as_they_are(case, folders):
    file = folders[1] / "record.csv"
    file.write_text(RECORD)
    assert load_with_record(case, folders[0], str(file)).earthquake.file == file


def test_files_of_a_relative_case_are_full_paths(case, folders, monkeypatch):
    (folders[0] / "record.csv").write_text(RECORD)
    load_with_record(case, folders[0])
    monkeypatch.chdir(folders[0])
    loaded = load_case("case.json")
    assert loaded.folder == folders[0]
    assert loaded.earthquake.file.is_absolute()


@pytest.mark.parametrize("name", ["none.csv", "", ".", "x" * 5000, "a\0b", "record.csv/x"])
def test_names_without_a_file(case, folders, name):
    (folders[0] / "record.csv").write_text(RECORD)
    with pytest.raises(CaseError, match=r"earthquake\.file: "):
        load_with_record(case, folders[0], name)


def test_a_dropped_line_of_numbers_is_warned_of(case, folders):
    (folders[0] / "record.csv").write_text("0,0,0,0\n1,1,0,0\n")
    (warning,) = load_with_record(case, folders[0]).warnings
    assert "dropped as heading" in warning


@pytest.mark.parametrize(
    ("given", "fields", "once"),
    [
        (["all"], 17, False),
        (["none", "all", "stress"], 0, True),
        (["stress", "id"], 2, False),
        ("none", 0, True),
        ([], 0, False),
    ],
)
def test_particle_fields(case, given, fields, once):
    case["results"] = {"material_point_results": given}
    results = load_case(case).results
    assert len(results.particle_fields) == fields
    assert results.particles_once is once


def test_grid_fields_with_none_keep_the_node_number(case):
    assert load_case(case).results.grid_fields == ("id",)
    assert load_case(case).results.grid_once
    case["results"] = {"grid_nodal_results": ["velocity", "mass"]}
    assert load_case(case).results.grid_fields == ("mass", "velocity")
    assert not load_case(case).results.grid_once


@pytest.mark.skipif(not ORACLES.is_dir(), reason="needs the folder of reference results")
@pytest.mark.parametrize("name", SUPPORTED)
def test_cases_of_the_reference_program_load(name):
    loaded = load_case(ORACLES / name / "case.json", strict=True)
    assert loaded.results.print == 4
    assert (loaded.notes, loaded.warnings) == ((), ())
