"""The Mohr–Coulomb surface with a tension cut-off, and the return of principal stresses to it.

Trial stresses s₁ ≤ s₂ ≤ s₃ beyond one of

    N s₃ − s₁ ≤ σc    (shear)        s₃ ≤ T    (tension)        T ≤ σc/(N − 1), the apex

return by Koiter's rule over all the planes, edges and corners that permutations of these make: the
plastic strains are multiples ≥ 0 of the gradients of M s₃ − s₁ (shear) and of s₃ (tension), for
the surfaces on which the result lies and no others. For M = N the result is the admissible point
nearest to the trial one in the energy norm. For M < N the tension planes close the apex, where
shear flow alone would leave trial stresses without a return.

On the edge s₂ = s₃ only the mean of the two counts: so edges are planes in fewer variables, and
each part of the surface has a formula of its own:

    shear only       plane, or edge s₂ = s₃, or edge s₁ = s₂
    tension only     plane s₃ = T, or edge s₂ = s₃ = T, or corner s₁ = s₂ = s₃ = T
    both             s₃ = T, s₁ = N T − σc, and s₂ between them as elasticity has it without plastic
                     strain along its own axis, or at one of the two

Source: Koiter (1953), Q. Appl. Math. 11, 350–354; the parts of the surface are those of Clausen,
Damkilde and Andersen (2007), Comput. Struct. 85, 1795–1807.
"""

from math import inf, sin

from mpmgeo.numerics.jit import inlined


@inlined
def flow_number(angle):
    """Return (1 + sin φ)/(1 − sin φ), the ratio of principal stresses at failure if c = 0."""
    return (1.0 + sin(angle)) / (1.0 - sin(angle))


@inlined
def cut_off(N, σc, T):
    """Return the tension cut-off, at most at the apex."""
    return min(T, σc / (N - 1.0) if N > 1.0 else inf)


@inlined
def shear_return(s1, s2, s3, r, N, M, σc):
    """Return the principal stresses after shear flow alone; those in no order lie beyond the apex.

    `r` is ν/(1 − ν); λ is the plastic multiplier times the stiffness of confined compression.
    """
    λ = (N * s3 - s1 - σc) / (1.0 + N * M - r * (N + M))
    y1, y2, y3 = s1 + λ * (1.0 - r * M), s2 + λ * r * (1.0 - M), s3 + λ * (r - M)
    if y2 > y3:
        s = 0.5 * (s2 + s3)
        h = 0.5 * (1.0 + r) * M
        λ = (N * s - s1 - σc) / (N * (h - r) + 1.0 - r * M)
        y1, y2 = s1 + λ * (1.0 - r * M), s + λ * (r - h)
        y3 = y2
    elif y1 > y2:
        s = 0.5 * (s1 + s2)
        h = 0.5 * (1.0 + r) - r * M
        λ = (N * s3 - s - σc) / (N * (M - r) + h)
        y2, y3 = s + λ * h, s3 + λ * (r - M)
        y1 = y2
    return y1, y2, y3


@inlined
def tension_return(s1, s2, s3, r, T):
    """Return the principal stresses after tensile flow alone."""
    y1, y2 = s1 - r * (s3 - T), s2 - r * (s3 - T)
    if y2 > T:
        y1, y2 = s1 - r / (1.0 + r) * (s2 + s3 - 2.0 * T), T
    return min(y1, T), y2, T


@inlined
def return_to_surface(s1, s2, s3, r, N, M, σc, T):
    """Return the principal stresses, ascending, to which a trial state beyond the surface flows."""
    if N * s3 - s1 > σc:
        y1, y2, y3 = shear_return(s1, s2, s3, r, N, M, σc)
        if y3 <= T:
            return y1, y2, y3
    y1, y2, y3 = tension_return(s1, s2, s3, r, T)
    low = N * T - σc
    if y1 < low:
        y1 = low
        y2 = min(max(s2 - r / (1.0 + r) * (s1 - low + s3 - T), low), T)
    return y1, y2, y3


@inlined
def lost_strain(d1, d2, d3, ν, E):
    """Return the plastic strain that lets the principal stresses drop by d."""
    tr, k, w = ν * (d1 + d2 + d3), 1.0 + ν, 1.0 / E
    return w * (k * d1 - tr), w * (k * d2 - tr), w * (k * d3 - tr)


@inlined
def tensile_part(ε1, ε2, ε3, M):
    """Return the part of a plastic volume strain, on a plane of tension, that is no dilation.

    Shear shortens axes 1 and 2, and lengthens the others by M times as much.
    """
    return max(ε1 + ε2 + ε3 - (M - 1.0) * (max(-ε1, 0.0) + max(-ε2, 0.0)), 0.0)
