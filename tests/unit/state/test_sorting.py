"""Sorting: every particle in its block, nothing lost, nothing moved without need."""

import numpy as np
import pytest
from assembly import assemble
from hypothesis import given, settings
from hypothesis import strategies as st
from models import Spline6, Spline10

from mpmgeo.numerics.chunks import ALONE, crew_of
from mpmgeo.shapes import SHAPES
from mpmgeo.state.grid import corners_of
from mpmgeo.state.sorting import Walls, sort

SHAPES_BY_WIDTH = {2: SHAPES["linear"], 3: SHAPES["GIMP"], 6: Spline6(), 10: Spline10()}
CELL, CELLS = (0.5, 0.25, 1.0), (20, 16, 24)
LOW, HIGH = np.zeros(3), np.array(CELL) * CELLS


def scattered(count, seed=0, width=3, split=1):
    """Return the solver of particles all over the mesh, not yet sorted."""
    random = np.random.default_rng(seed)
    solver = assemble(
        random.uniform(LOW, HIGH, (count, 3)),
        mass=np.arange(count) + 1.0,
        velocity=random.normal(size=(count, 3)),
        stress=random.normal(size=(count, 6)),
        shape=SHAPES_BY_WIDTH[width],
        cells=CELLS,
        cell=CELL,
        split=split,
    )
    return solver.grid, solver.sets


def base_corner(x, width):
    """Return the corners of the blocks that hold the first nodes of stencils around x (n, 3)."""
    g = (x - LOW) * (1 / np.array(CELL))
    return np.floor(g - 0.5 * (width - 2)).astype(int) // 4


def snapshot(s):
    """Return the particles by row: all that is theirs as one table (n, 14)."""
    table = np.column_stack([s.x, s.v, s.m, s.V, s.stress])
    return table[np.argsort(s.row)]


def check_order(grid, s):
    """Each particle of a set is in the range of its block, those outside the mesh are behind."""
    assert len(s.start) == len(grid.keys) + 1 and s.start[0] == 0
    assert (np.diff(s.start) >= 0).all()
    block = np.repeat(np.arange(len(grid.keys)), np.diff(s.start))
    expected = base_corner(s.x[: s.active], grid.widths[0])
    assert (corners_of(grid.keys)[block] == expected).all()
    inside = ((s.x >= LOW) & (s.x <= HIGH)).all(axis=1)
    assert inside[: s.active].all() and not inside[s.active :].any()
    assert s.chunk[-1] == len(grid.keys)


@pytest.mark.parametrize("width", SHAPES_BY_WIDTH)
def test_first_sort(width):
    grid, sets = scattered(500, width=width)
    before = snapshot(sets[0])
    assert sort(grid, sets, ALONE) == [0]
    check_order(grid, sets[0])
    assert (snapshot(sets[0]) == before).all()
    assert len(grid.keys) == len(np.unique(base_corner(sets[0].x, width), axis=0))


moves = st.lists(st.tuples(st.integers(0, 59), st.tuples(*[st.floats(-0.3, 1.3)] * 3)), max_size=60)


@settings(max_examples=100)
@given(st.lists(moves, min_size=1, max_size=3), st.sampled_from([1, 2]))
def test_any_moves(rounds, split):
    """Whatever moves wherever, particles stay the same ones and end up in order."""
    grid, sets = scattered(60, split=split)
    sort(grid, sets, ALONE)
    gone = 0
    for moved in rounds:
        place = {row: (s, p) for s in sets for p, row in enumerate(s.row.tolist())}
        for row, share in moved:
            s, p = place[row]
            if p < s.active:
                s.x[p] = LOW + np.array(share) * (HIGH - LOW)
        before = [snapshot(s) for s in sets]
        gone += sum(sort(grid, sets, ALONE))
        for s, table in zip(sets, before, strict=True):
            check_order(grid, s)
            assert (snapshot(s) == table).all()
        assert gone == sum(len(s.row) - s.active for s in sets)


def test_rows_and_state_move_along():
    """The row is an integer in a kernel of doubles; sizes, loads and law variables move too."""
    grid, sets = scattered(300)
    s = sets[0]
    s.row = np.arange(300) * 2**40 - 7
    s.half = np.column_stack([s.m] * 3) / 1000
    s.force = s.x.copy()
    s.state = np.column_stack([s.m, -s.m])
    rows = dict(zip(s.m.tolist(), s.row.tolist(), strict=True))
    sort(grid, sets, ALONE)
    assert s.row.dtype == np.int64
    assert [rows[m] for m in s.m.tolist()] == s.row.tolist()
    assert (s.force == s.x).all()
    assert (s.half == s.m[:, None] / 1000).all()
    assert (s.state == s.m[:, None] * [1, -1]).all()


