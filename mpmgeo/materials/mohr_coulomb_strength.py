"""The strengths of Mohr–Coulomb: constant, softening with plastic strain, undrained.

    y = y_residual + (y_peak − y_residual) exp(−η εp)    softening, y = φ, ψ, c, T
    N = 1,    c = su max(−σzz, 0)                        undrained, σzz of the trial stress

T never lies beyond the apex of the surface, σc/(N − 1).

Source: the softening is that of MPM-Geomechanics; su as in Skempton (1957), Proc. Inst. Civ. Eng.
7, 305–307.
"""

from math import exp, sqrt
from typing import NamedTuple

from mpmgeo.materials.mohr_coulomb_return import cut_off, flow_number
from mpmgeo.numerics.dispatch import generic


class Constant(NamedTuple):
    λ: float
    G2: float
    E: float
    ν: float
    N: float
    M: float
    σc: float
    T: float

    STATE = ("plastic_strain", "opening")
    GRAINS = True


class Softening(NamedTuple):
    """Strengths after softening, and by how much more they begin; angles in radians."""

    λ: float
    G2: float
    E: float
    ν: float
    η: float
    φ: float
    φ_loss: float
    ψ: float
    ψ_loss: float
    c: float
    c_loss: float
    T: float
    T_loss: float

    STATE = ("plastic_strain", "opening")
    GRAINS = True


class Undrained(NamedTuple):
    """Strength by vertical stress; dilation and tension may soften."""

    λ: float
    G2: float
    E: float
    ν: float
    su: float
    η: float
    ψ: float
    ψ_loss: float
    T: float
    T_loss: float

    STATE = ("plastic_strain", "opening")
    GRAINS = True


@generic
def strength(law, zz, εp):
    """Return N, M, σc [Pa], T [Pa] at the trial vertical stress `zz` [Pa] and plastic strain εp."""


@strength.register(Constant)
def constant(law, zz, εp):
    return law.N, law.M, law.σc, law.T


@strength.register(Softening)
def softening(law, zz, εp):
    w = exp(-law.η * εp)
    N = flow_number(law.φ + law.φ_loss * w)
    M = flow_number(law.ψ + law.ψ_loss * w)
    σc = 2.0 * (law.c + law.c_loss * w) * sqrt(N)
    return N, M, σc, cut_off(N, σc, law.T + law.T_loss * w)


@strength.register(Undrained)
def undrained(law, zz, εp):
    w = exp(-law.η * εp)
    M = flow_number(law.ψ + law.ψ_loss * w)
    return 1.0, M, 2.0 * law.su * max(-zz, 0.0), law.T + law.T_loss * w
