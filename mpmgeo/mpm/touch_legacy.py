"""Contact with the ground as MPM-Geomechanics has it, for comparison with old results.

It acts on all particles nearer than the radius of the search, along the normal of the nearest
triangle, and on their velocities alone: nodes, and with them positions, do not know of it.

    f_n = −m v_n/Δt n  if v_n < 0,   |f_t| ≤ μ |f_n|,   then f_n += k (−d) n  if d < 0

d: gathered distance. At the end particles whose middle was below the surface move by −d n.
"""

import numpy as np
from numba import prange

from mpmgeo.mpm.ground import level_at, tile_origin
from mpmgeo.mpm.tile import collect_value, copy_tile
from mpmgeo.mpm.touch import NORMAL, PUSH, TANGENT, TOUCHING, locate_both, put
from mpmgeo.numerics.jit import blockwise
from mpmgeo.numerics.simd import LANES, lane
from mpmgeo.numerics.triangle_tree import DEPTH, FACE, closest, nearest
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import SIDE


@blockwise
def impel(
    shape, mesh, contact, ground, h, dt, motion, level, chunk, near, start, corner, above,
    nodes, scratch, half, x, v, m, due, forces, some,
):  # fmt: skip
    """Change the velocities of particles near the ground, before they get the nodes' h a."""
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        waiting = np.empty(DEPTH, np.int64)
        t = 0
        for s in range(chunk[c], chunk[c + 1]):
            b = near[s]
            some[s] = 1
            copy_tile(nodes, above, b, row, tile)
            base = tile_origin(mesh, corner, b, (0, 0, 0))
            for p in range(start[b], start[b + 1]):
                due[p] = 0.0
                forces[p] = 0.0
                n, at, wx, wy, wz = locate_both(shape, mesh, base, None, half, x, p)
                d, _, _, _ = level_at(level, s * (row + 1) ** 3 + n, row + 1, wx, wy, wz)
                if not abs(d) < contact.D:
                    continue
                t = nearest(ground, x[p, 0], x[p, 1], x[p, 2], t, waiting)
                qx, qy, qz, _ = closest(ground.corner, t, x[p, 0], x[p, 1], x[p, 2])
                qx, qy, qz = qx - x[p, 0], qy - x[p, 1], qz - x[p, 2]
                if not qx * qx + qy * qy + qz * qz < contact.D**2:
                    continue
                due[p] = TOUCHING
                u = collect_value(tile, at, row, wx, wy, wz)
                ux = v[p, 0] + h * lane(u, 3) - motion[0]
                uy = v[p, 1] + h * lane(u, 4) - motion[1]
                uz = v[p, 2] + h * lane(u, 5) - motion[2]
                nx, ny, nz = (
                    ground.normal[t, FACE, 0],
                    ground.normal[t, FACE, 1],
                    ground.normal[t, FACE, 2],
                )
                speed = ux * nx + uy * ny + uz * nz
                put(forces, p, PUSH, max(-d, 0.0), nx, ny, nz)
                if speed >= 0.0:
                    continue
                fn = -m[p] * speed / dt
                tx, ty, tz = ux - speed * nx, uy - speed * ny, uz - speed * nz
                sliding = (tx * tx + ty * ty + tz * tz) ** 0.5
                ft = m[p] * sliding / dt
                f = -m[p] / dt * (contact.μ * fn / ft if ft > contact.μ * fn else 1.0)
                put(forces, p, TANGENT, f, tx, ty, tz)
                put(forces, p, NORMAL, fn + contact.k * max(-d, 0.0), nx, ny, nz)
                for i in range(3):
                    v[p, i] += dt / m[p] * (forces[p, NORMAL + i] + forces[p, TANGENT + i])
