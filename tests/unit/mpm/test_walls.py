"""Which planes cut shapes that end at walls, also when planes change during a run."""

from types import SimpleNamespace

import numpy as np
import pytest
from assembly import assemble, by_row, nodes, planes

from mpmgeo.boundaries.base_motion import BaseMotion
from mpmgeo.boundaries.planes import FREE
from mpmgeo.loads.record import Record
from mpmgeo.mpm.effects.base import Base
from mpmgeo.mpm.effects.tools import Tools
from mpmgeo.shapes import SHAPES, shape_of
from mpmgeo.shapes.shape import cuts
from mpmgeo.state.grid import walls_of
from mpmgeo.verify.plain import PlainSolver

inf = np.inf
CELLS = np.array([6, 5, 4])
ENDING = [name for name in SHAPES if cuts(shape_of(name))]
SHAPE = pytest.mark.parametrize("shape", ENDING)
RECORD = Record(np.array([0.0, 2.5e-3]), np.zeros((2, 3)))


def full(shape="quadratic-bspline", **more):
    """Return the solver of particles all over a mesh of one-metre cells, in random motion."""
    random = np.random.default_rng(2)
    position = random.uniform(0.01, 0.99, (400, 3)) * CELLS
    velocity = random.normal(size=(400, 3))
    more = {"stress": random.normal(size=(400, 6)) * 1e4} | more
    cells = tuple(CELLS.tolist())
    return assemble(position, velocity=velocity, shape=shape_of(shape), cells=cells, **more)


def walls(solver):
    return tuple(np.concatenate(walls_of(solver.grid.frame)))


def test_planes_that_hold_cut():
    solver = full(planes=planes("free", plane_X0="fixed", plane_Yn="sliding"))
    assert walls(solver) == (0, -inf, -inf, inf, 5, inf)
    assert walls(full()) == (-inf, -inf, -inf, inf, inf, inf)


def test_moving_planes_cut():
    """A base, and a plane with a prescribed velocity, though it counts as free."""
    assert walls(full(effects=(Base(BaseMotion(RECORD)),)))[2] == 0
    tool = SimpleNamespace(at=lambda t: (np.nan, 1.0, np.nan))
    assert walls(full(effects=(Tools([tool], [(1, 1)]),))) == (*3 * (-inf,), inf, 5, inf)


@SHAPE
def test_no_node_beyond_a_wall_takes_part(shape):
    solver = full(shape, planes=planes("sliding", plane_Zn="free"))
    for _ in range(3):
        solver.step()
    index, mass, *_ = nodes(solver)
    assert mass.sum() == pytest.approx(400, rel=1e-13)
    assert index.min() == 0 and (index[:, :2] <= CELLS[:2]).all()
    assert index[:, 2].max() > CELLS[2]


@SHAPE
def test_a_wall_holds_what_is_on_it(shape):
    """Weight and velocity of a particle at a fixed plane are those of its nodes there."""
    position = [[2.3, 2.6, 1e-12], [2.3, 2.6, 0.9], [3.1, 2.2, 0.6]]
    solver = assemble(
        position, velocity=(1, 2, 3), shape=shape_of(shape), planes=planes(plane_Z0="fixed")
    )
    solver.step()
    index, mass, velocity, _ = nodes(solver)
    assert not velocity[index[:, 2] == 0].any()
    assert mass[index[:, 2] == 0].sum() > 1.0
    moved = np.abs(by_row(solver, "x") - position).max(axis=1)
    assert moved[0] < 1e-14 < moved[1]


@SHAPE
@pytest.mark.parametrize("before, after", [("free", "sliding"), ("fixed", "free")])
def test_planes_that_change_during_a_run(shape, before, after):
    solver = full(shape, planes=planes(before))
    for _ in range(3):
        solver.step()
    solver.bound(planes(after))
    twin = PlainSolver(solver)
    for _ in range(5):
        solver.step()
        twin.step()
    for name in ("x", "v", "stress"):
        expected = getattr(twin, name)
        found = np.array(by_row(solver, name))
        assert np.abs(found - expected).max() < 1e-11 * np.abs(expected).max(), name


class Released(BaseMotion):
    """A base that is free when its record has ended."""

    def planes_after(self, planes):
        return planes._replace(z0=FREE)


def test_the_end_of_a_record_and_a_state_before_it():
    solver = full(effects=(Base(Released(RECORD)),))
    solver.step()
    kept = solver.keep()
    assert walls(solver)[2] == 0
    for _ in range(4):
        solver.step()
    assert walls(solver)[2] == -inf
    assert nodes(solver)[0][:, 2].min() < 0
    solver.restore(kept)
    assert walls(solver)[2] == 0
