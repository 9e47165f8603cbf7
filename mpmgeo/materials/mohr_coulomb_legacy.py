"""The Mohr–Coulomb return of MPM-Geomechanics, for results that shall agree with that program.

One plane at a time: the shear plane or the tension plane takes a trial stress back, chosen by a
line between the two, and nothing sees to it that the returned principal stresses are in order.
Edges, corners and equal principal stresses are left to chance. ψ does not soften.

    fs = σ₁ − N σ₃ + 2c√N < 0,    ft = T − σ₃ < 0    (yield)
    h = σ₃ − T + a (σ₁ − T N + 2c√N),    a = √(1 + N²) + N    (h > 0: tension)

Source: Itasca, FLAC theory, Mohr–Coulomb model: the equations that program follows.
"""

from math import exp, sqrt
from typing import NamedTuple

from mpmgeo.materials.elastic import hooke
from mpmgeo.materials.law import update_stress
from mpmgeo.materials.mohr_coulomb_strength import flow_number
from mpmgeo.numerics.jit import inlined


class Symbols(NamedTuple):
    """Peak and residual strengths, equal for what does not soften; angles in radians."""

    λ: float
    G2: float
    η: float
    φ: float
    ψ: float
    c: float
    T: float
    φ_residual: float
    ψ_residual: float
    c_residual: float
    T_residual: float
    su: float

    STATE = ("plastic_strain",)


C_MIN = 1e-5  # [Pa] cohesion where the vertical stress is tensile
SWEEPS = 6


@inlined
def rotation(xx, yy, xy):
    """Return cos and sin of the angle about z that makes xy zero."""
    if xy == 0.0:
        return 1.0, 0.0
    θ = 0.5 * (yy - xx) / xy
    t = 1.0 / (abs(θ) + sqrt(θ * θ + 1.0))
    c = 1.0 / sqrt(t * t + 1.0)
    return c, t * c if θ > 0.0 else -t * c


@inlined
def eigenvectors(a):
    """Return three principal values, in no order, and the axis of each: a flat tuple of 12.

    Jacobi's method; where values coincide round-off chooses the axes. Each rotation is about the
    third axis, then the axes change places.
    """
    x, y, z, xy, yz, xz = a
    x0, x1, x2, y0, y1, y2, z0, z1, z2 = 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0
    for _ in range(3 * SWEEPS):
        c, s = rotation(x, y, xy)
        t = s / c * xy
        x, y, xz, yz = x - t, y + t, c * xz - s * yz, s * xz + c * yz
        x0, x1, x2, y0, y1, y2 = (
            c * x0 - s * y0,
            c * x1 - s * y1,
            c * x2 - s * y2,
            s * x0 + c * y0,
            s * x1 + c * y1,
            s * x2 + c * y2,
        )
        x, y, z, xy, yz, xz = y, z, x, yz, xz, 0.0
        x0, x1, x2, y0, y1, y2, z0, z1, z2 = y0, y1, y2, z0, z1, z2, x0, x1, x2
    return x, y, z, x0, x1, x2, y0, y1, y2, z0, z1, z2


@inlined
def strengths(law, zz, εp):
    """Return N, M, c [Pa], T [Pa] as that program has them."""
    w = exp(-law.η * εp)
    φ = law.φ_residual + (law.φ - law.φ_residual) * w
    c = law.c_residual + (law.c - law.c_residual) * w
    if law.su > 0.0:
        φ, c = 0.0, -law.su * zz if zz <= 0.0 else C_MIN
    T = law.T_residual + (law.T - law.T_residual) * w
    return flow_number(φ), flow_number(law.ψ), c, T


@inlined
def one_plane(law, s1, s2, s3, N, M, c, T):
    """Return the principal stresses after the return to one of the planes, and the plastic strain."""
    A, B = law.λ + law.G2, law.λ
    fs = s1 - s3 * N + 2.0 * c * sqrt(N)
    h = s3 - T + (sqrt(1.0 + N * N) + N) * (s1 - T * N + 2.0 * c * sqrt(N))
    if fs < 0.0 and h <= 0.0:
        l = fs / ((A - B * M) - (B - A * M) * N)
        εp = abs(l) * sqrt(2.0 / 3.0 * (1.0 + M * M))
        return s1 - l * (A - B * M), s2 - l * B * (1.0 - M), s3 - l * (B - A * M), εp
    if T < s3 and h > 0.0:
        l = (T - s3) / A
        return s1 + l * B, s2 + l * B, s3 + l * A, abs(l) * sqrt(2.0 / 3.0)
    return s1, s2, s3, 0.0


@update_stress.register(Symbols)
def mohr_coulomb_legacy(law, stress, strain, state, dt):
    trial = hooke(law, stress, strain)
    N, M, c, T = strengths(law, trial[2], state[0])
    x, y, z, x0, x1, x2, y0, y1, y2, z0, z1, z2 = eigenvectors(trial)
    if y < x:
        x, y, x0, x1, x2, y0, y1, y2 = y, x, y0, y1, y2, x0, x1, x2
    if z < y:
        y, z, y0, y1, y2, z0, z1, z2 = z, y, z0, z1, z2, y0, y1, y2
    if y < x:
        x, y, x0, x1, x2, y0, y1, y2 = y, x, y0, y1, y2, x0, x1, x2
    x, y, z, εp = one_plane(law, x, y, z, N, M, c, T)
    if εp == 0.0:
        return trial + state
    return (
        x * x0 * x0 + y * y0 * y0 + z * z0 * z0,
        x * x1 * x1 + y * y1 * y1 + z * z1 * z1,
        x * x2 * x2 + y * y2 * y2 + z * z2 * z2,
        x * x0 * x1 + y * y0 * y1 + z * z0 * z1,
        x * x1 * x2 + y * y1 * y2 + z * z1 * z2,
        x * x0 * x2 + y * y0 * y2 + z * z0 * z2,
        state[0] + εp,
    )