def test_only_necessary_moves():
    """A particle whose place is still in its block's range stays there."""
    grid, sets = scattered(3000)
    s = sets[0]
    sort(grid, sets, ALONE)
    s.x[[50, 1700]] = s.x[7]
    block = {tuple(c): b for b, c in enumerate(grid.corner.tolist())}
    target = [block[tuple(c)] for c in base_corner(s.x, 3).tolist()]
    start = np.concatenate([[0], np.cumsum(np.bincount(target, minlength=len(block)))])
    stays = [start[t] <= p < start[t + 1] for p, t in enumerate(target)]
    before = s.row.copy()
    sort(grid, sets, ALONE)
    assert (s.start == start).all()
    assert np.count_nonzero(stays) > 2500
    assert (s.row[stays] == before[stays]).all()


def test_sorting_twice_changes_nothing():
    grid, sets = scattered(300)
    sort(grid, sets, ALONE)
    keys, row = grid.keys, sets[0].row.copy()
    assert sort(grid, sets, ALONE) == [0]
    assert (sets[0].row == row).all() and grid.keys is keys


def test_order_does_not_depend_on_threads():
    orders = []
    for crew in (ALONE, crew_of(2)):
        grid, sets = scattered(3000, split=2)
        random = np.random.default_rng(5)
        for _ in range(3):
            for s in sets:
                s.x[: s.active] += random.normal(0, 0.3, (s.active, 3))
            sort(grid, sets, crew)
        orders.append(np.concatenate([*(s.row for s in sets), *(s.start for s in sets)]))
    assert all((order == orders[0]).all() for order in orders)


def test_outside_and_nan_go_behind_for_good():
    grid, sets = scattered(50)
    s = sets[0]
    sort(grid, sets, ALONE)
    bad = [
        [np.nan, 1.0, 3.0],
        [0.0, np.inf, 3.0],
        [0.0, 1.0, -np.inf],
        LOW - [1e-9, 0, 0],
        HIGH + [0, 0, 1e-9],
        [1e300, 1.0, 3.0],
    ]
    rows = s.row[:6].copy()
    s.x[:6] = bad
    assert sort(grid, sets, ALONE) == [6]
    assert s.active == 44 and set(s.row[44:]) == set(rows)
    s.x[44:] = LOW + 0.1  # back inside, but it has left
    s.x[0] = np.nan
    late = s.row[0]
    assert sort(grid, sets, ALONE) == [1]
    assert s.active == 43 and s.row[43] == late
    check = np.isin(s.row[:43], [*rows, late])
    assert not check.any()


def test_who_passes_a_wall_is_put_back():
    grid, sets = scattered(50)
    s = sets[0]
    sort(grid, sets, ALONE)
    cell = np.array(CELL)
    s.x[0], s.x[1] = LOW - 0.1 * cell, HIGH + 0.1 * cell
    s.x[2:6] = [
        LOW - [1e-12, 0, 0],
        [LOW[0] + 1, LOW[1] - 1e-3, HIGH[2]],
        [LOW[0] - 1, LOW[1] + 1, np.nan],
        HIGH + [0, 0.1, 0],
    ]
    row = s.row[:6].copy()
    walls = Walls(x0=True, y0=True, z0=True, xn=True, zn=True)
    assert sort(grid, sets, ALONE, walls) == [3]
    check_order(grid, s)
    assert set(s.row[s.active :]) == set(row[[1, 4, 5]])
    x = s.x[np.argsort(s.row)][row]
    assert np.abs(x[0] - LOW).max() < 1e-8
    assert x[3] == pytest.approx([LOW[0] + 1, LOW[1], HIGH[2]], abs=1e-8)


def test_the_mesh_is_a_closed_box():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    grid, sets = scattered(8)
    sets[0].x[:] = LOW + corners * (HIGH - LOW)
    assert sort(grid, sets, ALONE) == [0]
    check_order(grid, sets[0])


def test_sets_share_blocks():
    """Ranges of every set run over the blocks of all sets."""
    grid, sets = scattered(300, split=3)
    sets[1].x[:] = LOW + 0.1
    sets[2].x[:] = HIGH + 1.0
    assert sort(grid, sets, ALONE) == [0, 0, 100]
    for s in sets:
        check_order(grid, s)
    assert sets[0].active == 100 and sets[1].active == 100 and sets[2].active == 0
    used = np.concatenate([base_corner(s.x, 3) for s in sets[:2]])
    assert len(grid.keys) == len(np.unique(used, axis=0))


def test_all_particles_leave():
    grid, sets = scattered(20)
    sort(grid, sets, ALONE)
    sets[0].x += 1000.0
    assert sort(grid, sets, ALONE) == [20]
    assert sets[0].active == 0
    assert sort(grid, sets, ALONE) == [0]


def test_no_particles():
    grid, sets = scattered(0)
    assert sort(grid, sets, ALONE) == [0]
    assert len(grid.keys) == 0
