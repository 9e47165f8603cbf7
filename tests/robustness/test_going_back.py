"""Going back to the last sound state, whatever takes part in the steps: whole, and fit to go on."""

import json
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from assembly import simulate
from terrains import patch, text_of

from mpmgeo import cli

WATER = {
    "density_fluid": 1000.0,
    "porosity": 0.4,
    "bulk_fluid": 1e6,
    "hydraulic_conductivity": [1e-3, 1e-3, 1e-2],
}
PUSHED = {
    "name": "pushed",
    "point_p1": [0, 0, 0.5],
    "point_p2": [2, 2, 2],
    "velocity": [None, None, -3.0],
    "every": 5,
}
RECORD = "t,ax,ay,az\n" + "".join(f"{n / 500},{3 * (-1) ** n},0,1\n" for n in range(60))
SHOWN = {
    "print": 10,
    "material_point_results": ["id", "displacement", "velocity", "stress"],
    "grid_nodal_results": ["id", "mass", "velocity"],
    "stl_contact_mesh": ["stl_density_levelset", "stl_normal"],
    "probes": [{"type": "planes", "every": 5}],
}


def terrain(case, folder):
    """Let the block lie on a tilted plane."""
    slope = patch(lambda x, y: 0.1 - 0.09 * x + 0 * y, -1.0, 2.0, 12)
    (folder / "ground.stl").write_text(text_of(slope))
    case["terrain_contact"] = {"active": True, "stl_mesh": "ground.stl", "friction": 0.4}


def shaken_terrain(case, folder):
    """Let the plane shake."""
    terrain(case, folder)
    base(case, folder)


def old_terrain(case, folder):
    """Let it be as in MPM-Geomechanics."""
    terrain(case, folder)
    case["compatibility"] = "mpm-geomechanics"


def base(case, folder):
    """Let the lowest plane shake."""
    (folder / "record.csv").write_text(RECORD)
    case["earthquake"] = {"active": True, "file": "record.csv"}


def old_base(case, folder):
    """Let it shake as in MPM-Geomechanics, which holds all planes after the record."""
    base(case, folder)
    case["compatibility"] = "mpm-geomechanics"


def tools(case, folder):
    """Push the upper half of the block down, and a plane against it."""
    case["prescribed_velocity"] = [
        PUSHED,
        {"plane": "Xn", "velocity": [-0.5, None, None], "every": 5},
    ]


def two_phases(case, folder):
    """Fill the pores with water."""
    case["materials"][0] |= WATER
    case["n_phases"] = 2


def rest(case, folder):
    """Stop the particles at peaks of the kinetic energy; load a node."""
    case["damping"] = {"type": "kinetic"}
    case["nodal_point_load"] = [[[0.6, 0.6, 0.8], [0.0, 0.0, -50.0]]]


def second_body(case, folder):
    """Let a fast body begin outside, beside the one inside."""
    far = {"type": "cuboid", "point_p1": [3.0, 0.2, 0.2], "point_p2": [3.2, 0.4, 0.4]}
    case["body"].append(far | {"material_id": 1, "initial_velocity": [2000.0, 0.0, 0.0]})


PARTS = (terrain, shaken_terrain, old_terrain, base, old_base, tools, two_phases, rest)


def case_with(part, folder):
    """Return a case: a soft block is thrown on the floor, and a part of its own."""
    soft = {"type": "elastic", "id": 1, "density": 1000.0, "young": 1e5, "poisson": 0.3}
    body = {"type": "cuboid", "point_p1": [0.4, 0.2, 0.1], "point_p2": [0.8, 1.0, 0.9]}
    case = {
        "time": 1.0,
        "time_step": 1e-4,
        "n_threads": 1,
        "gravity": [0, 0, -9.81],
        "mesh": {
            "cells_number": [12, 12, 12],
            "cells_dimension": [0.1, 0.1, 0.1],
            "boundary_conditions": {"plane_Z0": "fixed"},
        },
        "materials": [soft],
        "body": [body | {"material_id": 1, "initial_velocity": [-0.5, 0.2, -1.0]}],
        "results": SHOWN,
    }
    part(case, folder)
    return case


def state(simulation):
    """Return all that a run holds, arrays as bytes."""
    held = simulation.solver.keep(None)
    return {k: v.tobytes() if isinstance(v, np.ndarray) else v for k, v in held.items()}


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.__name__)
@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_going_back_and_on_is_as_if_nothing_had_happened(part, scheme, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    case = case_with(part, tmp_path) | {"stress_scheme_update": scheme, "time_step": 5e-4}
    simulation = simulate(case).step(150)  # beyond the record's end
    simulation.keep()
    before = state(simulation)
    first = state(simulation.step(40))
    assert first != before
    simulation.restore()
    assert simulation.steps == 150
    assert state(simulation.step(40)) == first
    simulation.restore()
    simulation.keep()  # in the arrays of the copy that it went back to
    assert state(simulation.step(40)) == first


def points_of(folder, name):
    """Return times and meshes of a collection."""
    pvd = folder / name
    entries = list(ElementTree.parse(pvd).iter("DataSet"))
    times = [float(entry.get("timestep")) for entry in entries]
    return times, [meshio.read(pvd.parent / entry.get("file")) for entry in entries]


@pytest.mark.parametrize("part", [*PARTS, second_body], ids=lambda part: part.__name__)
def test_a_run_that_diverges_leaves_its_last_sound_state(part, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    case = case_with(part, tmp_path)
    if part is not second_body:
        case["time_step"] = 5 * simulate(case).critical_time_step
    (tmp_path / "case.json").write_text(json.dumps(case))
    assert cli.main(["case.json", "--output", "out", "--quiet"]) == cli.DIVERGED
    shown = capsys.readouterr().err
    assert "the run diverged in step" in shown and "Traceback" not in shown
    assert not list(tmp_path.rglob("*.part"))
    times, meshes = points_of(tmp_path / "out", "particles/particleTimeSerie.pvd")
    twin = simulate(case)
    while twin.label < times[-1] - 1e-12:
        twin.step()
    assert (meshes[-1].points == twin.field("position")).all()
    assert (meshes[-1].point_data["Velocity"] == twin.field("velocity")).all()
    grid_times, grids = points_of(tmp_path / "out", "grid/gridTimeSerie.pvd")
    assert grid_times == times
    mass = grids[-1].point_data["Mass"].sum()
    assert mass == 0 if twin.steps == 0 else mass == pytest.approx(twin.nodes().mass.sum())
    if "terrain_contact" in case:
        name = "centroid_points_stl_contact"
        terrain_times, terrains = points_of(tmp_path / "out", f"{name}/{name}TimeSerie.pvd")
        assert terrain_times == times
        assert np.isfinite(terrains[-1].point_data["stl_density_levelset"]).all()
