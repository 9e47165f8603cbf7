"""Fill volume elements with particles at a given spacing, their volume shared out to the particles.

Space is divided into boxes of the spacing. A box whose middle lies in an element holds a particle
there, and the element's volume is shared by the middles that it contains. An element without any
gives its volume to the particle of the box that it lies in; if there is none, all such elements of
a box make one particle together, at the middle of their volume.
"""

from collections.abc import Iterator

import numpy as np

from mpmgeo.bodies.lattice import too_many
from mpmgeo.bodies.volume_mesh import Piece

ROUND_OFF = 1e-9
"""Share of the spacing by which a middle may be off, at least."""

BATCH = 2**16
"""Pairs of element and position that are looked at together."""

BULGE = 0.25
"""How far a quadratic element may reach beyond the box around its nodes, in sizes of that box."""


def fill(pieces: list[Piece], start: np.ndarray, spacing: np.ndarray, resolution: float = 0.0):
    """Return position (n, 3) [m] and volume (n,) [m³] of particles that fill the elements.

    `start` (3,): a corner of the boxes [m], below all elements; `spacing` (3,): their edges [m];
    `resolution` [m]: how exactly the coordinates are known. Raises ValueError if that makes more
    than a thousand million positions to look at.
    """
    volume = np.concatenate([piece.volume for piece in pieces])
    center = np.concatenate([piece.center for piece in pieces])
    owner, box = _middles(pieces, start, spacing, resolution)
    home = np.floor((center - start) / spacing).astype(np.int64)
    key, home_key = _keys(box, home)

    # a middle on a face belongs in part to each of the elements there
    key, first, which, parts = np.unique(key, True, True, True)
    weight = 1 / parts[which]
    count = np.bincount(owner, weight, len(volume))
    share = np.bincount(which, volume[owner] * weight / count[owner], len(key))
    position = start + (box[first] + 0.5) * spacing

    empty = np.flatnonzero(count == 0)
    has_home = np.isin(home_key[empty], key)
    at_home, lonely = empty[has_home], empty[~has_home]
    np.add.at(share, np.searchsorted(key, home_key[at_home]), volume[at_home])
    others, extra = _joined(home_key[lonely], center[lonely], volume[lonely])

    order = np.argsort(first)
    return np.concatenate([position[order], others]), np.concatenate([share[order], extra])


def _joined(key, center, volume):
    """Return middle (n, 3) and volume (n,) of all that has the same key."""
    which = np.unique(key, return_inverse=True)[1]
    total = np.bincount(which, volume)
    moments = [np.bincount(which, volume * x) for x in center.T]
    return np.stack(moments, axis=1) / total[:, None], total


def _middles(pieces, start, spacing, resolution):
    """Return elements (n,), counted through all pieces, and boxes (n, 3) that they hold."""
    found = [(np.empty(0, np.int64), np.empty((0, 3), np.int64))]
    before = 0
    for piece in pieces:
        inside = _middles_inside(piece, start, spacing, resolution)
        found += [(before + element, box) for element, box in inside]
        before += len(piece.volume)
    return [np.concatenate(column) for column in zip(*found, strict=True)]


def _keys(*boxes):
    """Return one number a box for several arrays (n, 3) of box indices, in the same numbering."""
    together = np.concatenate(boxes)
    low = together.min(axis=0)
    extent = [int(n) for n in np.ptp(together, axis=0) + 1]
    if extent[0] * extent[1] * extent[2] >= 2**62:
        raise ValueError("the body is too large for the spacing of its particles")
    x, y, z = (together - low).T
    keys = (x * extent[1] + y) * extent[2] + z
    return np.split(keys, np.cumsum([len(box) for box in boxes])[:-1])


def _middles_inside(piece, start, spacing, resolution) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield elements (n,) and the boxes (n, 3) whose middles they contain, in batches."""
    low, high = piece.nodes.min(axis=1), piece.nodes.max(axis=1)
    if not piece.element.is_linear:
        low, high = low - BULGE * (high - low), high + BULGE * (high - low)
    slack = np.maximum(ROUND_OFF, resolution / spacing)
    lowest = np.ceil((low - start) / spacing - 0.5 - slack)
    extent = np.floor((high - start) / spacing - 0.5 + slack) - lowest + 1
    number = np.prod(np.maximum(extent, 0), axis=1)
    if message := too_many(float(number.sum())):
        raise ValueError(message)
    lowest, extent = lowest.astype(np.int64), extent.astype(np.int64)
    last = np.cumsum(number.astype(np.int64))
    for begin in range(0, int(last[-1]), BATCH):
        pair = np.arange(begin, min(begin + BATCH, int(last[-1])))
        element = np.searchsorted(last, pair, side="right")
        rest = pair - last[element] + number[element].astype(np.int64)
        rest, k = np.divmod(rest, extent[element, 2])
        i, j = np.divmod(rest, extent[element, 1])
        box = lowest[element] + np.stack([i, j, k], axis=1)
        few = slice(element[0], element[-1] + 1)
        middle = start + (box + 0.5) * spacing
        inside = piece.element.contains(piece.nodes[few], element - few.start, middle, resolution)
        yield element[inside], box[inside]
