"""B-bar on cells: what is done against volumetric locking.

    L ← L + ⅓ (θ̄ − tr L) I,    σ ← σ + (p̄ − p) I,    θ̄ = Σ V tr L / Σ V,    p̄ = Σ V p / Σ V

for the strain and in the internal force, with sums over the particles of one material in a cell;
p = ⅓ tr σ of the total stress. Two particles or more in a cell then keep its volume only together,
and force and strain do the same work: Σ V p̄ tr L = Σ V p θ̄.

Source: Hughes (1980), Int. J. Numer. Methods Eng. 15, 1413–1418, for elements.
"""

from typing import NamedTuple

from mpmgeo.mpm.core.cells import add_to_cell, mean_of_cell
from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.point import divergence
from mpmgeo.mpm.core.stencils import locate
from mpmgeo.mpm.core.tile import collect_diagonal
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import add, pack4

MEAN = 0  # lane of the mean in the record of a cell


@inlined
def _mean_stress(stress, p):
    """Return a third of the trace of the effective stress [Pa] of particle p."""
    return (stress[p, 0] + stress[p, 1] + stress[p, 2]) / 3.0


@inlined
def beside_effective_stress(here, stress, pressure, means, p):
    """Return what the force has in its normal stresses beside the effective one [Pa], or None.

    `pressure`: given pore pressure, or None; `means`: blocks under the tiles and records of cells
    with p̄, or None.
    """
    if means is None:
        return _less(pressure, p)
    return mean_of_cell(here, p, means[0], means[1], MEAN) - _mean_stress(stress, p)


@inlined
def _less(pressure, p):
    """Return what a pore pressure takes away from normal stresses; None without one."""
    if pressure is None:
        return None
    return -pressure[p]


@inlined
def with_mean_divergence(here, sx, sy, sz, means, p):
    """Return slopes per cell of the velocity whose divergence is the mean one of particle p's cell.

    `means`: blocks under the tiles and records of cells with θ̄; None: the slopes as they are.
    """
    if means is None:
        return sx, sy, sz
    mesh = here.mesh
    θ = mean_of_cell(here, p, means[0], means[1], MEAN)
    d = (θ - divergence(mesh, sx, sy, sz)) / 3.0
    return (
        add(sx, pack4(mesh.hx * d, 0.0, 0.0, 0.0)),
        add(sy, pack4(0.0, mesh.hy * d, 0.0, 0.0)),
        add(sz, pack4(0.0, 0.0, mesh.hz * d, 0.0)),
    )


class SumMeanStress(NamedTuple):
    """Sum volume and volume times mean total stress of the particles of each cell.

    Arrays: V, stress, pressure of a pore fluid or None.
    """


@visit.register(SumMeanStress)
def sum_mean_stress(work, here, a, p):
    V, stress, pressure = a
    add_to_cell(here, p, V[p], _total(stress, pressure, p))
    return 0


@inlined
def _total(stress, pressure, p):
    if pressure is None:
        return _mean_stress(stress, p)
    return _mean_stress(stress, p) - pressure[p]


class SumDivergence(NamedTuple):
    """Sum volume and volume times divergence of the nodal velocity of the particles of each cell.

    Arrays: V.
    """


@visit.register(SumDivergence)
def sum_divergence(work, here, a, p):
    n, wx, wy, wz = locate(here, p)
    s = collect_diagonal(here.source, n, here.rows, wx, wy, wz)
    add_to_cell(here, p, a[0][p], divergence(here.mesh, s, s, s))
    return 0
