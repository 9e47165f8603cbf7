"""The triangle nearest to a point: a tree of boxes around triangles, in order of a space-filling
curve.

Neighbours on the curve are neighbours in space, so the tree is complete and needs no pointers: box
i holds the boxes 2i + 1 and 2i + 2, and the last row holds a few triangles each.

Sources: Lauterbach et al. (2009), Comput. Graph. Forum 28, 375–384, section 3 (order by Morton
codes); Ericson, Real-Time Collision Detection (2005), section 5.1.5 (nearest point of a triangle).
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.numerics.jit import inlined

LEAF = 4  # triangles that a lowest box holds at most
DEPTH = 64  # boxes that wait at most while a point is looked up
TIE = 1e-12  # relative difference up to which two distances may differ by round-off alone
BITS = 21  # of a Morton code, for each axis
VERTEX_1, VERTEX_2, VERTEX_3, EDGE_12, EDGE_23, EDGE_31, FACE = range(7)


class Tree(NamedTuple):
    """Triangles in the order of the tree, their numbers (n,), and the boxes around them."""

    corner: np.ndarray  # (n, 3, 3) [m]
    number: np.ndarray  # (n,) which triangle of the caller each one is
    first: np.ndarray  # (leaves + 1,) first triangle of each lowest box
    box: np.ndarray  # (2 leaves − 1, 6) lowest and highest coordinates [m]


def build(corner) -> Tree:
    """Return the tree of triangles (n, 3, 3) [m], n ≥ 1."""
    corner = np.asarray(corner, float)
    order = np.argsort(_morton(corner.mean(axis=1)), kind="stable")
    corner = np.ascontiguousarray(corner[order])
    leaves = 1
    while leaves * LEAF < len(corner):
        leaves *= 2
    first = np.arange(leaves + 1) * len(corner) // leaves
    box = np.empty((2 * leaves - 1, 6))
    box[leaves - 1 :, :3] = np.minimum.reduceat(corner.min(axis=1), first[:-1])
    box[leaves - 1 :, 3:] = np.maximum.reduceat(corner.max(axis=1), first[:-1])
    row = leaves - 1
    while row:
        pairs = box[row : 2 * row + 1].reshape(-1, 2, 6)
        above = (row - 1) // 2
        box[above:row, :3] = pairs[:, :, :3].min(axis=1)
        box[above:row, 3:] = pairs[:, :, 3:].max(axis=1)
        row = above
    return Tree(corner, order, first, box)


def _morton(x):
    """Return the places of points (n, 3) on a curve through all of them."""
    low, extent = x.min(axis=0), max(float(np.ptp(x, axis=0).max()), 1e-300)
    cell = ((x - low) / extent * (2**BITS - 1)).astype(np.uint64)
    code = np.zeros(len(x), np.uint64)
    for axis in range(3):
        c = cell[:, axis]
        for shift, mask in (
            (32, 0x1F00000000FFFF),
            (16, 0x1F0000FF0000FF),
            (8, 0x100F00F00F00F00F),
            (4, 0x10C30C30C30C30C3),
            (2, 0x1249249249249249),
        ):
            c = (c | c << np.uint64(shift)) & np.uint64(mask)
        code |= c << np.uint64(axis)
    return code


@inlined
def _dot(ax, ay, az, bx, by, bz):
    return ax * bx + ay * by + az * bz


@inlined
def closest(corner, t, x, y, z):
    """Return the point of triangle t nearest to (x, y, z), and on which of its parts it lies."""
    ax, ay, az = corner[t, 0, 0], corner[t, 0, 1], corner[t, 0, 2]
    ux, uy, uz = corner[t, 1, 0] - ax, corner[t, 1, 1] - ay, corner[t, 1, 2] - az
    wx, wy, wz = corner[t, 2, 0] - ax, corner[t, 2, 1] - ay, corner[t, 2, 2] - az
    px, py, pz = x - ax, y - ay, z - az
    d1, d2 = _dot(ux, uy, uz, px, py, pz), _dot(wx, wy, wz, px, py, pz)
    if d1 <= 0.0 and d2 <= 0.0:
        return ax, ay, az, VERTEX_1
    px, py, pz = px - ux, py - uy, pz - uz
    d3, d4 = _dot(ux, uy, uz, px, py, pz), _dot(wx, wy, wz, px, py, pz)
    if d3 >= 0.0 and d4 <= d3:
        return ax + ux, ay + uy, az + uz, VERTEX_2
    c = d1 * d4 - d3 * d2
    if c <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        s = d1 / (d1 - d3)
        return ax + s * ux, ay + s * uy, az + s * uz, EDGE_12
    px, py, pz = x - corner[t, 2, 0], y - corner[t, 2, 1], z - corner[t, 2, 2]
    d5, d6 = _dot(ux, uy, uz, px, py, pz), _dot(wx, wy, wz, px, py, pz)
    if d6 >= 0.0 and d5 <= d6:
        return ax + wx, ay + wy, az + wz, VERTEX_3
    b = d5 * d2 - d1 * d6
    if b <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        s = d2 / (d2 - d6)
        return ax + s * wx, ay + s * wy, az + s * wz, EDGE_31
    a = d3 * d6 - d5 * d4
    if a <= 0.0 and d4 >= d3 and d5 >= d6:
        s = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        ex, ey, ez = wx - ux, wy - uy, wz - uz
        return ax + ux + s * ex, ay + uy + s * ey, az + uz + s * ez, EDGE_23
    w = 1.0 / (a + b + c)
    s, r = b * w, c * w
    return ax + s * ux + r * wx, ay + s * uy + r * wy, az + s * uz + r * wz, FACE


@inlined
def _square(corner, t, x, y, z):
    qx, qy, qz, _ = closest(corner, t, x, y, z)
    return (x - qx) * (x - qx) + (y - qy) * (y - qy) + (z - qz) * (z - qz)


@inlined
def _outside(box, i, x, y, z):
    """Return the square of the distance from a point to box i."""
    ex = max(box[i, 0] - x, 0.0, x - box[i, 3])
    ey = max(box[i, 1] - y, 0.0, y - box[i, 4])
    ez = max(box[i, 2] - z, 0.0, z - box[i, 5])
    return ex * ex + ey * ey + ez * ez


@inlined
def nearest(tree, x, y, z, guess, waiting):
    """Return the triangle nearest to a point, of several the caller's first one.

    `guess`: a triangle that may be near, such as that of a neighbouring point; `waiting`: room for
    DEPTH whole numbers.
    """
    leaves = len(tree.first) - 1
    best, least = guess, _square(tree.corner, guess, x, y, z)
    waiting[0] = 0
    count = 1
    while count > 0:
        count -= 1
        i = waiting[count]
        if _outside(tree.box, i, x, y, z) > least:
            continue
        if i >= leaves - 1:
            for t in range(tree.first[i - leaves + 1], tree.first[i - leaves + 2]):
                d = _square(tree.corner, t, x, y, z)
                if d < least or (d == least and tree.number[t] < tree.number[best]):
                    best, least = t, d
            continue
        a, b = 2 * i + 1, 2 * i + 2
        da, db = _outside(tree.box, a, x, y, z), _outside(tree.box, b, x, y, z)
        if da > db:
            a, b, da, db = b, a, db, da
        if db <= least:
            waiting[count] = b
            count += 1
        if da <= least:
            waiting[count] = a
            count += 1
    return best


@inlined
def first_of_nearest(tree, x, y, z, best, waiting):
    """Return the caller's first one of the triangles that are as near as `best`, the nearest one.

    Round-off aside: above a convex edge two triangles are equally near, in a whole wedge.
    """
    leaves = len(tree.first) - 1
    reach = _square(tree.corner, best, x, y, z) ** 0.5
    reach += TIE * (reach + abs(x) + abs(y) + abs(z))
    most = reach * reach
    waiting[0] = 0
    count = 1
    while count > 0:
        count -= 1
        i = waiting[count]
        if i >= leaves - 1:
            for t in range(tree.first[i - leaves + 1], tree.first[i - leaves + 2]):
                if tree.number[t] < tree.number[best] and _square(tree.corner, t, x, y, z) <= most:
                    best = t
            continue
        for child in range(2 * i + 1, 2 * i + 3):
            if _outside(tree.box, child, x, y, z) <= most:
                waiting[count] = child
                count += 1
    return best
