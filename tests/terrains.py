"""Terrains for the tests: planes, hills and boxes of triangles, and bodies that lie on them."""

import numpy as np

import mpmgeo

SPAN = 60.0  # m: half the width of a plane, far beyond every mesh here
STONE = {"type": "elastic", "id": 1, "density": 2000.0, "young": 1e8, "poisson": 0.3}
G = 9.81
FREE = {f"plane_{plane}": "free" for plane in ("X0", "Y0", "Z0", "Xn", "Yn", "Zn")}


def axes(angle):
    """Return the directions downhill and out of a plane tilted by an angle [degrees] about y."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([c, 0.0, -s]), np.array([s, 0.0, c])


def plane(angle=0.0, height=0.0):
    """Return the two triangles of a tilted plane through (0, 0, height)."""
    down, _ = axes(angle)
    side, middle = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, height])
    a, b, c, d = (
        middle + SPAN * (i * down + j * side) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    )
    return np.array([[a, b, c], [a, c, d]])


def patch(height, low, high, count):
    """Return the triangles of z = height(x, y) over a square, `count` squares along an edge."""
    x, y = np.meshgrid(*2 * [np.linspace(low, high, count + 1)], indexing="ij")
    p = np.stack([x, y, height(x, y)], axis=-1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    halves = [np.stack(t, axis=-2).reshape(-1, 3, 3) for t in ((a, b, c), (a, c, d))]
    return np.concatenate(halves)


def box(low, high):
    """Return the twelve triangles of a closed box, their outside outside."""
    p = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * (
        np.array(high, float) - low
    ) + np.array(low)
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return np.array([[p[i] for i in t] for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def text_of(triangles, name="ground"):
    """Return triangles as the text of an ASCII STL file without normals."""
    lines = [f"solid {name}"]
    for triangle in np.asarray(triangles).tolist():
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += [f"  vertex {x!r} {y!r} {z!r}" for x, y, z in triangle]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, f"endsolid {name}"]) + "\n"


def binary_of(triangles, heading=b"made by a test"):
    """Return triangles as the bytes of a binary STL file without normals."""
    records = np.zeros(len(triangles), [("n", "<f4", 3), ("x", "<f4", (3, 3)), ("a", "<u2")])
    records["x"] = triangles
    return heading.ljust(80) + len(triangles).to_bytes(4, "little") + records.tobytes()


def block(angle, size, cell, gap=0.0):
    """Return a body of particles, two a cell, on a plane tilted by an angle through the origin."""
    down, out = axes(angle)
    d = cell / 2
    steps = np.stack(
        np.meshgrid(*[(np.arange(round(l / d)) + 0.5) * d for l in size], indexing="ij"), -1
    ).reshape(-1, 3)
    position = steps @ np.stack([down, [0.0, 1.0, 0.0], out]) + gap * out
    count = len(position)
    particles = {"id": list(range(count)), "position": position.tolist()}
    particles |= {"volume": count * [d**3], "material_id": count * [1]}
    return {"type": "particles", "particles": particles}, position


def on_slope(folder, angle, friction, size=(3, 2, 2), cell=1.0, path=0.0, gap=0.0, **keys):
    """Return the case of a block on a tilted plane, in a mesh with room for a path downhill [m]."""
    body, position = block(angle, size, cell, gap)
    way = path * axes(angle)[0]
    low = np.floor((np.minimum(position, position + way).min(axis=0) - 2 * cell) / cell) * cell
    high = np.maximum(position, position + way).max(axis=0) + 2 * cell
    file = folder / f"plane_{angle}.stl"
    file.write_text(text_of(plane(angle)))
    mesh = {
        "cells_number": np.ceil((high - low) / cell).astype(int).tolist(),
        "cells_dimension": 3 * [cell],
        "origin": low.tolist(),
        "boundary_conditions": FREE,
    }
    terrain = {"active": True, "stl_mesh": str(file), "friction": friction}
    return {
        "time": 1.0,
        "gravity": [0.0, 0.0, -G],
        "n_threads": 1,
        "mesh": mesh,
        "materials": [STONE],
        "body": [body],
        "terrain_contact": terrain,
    } | keys


def simulate(case):
    """Return the simulation of a case given as a dict."""
    return mpmgeo.Simulation(mpmgeo.load_case(case))
