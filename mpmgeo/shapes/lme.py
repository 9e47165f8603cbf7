"""Local maximum-entropy functions: wide and smooth for small γ, hats for large; they end at walls.

    minimise γ Σ Nⱼ tⱼ² + Σ Nⱼ ln Nⱼ  with  Σ Nⱼ = 1, Σ Nⱼ tⱼ = 0;      dNⱼ/ds = Nⱼ tⱼ / Σ Nᵢ tᵢ²

tⱼ: nodes from the particle, in cells, so γ = β h². On a box of nodes these are products of those of
its rows (`maximum_entropy`), where nodes beyond a wall are left out.

Source: Arroyo and Ortiz (2006), Int. J. Numer. Meth. Engng 65, 2167–2202.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from math import exp, floor, log, sqrt
from typing import ClassVar, NamedTuple

import numpy as np
from numba.core import types
from numba.extending import overload

from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import Vector, along, lane, pack4
from mpmgeo.parameters import parameter
from mpmgeo.shapes.maximum_entropy import (
    coefficients,
    looked_up,
    looked_up_of_axes,
    searched,
    tabulated,
    weights_and_slopes,
)
from mpmgeo.shapes.shape import stencil
from mpmgeo.shapes.wall import HAIR, is_cut

NARROWEST, WIDEST = 3, 14  # nodes along an axis


@dataclass(frozen=True)
class LocalMaxEnt:
    """The numbers of the shape function LME."""

    key: ClassVar[str] = "lme"

    gamma: float = parameter(
        "Locality β h²: below 1 wide and smooth, from 6 on hats", above=0, maximum=50, default=3.0
    )
    support_tolerance: float = parameter(
        "Weight, relative to that of the particle's own place, below which nodes are left out",
        above=0,
        maximum=1e-3,
        default=1e-6,
    )

    @property
    def width(self) -> int:
        """Return how many nodes the function reaches along an axis."""
        return max(NARROWEST, floor(2.0 * sqrt(-log(self.support_tolerance) / self.gamma)) + 1)

    @property
    def shape(self) -> NamedTuple:
        """Return the shape."""
        return _shape(self.gamma, self.width)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) where the functions would be too wide."""
        if self.width > WIDEST:
            least = -4.0 * log(self.support_tolerance) / WIDEST**2
            yield (
                "gamma",
                f"{self.gamma:g} lets the functions reach {self.width} nodes along an axis, more "
                f"than {WIDEST}; with this support_tolerance accepted: above {least:.4g}",
            )


@lru_cache
def _shape(γ, count):
    a = coefficients(γ, count)
    return _of_width(count)(exp(-γ), a, tabulated(a))


class Row(NamedTuple):
    """A row of nodes without walls: e^(−γ), its coefficients, its table, None if none serves."""

    t: float
    a: tuple
    table: np.ndarray | None

    def __eq__(self, other):
        return type(self) is type(other) and self.a == other.a

    def __hash__(self):
        return hash(self.a)


@lru_cache
def _of_width(count):
    """Return the type of shapes of a width."""
    shape = type(f"Lme{count}", (Row,), {"__slots__": (), "width": count, "edge": 2, "cuts": True})
    stencil.register(shape)(lme)
    return shape


def lme(shape, s, l, cut):
    """Return what `stencil` does for all shapes of this file."""
    return tilted(shape, s, cut)


def tilted(shape, s, cut):
    """Return weights and slopes at s."""
    if shape.table is None or is_cut(cut):
        return _of_numbers(shape, s, cut)
    return weights_and_slopes(shape.a, looked_up(shape.table, s), first_of(shape, s))


@inlined
def first_of(shape, s):
    """Return the first of the tⱼ."""
    return -s - 0.5 * (len(shape.a) - 1.0)


@inlined
def inside(shape, s, cut):
    """Return s as a place between the walls."""
    last = 0.5 * (len(shape.a) - 1.0) - HAIR
    return min(max(s, cut[0] - last), last - cut[1])


@inlined
def _of_numbers(shape, s, cut):
    s = inside(shape, s, cut)
    a, t = kept(shape.a, 1.0 - cut[0], len(shape.a) - cut[1]), first_of(shape, s)
    return weights_and_slopes(a, between_walls(shape, a, s, t, cut[0], cut[1]), t)


@inlined
def _of_axes(shape, s, cut):
    s = inside(shape, s, cut)
    a, t = kept(shape.a, 1.0 - cut[0], len(shape.a) - cut[1]), first_of(shape, s)
    x, y, z = along(a, 0), along(a, 1), along(a, 2)
    below, above = cut
    r = pack4(
        between_walls(shape, x, lane(s, 0), lane(t, 0), lane(below, 0), lane(above, 0)),
        between_walls(shape, y, lane(s, 1), lane(t, 1), lane(below, 1), lane(above, 1)),
        between_walls(shape, z, lane(s, 2), lane(t, 2), lane(below, 2), lane(above, 2)),
        1.0,
    )
    return weights_and_slopes(a, r, t)


@overload(tilted, jit_options=INLINED)
def _tilted(shape, s, cut):
    vectors = isinstance(s, Vector)
    search, look = (_of_axes, looked_up_of_axes) if vectors else (_of_numbers, looked_up)
    if isinstance(shape[2], types.NoneType):
        return search

    def values(shape, s, cut):
        if is_cut(cut):
            return search(shape, s, cut)
        return weights_and_slopes(shape.a, look(shape.table, s), first_of(shape, s))

    return values


def kept(a, low, high):
    """Return coefficients without those of nodes beyond a wall, where `low` or `high` is not > 0.

    Both are for the first node; `low` grows by one from node to node, `high` falls.
    """
    return _kept(len(a))(a, low, high)


def _kept(count):
    if count == 1:
        return lambda a, low, high: (a[0] * min(max(min(low, high), 0.0), 1.0),)

    def several(a, low, high):
        first = a[0] * min(max(min(low, high), 0.0), 1.0)
        return (first,) + kept(a[1:], low + 1.0, high - 1.0)

    return several


overload(kept, jit_options=INLINED)(lambda a, low, high: _kept(len(a)))


@inlined
def between_walls(shape, a, s, t, below, above):
    """Return r of the nodes that are kept, along one axis.

    The search begins with r for the two nodes of the particle's cell alone, which it is beside a
    wall, or with that of a row without walls.
    """
    last = len(a) - 1.0 - above
    i = min(max(float(floor(-t)), below), last - 1.0)
    ξ = -t - i
    first, final = i == below, i + 1.0 == last
    ξ = min(max(ξ, HAIR if first else shape.t), 1.0 - (HAIR if final else shape.t))
    r = a[int(i)] * ξ / (a[int(i) + 1] * (1.0 - ξ))
    beside = (first and below > 0.0) or (final and above > 0.0)
    return searched(a, r if beside else without_walls(shape.table, s, r), t)


@inlined
def without_walls(table, s, r):
    """Return r of a row without walls if there is a table of it, else r."""
    return r if table is None else looked_up(table, s)
