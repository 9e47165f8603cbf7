"""Nodes whose velocity is prescribed in some components, whatever the forces.

    a = (V' − v)/h,   v = (Σ S m v − m_t V) / (m − m_t),   F = (m V' − Σ S m v)/h − f

V and V': prescribed velocity before and after the step, m_t: mass of the particles that have it, a:
what the others get, F: the force that it takes, so that momentum is balanced exactly.

Arrays: number of the velocity that each node has, or −1; 1 for the components that each velocity
prescribes, else 0; the velocities before and after the step (k, 3).
"""

from typing import NamedTuple

from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import lane

ROUND_OFF = 1e-14  # share of a node's mass below which what is left of it is round-off


class Driven(NamedTuple):
    """There are such nodes."""


@inlined
def holds(model, a, node, axis):
    """Return the number of the velocity that a node has in a component, −1 if it has none."""
    if model is None:
        return -1
    t = a[0][node]
    return t if t >= 0 and a[1][t, axis] > 0.0 else -1


@inlined
def free_components(model, a, node):
    """Return 0 for the components that are prescribed at a node, 1 for the others."""
    gx = gy = gz = 1.0
    if model is not None:
        t = a[0][node]
        if t >= 0:
            given = a[1]
            gx, gy, gz = 1.0 - given[t, 0], 1.0 - given[t, 1], 1.0 - given[t, 2]
    return gx, gy, gz


@inlined
def others_velocity(m, of_tool, momentum, before):
    """Return the velocity of what is at a node beside the particles with the prescribed one."""
    others = m - of_tool
    return (momentum - of_tool * before) / others if others > ROUND_OFF * m else before


@inlined
def drive(model, a, node, axis, r, v, x, f, e, h):
    """Return velocity, acceleration and outer force of a node, as they are, or as prescribed.

    `r`: sum of the tiles; v, x, f: what they are; e: the acceleration that nothing holds.
    """
    if model is not None:
        t = holds(model, a, node, axis)
        if t >= 0:
            before, after = a[2][t, axis], a[3][t, axis]
            m, momentum = lane(r, 0), lane(r, 1 + axis)
            v = others_velocity(m, lane(r, 7), momentum, before)
            return after, (after - v) / h, (m * after - momentum) / h - m * e
    return v, x, f


@inlined
def prescribe(model, a, node, axis, after, v):
    """Return the velocity of a node, as it is, or as prescribed."""
    if model is not None:
        t = holds(model, a, node, axis)
        if t >= 0:
            return a[3][t, axis] if after else a[2][t, axis]
    return v
