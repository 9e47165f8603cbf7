"""Splines that end at a wall: functions of nodes beyond are given to nodes before, linearly.

A field that goes on straight beyond the wall has f₋₁ = 2 f₀ − f₁ at the first node there. So

    N₀ ← N₀ + 2 N₋₁,   N₁ ← N₁ − N₋₁,   N₋₁ ← 0

leaves no function beyond, and constant and linear fields as they were; at a node f₋₂ two beyond
the same is done before, with N₋₂. A spline is symmetric, so N₁ = N₋₁ at the wall: there N₀ = 1 and
all others vanish. In the first cell N₁ − N₋₁ ≥ 0, for N grows towards its node.

Source: Steffen, Kirby and Berzins (2008), Int. J. Numer. Meth. Engng 76, 922–948, for splines
that differ at walls; the rule is that of a field without curvature at the wall.
"""

from numba.extending import overload

from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import Vector, lane

HAIR = 2.0**-50
"""Cells that particles keep from a wall, where N₁ has a slope but no weight; as `LinearInside`."""


def is_cut(cut):
    """Tell whether a wall cuts the stencil, along any axis; where none does, nothing is to do."""
    return cut[0] + cut[1] > 0.0


@overload(is_cut, jit_options=INLINED)
def _is_cut(cut):
    if not isinstance(cut[0], Vector):
        return is_cut

    def along_any_axis(cut):
        count = cut[0] + cut[1]  # the fourth lane is no axis
        return lane(count, 0) + lane(count, 1) + lane(count, 2) > 0.0

    return along_any_axis


@inlined
def before_walls(s, cut, reach):
    """Return a position `s` as one before the walls; `reach`: half of the stencil's length."""
    below, above = cut
    return min(max(s, below * (1.0 + HAIR) - reach), reach - above * (1.0 + HAIR))


@inlined
def fold(part, outer, wall, inner):
    """Return values of three nodes in a row, after a part of `outer` has gone to the other two."""
    moved = part * outer
    return outer - moved, wall + 2.0 * moved, inner - moved
