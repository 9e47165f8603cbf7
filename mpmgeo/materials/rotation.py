"""Objective rates: how the old stress turns with its particle, before the law sees it.

    Jaumann          σ ← σ + W σ + σ Wᵀ                             W = ½ (G − Gᵀ),  G = L Δt
    Hughes–Winget    σ ← R σ Rᵀ,    R = I + (W + ½ W²)/(1 + ¼ w²)   w the axial vector of W,
                                                                    G = L Δt (I + ½ L Δt)⁻¹

The Jaumann rate is taken to first order, as in MPM-Geomechanics: it does not preserve the size of
the stress, but lets the deviator grow by up to 2w² of itself in a step. R is orthogonal, and G,
the gradient in the middle of the step, has no strain ½ (G + Gᵀ) where the step is a rigid turn:
a particle that moves along its velocity is stretched by ½ w², and strains by as much.

Source: Hughes and Winget (1980), Int. J. Numer. Methods Eng. 15, 1862–1867.
"""

from typing import NamedTuple

from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.matrices import inverse, product
from mpmgeo.parameters import parameter


class Jaumann(NamedTuple):
    pass


class HughesWinget(NamedTuple):
    pass


ROTATIONS = {"none": None, "jaumann": Jaumann(), "hughes-winget": HughesWinget()}


def objective_rate(default):
    """Return the declaration of the key by which a material chooses its rotation."""
    return parameter(
        "How stress follows the rotation of the material",
        choices=tuple(ROTATIONS),
        default=default,
    )


@generic
def increments(rotation, strain, spin):
    """Return the increments of strain and spin that a rate takes for the gradient L Δt of a step.

    `strain` and `spin` are the symmetric part of L Δt and the components xy, yz, xz of the other.
    """


@increments.register(type(None))
@increments.register(Jaumann)
def at_the_start(rotation, strain, spin):
    return strain, spin


@increments.register(HughesWinget)
def in_the_middle(rotation, strain, spin):
    L = gradient(strain, spin)
    half = (
        (1.0 + 0.5 * L[0], 0.5 * L[1], 0.5 * L[2])
        + (0.5 * L[3], 1.0 + 0.5 * L[4], 0.5 * L[5])
        + (0.5 * L[6], 0.5 * L[7], 1.0 + 0.5 * L[8])
    )
    xx, xy, xz, yx, yy, yz, zx, zy, zz = product(inverse(half), L)
    return (
        (xx, yy, zz, 0.5 * (xy + yx), 0.5 * (yz + zy), 0.5 * (xz + zx)),
        (0.5 * (xy - yx), 0.5 * (yz - zy), 0.5 * (xz - zx)),
    )


@inlined
def gradient(strain, spin):
    """Return the sum of a symmetric tensor and a skew one, given as xy, yz, xz, as a matrix."""
    xx, yy, zz, xy, yz, xz = strain
    a, b, c = spin
    return xx, xy + a, xz + c, xy - a, yy, yz + b, xz - c, yz - b, zz


@generic
def rotate_stress(rotation, stress, spin):
    """Return a stress [Pa] after the rotation increment `spin`: W_xy, W_yz, W_xz [-].

    W_ij = ½ (∂v_i/∂x_j − ∂v_j/∂x_i) Δt.
    """


@rotate_stress.register(type(None))
def unrotated(rotation, stress, spin):
    return stress


@rotate_stress.register(Jaumann)
def jaumann(rotation, stress, spin):
    xx, yy, zz, xy, yz, xz = stress
    a, b, c = spin
    return (
        xx + 2.0 * (a * xy + c * xz),
        yy + 2.0 * (b * yz - a * xy),
        zz - 2.0 * (c * xz + b * yz),
        xy + a * (yy - xx) + b * xz + c * yz,
        yz + b * (zz - yy) - a * xz - c * xy,
        xz + c * (zz - xx) + a * yz - b * xy,
    )


@inlined
def times_row(σ, x, y, z):
    """Return the product of a row vector and a symmetric tensor."""
    return (
        x * σ[0] + y * σ[3] + z * σ[5],
        x * σ[3] + y * σ[1] + z * σ[4],
        x * σ[5] + y * σ[4] + z * σ[2],
    )


@rotate_stress.register(HughesWinget)
def hughes_winget(rotation, stress, spin):
    a, b, c = spin
    q = 1.0 / (1.0 + 0.25 * (a * a + b * b + c * c))
    h = 0.5 * q
    R00, R01, R02 = 1.0 - h * (a * a + c * c), q * a - h * b * c, q * c + h * a * b
    R10, R11, R12 = -q * a - h * b * c, 1.0 - h * (a * a + b * b), q * b - h * a * c
    R20, R21, R22 = h * a * b - q * c, -q * b - h * a * c, 1.0 - h * (b * b + c * c)
    P00, P01, P02 = times_row(stress, R00, R01, R02)
    P10, P11, P12 = times_row(stress, R10, R11, R12)
    P20, P21, P22 = times_row(stress, R20, R21, R22)
    return (
        P00 * R00 + P01 * R01 + P02 * R02,
        P10 * R10 + P11 * R11 + P12 * R12,
        P20 * R20 + P21 * R21 + P22 * R22,
        P00 * R10 + P01 * R11 + P02 * R12,
        P10 * R20 + P11 * R21 + P12 * R22,
        P00 * R20 + P01 * R21 + P02 * R22,
    )
