"""Grid files of huge meshes: the cells near particles, or all of them on request."""

from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from assembly import simulate, two_blocks

import mpmgeo.output.results as results


def grid_files(folder):
    """Return the grid files of a run in their order."""
    path = folder / "grid" / "gridTimeSerie.pvd"
    return [path.parent / entry.get("file") for entry in ElementTree.parse(path).iter("DataSet")]


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
    paths = grid_files(tmp_path)
    assert len(paths) == 6
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
    mesh = check_grid_file(grid_files(tmp_path)[-1], simulation)
    assert (len(mesh.cells[0].data) == 24**3) is asked
    assert any("cells" in m for m in simulation.messages) is not asked
    assert mesh.point_data["Mass"].sum() == pytest.approx(simulation.field("mass").sum())


def test_as_many_cells_as_the_limit_are_shown(tmp_path, monkeypatch):
    monkeypatch.setattr(results, "MANY_CELLS", 24**3)
    simulation = simulate(huge(20), output=tmp_path).run()
    mesh = check_grid_file(grid_files(tmp_path)[-1], simulation)
    assert len(mesh.cells[0].data) == 24**3


def test_touched_blocks_hold_what_all_cells_hold(tmp_path, monkeypatch):
    """The same nodes with the same values, whichever way they are written."""
    states = []
    for limit in (10**7, 0):
        monkeypatch.setattr(results, "MANY_CELLS", limit)
        folder = tmp_path / str(limit)
        simulate(huge(20), output=folder).run()
        mesh = meshio.read(grid_files(folder)[-1])
        used = mesh.point_data["Active"] == 1
        states.append([mesh.points[used], *(values[used] for values in mesh.point_data.values())])
    for all_cells, touched in zip(*states, strict=True):
        assert (all_cells == touched).all()
