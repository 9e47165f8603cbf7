"""Uniform generalised interpolation: a hat function averaged over a particle of constant size.

Source: Bardenhagen and Kober (2004), CMES 5(6), eq. (31), written here without cases: with ξ the
offset from the middle node and t = clamp(l − ξ, 0, 2l), the left node has
S = t²/(4l) + max(−ξ−l, 0) and S' = −t/(2l), the right node follows by symmetry and the middle one
by partition of unity. Holds for l ≤ ½ cell.
"""

from typing import NamedTuple

from mpmgeo.shapes.shape import ends, stencil


class Gimp(NamedTuple):
    width = 3
    edge = 2
    sized = True


@stencil.register(Gimp)
def gimp(shape, s, l, cut):
    k = 0.25 / l
    a = min(max(l - s, 0.0), 2.0 * l)
    b = min(max(l + s, 0.0), 2.0 * l)
    left = a * a * k + max(-s - l, 0.0)
    right = b * b * k + max(s - l, 0.0)
    return left, 1.0 - left - right, right, -2.0 * a * k, 2.0 * (a - b) * k, 2.0 * b * k


@ends.register(Gimp)
def ends_of_particle(shape, s, l):
    left = 0.5 * (max(l - s, 0.0) + max(-s - l, 0.0))
    right = 0.5 * (max(l + s, 0.0) + max(s - l, 0.0))
    return left, 1.0 - left - right, right
