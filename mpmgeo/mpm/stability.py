"""The longest stable time step: of scheme, shape, size of particles, stiffness and phases.

    Δt (ω² Δt + 2d) = n,    ω² ρ = λ Σ + 2G Γ,    d ρ = 2η Δ

Σ ≥ ‖div v‖², Γ ≥ ‖grad v‖², Δ ≥ ‖dev sym grad v‖² for all velocities with Σ m v² = ρ. The bounds
hold for boxes of particles, whose weights and slopes are products of those of three rows:

    Σ = Σₐ μₐ/hₐ²,  μ = max uᵀAu,      Γ = max Σₐ uₐᵀAuₐ/hₐ² · u_bᵀPu_b · u_cᵀPu_c,      |u| = 1

    A = w M^−½ BᵀB M^−½,  P = w M^−½ SᵀS M^−½        for strains from velocities of nodes, n = 2
    A → P^½ A P^½,        P → P²                     for strains from those of particles, n = 4, or
                                                     as `mpm.newmark` says

S, B: weights and slopes (particles, nodes), M: masses of nodes, w: that of a particle, in cells;
the largest over the places of a row on the grid. A node at the end of a row may belong to one
particle, which gives it hardly mass, but a slope: for GIMP μ is about 1/l, l the half-size. USL
strains with the velocity of that node, which no particle has; so its limit lies at ωΔt = √2. MUSL
and USF strain with velocities that particles brought to the nodes, as a leapfrog: ωΔt = 2.

Particles that keep a velocity gradient bring much of what a node had back to it. If they bring the
share φ of a motion, a step takes (x, v) to (x + Δt φ v′, v′), v′ = φ v − ω²Δt x, with MUSL and USF:
stable for ω²Δt² < 2 (1 + φ)/φ, so for 4 and the A of velocities of nodes, whatever the share.

Derived, but for Γ, which is the largest that a search over products finds, and for Δ = ⅔ Γ in USL,
that of a node which moves by itself, else Γ; `benchmarks/stability.py` measures how close they are.
Shapes that end at walls have rows beside walls, too, from half a half-size on; planes that hold
nodes only take motions away.

Not covered: a particle apart from all others that is smaller than a cell or nearer to a wall, and,
with hats, lattices on the faces of cells to round-off.

Source: Hughes, The Finite Element Method (1987), section 9.1, for the damped leapfrog.
"""

from functools import lru_cache
from math import floor, inf, sqrt
from typing import NamedTuple

import numpy as np

from mpmgeo.shapes.shape import cut_of, cuts, stencil, width

LENGTHS = (1, 4)  # of rows, in cells
TOUCH = 1e-3  # cells by which particles reach over a node, or lie beyond it
PLACES = 20  # of a row on the grid
NEAREST = 0.5  # half-sizes between a wall and the nearest particle
SMALLEST = 0.01  # half-size in cells below which particles count as no smaller
ROUNDS = 4  # of the search for Γ


class Slopes(NamedTuple):
    """Σ, Γ, Δ, and Σ of means over the particles of cells [1/m²]."""

    divergence: float
    gradient: float
    deviator: float
    mean_divergence: float


def has_stable_step(shape, filtered):
    """Tell whether slopes vanish with the weights, or strains do not feel nodes without mass."""
    return filtered or type(shape).edge >= 2


def stable_time_step(frequency, decay, n):
    """Return Δt [s] of ω² [1/s²] and d [1/s]; n: the largest (ω Δt)² that the scheme bears."""
    return n / (decay + sqrt(decay * decay + n * frequency))


def slopes(shape, filtered, half, cell):
    """Return the largest slopes of particles of half-sizes `half` (3,) [cells], `cell` (3,) [m]."""
    axes = [rows(shape, filtered, max(round(float(l), 4), SMALLEST)) for l in half]
    scale = 1.0 / np.square(cell)
    μ, means = np.transpose([[np.linalg.eigvalsh(A).max() for A in axis[:2]] for axis in axes])
    Γ = max(_gradient(axes, scale, start) for start in (0.0, 1.0))
    return Slopes(float(μ @ scale), Γ, Γ if filtered else Γ * 2 / 3, float(means @ scale))


def _gradient(axes, scale, π):
    """Return Γ: the vectors of the three axes are improved in turn, from uᵀPu = π; all places."""
    places = len(axes[0][0])
    α, π = np.ones((3, places)), np.full((3, places), π)
    for turn in range(3 * ROUNDS):
        a, b, c = turn % 3, (turn + 1) % 3, (turn + 2) % 3
        A, _, P = axes[a]
        own = scale[a] * π[b] * π[c]
        others = scale[b] * α[b] * π[c] + scale[c] * π[b] * α[c]
        value, u = np.linalg.eigh(own[:, None, None] * A + others[:, None, None] * P)
        u = u[:, :, -1]
        α[a], π[a] = (np.einsum("ni,nij,nj->n", u, X, u) for X in (A, P))
    return float(value[:, -1].max())


@lru_cache(typed=True)
def rows(shape, filtered, l):
    """Return A, A of the means over cells, and P of rows of particles of half-size `l` [cells].

    Each is (places, nodes, nodes), for all places on the grid and beside walls.
    """
    ends = (TOUCH, 0.5 - TOUCH, 0.5 + TOUCH, *(i / PLACES for i in range(PLACES)))
    ends = (*ends, *((l + end) % 1.0 for end in ends))
    cases = [(length, end, None) for length in LENGTHS for end in ends]
    if cuts(shape):
        beside = (l, *(max(end, NEAREST * l) for end in ends))
        cases += [(length, end, (0.0, inf)) for length in LENGTHS for end in beside]
        cases += [(1, l, (0.0, 1.0))]
    found = [_operators(shape, filtered, l, *case) for case in cases]
    return tuple(map(np.array, zip(*found, strict=True)))


def _operators(shape, filtered, l, *case):
    S, B, cell = _row(shape, l, *case)
    total = S.sum(axis=0)
    r = np.divide(1.0, np.sqrt(total), where=total > 0, out=np.zeros_like(total))
    S, B = S * r, B * r
    means = (cell[:, None] == cell) / (cell[:, None] == cell).sum(axis=0)
    A, mean, P = B.T @ B, B.T @ means @ B, S.T @ S
    if filtered:
        value, u = np.linalg.eigh(P)
        root = u * np.sqrt(np.maximum(value, 0.0)) @ u.T
        A, mean, P = root @ A @ root, root @ mean @ root, P @ P
    return A, mean, P


def _row(shape, l, length, end, walls):
    """Return weights, slopes (particles, nodes), cells of a row `end` cells after a node.

    `walls`: where they are, in cells from that node, or None.
    """
    count, nodes = max(1, round(length / (2 * l))), width(shape)
    S = np.zeros((count, max(LENGTHS) + 1 + 2 * nodes))
    B, places = np.zeros_like(S), nodes + end + 2 * l * np.arange(count)
    for p, x in enumerate(places):
        first = floor(x - nodes / 2 + 1)
        cut = cut_of(shape, walls, first - nodes)
        values = stencil(shape, x - first - (nodes - 1) / 2, l, cut)
        S[p, first : first + nodes] = values[:nodes]
        B[p, first : first + nodes] = values[nodes:]
    return S, B, np.floor(places)
