"""What tension opens, and what has to close before the material bears pressure again.

A law with a tension cut-off keeps the strain θ by which tensile flow has opened the material, as
`opening` in its `STATE`. It is strain that is still there: the next trial stress counts it as
elastic, across the axis on which the old stress is most tensile, for that is where the crack is,
and what does not close flows once more:

    σ → σ + λ θ I + 2G O,    θ → tr εt

O is θ on that axis, εt the tensile plastic strain from there.

Axes on which the stress is as large share θ. So a crack bears no pressure before it has closed, and
pressure along it is none of its concern. One number is enough for several cracks, which close one
after the other instead of each by itself; soil without cohesion bears nothing while any is open.

The solver keeps the volume without openings, with which forces are computed, and does not let a
particle be open by more than the space around it is empty (`mpm/core/opening.py`).

Source: Del Piero (1989), Meccanica 24, 150–162, whose strain of fractures has the axes of the
stress and is kept; one number for it is ours.
"""

from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.tensors import on_same_axes, plus, principal, scalar_product

EQUAL = 1e-6  # difference of two principal stresses, over 2G θ, up to which they share θ


@inlined
def strain_of_opening(law, stress, θ):
    """Return the six components of the strain θ across the cracks of a stress [Pa]."""
    p = principal(stress)
    near = EQUAL * law.G2 * θ
    n1, n2 = 1.0 if p[2] - p[0] <= near else 0.0, 1.0 if p[2] - p[1] <= near else 0.0
    o = θ / (1.0 + n1 + n2)
    return on_same_axes(p, n1 * o, n2 * o, o)


@inlined
def square_of_flow(ε, was_open, θ, wide):
    """Return Δεp : Δεp, for the strain ε that flowed from a trial stress which counts θ as elastic.

    What was open and still is, θ or less in a material that now is `wide` open, has not flown.
    """
    flow = plus(ε, -min(wide / θ, 1.0), was_open)
    return scalar_product(flow, flow)
