"""The Mohr–Coulomb return of MPM-Geomechanics, for results that shall agree with that program.

One plane at a time: the shear plane or the tension plane takes a trial stress back, chosen by a
line between the two, and nothing sees to it that the returned principal stresses are in order.
Edges, corners and equal principal stresses are left to chance; between equal ones a small shear
decides here, in place of round-off. ψ does not soften.

    fs = σ₁ − N σ₃ + 2c√N < 0,    ft = T − σ₃ < 0    (yield)
    h = σ₃ − T + a (σ₁ − T N + 2c√N),    a = √(1 + N²) + N    (h > 0: tension)

Source: Itasca, FLAC theory, Mohr–Coulomb model: the equations that program follows.
"""

from math import exp, sqrt
from typing import NamedTuple

from mpmgeo.materials.elastic import hooke, hooke_energy
from mpmgeo.materials.law import strain_energy, update_stress
from mpmgeo.materials.mohr_coulomb_return import flow_number
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.tensors import on_same_axes, principal


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
    c_residual: float
    T_residual: float
    su: float

    STATE = ("plastic_strain",)


C_MIN = 1e-5  # [Pa] cohesion where the vertical stress is tensile
NOISE = 1e-9  # relative difference below which principal stresses count as equal


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
    """Return the principal stresses after the return to a plane, and the plastic strain."""
    A, B = law.λ + law.G2, law.λ
    fs = s1 - s3 * N + 2.0 * c * sqrt(N)
    h = s3 - T + (sqrt(1.0 + N * N) + N) * (s1 - T * N + 2.0 * c * sqrt(N))
    if fs < 0.0 and h <= 0.0:
        l = fs / ((A - B * M) - (B - A * M) * N)
        εp = abs(l) * sqrt(2.0 / 3.0 * (1.0 + M * M))
        return s1 - l * (A - B * M), s2 - l * B * (1.0 - M), s3 - l * (B - A * M), εp
    if s3 > T and h > 0.0:
        l = (T - s3) / A
        return s1 + l * B, s2 + l * B, s3 + l * A, abs(l) * sqrt(2.0 / 3.0)
    return s1, s2, s3, 0.0


@inlined
def told_apart(a):
    """Return what `principal` does, for equal principal stresses those of a sheared tensor."""
    p = principal(a)
    k = NOISE * (abs(a[0]) + abs(a[1]) + abs(a[2]))
    if min(p[1] - p[0], p[2] - p[1]) < k:
        p = principal((a[0], a[1], a[2], a[3] - k, a[4] - k, a[5] - k))
    return p


@update_stress.register(Symbols)
def mohr_coulomb_legacy(law, stress, strain, state, dt):
    trial = hooke(law, stress, strain)
    N, M, c, T = strengths(law, trial[2], state[0])
    p = told_apart(trial)
    y1, y2, y3, εp = one_plane(law, p[0], p[1], p[2], N, M, c, T)
    if εp == 0.0:
        return trial + state
    return on_same_axes(p, y1, y2, y3) + (state[0] + εp,)


strain_energy.register(Symbols)(hooke_energy)
