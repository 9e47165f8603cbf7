"""The manual's table of the keys of MPM-Geomechanics: complete, and every row is accepted."""

import json
import re
from pathlib import Path

import meshes
import pytest
import terrains

from mpmgeo.case.load import CaseError, load_case
from mpmgeo.simulation import Simulation

PAGE = Path(__file__).parents[2] / "manual" / "compatibility-keys.md"
ROW = re.compile(r"^\| `([^`]+)` \| `([^`]+)` \| ([^|]*) \| ([^|]*) ?\|$", re.MULTILINE)
FOUND = ROW.findall(PAGE.read_text("utf-8"))
ROWS = [(key, json.loads(text)) for key, text, _, _ in FOUND]

BOX = {"point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
PLANES = [f"plane_{axis}{side}" for side in "0n" for axis in "XYZ"]
STRENGTHS = ("friction", "cohesion", "tensile")
SOFT = [f"softening.{name}.{key}" for name in STRENGTHS for key in ("residual", "active")]

# The keys that MPM-Geomechanics reads, by their place.
KEYS = {
    "": "time time_step critical_time_step_multiplier stress_scheme_update shape_function n_phases "
    "n_threads gravity save_state load_state mesh material materials body results damping "
    "nodal_point_load load_distributed_box prescribed_pressure_box initial_pressure_box "
    "initial_pressure_material pressure_force_box terrain_contact earthquake "
    "hydro_mechanical_coupling",
    "mesh.": "cells_number cells_dimension origin boundary_conditions_fluid",
    "mesh.boundary_conditions.": " ".join(PLANES),
    "materials.elastic.": "type id density young poisson density_fluid porosity bulk_fluid "
    "hydraulic_conductivity",
    "materials.newtonian.": "viscosity bulk",
    "materials.mohr-coulomb.": "young poisson friction dilation cohesion tensile "
    "su_vertical_stress softening softening.exponential.eta " + " ".join(SOFT),
    "body.cuboid.": "type active id material_id initial_velocity point_p1 point_p2",
    "body.sphere.": "center diameter particles_per_direction",
    "body.polygon_2d.": "extrude_direction extrude_displacement discretization_length points",
    "body.particles.particles.": "id position volume material_id",
    "body.particles_list.": "file material_id",
    "body.particles_from_file.": "file",
    "body.gmsh.": "mesh_file physical_to_material particle_distribution",
    "load_distributed_box.*.": "point_p1 point_p2 load",
    "prescribed_pressure_box.*.": "point_p1 point_p2 pressure",
    "initial_pressure_box.*.": "point_p1 point_p2 pressure",
    "initial_pressure_material.*.": "material material_id pressure",
    "pressure_force_box.*.": "point_p1 point_p2 pressure_force",
    "damping.": "type value alpha",
    "terrain_contact.": "active stl_mesh friction distance_threshold penalty_contact_active "
    "penalty_stiffness",
    "earthquake.": "active file header",
    "hydro_mechanical_coupling.": "enabled type pore_pressure_field",
    "results.": "print material_point_results grid_nodal_results stl_contact_mesh",
}

# What a key needs around it, by its place.
WATER = {
    "density_fluid": 1000,
    "porosity": 0.4,
    "bulk_fluid": 1e8,
    "hydraulic_conductivity": [1e-3, 1e-3, 1e-3],
}
STONE = {"id": 1, "density": 2000, "young": 1e6, "poisson": 0.3} | WATER
AROUND = {
    "materials.elastic": {"type": "elastic"} | STONE,
    "materials.mohr-coulomb": STONE | {"type": "mohr-coulomb", "friction": 30, "cohesion": 1e3},
    "materials.newtonian": {"type": "newtonian", "id": 1, "density": 1000, "bulk": 1e6},
    "body.cuboid": {"type": "cuboid", "material_id": 1} | BOX,
    "body.sphere": {"type": "sphere", "material_id": 1, "center": [1, 1, 1], "diameter": 1},
    "body.polygon_2d": {
        "type": "polygon_2d",
        "material_id": 1,
        "points": [[0, 0, 0], [1, 1, 0], [0, 1, 1]],
        "extrude_direction": "y",
        "extrude_displacement": 1,
    },
    "body.particles": {
        "type": "particles",
        "particles": {
            "id": [0, 1],
            "position": [[1, 1, 1], [1.5, 1, 1]],
            "volume": [0.1, 0.1],
            "material_id": [1, 1],
        },
    },
    "body.particles_list": {"type": "particles_list", "file": "list.json"},
    "body.particles_from_file": {"type": "particles_from_file", "file": "list.json"},
    "body.gmsh": {"type": "gmsh", "mesh_file": "soil.msh", "physical_to_material": {"soil": 1}},
    "load_distributed_box.*": BOX | {"load": [0, 0, 1]},
    "prescribed_pressure_box.*": BOX | {"pressure": 1},
    "initial_pressure_box.*": BOX | {"pressure": 1},
    "initial_pressure_material.*": {"pressure": 1, "material_id": 1},
    "pressure_force_box.*": BOX | {"pressure_force": [0, 0, 1]},
    "damping": {"type": "local"},
    "terrain_contact": {"active": True, "stl_mesh": "terrain.stl"},
    "earthquake": {"active": True, "file": "record.csv"},
    "hydro_mechanical_coupling": {"enabled": True, "pore_pressure_field": "pressures.json"},
}

# What the last column of the table calls an error or a warning, by key.
ERRORS = {
    "time_step": [-1],
    "critical_time_step_multiplier": [0, -1, "0.5"],
    "n_phases": [1.5],
    "save_state": ["yes", 1],
    "mesh.cells_number": [[4.5, 4, 4]],
    "materials.elastic.type": ["plastic"],
    "materials.elastic.id": [1.5],
    "materials.elastic.density": [0],
    "materials.elastic.young": ["2e6"],
    "materials.elastic.poisson": [0.5, 0.6],
    "materials.elastic.density_fluid": [0],
    "materials.elastic.porosity": [0],
    "materials.elastic.bulk_fluid": [0],
    "materials.elastic.hydraulic_conductivity": [[0, 0, 0]],
    "materials.mohr-coulomb.softening": ["linear"],
    "body.cuboid.type": ["cone"],
    "body.cuboid.active": ["yes"],
    "body.cuboid.material_id": [9],
    "body.cuboid.point_p2": [[-1, 1, 1], [0, 1, 1]],
    "body.polygon_2d.extrude_direction": ["w"],
    "body.polygon_2d.extrude_displacement": [0, -1],
    "body.polygon_2d.discretization_length": [-1],
    "body.polygon_2d.points": [[[0, 0, 0], [1, 0, 0]]],
    "body.particles.particles.position": [[[1, 1, 1]]],
    "body.gmsh.physical_to_material": [{"sand": 1}],
    "body.gmsh.particle_distribution": ["random"],
    "nodal_point_load": [[[[9, 9, 9], [0, 0, -1]]]],
    "load_distributed_box.*.point_p1": [None],
    "load_distributed_box.*.point_p2": [None],
    "load_distributed_box.*.load": [None],
    "prescribed_pressure_box.*.point_p1": [None],
    "initial_pressure_material.*.pressure": [None],
    "damping.value": [-0.1],
    "earthquake.file": ["none.csv", "list.json"],
    "hydro_mechanical_coupling.type": ["two_way"],
    "hydro_mechanical_coupling.pore_pressure_field": ["none.json", "record.csv"],
    "results.print": ["20"],
}
WARNINGS = {
    "material": [[{"type": "elastic"} | STONE]],
    "materials.elastic.id": [1],
    "earthquake.active": [None],
    "earthquake.header": [True],
    "hydro_mechanical_coupling.enabled": [None],
    "results.material_point_results": [["stres"]],
}
RAISED_LATER = {"load_state"}  # whether the saved state fits is known once there are particles


def entries(table):
    return [pytest.param(key, value, id=f"{key}={value}") for key in table for value in table[key]]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working directory, with the files that the rows name."""
    monkeypatch.chdir(tmp_path)
    entry = {"position": [1, 1, 1], "volume": 0.1, "material_id": 1, "pressure": 5}
    for name in ("list.json", "pressures.json"):
        (tmp_path / name).write_text(json.dumps([entry]))
    (tmp_path / "record.csv").write_text("t,x,y,z\n0,0,0,0\n1,0,0,0\n")
    (tmp_path / "terrain.stl").write_text(terrains.text_of(terrains.plane()))
    group = {"soil": [("hexahedron", *meshes.box("hexahedron"))]}
    meshes.write(tmp_path / "soil.msh", meshes.mesh_of(group))


def case_with(key, value):
    """Return a case with a value at a key of the table."""
    case = {
        "time": 0.1,
        "mesh": {"cells_number": [4, 4, 4], "cells_dimension": [0.5, 0.5, 0.5]},
        "materials": {"soil": AROUND["materials.elastic"]},
        "body": {"block": AROUND["body.cuboid"]},
    }
    if key == "material":
        del case["materials"]
    place = max((p for p in AROUND if key.startswith(f"{p}.")), key=len, default=None)
    if place is None:
        *path, last = key.split(".")
        node = case
        for step in path:
            node[step] = node = dict(node.get(step, {}))
        node[last] = value
        return case
    entry, rest = json.loads(json.dumps(AROUND[place])), key.removeprefix(f"{place}.")
    if place.startswith("materials"):
        entry[rest] = value
        case["materials"]["other"] = entry
        if entry["id"] == 1:
            del case["materials"]["soil"]
        return case
    node = entry
    while "." in rest:
        step, _, rest = rest.partition(".")
        node = node[step]
    node[rest] = value
    if rest == "material":
        del node["material_id"]
    top, _, kind = place.partition(".")
    case[top] = entry if not kind else {"entry": entry}
    return case


def test_table_is_complete():
    wanted = {place + key for place, keys in KEYS.items() for key in keys.split()}
    assert {key for key, _ in ROWS} == wanted


def test_every_line_of_the_tables_is_a_row():
    lines = [line for line in PAGE.read_text("utf-8").splitlines() if line.startswith("| `")]
    assert len(lines) == len(ROWS)


@pytest.mark.parametrize(("key", "value"), ROWS, ids=[f"{key}={value}"[:60] for key, value in ROWS])
def test_row(folder, key, value):
    try:
        loaded = load_case(case_with(key, value))
    except CaseError as error:
        pytest.fail("; ".join(error.problems))
    assert not [warning for warning in loaded.warnings if "ignored" in warning]


@pytest.mark.parametrize(("word", "table"), [("an error", ERRORS), ("a warning", WARNINGS)])
def test_what_the_table_promises_is_tried(word, table):
    promised = {key for key, _, _, difference in FOUND if word in difference}
    assert promised - RAISED_LATER <= set(table)


@pytest.mark.parametrize(("key", "value"), entries(ERRORS))
def test_error_of_a_row(folder, key, value):
    phases = {"n_phases": 2} if key.rpartition(".")[2] in WATER else {}
    with pytest.raises(CaseError) as error:
        load_case(case_with(key, value) | phases)
    name = key.rpartition(".")[2] if "softening" not in key else "softening"
    assert any(name in problem for problem in error.value.problems)


@pytest.mark.parametrize(("key", "value"), entries(WARNINGS))
def test_warning_of_a_row(folder, key, value):
    case = case_with(key, value)
    soil = {"type": "elastic"} | STONE
    if key == "material":
        case["materials"] = [soil]
    elif key == "materials.elastic.id":
        case["materials"] = [soil, soil]
    elif key == "earthquake.header":
        Path("record.csv").write_text("0,0,0,0\n1,0,0,0\n")
    assert load_case(case).warnings


def test_a_missing_state_is_an_error(folder):
    with pytest.raises(ValueError, match="load_state"):
        Simulation(load_case(case_with("load_state", True)))


OF_THE_FLUID = [
    (key, value)
    for key, value in ROWS
    if "pressure_" in key.partition(".")[0] or key.rpartition(".")[2] in WATER or "fluid" in key
]


@pytest.mark.parametrize(("key", "value"), OF_THE_FLUID, ids=[key for key, _ in OF_THE_FLUID])
def test_row_with_two_phases(folder, key, value):
    """What belongs to the fluid acts, so that there is nothing to note but an old spelling."""
    loaded = load_case(case_with(key, value) | {"n_phases": 2})
    assert not loaded.notes
    assert not loaded.warnings
