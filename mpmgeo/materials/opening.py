"""What tension opens, and what has to close before the material bears pressure again.

A law with a tension cut-off keeps the strain θ by which tensile flow has opened the material, as
`opening` in its `STATE`. It is strain that is still there: the next trial stress counts it as
elastic, along the axis of the largest principal stress, which is that of the crack, and what does
not close flows once more:

    s → s + λ θ + 2G o,    θ → tr εt    o: θ on that axis, εt: the tensile plastic strain from there

Axes on which the stress is as large share θ. So a crack bears nothing before it has closed, and
pressure along it is none of its concern. One number is enough for several cracks, which close one
after the other instead of each by itself; soil without cohesion bears nothing while any is open.

The solver keeps the volume without openings, with which forces are computed, and does not let a
particle be open by more than the space around it is empty (`mpm/core/opening.py`).

Source: Del Piero (1989), Meccanica 24, 150–162, whose strain of fractures has the axes of the
stress and is kept; one number for it is ours.
"""

from mpmgeo.numerics.jit import inlined

EQUAL = 1e-6  # difference of two principal stresses, over 2G θ, up to which they share θ


@inlined
def opening_on_axes(law, s1, s2, s3, θ):
    """Return how much of θ is on each of the axes of principal stresses s₁ ≤ s₂ ≤ s₃ [Pa]."""
    near = EQUAL * law.G2 * θ
    n1, n2 = 1.0 if s3 - s1 <= near else 0.0, 1.0 if s3 - s2 <= near else 0.0
    o = θ / (1.0 + n1 + n2)
    return n1 * o, n2 * o, o
