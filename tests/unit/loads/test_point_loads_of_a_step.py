"""Forces on single nodes: all of them act, and only where there is mass."""

import numpy as np
import pytest
from assembly import assemble, by_row, nodes

from mpmgeo.loads.point import PointLoads
from mpmgeo.shapes import SHAPES

SCHEMES = pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
PLACE = [[4.3, 4.1, 3.9], [4.6, 7.4, 7.9], [3.1, 3.2, 7.6]]
FORCE = np.array([1.0, -2.0, 3.0])


def loaded(node, force, steps=1, **more):
    """Return a solver of three particles after some steps with forces (k, 3) on nodes (k, 3)."""
    loads = PointLoads(node, force)
    solver = assemble(PLACE, mass=2.0, effects=(loads,), **more)
    for _ in range(steps):
        solver.step()
    return solver


def touched():
    """Return the nodes that carry mass, one of each at the least in every active block."""
    return nodes(loaded([[0, 0, 0]], [FORCE]))[0]


@SCHEMES
def test_momentum_grows_by_the_forces(scheme):
    node = touched()[::7]
    force = np.outer(np.arange(len(node)) + 1.0, FORCE)
    solver = loaded(node, force, steps=3, scheme=scheme)
    momentum = by_row(solver, "m") @ by_row(solver, "v")
    assert momentum == pytest.approx(2.5e-3 * force.sum(axis=0), rel=1e-11)


def test_every_node_with_mass_can_be_loaded():
    """Blocks' own nodes and those of their tiles' upper halo, one after the other."""
    for node in touched():
        solver = loaded([node], [FORCE])
        index, mass, _, acceleration = nodes(solver)
        at = (index == node).all(axis=1)
        assert acceleration[at] == pytest.approx(FORCE[None] / mass[at])
        assert not acceleration[~at].any()


def test_many_on_one_node():
    solver = loaded([[4, 4, 4]] * 3 + [[5, 4, 4]], [FORCE, FORCE, 2 * FORCE, 5 * FORCE])
    index, mass, _, acceleration = nodes(solver)
    force = {tuple(n): m * a for n, m, a in zip(index.tolist(), mass, acceleration, strict=True)}
    assert force[4, 4, 4] == pytest.approx(4 * FORCE)
    assert force[5, 4, 4] == pytest.approx(5 * FORCE)


@pytest.mark.parametrize(
    "node", [[6, 3, 3], [1, 9, 1], [-2, -2, -2], [14, 14, 14], [10**5, 0, 0], [-(10**5), 0, 0]]
)
def test_on_an_empty_node_nothing_is_stored_up(node):
    """In an active block and far from all of them; nor does it act once mass has come."""
    solver = loaded([node], [FORCE * 1e6], steps=5)
    assert solver.effect("point loads").idle(solver.grid).tolist() == [True]
    assert not by_row(solver, "v").any()


def test_idle_loads():
    solver = loaded([[4, 4, 4], [9, 9, 9], [4, 7, 8]], [FORCE] * 3)
    assert solver.effect("point loads").idle(solver.grid).tolist() == [False, True, False]


def test_loads_find_their_nodes_again_when_blocks_change():
    """A particle comes to a loaded node through several blocks, feels it, and goes on."""
    loads = PointLoads([[10, 5, 5]], [[0.0, 0.0, 1.0]])
    solver = assemble([[1.6, 5.0, 5.0]], velocity=(50.0, 0.0, 0.0), effects=(loads,))
    impulse = 0.0
    for _ in range(195):
        before = by_row(solver, "v")[0, 2]
        solver.step()
        index, *_ = nodes(solver)
        felt = (index == [10, 5, 5]).all(axis=1).any()
        change = by_row(solver, "v")[0, 2] - before
        assert (change > 0) == felt
        assert loads.idle(solver.grid)[0] == (not felt)
        impulse += change
    assert impulse > 0
    assert by_row(solver, "x")[0, 0] > 11.3


def test_loads_on_a_linear_shape():
    solver = loaded([[4, 4, 3]], [FORCE], shape=SHAPES["linear"])
    momentum = by_row(solver, "m") @ by_row(solver, "v")
    assert momentum == pytest.approx(0.5e-3 * FORCE, rel=1e-12)
