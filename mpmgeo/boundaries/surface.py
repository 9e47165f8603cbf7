"""A surface of triangles: joined at their corners, turned the same way round, with its outside.

The outside of a triangle is the side from which its corners run anticlockwise. The sign of the
distance follows from the pseudo-normal of the part of the triangle that is nearest: its own normal,
the mean of those that share the edge, or at a corner the mean weighted by the angles there.

Source: Bærentzen and Aanæs (2005), IEEE Trans. Vis. Comput. Graph. 11, 243–253, section 3.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.numerics.neighbours import Neighbours
from mpmgeo.numerics.triangle_tree import EDGE_12, FACE

JOINED = 1e-9  # edges of a triangle by which copies of its corner may be apart, at least
FLAT = 1e-12  # height over length below which a triangle is a line


class Surface(NamedTuple):
    """Triangles with what tells their sides apart, and what the user should know about them.

    corner (n, 3, 3) [m]; normal (n, 7, 3): unit pseudo-normals of the parts, as `triangle_tree`
    numbers them; rim (n, 7): whether a part lies on the surface's border, with nothing beyond.
    """

    corner: np.ndarray
    normal: np.ndarray
    rim: np.ndarray
    notes: tuple[str, ...] = ()

    def part(self, chosen) -> "Surface":
        """Return the surface with the triangles `chosen` alone; borders stay what they were."""
        return Surface(self.corner[chosen], self.normal[chosen], self.rim[chosen], self.notes)


def surface_of(corner, normal, resolution=0.0) -> Surface:
    """Return the surface of triangles (n, 3, 3) [m] in any order.

    `normal` (n, 3): what a file says, zero for nothing; only compared with the order of corners;
    `resolution` [m]: how exactly the coordinates are known. Raises ValueError if no triangle has
    an area.
    """
    vertex = _joined(corner, resolution)
    notes = []
    keep = ~_is_flat(corner, vertex)
    if not keep.any():
        raise ValueError(f"none of the {len(keep)} triangles has an area")
    if not keep.all():
        notes.append(f"{np.count_nonzero(~keep)} of {len(keep)} triangles without area left out")
    corner, normal, vertex = corner[keep], normal[keep], vertex[keep]
    edge, count = _edges(vertex)
    turned = _turned(vertex, edge, count, _areas(corner))
    if turned.any():
        notes.append(f"{np.count_nonzero(turned)} triangles turned round to agree with the others")
        corner, vertex = corner.copy(), vertex.copy()
        corner[turned, 1], corner[turned, 2] = corner[turned, 2], corner[turned, 1].copy()
        vertex[turned, 1], vertex[turned, 2] = vertex[turned, 2], vertex[turned, 1].copy()
        edge, count = _edges(vertex)
    own = _normals(corner)
    against = np.einsum("ij,ij->i", own, normal) < 0
    if 2 * np.count_nonzero(against) > len(own):
        notes.append("the normals in the file oppose the order of the corners, which counts")
    return Surface(corner, *_sides(corner, vertex, own, edge, count), tuple(notes))


def _joined(corner, resolution):
    """Return the numbers (n, 3) of the corners, the same for corners as good as equal."""
    x = corner.reshape(-1, 3)
    order = np.lexsort(x.T)
    fresh = np.append(True, (np.diff(x[order], axis=0) != 0).any(axis=1))
    number = np.empty(len(x), np.int64)
    number[order] = np.cumsum(fresh) - 1
    x, vertex = x[order[fresh]], number.reshape(-1, 3)
    # only where triangles do not meet exactly can there be corners to join
    edge, count = _edges(vertex)
    alone = (count == 1)[edge]
    loose, rows = np.unique(vertex[alone | np.roll(alone, 1, axis=1)]), alone.any(axis=1)
    lowest = np.arange(len(x))
    longest = _longest(corner[rows], vertex[rows], len(x))[loose]
    tolerance = np.maximum(2 * resolution, JOINED * longest)
    if tolerance.max(initial=0.0) > 0:
        for one, other, distance in Neighbours(x[loose], tolerance.max()).pairs(x[loose]):
            near = distance <= np.minimum(tolerance[one], tolerance[other])
            np.minimum.at(lowest, loose[one[near]], loose[other[near]])
    return lowest[vertex]


def _longest(corner, vertex, number):
    """Return for each of a number of corners the longest edge [m] of the triangles around it."""
    edge = np.linalg.norm(corner - np.roll(corner, -1, axis=1), axis=2).max(axis=1, initial=0.0)
    longest = np.zeros(number)
    np.maximum.at(longest, vertex.ravel(), np.repeat(edge, 3))
    return longest


def _cross(corner):
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def _areas(corner):
    return 0.5 * np.linalg.norm(_cross(corner), axis=1)


def _normals(corner):
    cross = _cross(corner)
    return cross / np.linalg.norm(cross, axis=1)[:, None]


def _is_flat(corner, vertex):
    sides = corner - np.roll(corner, -1, axis=1)
    longest = (sides**2).sum(axis=2).max(axis=1)
    a, b, c = vertex.T
    return (a == b) | (b == c) | (c == a) | ~(2 * _areas(corner) > FLAT * longest)


def _edges(vertex):
    """Return the number (n, 3) of the edges 12, 23, 31 and how many triangles share each (m,)."""
    ends = np.sort(np.stack([vertex, np.roll(vertex, -1, axis=1)], axis=-1), axis=-1)
    key = (ends[..., 0] << 32) | ends[..., 1]
    _, number, count = np.unique(key, return_inverse=True, return_counts=True)
    return number.reshape(-1, 3), count


def _pairs(vertex, edge, count):
    """Return the triangles (k, 2) that meet at edges of two, and whether both run the same way."""
    order = np.argsort(edge.ravel(), kind="stable")
    order = order[count[edge.ravel()[order]] == 2].reshape(-1, 2)
    start = vertex.ravel()[order]
    return order // 3, start[:, 0] == start[:, 1]


def _turned(vertex, edge, count, area):
    """Return which triangles (n,) to turn round so that neighbours agree.

    In each connected piece the side with more area stays.
    """
    pairs, opposed = _pairs(vertex, edge, count)
    turned = np.zeros(len(vertex), bool)
    if not opposed.any():
        return turned
    piece, side = _two_sides(len(vertex), pairs, opposed)
    share = np.zeros((piece.max() + 1, 2))
    np.add.at(share, (piece, side), area)
    return side != share.argmax(axis=1)[piece]


def _two_sides(count, pairs, opposed):
    """Return the piece (n,) and the side (n,), 0 or 1, of triangles joined in pairs."""
    start = np.searchsorted(np.sort(pairs.ravel()), np.arange(count + 1))
    order = np.argsort(pairs.ravel(), kind="stable")
    other, differs = pairs[:, ::-1].ravel()[order], np.repeat(opposed, 2)[order]
    piece, side = np.full(count, -1), np.zeros(count, int)
    pieces = 0
    for seed in range(count):
        if piece[seed] >= 0:
            continue
        piece[seed], waiting = pieces, [seed]
        while waiting:
            t = waiting.pop()
            for i in range(start[t], start[t + 1]):
                if piece[other[i]] < 0:
                    piece[other[i]], side[other[i]] = pieces, side[t] ^ differs[i]
                    waiting.append(other[i])
        pieces += 1
    return piece, side


def _sides(corner, vertex, own, edge, count):
    """Return the pseudo-normals (n, 7, 3) of the parts and which of them lie on the border."""
    along = np.roll(corner, -1, axis=1) - corner
    along /= np.linalg.norm(along, axis=2)[..., None]
    angle = np.arccos(np.clip(-(along * np.roll(along, 1, axis=1)).sum(axis=2), -1, 1))
    at_vertex = _summed(vertex, angle[..., None] * own[:, None])
    at_edge = _summed(edge, np.repeat(own[:, None], 3, axis=1))
    normal = np.empty((len(corner), FACE + 1, 3))
    normal[:, :EDGE_12], normal[:, EDGE_12:FACE] = at_vertex[vertex], at_edge[edge]
    normal[:, FACE] = own
    size = np.linalg.norm(normal, axis=2)[..., None]
    normal = np.where(size > 1e-9, normal / np.maximum(size, 1e-9), own[:, None])
    ends = np.zeros(vertex.max() + 1, bool)
    rim = np.zeros((len(corner), FACE + 1), bool)
    rim[:, EDGE_12:FACE] = count[edge] == 1
    for i in range(3):
        at_rim = rim[:, EDGE_12 + i]
        ends[vertex[at_rim, i]] = ends[vertex[at_rim, (i + 1) % 3]] = True
    rim[:, :EDGE_12] = ends[vertex]
    return normal, rim


def _summed(number, vectors):
    """Return for each number the sum of its vectors; `number` (n, 3), `vectors` (n, 3, 3)."""
    parts = [np.bincount(number.ravel(), vectors[..., i].ravel()) for i in range(3)]
    return np.stack(parts, axis=-1)
