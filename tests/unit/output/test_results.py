"""The files of a run: which, when, with what in them; what becomes of those of the run before."""

from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from assembly import simulate, two_blocks

import mpmgeo.output.results as results
from mpmgeo.run.watch import Diverged

EVERYTHING = {"material_point_results": ["all"], "grid_nodal_results": ["all"]}


def run(folder, shown=None, **keys):
    """Return the simulation of two blocks, 50 steps, with its files in `folder`."""
    case = two_blocks(results={"print": 5} | (shown or {}), **keys)
    return simulate(case, output=folder).run()


def listed(path):
    """Return the times and files of a collection."""
    entries = list(ElementTree.parse(path).iter("DataSet"))
    times = [float(entry.get("timestep")) for entry in entries]
    return times, [path.parent / entry.get("file") for entry in entries]


def collections(folder):
    particles = listed(folder / "particles" / "particleTimeSerie.pvd")
    return particles, listed(folder / "grid" / "gridTimeSerie.pvd")


def energies(folder):
    """Return the rows of the energy file (n, 2)."""
    header, *rows = (folder / "time-energy.csv").read_text().splitlines()
    assert header == "time,energy"
    return np.array([[float(x) for x in row.split(",")] for row in rows])


def files(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_files_and_their_times(tmp_path):
    simulation = run(tmp_path, EVERYTHING)
    names = [f"particles/particles_{k}.vtu" for k in range(1, 7)]
    names += [f"grid/eulerianGrid_{k}.vtu" for k in range(1, 7)]
    names += ["particles/particleTimeSerie.pvd", "grid/gridTimeSerie.pvd", "time-energy.csv"]
    assert files(tmp_path) == sorted(names)
    for times, paths in collections(tmp_path):
        assert times == pytest.approx([0, 0.01, 0.02, 0.03, 0.04, 0.05])
        assert [int(path.stem.split("_")[1]) for path in paths] == [1, 2, 3, 4, 5, 6]
        assert all(path.exists() for path in paths)
    assert times[-1] == simulation.time


def test_default_is_one_grid_file(tmp_path):
    run(tmp_path)
    particles, grid = collections(tmp_path)
    assert len(particles[0]) == 6 and grid[0] == [0.0]
    mesh = meshio.read(grid[1][0])
    assert set(mesh.point_data) == {"NodeId"} and set(mesh.cell_data) == {"CellId"}
    assert set(meshio.read(particles[1][3]).point_data) == {"Particle Id", "Displacement"}


def test_none_means_the_initial_particles_only(tmp_path):
    run(tmp_path, {"material_point_results": ["none"]})
    (times, paths), _ = collections(tmp_path)
    assert times == [0.0] and files(tmp_path / "particles") == [
        "particleTimeSerie.pvd",
        "particles_1.vtu",
    ]
    assert not meshio.read(paths[0]).point_data
    assert len(energies(tmp_path)) == 6


def test_only_the_asked_for_fields(tmp_path):
    shown = {
        "material_point_results": ["stress", "velocity", "id"],
        "grid_nodal_results": ["mass", "active"],
    }
    simulation = run(tmp_path, shown)
    (_, particles), (_, grid) = collections(tmp_path)
    mesh = meshio.read(particles[-1])
    names = [f"Stress_{axes}" for axes in ("XX", "YY", "ZZ", "XY", "XZ", "YZ")]
    assert list(mesh.point_data) == ["Particle Id", "Velocity", *names]
    assert (mesh.points == simulation.field("position")).all()
    assert (mesh.point_data["Velocity"] == simulation.field("velocity")).all()
    assert mesh.point_data["Particle Id"].dtype == np.uint64
    mesh = meshio.read(grid[-1])
    assert list(mesh.point_data) == ["Active", "Mass"]
    assert mesh.point_data["Mass"].sum() == pytest.approx(simulation.field("mass").sum())
    assert len(mesh.cells[0].data) == 12 * 10 * 14


def test_energy_is_that_of_the_state_of_the_same_label(tmp_path):
    run(tmp_path, {"material_point_results": ["velocity"]})
    (times, particles), _ = collections(tmp_path)
    rows = energies(tmp_path)
    assert rows[:, 0].tolist() == times
    mass = simulate(two_blocks()).field("mass")
    for (_, energy), path in zip(rows, particles, strict=True):
        velocity = meshio.read(path).point_data["Velocity"]
        assert energy == pytest.approx(0.5 * mass @ (velocity**2).sum(axis=1), rel=1e-12)


def test_energy_before_kinetic_damping_stops_the_particles(tmp_path):
    """Every step is an output; rows show the energies that made the damping act."""
    case = two_blocks(results={"print": 0}, damping={"type": "kinetic"}, time=0.2)
    case["body"][1]["initial_velocity"] = [0, 0, -10.0]
    simulate(case, output=tmp_path).run()
    energy = energies(tmp_path)[:, 1]
    assert len(energy) == 201 and (energy > 0).all()
    assert (np.diff(energy) < 0).any()


def test_labels_as_mpm_geomechanics(tmp_path):
    """A step early, but for the initial state."""
    simulation = run(tmp_path, compatibility="mpm-geomechanics")
    (times, _), _ = collections(tmp_path)
    assert times == pytest.approx([0, 0.009, 0.019, 0.029, 0.039, 0.049])
    assert energies(tmp_path)[:, 0].tolist() == times
    assert simulation.time == pytest.approx(0.05)


@pytest.mark.parametrize(
    "wanted, steps, every, outputs",
    [(5, 50, 10, 6), (7, 50, 7, 8), (0, 12, 1, 13), (-3, 12, 1, 13), (100, 12, 1, 13)],
)
def test_number_of_outputs(tmp_path, wanted, steps, every, outputs):
    """1 + floor(steps / R), R the floor of steps over the wanted number, at least one."""
    simulation = run(tmp_path, {"print": wanted}, time=(steps - 0.5) * 1e-3 + 0.5e-3)
    assert simulation.output_interval == every
    (times, _), _ = collections(tmp_path)
    assert len(times) == 1 + simulation.steps // every == outputs
    assert times == pytest.approx(1e-3 * every * np.arange(outputs))


# What was there before


def test_files_of_the_run_before_are_removed(tmp_path):
    run(tmp_path, {"print": 50} | EVERYTHING)
    assert len(files(tmp_path)) == 105
    mine = tmp_path / "particles" / "of_mine.vtu"
    mine.write_text("not listed")
    simulation = run(tmp_path, {"print": 2})
    assert files(tmp_path / "particles") == [
        "of_mine.vtu",
        "particleTimeSerie.pvd",
        *(f"particles_{k}.vtu" for k in (1, 2, 3)),
    ]
    assert files(tmp_path / "grid") == ["eulerianGrid_1.vtu", "gridTimeSerie.pvd"]
    assert mine.read_text() == "not listed"
    assert len(energies(tmp_path)) == 3
    (message,) = [m for m in simulation.messages if "other .vtu" in m]
    assert "1 other" in message and "of_mine.vtu" in message and "grid" not in message


def test_no_output_without_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    simulate(two_blocks()).run()
    assert files(tmp_path) == []


def test_building_writes_nothing(tmp_path):
    simulate(two_blocks(), output=tmp_path / "new")
    assert not (tmp_path / "new").exists()


# Runs that do not come to their end


class Stop:
    """Ends a run in a step, in the way that it is given."""

    def __init__(self, step, act):
        self.step, self.act = step, act

    def begin(self, simulation):
        pass

    def after_step(self, simulation):
        if simulation.steps == self.step:
            self.act(simulation)

    def end(self, simulation, error):
        pass


def broken(simulation):
    raise RuntimeError


def poisoned(simulation):
    for s in simulation.solver.sets:
        s.stress[5] = np.nan


def test_a_broken_run_shows_its_last_state(tmp_path):
    case = two_blocks(results={"print": 5} | EVERYTHING)
    simulation = simulate(case, output=tmp_path)
    with pytest.raises(RuntimeError):
        simulation.run(watchers=[Stop(23, broken)])
    for times, paths in collections(tmp_path):
        assert times == pytest.approx([0, 0.01, 0.02, 0.023])
        assert all(path.exists() for path in paths)
    last = collections(tmp_path)[0][1][-1]
    assert (meshio.read(last).points == simulation.field("position")).all()
    assert energies(tmp_path)[-1] == pytest.approx([0.023, simulation.kinetic_energy()])


def test_a_run_broken_at_an_output_writes_it_once(tmp_path):
    simulation = simulate(two_blocks(results={"print": 5}), output=tmp_path)
    with pytest.raises(RuntimeError):
        simulation.run(watchers=[Stop(20, broken)])
    assert collections(tmp_path)[0][0] == pytest.approx([0, 0.01, 0.02])


def test_a_diverged_run_shows_nothing_but_sound_states(tmp_path):
    """Particles and nodes: what failed in step 25 is in no file."""
    case = two_blocks(results={"print": 5} | EVERYTHING)
    simulation = simulate(case, output=tmp_path)
    with pytest.raises(Diverged):
        simulation.run(watchers=[Stop(25, poisoned)])
    (times, particles), (_, grid) = collections(tmp_path)
    assert times == pytest.approx([0, 0.01, 0.02])
    for path in (*particles, *grid):
        for name, values in meshio.read(path).point_data.items():
            assert np.isfinite(values).all(), (path.name, name)
    assert np.isfinite(energies(tmp_path)).all()


def test_the_last_sound_state_of_a_diverged_run_is_whole(tmp_path, monkeypatch):
    """It lies between two outputs here; its nodes must not be those of the step that failed."""
    monkeypatch.setattr("mpmgeo.run.watch.EVERY", 7)
    case = two_blocks(results={"print": 1} | EVERYTHING)
    simulation = simulate(case, output=tmp_path)
    with pytest.raises(Diverged):
        simulation.run(watchers=[Stop(25, poisoned)])
    (times, particles), (grid_times, grid) = collections(tmp_path)
    assert times == grid_times == pytest.approx([0, 0.021])
    for path in (particles[-1], grid[-1]):
        for name, values in meshio.read(path).point_data.items():
            assert np.isfinite(values).all(), (path.name, name)
    twin = simulate(case).step(21)
    assert (meshio.read(particles[-1]).points == twin.field("position")).all()


# Huge meshes


def huge(cells, **shown):
    """Return a case with two small blocks in a mesh of cells³ cells."""
    mesh = {"cells_number": [cells] * 3, "cells_dimension": [0.5] * 3, "origin": [-5.0, -5.0, -5.0]}
    shown = {"print": 5, "grid_nodal_results": ["id", "mass", "active", "velocity"]} | shown
    return two_blocks(mesh=mesh, results=shown)


def check_grid_file(path, simulation):
    """Return a grid file, nodes of which are where their numbers say, as are cells."""
    mesh = meshio.read(path)
    count = np.array(simulation.case.mesh.cells_number) + 5
    number = mesh.point_data["NodeId"].astype(np.int64)
    index = np.stack(np.unravel_index(number, count[::-1])[::-1], axis=1)
    assert mesh.points == pytest.approx((index - 2) * 0.5 - 5.0)
    assert (np.ptp(mesh.points[mesh.cells[0].data], axis=1) == 0.5).all()
    lowest = number[mesh.cells[0].data[:, 0]]
    assert (mesh.cell_data["CellId"][0] == lowest).all()
    return mesh


def test_a_huge_mesh_shows_touched_blocks_only(tmp_path):
    """27 million cells; the files hold those near the particles, also as these move on."""
    simulation = simulate(huge(300), output=tmp_path).run()
    _, (times, paths) = collections(tmp_path)
    assert len(times) == 6
    total = simulation.field("mass").sum()
    masses = []
    for path in paths:
        mesh = check_grid_file(path, simulation)
        assert 100 < len(mesh.cells[0].data) < 10_000
        masses.append(mesh.point_data["Mass"].sum())
    assert masses[0] == 0.0 and masses[1:] == pytest.approx([total] * 5)
    (message,) = [m for m in simulation.messages if "cells" in m]
    assert f"{304**3} cells" in message and "grid_all_cells" in message


@pytest.mark.parametrize("asked", [False, True])
def test_all_cells_on_request(tmp_path, monkeypatch, asked):
    monkeypatch.setattr(results, "MANY_CELLS", 24**3 - 1)
    simulation = simulate(huge(20, grid_all_cells=asked), output=tmp_path).run()
    mesh = check_grid_file(collections(tmp_path)[1][1][-1], simulation)
    assert (len(mesh.cells[0].data) == 24**3) is asked
    assert any("cells" in m for m in simulation.messages) is not asked
    assert mesh.point_data["Mass"].sum() == pytest.approx(simulation.field("mass").sum())


def test_as_many_cells_as_the_limit_are_shown(tmp_path, monkeypatch):
    monkeypatch.setattr(results, "MANY_CELLS", 24**3)
    simulation = simulate(huge(20), output=tmp_path).run()
    mesh = check_grid_file(collections(tmp_path)[1][1][-1], simulation)
    assert len(mesh.cells[0].data) == 24**3


def test_touched_blocks_hold_what_all_cells_hold(tmp_path, monkeypatch):
    """The same nodes with the same values, whichever way they are written."""
    states = []
    for limit in (10**7, 0):
        monkeypatch.setattr(results, "MANY_CELLS", limit)
        folder = tmp_path / str(limit)
        simulate(huge(20), output=folder).run()
        mesh = meshio.read(collections(folder)[1][1][-1])
        used = mesh.point_data["Active"] == 1
        states.append([mesh.points[used], *(values[used] for values in mesh.point_data.values())])
    for all_cells, touched in zip(*states, strict=True):
        assert (all_cells == touched).all()


def test_no_file_is_left_half_written(tmp_path):
    run(tmp_path, EVERYTHING)
    assert not list(Path(tmp_path).rglob("*.part"))
