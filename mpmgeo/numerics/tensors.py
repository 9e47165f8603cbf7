"""Symmetric 3×3 tensors in kernels: principal values, and tensors of others on the same axes.

Six components xx yy zz xy yz xz. The principal values of the deviator, scaled to √(J₂/3) = 1 and
turned so that det ≥ 0, are the roots of

    x³ − 3x − 2r = 0,    r = ½ det ∈ [0, 1]

whose largest, x ∈ [√3, 2], is at least √3 away from the others. So Newton's method finds it, and

    N = (A² + xA + (x² − 3) I)/(3x² − 3)

is the projector on its axis, both to round-off. What is left of A across that axis,

    M = A + ½x I − (3/2)x N = ½g (n₂n₂ᵀ − n₃n₃ᵀ),    g = √2 ‖M‖

gives the other two roots −½x ± ½g: no difference of nearly equal numbers, so nearly equal principal
values are as accurate as others. No axis of its own is ever needed: where two values coincide, M
vanishes and with it whatever would depend on the choice of axes.

Source: closed forms and their round-off are discussed by Hartmann (2003), Tech. Mech. 23, 283–294;
Newton's method and M, which avoid the latter, are ours.
"""

from math import copysign, sqrt

from mpmgeo.numerics.jit import inlined


@inlined
def invariants(a):
    """Return the mean of the principal values, and √(J₂/3), J₂ half the square of the deviator."""
    m = (a[0] + a[1] + a[2]) / 3.0
    x, y, z = a[0] - m, a[1] - m, a[2] - m
    shear = a[3] * a[3] + a[4] * a[4] + a[5] * a[5]
    return m, sqrt((0.5 * (x * x + y * y + z * z) + shear) / 3.0)


@inlined
def principal(a):
    """Return the principal values, ascending, and the frame of a tensor: a flat tuple of 3 and 14.

    The values are accurate to round-off of the largest one, however near to each other they are.
    """
    m, s = invariants(a)
    u = 1.0 / s if s > 0.0 else 0.0
    x, y, z = (a[0] - m) * u, (a[1] - m) * u, (a[2] - m) * u
    xy, yz, xz = a[3] * u, a[4] * u, a[5] * u
    r = 0.5 * (x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz))
    turn = copysign(1.0, r)
    x, y, z, xy, yz, xz = turn * x, turn * y, turn * z, turn * xy, turn * yz, turn * xz
    r = abs(r)

    # 2 cos(⅓ arccos r) to 3e-8, then to round-off
    r2 = r * r
    t = -0.028579130 + 0.0153286035 * r + r2 * (-0.005845661 + 0.00108521542 * r)
    t = 1.73205083 + 0.333330086 * r + r2 * (-0.0961547007 + 0.0487847677 * r + r2 * t)
    t -= (t * (t * t - 3.0) - 2.0 * r) / (3.0 * t * t - 3.0)
    q = 1.0 / (3.0 * t * t - 3.0)

    c, d = t * q, (t * t - 3.0) * q
    N0 = q * (x * x + xy * xy + xz * xz) + c * x + d
    N1 = q * (xy * xy + y * y + yz * yz) + c * y + d
    N2 = q * (xz * xz + yz * yz + z * z) + c * z + d
    N3 = q * (xy * (x + y) + xz * yz) + c * xy
    N4 = q * (yz * (y + z) + xy * xz) + c * yz
    N5 = q * (xz * (x + z) + xy * yz) + c * xz
    h, k = 0.5 * t, -1.5 * t
    M0, M1, M2 = x + h + k * N0, y + h + k * N1, z + h + k * N2
    M3, M4, M5 = xy + k * N3, yz + k * N4, xz + k * N5
    g = sqrt(2.0 * (M0 * M0 + M1 * M1 + M2 * M2) + 4.0 * (M3 * M3 + M4 * M4 + M5 * M5))

    k = turn * s
    far, near, middle = m + k * t, m - 0.5 * k * (t + g), m - 0.5 * k * (t - g)
    low, high = (near, far) if turn > 0.0 else (far, near)
    return low, middle, high, turn, g, N0, N1, N2, N3, N4, N5, M0, M1, M2, M3, M4, M5


@inlined
def on_same_axes(p, low, middle, high):
    """Return the tensor on the axes of what `principal` returned, with other principal values.

    Old values that are equal to round-off must get new ones that are.
    """
    turn, g = p[3], p[4]
    far, near = (high, low) if turn > 0.0 else (low, high)
    m = 0.5 * (middle + near)
    n = far - m
    q = (middle - near) / g if g > 0.0 else 0.0
    return (
        m + n * p[5] + q * p[11],
        m + n * p[6] + q * p[12],
        m + n * p[7] + q * p[13],
        n * p[8] + q * p[14],
        n * p[9] + q * p[15],
        n * p[10] + q * p[16],
    )


@inlined
def plus(a, s, b):
    """Return a + s b."""
    return (
        a[0] + s * b[0],
        a[1] + s * b[1],
        a[2] + s * b[2],
        a[3] + s * b[3],
        a[4] + s * b[4],
        a[5] + s * b[5],
    )


@inlined
def scalar_product(a, b):
    """Return a : b."""
    normal = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return normal + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
