"""Strengths of a Mohr–Coulomb material: constant, softening with plastic strain, undrained.

    N = (1 + sin φ)/(1 − sin φ)      M = (1 + sin ψ)/(1 − sin ψ)      σc = 2 c √N
    y = y_residual + (y_peak − y_residual) exp(−η εp)                 softening
    N = 1,    c = −su σzz, but not below 0                            undrained

The tension cut-off T never lies beyond the apex σc/(N − 1).

Source: the softening of MPM-Geomechanics; su of Skempton (1957), Proc. Inst. Civ. Eng. 7, 305–307.
"""

from math import exp, inf, sin, sqrt
from typing import NamedTuple

from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import inlined


class Constant(NamedTuple):
    N: float
    M: float
    σc: float
    T: float


class Softening(NamedTuple):
    """Residual values and what is lost on the way to them; angles in radians."""

    η: float
    φ: float
    φ_loss: float
    ψ: float
    ψ_loss: float
    c: float
    c_loss: float
    T: float
    T_loss: float


class Undrained(NamedTuple):
    su: float
    drained: NamedTuple  # gives dilation and tension


@generic
def strength(model, zz, εp):
    """Return N, M, σc [Pa], T [Pa] at the trial vertical stress `zz` [Pa] and plastic strain εp."""


@inlined
def flow_number(angle):
    """Return (1 + sin φ)/(1 − sin φ), the ratio of principal stresses at failure without cohesion."""
    return (1.0 + sin(angle)) / (1.0 - sin(angle))


@inlined
def cut_off(N, σc, T):
    """Return the tension cut-off, at most at the apex."""
    return min(T, σc / (N - 1.0) if N > 1.0 else inf)


@strength.register(Constant)
def constant(model, zz, εp):
    return model.N, model.M, model.σc, model.T


@strength.register(Softening)
def softening(model, zz, εp):
    w = exp(-model.η * εp)
    N = flow_number(model.φ + model.φ_loss * w)
    M = flow_number(model.ψ + model.ψ_loss * w)
    σc = 2.0 * (model.c + model.c_loss * w) * sqrt(N)
    return N, M, σc, cut_off(N, σc, model.T + model.T_loss * w)


@strength.register(Undrained)
def undrained(model, zz, εp):
    _, M, _, T = strength(model.drained, zz, εp)
    return 1.0, M, 2.0 * model.su * max(-zz, 0.0), T
