"""Weights of largest entropy on a row of evenly spaced nodes, and the one unknown in them.

    Nⱼ = aⱼ rʲ / Z,   Σ Nⱼ tⱼ = 0,   dNⱼ/ds = Nⱼ tⱼ / Σ Nᵢ tᵢ²,   tⱼ = t + j

a: coefficients, e^(−γ j²) with j from the middle of the row, zero where a node takes no part; tⱼ:
nodes from the particle, in cells; r > 0 is e^(2γs − hλ) of the position s from the middle and of
the multiplier λ. The mean of the nodes grows with ln r, so between the first and the last node
there is one r for every place. On a whole row it depends on s alone: there it is in a table.

Source: Arroyo and Ortiz (2006), Int. J. Numer. Meth. Engng 65, 2167–2202, section 3.
"""

from math import exp, inf, nan, sqrt

import numpy as np
from numba.extending import overload

from mpmgeo.numerics.jit import INLINED, compiled, inlined
from mpmgeo.numerics.simd import lane, pack4, truncate

NEAR = 1e-7  # change of ln r whose square is round-off
LONGEST = 1.5  # change of ln r at once
TURNS = 100  # more than bisection needs
CONVERGED = 1e-13  # change of ln r that is round-off
INTERVALS = (64, 128, 256, 512, 1024)  # of a table over a cell


def coefficients(γ, count):
    """Return e^(−γ j²) of so many nodes, j from the middle of the row."""
    return tuple(exp(-γ * (j - 0.5 * (count - 1)) ** 2) for j in range(count))


def weights_and_slopes(a, r, t):
    """Return the weights and then the slopes of the nodes, one flat tuple; t: the first tⱼ."""
    return _written_out(len(a))(a, r, t)


overload(weights_and_slopes, jit_options=INLINED)(lambda a, r, t: _written_out(len(a)))


def _written_out(count):
    """Return the formula for so many nodes; powers in two chains, which are half as long."""
    nodes = range(count)
    lines = ["def formula(a, r, t):", " p0, p1, rr = 1.0 + 0.0 * r, r, r * r"]
    lines += [f" p{j} = p{j - 2} * rr" for j in nodes[2:]]
    lines += [f" n{j}, t{j} = a[{j}] * p{j}, t + {j}.0" for j in nodes]
    lines += [f" g{j} = n{j} * t{j}" for j in nodes]
    lines += [f" Z = 1.0 / ({' + '.join(f'n{j}' for j in nodes)})"]
    lines += [f" J = 1.0 / ({' + '.join(f'g{j} * t{j}' for j in nodes)})"]
    values = [f"n{j} * Z" for j in nodes] + [f"g{j} * J" for j in nodes]
    scope = {}
    exec("\n".join([*lines, f" return {', '.join(values)}"]), scope)
    return scope["formula"]


@inlined
def looked_up(table, s):
    """Return r of a whole row for s; `table`: polynomials over intervals of a cell, a row each."""
    u = (s + 0.5) * len(table)
    i = int(min(max(u, 0.0), len(table) - 1.0))
    return _polynomial(table, i, u - i)


@inlined
def looked_up_of_axes(table, s):
    """Return the r of three axes, as vectors."""
    u = (s + 0.5) * float(len(table))
    i = truncate(min(max(u, 0.0), len(table) - 1.0))
    x = u - i
    return pack4(
        _polynomial(table, int(lane(i, 0)), lane(x, 0)),
        _polynomial(table, int(lane(i, 1)), lane(x, 1)),
        _polynomial(table, int(lane(i, 2)), lane(x, 2)),
        1.0,
    )


@inlined
def _polynomial(table, i, x):
    xx = x * x
    low = table[i, 0] + x * table[i, 1] + xx * (table[i, 2] + x * table[i, 3])
    return low + xx * xx * (table[i, 4] + x * table[i, 5])


@compiled
def searched(a, r, t):
    """Return r by Newton's method in a bracket, from `r` on; NaN if it is not found."""
    low, high = 0.0, inf
    for _ in range(TURNS):
        p, x, m1, m2 = 1.0, t, 0.0, 0.0
        for j in range(len(a)):
            g = a[j] * p * x
            m1, m2 = m1 + g, m2 + g * x
            p, x = p * r, x + 1.0
        δ = -m1 / m2
        if abs(δ) <= NEAR:
            return r * (1.0 + δ)
        if m1 > 0.0:
            high = r
        else:
            low = r
        δ = min(max(δ, -LONGEST), LONGEST)
        new = r * (2.0 + δ) / (2.0 - δ)
        r = new if low < new < high else sqrt(low * high)
    return nan


def tabulated(a):
    """Return the smallest table for the coefficients of a whole row, None if none is CONVERGED."""
    for count in INTERVALS:
        table = _table(a, count)
        if all(_residual(a, table, x) < CONVERGED for x in (0.25, 0.5, 0.75)):
            return table
    return None


def _table(a, count):
    """Return quintics between values, slopes and curvatures of r, which are those of ln r."""
    s = np.linspace(-0.5, 0.5, count + 1)
    r = np.array([searched(a, 1.0, -x - 0.5 * (len(a) - 1)) for x in s])
    m0, _, m2, m3 = _moments(a, r, s)
    slope = m0 / m2 / count
    d, e = r * slope, r * (slope**2 - m3 / m0 * slope**3 * count)
    (f, g), (d, b), (e, c) = ((x[:-1], x[1:]) for x in (r, d, e))
    c3 = 10 * (g - f) - 6 * d - 4 * b - 1.5 * e + 0.5 * c
    c4 = -15 * (g - f) + 8 * d + 7 * b + 1.5 * e - c
    c5 = 6 * (g - f) - 3 * (d + b) - 0.5 * (e - c)
    return np.stack([f, d, 0.5 * e, c3, c4, c5], axis=1)


def _residual(a, table, x):
    s = (np.arange(len(table)) + x) / len(table) - 0.5
    _, m1, m2, _ = _moments(a, table @ x ** np.arange(6), s)
    return np.abs(m1 / m2).max()


def _moments(a, r, s):
    """Return Σ nⱼ tⱼᵏ, k = 0 … 3, for many r and s."""
    j = np.arange(len(a))
    n, t = a * r[:, None] ** j, j - 0.5 * (len(a) - 1) - s[:, None]
    return [(n * t**k).sum(axis=1) for k in range(4)]
