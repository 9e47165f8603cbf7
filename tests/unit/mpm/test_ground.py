"""Distances where particles are, and contact that goes on after a snapshot."""

import numpy as np
import pytest
import terrains
from terrains import on_slope, simulate

import mpmgeo
from mpmgeo.numerics.chunks import ALONE


@pytest.mark.parametrize("offset", [(0.0, 0.0, 0.0), (0.3, 0.0, 0.0), (-5.7, 2.2, 1.9)])
def test_tiles_hold_the_distances_of_the_nodes_under_them(tmp_path, offset):
    simulation = simulate(on_slope(tmp_path, 20, 0.3))
    solver = simulation.solver
    solver.arrange()
    near, grid = solver.ground.near, solver.grid
    near.arrange(grid, offset, ALONE)
    side = 4 + grid.widths[0]
    level = near.level[:-8].reshape(-1, side, side, side)
    assert len(near.near) or offset[2] > 1
    out = terrains.axes(20)[1]
    for s, b in enumerate(near.near):
        first = grid.corner[b] * 4 + near.shift
        index = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), -1) + first
        exact = (index + solver.population.zero) @ out
        known = np.abs(level[s]) < 1e29
        assert level[s][known] == pytest.approx(exact[known], abs=1e-12)
        assert (np.abs(exact[~known]) > 2).all()
        # the particles of the block, as the ground sees them, have their stencils in the tile
        assert (np.floor(np.array(offset) + near.shift) == 0).all() or any(offset)


def test_a_run_goes_on_bit_by_bit_after_a_snapshot(tmp_path):
    rows = "t,x,y,z\n0,3,0,1\n9,3,0,1\n"
    (tmp_path / "record.csv").write_text(rows)
    case = on_slope(tmp_path, 20, 0.2, path=1.0)
    case["earthquake"] = {"active": True, "file": str(tmp_path / "record.csv")}
    whole = simulate(case).step(40)
    whole.save(tmp_path / "state.npz")
    resumed = mpmgeo.Simulation.resume(tmp_path / "state.npz")
    for simulation in (whole, resumed):
        simulation.step(40)
    for key in ("position", "velocity", "stress", "particle_contact_force", "distance_levelset"):
        assert (whole.field(key) == resumed.field(key)).all()
    assert whole.solver.ground.offset == resumed.solver.ground.offset
    assert whole.field("particle_contact_flag").any()


def test_a_penalty_pushes_out_what_overlaps(tmp_path):
    """But never throws it out: what is left after a step is no more than before."""
    for stiffness in (1e5, 1e15):
        case = on_slope(tmp_path, 0, 0.0, size=(2, 1, 1), gap=-0.1)
        case["terrain_contact"] |= {"penalty_contact_active": True, "penalty_stiffness": stiffness}
        simulation = simulate(case)
        simulation.step()
        assert simulation.field("particle_contact_force_normal")[:, 2].max() > 0
        speed = simulation.field("velocity")[:, 2].max()
        assert 0 < speed <= 2 * 0.1 / simulation.time_step


def test_contact_keeps_to_planes_and_tools(tmp_path):
    """A node that a plane or a prescribed velocity holds is not moved by contact."""
    case = on_slope(tmp_path, 20, 0.0, size=(2, 1, 1))
    case["mesh"]["boundary_conditions"] = {f"plane_{p}": "sliding" for p in ("X0", "Y0", "Xn")}
    case["prescribed_velocity"] = {"held": {"body": 1, "velocity": [None, 0.0, None]}}
    simulation = simulate(case).step(20)
    assert not simulation.field("velocity")[:, 1].any()
