"""The six planes: the rule at one node against plain steps, then their place in the mesh."""

from itertools import product

import numpy as np
import pytest
from assembly import SIDES, assemble, nodes, planes

from mpmgeo.boundaries.planes import (
    BASE,
    FIXED,
    FREE,
    SLIDING,
    BoundaryConditions,
    Planes,
    constrain,
    touches,
)
from mpmgeo.state.grid import SIDE, Mesh

MESH = Mesh.of((1.0, 1.0, 1.0), (5, 6, 7))
CELLS = (5, 6, 7)
VECTOR, PUSH = (1.0, -2.0, 3.0), (10.0, 20.0, 30.0)


def applied_in_turn(kinds, node, upper_wins, on_base):
    """Return the vector after the planes one by one: X0 Y0 Z0 Xn Yn Zn, as upstream does it."""
    v = np.array(VECTOR)
    beyond = [node[a] <= 0 for a in range(3)] + [node[a] >= CELLS[a] for a in range(3)]
    base = kinds[2] == BASE and beyond[2]
    for side, kind in enumerate(kinds):
        if not beyond[side] or (base and not upper_wins and side != 2):
            continue
        if kind == FIXED:
            v[:] = 0
        elif kind == SLIDING:
            v[side % 3] = 0
        elif kind == BASE and on_base:
            v = np.array(PUSH)
    return v


@pytest.mark.parametrize("floor", [FREE, SLIDING, FIXED, BASE])
def test_every_node_with_every_combination_of_planes(floor):
    """Faces, edges and corners; one side of each axis differs from the other."""
    places = [(0, 3, n, -1, n + 2) for n in CELLS]
    for kinds in product((FREE, SLIDING, FIXED), repeat=5):
        kinds = (*kinds[:2], floor, *kinds[2:])
        for node in product(*(p[:3] for p in places)):
            for upper_wins, on_base in ((False, True), (True, True), (True, False)):
                symbols = Planes(*kinds, upper_wins=upper_wins)
                v = constrain(symbols, MESH, *node, *VECTOR, PUSH, on_base)
                expected = applied_in_turn(kinds, node, upper_wins, on_base)
                assert v == tuple(expected), (kinds, node, upper_wins, on_base)


def test_ghost_nodes_belong_to_their_plane():
    symbols = planes("sliding", plane_Yn="fixed")
    for node, expected in {
        (-2, 3, 3): (0.0, -2.0, 3.0),
        (7, 3, -1): (0.0, -2.0, 0.0),
        (3, 8, 3): (0.0, 0.0, 0.0),
        (4, 5, 6): VECTOR,
    }.items():
        assert constrain(symbols, MESH, *node, *VECTOR, PUSH, True) == expected


def test_blocks_that_touch_a_plane():
    for cells in range(1, 14):
        for corner in range(-2, 5):
            reached = [n <= 0 or n >= cells for n in range(corner * SIDE, corner * SIDE + SIDE)]
            assert touches(corner, cells, SIDE) == any(reached)


def test_not_said_means_sliding():
    assert set(BoundaryConditions().kinds().values()) == {"sliding"}
    symbols = Planes.of(BoundaryConditions(plane_Y0="free", plane_Zn="fixed"))
    assert symbols == (SLIDING, FREE, SLIDING, SLIDING, SLIDING, FIXED, False)
    assert tuple(BoundaryConditions().kinds()) == SIDES


def filled(cell, cells, symbols):
    """Return the nodes of a mesh full of particles of random velocity after a step of 1 ms."""
    random = np.random.default_rng(8)
    position = random.uniform(0.001, 0.999, (3000, 3)) * np.array(cell) * cells
    velocity = random.uniform(0.5, 1.0, (3000, 3))
    extra = {"cell": cell, "cells": cells, "planes": symbols}
    solver = assemble(position, velocity=velocity, gravity=(-1.0, -2.0, -3.0), **extra)
    solver.step()
    return nodes(solver)


GRIDS = {
    "cubes": ((1.0, 1.0, 1.0), (5, 6, 7)),
    "anisotropic": ((0.1, 2.5, 0.75), (8, 4, 9)),
}


@pytest.mark.parametrize("side", range(6))
@pytest.mark.parametrize("grid", GRIDS.values(), ids=GRIDS)
@pytest.mark.parametrize("kind", ["sliding", "fixed"])
def test_place_of_each_plane(grid, side, kind):
    """Lower planes at 0, upper ones at N cells; nothing is held elsewhere."""
    index, _, velocity, acceleration = filled(*grid, planes(**{SIDES[side]: kind}))
    axis, cells = side % 3, grid[1]
    held = index[:, axis] <= 0 if side < 3 else index[:, axis] >= cells[axis]
    assert held.any() and (held != (np.abs(index[:, axis] - 3) < 2)).any()
    components = [axis] if kind == "sliding" else [0, 1, 2]
    free = [a for a in range(3) if a not in components]
    for values in (velocity, acceleration):
        assert not values[held][:, components].any()
        assert values[held][:, free].all()
        assert values[~held].all()
