"""Files of a terrain, and its distances and forces in those of particles and grid."""

import numpy as np
import pytest
import pyvista
import terrains
from terrains import on_slope, simulate

from mpmgeo.output.pvd import listed

FOLDER = "centroid_points_stl_contact"
FORCES = [f"particle_contact_force{part}" for part in ("", "_normal", "_tangential")]


def written(folder, tmp_path, **keys):
    """Run a resting block for some steps and return where its files are."""
    case = on_slope(tmp_path, 0, 0.5, size=(2, 1, 1))
    case["results"] = {"print": 2, **keys}
    simulation = simulate(case | {"time": 0.02, "time_step": 1e-3})
    simulation.output = folder
    simulation.run()
    return simulation


def test_terrain_files_hold_what_was_asked_for(tmp_path):
    simulation = written(tmp_path / "out", tmp_path, stl_contact_mesh=["all"])
    collection = tmp_path / "out" / FOLDER / f"{FOLDER}TimeSerie.pvd"
    assert [name for _, name in listed(collection)] == [f"{FOLDER}_{k}.vtu" for k in (1, 2, 3)]
    points = pyvista.read(tmp_path / "out" / FOLDER / f"{FOLDER}_3.vtu")
    assert points["stl_normal"] == pytest.approx(np.tile([0, 0, 1], (2, 1)))
    assert points["stl_density_levelset"].shape == (2,)
    assert points.points == pytest.approx(terrains.plane().mean(axis=1), rel=1e-6)
    assert simulation.solver.ground is not None


def test_by_default_the_terrain_is_written_once(tmp_path):
    written(tmp_path / "out", tmp_path)
    assert [f.name for f in sorted((tmp_path / "out" / FOLDER).glob("*.vtu"))] == [
        f"{FOLDER}_1.vtu"
    ]
    assert not pyvista.read(tmp_path / "out" / FOLDER / f"{FOLDER}_1.vtu").array_names


def test_without_a_terrain_there_is_no_folder(tmp_path):
    case = on_slope(tmp_path, 0, 0.5, size=(1, 1, 1))
    del case["terrain_contact"]
    simulation = simulate(case | {"time": 0.002, "time_step": 1e-3})
    simulation.output = tmp_path / "out"
    simulation.run()
    assert not (tmp_path / "out" / FOLDER).exists()


def test_distances_and_forces_are_in_the_files(tmp_path):
    keys = {"material_point_results": ["all"], "grid_nodal_results": ["all"]}
    simulation = written(tmp_path / "out", tmp_path, **keys)
    particles = pyvista.read(tmp_path / "out" / "particles" / "particles_3.vtu")
    assert particles["Distance-levelset"] == pytest.approx(particles.points[:, 2], abs=1e-6)
    total, normal, along = (particles[name] for name in FORCES)
    assert total == pytest.approx(normal + along)
    touching = particles["particle_contact_flag"] == 1
    assert (normal[touching, 2] > 0).all()
    assert not total[~touching].any()
    assert 0 < touching.sum() <= len(touching) // 2
    grid = pyvista.read(tmp_path / "out" / "grid" / "eulerianGrid_3.vtu")
    assert grid["distance level set"] == pytest.approx(grid.points[:, 2], abs=1e-6)
    volume = simulation.field("volume").sum()
    assert grid["density levelset"].sum() == pytest.approx(volume, rel=1e-3)  # cells of 1 m³
    assert "Seismic Node" not in grid.array_names


def test_the_density_between_nodes(tmp_path):
    """Full inside a body, half at its face, nothing outside."""
    simulation = simulate(on_slope(tmp_path, 0, 0.5, size=(4, 4, 4)))
    contact = simulation.solver.ground
    x = np.array([[2.0, 2, 2], [2, 2, 0], [2, 2, 20], [2, 0, 0], [1e9, 0, 0]])
    density = contact.density_at(simulation.solver, x - simulation.case.mesh.origin)
    assert density == pytest.approx([1, 0.5, 0, 0.25, 0])


def test_nodes_near_ground_that_shakes_are_marked(tmp_path):
    (tmp_path / "record.csv").write_text("t,x,y,z\n0,1,0,0\n9,1,0,0\n")
    case = on_slope(tmp_path, 0, 0.5, size=(1, 1, 1), time=0.002, time_step=1e-3)
    case["earthquake"] = {"active": True, "file": str(tmp_path / "record.csv")}
    simulation = simulate(case)
    simulation.output = tmp_path / "out"
    simulation.run()
    grid = pyvista.read(tmp_path / "out" / "grid" / "eulerianGrid_1.vtu")
    assert (grid["Seismic Node"] == (np.abs(grid.points[:, 2]) < 0.25)).all()
