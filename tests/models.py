"""Shapes and a material law that only the tests know, as a user would add them."""

from typing import NamedTuple

from mpmgeo.materials.law import update_stress
from mpmgeo.shapes.shape import stencil


class Spline6(NamedTuple):
    """B-spline of degree five."""

    width = 6
    edge = 5


class Spline10(NamedTuple):
    """B-spline of degree nine."""

    width = 10
    edge = 9


def _spline(width):
    """Return the stencil of a uniform B-spline, written out from degree to degree.

    N_r ← ((u + d − r) N_{r−1} + (r + 1 − u) N_r) / d,  u = s + ½,  the slopes from degree d − 1.
    """
    lines = ["def stencil(shape, s, l, cut):", " u = s + 0.5", " N0_0 = 0.0 * u + 1.0"]
    for d in range(1, width):
        for r in range(d + 1):
            lower = f"(u + {d - r}.0) * N{d - 1}_{r - 1}" if r > 0 else "0.0 * u"
            upper = f"({r + 1}.0 - u) * N{d - 1}_{r}" if r < d else "0.0 * u"
            lines.append(f" N{d}_{r} = ({lower} + {upper}) * {1 / d!r}")
    last = width - 1
    weights = [f"N{last}_{r}" for r in range(width)]
    below = ["0.0 * u", *(f"N{last - 1}_{r}" for r in range(last)), "0.0 * u"]
    slopes = [f"{below[r]} - {below[r + 1]}" for r in range(width)]
    lines.append(f" return {', '.join(weights + slopes)}")
    scope = {}
    exec("\n".join(lines), scope)
    return scope["stencil"]


for _shape in (Spline6, Spline10):
    stencil.register(_shape)(_spline(_shape.width))


class Counting(NamedTuple):
    """Symbols of an elastic law that keeps two variables: volume strain and number of updates."""

    λ: float
    G2: float

    STATE = ("volume_strain", "updates")


@update_stress.register(Counting)
def counting(law, stress, strain, state, dt):
    trace = strain[0] + strain[1] + strain[2]
    p = law.λ * trace
    return (
        stress[0] + p + law.G2 * strain[0],
        stress[1] + p + law.G2 * strain[1],
        stress[2] + p + law.G2 * strain[2],
        stress[3] + law.G2 * strain[3],
        stress[4] + law.G2 * strain[4],
        stress[5] + law.G2 * strain[5],
        state[0] + trace,
        state[1] + 1.0,
    )
