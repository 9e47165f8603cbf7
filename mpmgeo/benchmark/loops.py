"""Work on particles or nodes for one quantity alone, which the solver computes in passing."""

from typing import NamedTuple

from mpmgeo.materials.law import update_stress
from mpmgeo.mpm.core.loops import at_node, visit
from mpmgeo.mpm.core.point import spin_increment, strain_increment
from mpmgeo.mpm.core.stencils import locate
from mpmgeo.mpm.core.tile import collect
from mpmgeo.numerics.simd import LANES, load, store


class SumWeights(NamedTuple):
    """Sum the S³ weights of a particle. Arrays: sums."""


@visit.register(SumWeights)
def sum_weights(work, here, a, p):
    _, wx, wy, wz = locate(here, p)
    total = 0.0
    for i in range(len(wx) // 2):
        for j in range(len(wy) // 2):
            for k in range(len(wz) // 2):
                total += wx[i] * wy[j] * wz[k]
    a[0][p] = total
    return 0


class Stretch(NamedTuple):
    """Change the volume by a volume strain and leave the density. Arrays: m, V, densities."""

    trace: float


@visit.register(Stretch)
def stretch(work, here, a, p):
    m, V, density = a
    V[p] *= 1.0 + work.trace
    density[p] = m[p] / V[p]
    return 0


class Strain(NamedTuple):
    """Update the stress for the same strain increment everywhere. Arrays: stresses."""

    law: object
    strain: tuple


@visit.register(Strain)
def strain_particle(work, here, a, p):
    s = a[0]
    old = (s[p, 0], s[p, 1], s[p, 2], s[p, 3], s[p, 4], s[p, 5])
    new = update_stress(work.law, old, work.strain, (), 1.0)
    for i in range(6):
        s[p, i] = new[i]
    return 0


class SumTiles(NamedTuple):
    """Sum the tiles into the nodes. Arrays: nodes."""


@at_node.register(SumTiles)
def sum_tiles(work, node, a):
    store(a[0], node.number * LANES, load(node.sums, node.at))


class Strains(NamedTuple):
    """Gather the strain increment. Arrays: increments (n, 6)."""

    dt: float


@visit.register(Strains)
def strains(work, here, a, p):
    n, wx, wy, wz = locate(here, p)
    _, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
    new = strain_increment(here.mesh, sx, sy, sz, work.dt)
    for i in range(6):
        a[0][p, i] = new[i]
    return 0


class Spins(NamedTuple):
    """Gather the spin increment. Arrays: increments (n, 3)."""

    dt: float


@visit.register(Spins)
def spins(work, here, a, p):
    n, wx, wy, wz = locate(here, p)
    _, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
    new = spin_increment(here.mesh, sx, sy, sz, work.dt)
    for i in range(3):
        a[0][p, i] = new[i]
    return 0
