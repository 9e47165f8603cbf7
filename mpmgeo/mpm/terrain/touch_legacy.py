"""Contact with the ground as MPM-Geomechanics has it, for comparison with old results.

It acts on all particles nearer than the radius of the search, along the normal of the nearest
triangle, and on their velocities alone: nodes, and with them positions, do not know of it.

    f_n = −m v_n/Δt n  if v_n < 0,   |f_t| ≤ μ |f_n|,   then f_n += k (−d) n  if d < 0

d: gathered distance. At the end particles whose middle was below the surface move by −d n, and d
counts as zero.
"""

from typing import NamedTuple

from mpmgeo.boundaries.distance import nearest_of
from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.tile import collect_value
from mpmgeo.mpm.terrain.touch import NORMAL, PUSH, TANGENT, TOUCHING, distance_of, locate_both, put
from mpmgeo.numerics.simd import lane
from mpmgeo.numerics.triangle_tree import FACE, closest

LEVEL = 9  # column of the distance, behind those of `touch`


class Impel(NamedTuple):
    """Change the velocities of particles near the ground, before they get the nodes' h a.

    Arrays: ground, distances, v, m, due, forces, and for each chunk room for the search and the
    triangle found last.
    """

    contact: object
    h: float
    dt: float
    motion: tuple


@visit.register(Impel)
def impel(work, here, a, p):
    ground, level, v, m, due, forces, waiting, last = a
    contact, motion, h, dt = work.contact, work.motion, work.h, work.dt
    x = here.x
    due[p] = 0.0
    forces[p] = 0.0
    n, at, wx, wy, wz = locate_both(here, (0, 0, 0), None, p)
    d, _, _, _ = distance_of(here, level, n, wx, wy, wz)
    if not abs(d) < contact.D:
        return 0
    c = here.c
    t = nearest_of(ground, x[p, 0], x[p, 1], x[p, 2], last[c], waiting[c])
    last[c] = t
    qx, qy, qz, _ = closest(ground.corner, t, x[p, 0], x[p, 1], x[p, 2])
    qx, qy, qz = qx - x[p, 0], qy - x[p, 1], qz - x[p, 2]
    if not qx * qx + qy * qy + qz * qz < contact.D**2:
        return 0
    due[p] = TOUCHING
    forces[p, LEVEL] = max(d, 0.0)
    u = collect_value(here.source, at, here.rows, wx, wy, wz)
    ux = v[p, 0] + h * lane(u, 3) - motion[0]
    uy = v[p, 1] + h * lane(u, 4) - motion[1]
    uz = v[p, 2] + h * lane(u, 5) - motion[2]
    normal = ground.normal
    nx, ny, nz = normal[t, FACE, 0], normal[t, FACE, 1], normal[t, FACE, 2]
    speed = ux * nx + uy * ny + uz * nz
    put(forces, p, PUSH, max(-d, 0.0), nx, ny, nz)
    if speed >= 0.0:
        return 0
    fn = -m[p] * speed / dt
    tx, ty, tz = ux - speed * nx, uy - speed * ny, uz - speed * nz
    sliding = (tx * tx + ty * ty + tz * tz) ** 0.5
    ft = m[p] * sliding / dt
    f = -m[p] / dt * (contact.μ * fn / ft if ft > contact.μ * fn else 1.0)
    put(forces, p, TANGENT, f, tx, ty, tz)
    put(forces, p, NORMAL, fn + contact.k * max(-d, 0.0), nx, ny, nz)
    for i in range(3):
        v[p, i] += dt / m[p] * (forces[p, NORMAL + i] + forces[p, TANGENT + i])
    return 0
