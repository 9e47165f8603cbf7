"""What lies above each particle along gravity.

Particles are bricks, boxes of their edge lengths. A particle p bears

    σ(p) = Σ_q W_q/A_q · A_pq/A_p · min(max(top_q − h_p, 0)/t_q, 1),

the weights of all bricks q over the share of its own base that they cover, whatever lies between,
and of its own one half: W, A, t, top are weight, base, thickness and upper face, A_pq the area that
two bases share, h the height of the centre. Bricks of one base above each other make a line; lines,
not particles, are compared.
"""

import numpy as np

from mpmgeo.numerics.jit import compiled, inlined

SAME = 1e-6
"""Share of the smallest edge within which bricks stand in one line."""

ROWS, ENDS = np.array([[-1], [0], [1]]), np.array([-1, 2])
"""Steps to the rows around a square, and to the first square of a range and the one after it."""


def overburden(across, edges, height, thickness, weight):
    """Return the stresses (n,) [Pa] of what lies above particles, and the ground (n,) [m].

    across (n, 2) [m]: centres across gravity, with edges (n, 2) [m]; height (n,) [m]: of the
    centres against gravity, with thickness (n,) [m]; weight (n,) [N]. The ground is the highest
    face on the vertical through a particle's centre.
    """
    stress, ground = np.zeros(len(height)), height + thickness / 2
    if not len(height):
        return stress, ground
    square, near = _squares(across, edges.max(axis=0))
    order, bounds = _lines(square, across, edges, ground)
    first = order[bounds[:-1]]
    lines = (np.searchsorted(square[first], near(square[first])), bounds)
    bricks = (across, edges, height, ground, 1 / thickness, weight / edges.prod(axis=1))
    stress[order], ground[order] = _sums(*lines, *(of[order] for of in bricks))
    return stress, ground


def _squares(across, width):
    """Return in which square bricks stand (n,), and what tells which squares are near to some.

    Squares, of the `width` (2,) [m] of the widest brick, are numbered row after row: those near to
    one are three ranges, bounds of which are returned, (n, 3, 2).
    """
    place = np.floor((across - across.min(axis=0)) / width).astype(np.int64) + 1
    row = place[:, 1].max() + 2
    return place[:, 0] * row + place[:, 1], lambda number: number[:, None, None] + row * ROWS + ENDS


def _lines(square, across, edges, top):
    """Return the order of the bricks, square by square and line by line, and bounds of the lines.

    The highest of a line is the first.
    """
    places = np.round(np.hstack([across, edges]) / (SAME * edges.min()))
    order = np.lexsort((-top, *places.T, square))
    places, square = places[order], square[order]
    begins = (np.diff(places, axis=0) != 0).any(axis=1) | (np.diff(square) != 0)
    return order, np.concatenate([[0], np.flatnonzero(begins) + 1, [len(order)]])


@inlined
def _borne(h, first, last, top, slope, pressure, above, thickest):
    """Return what the bricks first … last − 1 of a line weigh above a height h on their base [Pa].

    `above`: what the bricks of a line weigh down to each; `thickest` of the line [m].
    """
    low, high = first, last
    while low < high:  # to the number of those whose upper face lies above h
        middle = (low + high) // 2
        low, high = (middle + 1, high) if top[middle] > h else (low, middle)
    q, sum = low - 1, 0.0
    while q >= first and top[q] < h + thickest:
        sum += pressure[q] * min((top[q] - h) * slope[q], 1.0)
        q -= 1
    return sum + above[q] if q >= first else sum


@compiled
def _sums(near, bounds, centre, edge, height, top, slope, pressure):
    """Return stress and ground of all bricks, which are in the order of their lines.

    `slope` [1/m]: 1 over the thickness; `pressure` [Pa]: weight over the base.
    """
    stress, ground = np.zeros(len(height)), top.copy()
    above, thickest = np.empty(len(height)), np.empty(len(near))
    for a in range(len(near)):
        of = slice(bounds[a], bounds[a + 1])
        above[of], thickest[a] = np.cumsum(pressure[of]), 1.0 / slope[of].min()
    for a in range(len(near)):
        i, end = bounds[a], bounds[a + 1]
        x, y, dx, dy = centre[i, 0], centre[i, 1], edge[i, 0], edge[i, 1]
        part, lowest = 1.0 / (dx * dy), height[i:end].min()
        for r in range(3):
            for b in range(near[a, r, 0], near[a, r, 1]):
                j = bounds[b]
                if top[j] <= lowest:
                    continue
                wx, wy = abs(x - centre[j, 0]), abs(y - centre[j, 1])
                ex, ey = edge[j, 0], edge[j, 1]
                X = min(0.5 * (dx + ex) - wx, dx, ex)
                Y = min(0.5 * (dy + ey) - wy, dy, ey)
                if not (X > 0.0 and Y > 0.0):
                    continue
                covers, share = wx <= 0.5 * ex and wy <= 0.5 * ey, X * Y * part
                for p in range(i, end):
                    stress[p] += share * _borne(
                        height[p], j, bounds[b + 1], top, slope, pressure, above, thickest[b]
                    )
                    if covers:
                        ground[p] = max(ground[p], top[j])
    return stress, ground
