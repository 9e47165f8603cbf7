"""What lies above each particle along gravity.

Particles are bricks, boxes of their edge lengths. A particle p bears

    σ(p) = Σ_q W_q/A_q · A_pq/A_p · min(max(top_q − h_p, 0)/t_q, 1),

the weights of all bricks q over the share of its own base that they cover, whatever lies between,
and of its own one half: W, A, t, top are weight, base, thickness and upper face, A_pq the area that
two bases share, h the height of the centre. Bricks of one base above each other make a line; lines,
not particles, are compared.
"""

import numpy as np

from mpmgeo.numerics.jit import compiled

SAME = 1e-6
"""Share of the smallest edge within which bricks stand in one line."""

AROUND = np.array([-1, 0, 1])


def overburden(across, edges, height, thickness, weight):
    """Return the stresses (n,) [Pa] of what lies above particles, and the ground (n,) [m].

    across (n, 2) [m]: centres across gravity, with edges (n, 2) [m]; height (n,) [m]: of the
    centres against gravity, with thickness (n,) [m]; weight (n,) [N]. The ground is the highest
    face on the vertical through a particle's centre.
    """
    stress, ground = np.zeros(len(height)), height + thickness / 2
    if not len(height):
        return stress, ground
    order, bounds = _lines(across, edges, ground)
    first = order[bounds[:-1]]
    at, by_place = _near(across[first], edges[first].max(axis=0))
    lines = (by_place, bounds, across[first], edges[first])
    bricks = (height[order], ground[order], thickness[order], weight[order])
    found, top = _sums(at, lines, bricks)
    stress[order], ground[order] = found, top
    return stress, ground


def _lines(across, edges, top):
    """Return the order of the bricks line by line, the highest first, and bounds of the lines."""
    places = np.round(np.hstack([across, edges]) / (SAME * edges.min()))
    order = np.lexsort((-top, *places.T))
    begins = (np.diff(places[order], axis=0) != 0).any(axis=1)
    return order, np.concatenate([[0], np.flatnonzero(begins) + 1, [len(order)]])


def _near(centre, width):
    """Return where lines that may overlap stand in an order by place, and that order.

    `width` (2,) [m] of the widest. Places are squares of that width, numbered row after row: those
    near to one are three ranges, (lines, 3, 2).
    """
    square = np.floor((centre - centre.min(axis=0)) / width).astype(np.int64) + 1
    rows = square[:, 1].max() + 2
    number = square[:, 0] * rows + square[:, 1]
    by_place = np.argsort(number, kind="stable")
    middle = number[:, None] + rows * AROUND
    low = np.searchsorted(number[by_place], middle - 1, side="left")
    high = np.searchsorted(number[by_place], middle + 1, side="right")
    return np.stack([low, high], axis=2), by_place


@compiled
def _sums(at, lines, bricks):
    """Return stress and ground of all bricks in the order of their lines."""
    by_place, bounds, centre, edge = lines
    height, top, thickness, weight = bricks
    stress, ground = np.zeros(len(height)), top.copy()
    for a in range(len(centre)):
        for r in range(3):
            for b in by_place[at[a, r, 0] : at[a, r, 1]]:
                share, apart = 1.0, False
                for c in range(2):
                    way, reach = abs(centre[a, c] - centre[b, c]), edge[a, c] + edge[b, c]
                    common = min(0.5 * reach - way, edge[a, c], edge[b, c])
                    share *= max(common, 0.0) / (edge[a, c] * edge[b, c])
                    apart = apart or way > 0.5 * edge[b, c]
                if share > 0.0:
                    for p in range(bounds[a], bounds[a + 1]):
                        for q in range(bounds[b], bounds[b + 1]):
                            above = top[q] - height[p]
                            if above <= 0.0:
                                break
                            stress[p] += share * weight[q] * min(above / thickness[q], 1.0)
                        if not apart:
                            ground[p] = max(ground[p], top[bounds[b]])
    return stress, ground
