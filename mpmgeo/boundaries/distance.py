"""Signed distance to a surface at the nodes of the mesh, computed for whole blocks of them.

Only blocks in a band around the surface are computed, node by node; the others are FAR.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.numerics.chunks import CHUNKS, blockwise
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.triangle_tree import (
    DEPTH,
    FACE,
    build,
    closest,
    first_of_nearest,
    nearest,
)
from mpmgeo.state.layout import CUBE, NODES, SIDE, axes

FAR = 1e30  # m


class Ground(NamedTuple):
    """A surface for kernels; `rim` empty for the signs of MPM-Geomechanics."""

    corner: np.ndarray  # with the next three a `Tree`; flat, as loops over threads need it
    number: np.ndarray
    first: np.ndarray
    box: np.ndarray
    normal: np.ndarray  # (n, 7, 3) pseudo-normals, in the order of the tree
    rim: np.ndarray  # (n, 7) whether a part lies on the border of the surface
    x0: float  # box of the mesh, less a little on all sides [m]
    y0: float
    z0: float
    x1: float
    y1: float
    z1: float
    slack: float  # that little

    @classmethod
    def of(cls, surface, low, high, slack, by_plane=False):
        """Return the symbols of a surface in a mesh from `low` to `high` (3,) [m].

        `slack` [m]: how exactly a border is to lie in the mesh to count; `by_plane`: signs are
        those of MPM-Geomechanics.
        """
        tree = build(surface.corner)
        normal = np.ascontiguousarray(surface.normal[tree.number])
        rim = np.ascontiguousarray(surface.rim[tree.number[: 0 if by_plane else None]])
        box = (*(float(l + slack) for l in low), *(float(h - slack) for h in high))
        return cls(*tree, normal, rim, *box, float(slack))


@inlined
def nearest_of(ground, x, y, z, guess, waiting):
    """Return the nearest triangle; for the signs of MPM-Geomechanics the first in the file."""
    t = nearest(ground, x, y, z, guess, waiting)
    return first_of_nearest(ground, x, y, z, t, waiting) if len(ground.rim) == 0 else t


@inlined
def signed_distance(ground, t, x, y, z):
    """Return the distance [m] to triangle t, the nearest one: negative below the ground.

    Beyond a border inside the mesh there is no ground: all distances are positive. A surface that
    ends where the mesh does, or outside, goes on straight.
    """
    qx, qy, qz, part = closest(ground.corner, t, x, y, z)
    ex, ey, ez = x - qx, y - qy, z - qz
    d = (ex * ex + ey * ey + ez * ez) ** 0.5
    n = ground.normal
    above = ex * n[t, FACE, 0] + ey * n[t, FACE, 1] + ez * n[t, FACE, 2]
    if len(ground.rim) == 0:
        return -d if above < 0.0 else d
    if ground.rim[t, part]:
        is_inside = (
            ground.x0 < qx < ground.x1 and ground.y0 < qy < ground.y1 and ground.z0 < qz < ground.z1
        )
        if not is_inside:
            return above
        is_beyond = d * d - above * above > ground.slack * ground.slack
        return -d if above < 0.0 and not is_beyond else d
    side = ex * n[t, part, 0] + ey * n[t, part, 1] + ez * n[t, part, 2]
    return -d if side < 0.0 else d


@blockwise
def distances(c, ground, x, out):
    """Write the signed distances [m] of points x (n, 3) [m]."""
    waiting = np.empty(DEPTH, np.int64)
    t = 0
    for p in range(c * len(x) // CHUNKS, (c + 1) * len(x) // CHUNKS):
        t = nearest_of(ground, x[p, 0], x[p, 1], x[p, 2], t, waiting)
        out[p] = signed_distance(ground, t, x[p, 0], x[p, 1], x[p, 2])


@blockwise
def fill(c, ground, mesh, band, corner, out):
    """Write the distances (blocks, 64) [m] at the nodes of blocks of `corner` (blocks, 3).

    Blocks without a point within `band` [m] of the surface get FAR, with the sign of their middle.
    """
    radius = 1.5 * (mesh.hx**2 + mesh.hy**2 + mesh.hz**2) ** 0.5
    waiting = np.empty(DEPTH, np.int64)
    t = 0
    for b in range(c * len(corner) // CHUNKS, (c + 1) * len(corner) // CHUNKS):
        ox = corner[b, 0] * SIDE * mesh.hx
        oy = corner[b, 1] * SIDE * mesh.hy
        oz = corner[b, 2] * SIDE * mesh.hz
        x, y, z = ox + 1.5 * mesh.hx, oy + 1.5 * mesh.hy, oz + 1.5 * mesh.hz
        t = nearest_of(ground, x, y, z, t, waiting)
        d = signed_distance(ground, t, x, y, z)
        if abs(d) > band + radius:
            out[b] = FAR if d > 0.0 else -FAR
            continue
        for n in range(NODES):
            i, j, k = axes(CUBE, n)
            x, y, z = ox + i * mesh.hx, oy + j * mesh.hy, oz + k * mesh.hz
            t = nearest_of(ground, x, y, z, t, waiting)
            out[b, n] = signed_distance(ground, t, x, y, z)
