"""What contact with a terrain costs: a step with and without, and the distances before it.

python benchmarks/terrain.py [--particles 512000] [--rounds 7] [--triangles 100000]
"""

import argparse
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
from contest import Contest, Table
from scenes import CELL, SOLID, TIME_STEP, simulation

from mpmgeo.boundaries.distance import Ground, fill
from mpmgeo.boundaries.surface import surface_of
from mpmgeo.numerics.chunks import crew_of
from mpmgeo.state.grid import Mesh
from mpmgeo.state.layout import NODES

HEIGHT = 5  # cells: ten layers of particles, of which one touches
MARGIN = 4  # cells around the slab
PLANES = ("X0", "Y0", "Z0", "Xn", "Yn", "Zn")


def slab(side, terrain):
    """Return the case of a slab of side × side × HEIGHT cells that lies on a terrain, if given."""
    low = [MARGIN * CELL] * 2 + [MARGIN * CELL]
    body = {
        "type": "cuboid",
        "point_p1": low,
        "point_p2": [low[0] + side * CELL, low[1] + side * CELL, low[2] + HEIGHT * CELL],
        "material_id": 1,
    }
    case = {
        "time": 1.0,
        "time_step": TIME_STEP,
        "gravity": [1.0, 0.0, -9.81],
        "mesh": {
            "cells_number": [side + 2 * MARGIN] * 2 + [HEIGHT + 2 * MARGIN],
            "cells_dimension": 3 * [CELL],
            "boundary_conditions": {f"plane_{plane}": "free" for plane in PLANES},
        },
        "materials": [SOLID],
        "body": [body],
    }
    if terrain:
        case["terrain_contact"] = {"active": True, "stl_mesh": str(terrain), "friction": 0.3}
    return case


def write_plane(path, height, width):
    """Write a level square as an ASCII STL file."""
    a, b = (0.0, 0.0, height), (width, width, height)
    c, d = (width, 0.0, height), (0.0, width, height)
    lines = ["solid plane"]
    for triangle in ((a, c, b), (a, b, d)):
        lines += ["facet normal 0 0 1", "outer loop"]
        lines += [f"vertex {x} {y} {z}" for x, y, z in triangle]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid plane"]) + "\n")


def compare_contact(table, particles, rounds):
    """Time a step of the slab with and without the terrain under it."""
    side = max(4, round((particles / 8 / HEIGHT) ** 0.5))
    contest = Contest(8 * side * side * HEIGHT)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plane.stl"
        write_plane(path, MARGIN * CELL, (side + 2 * MARGIN) * CELL)
        runs = {"without": simulation(slab(side, None)), "with": simulation(slab(side, path))}
    for name, run in runs.items():
        run.step(10)
        contest.add(name, run.solver.step)
    contest.run(rounds)
    touching = runs["with"].field("particle_contact_flag").mean()
    table.add("particles", "", runs["with"].solver.count)
    table.add("share of them that touches", "", touching)
    table.add("without a terrain", "million particle-steps/s", *contest.speed("without"))
    table.add("with contact", "million particle-steps/s", *contest.speed("with"))
    table.add("time with / without", "", *contest.ratio("without", "with"), bar="≤ 1.25")


def hills(count):
    """Return about `count` triangles (n, 3, 3) [m] of hills on a square of 10 m."""
    n = round((count / 2) ** 0.5)
    x, y = np.meshgrid(*2 * [np.linspace(0.0, 10.0, n + 1)], indexing="ij")
    p = np.stack([x, y, 2.0 + np.sin(x) * np.cos(y)], axis=-1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    halves = [np.stack(t, axis=-2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))]
    return np.concatenate(halves)


def near_blocks(nodes):
    """Return a mesh over the hills and the blocks along them with about so many nodes."""
    side = round((nodes / NODES / 2) ** 0.5)
    h = 10.0 / side / 4
    mesh = Mesh.of((h, h, h), (4 * side, 4 * side, round(4.0 / h)))
    i, j, k = np.meshgrid(np.arange(side), np.arange(side), np.arange(2), indexing="ij")
    height = 2.0 + np.sin((4 * i + 2) * h) * np.cos((4 * j + 2) * h)
    return mesh, np.stack([i, j, k - 1 + np.round(height / h / 4).astype(int)], -1).reshape(-1, 3)


def time_distances(table, triangles, nodes, rounds):
    """Time all that is done between reading a surface and its distances at nodes near it."""
    corner = hills(triangles)
    mesh, blocks = near_blocks(nodes)
    out = np.empty((len(blocks), NODES))
    table.add("triangles", "", len(corner))
    table.add("nodes near the surface", "", out.size)
    for threads in (2, 1):
        crew, parts = crew_of(threads), []
        for _ in range(rounds):
            begin = time.perf_counter()
            surface = surface_of(corner, np.zeros((len(corner), 3)))
            joined = time.perf_counter()
            ground = Ground.of(surface, 3 * (0.0,), 3 * (10.0,), 0.01 * mesh.hx)
            fill(crew, ground, mesh, 1.0, blocks, out)
            end = time.perf_counter()
            parts.append((joined - begin, end - joined))
        joining, distances = (np.array(seconds) for seconds in zip(*parts, strict=True))
        label = f"{threads} threads" if threads > 1 else "1 thread"
        bar = "≤ 2" if threads > 1 else None
        if threads > 1:
            table.add("triangles joined", "s", median(joining), joining.min(), joining.max())
        row = (median(distances), distances.min(), distances.max())
        table.add(f"tree and distances, {label}", "s", *row, bar=bar)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--triangles", type=int, default=100_000)
    parser.add_argument("--nodes", type=int, default=1_000_000)
    arguments = parser.parse_args()
    table = Table("terrain")
    compare_contact(table, arguments.particles, arguments.rounds)
    time_distances(table, arguments.triangles, arguments.nodes, arguments.rounds)
    table.write()


if __name__ == "__main__":
    main()
