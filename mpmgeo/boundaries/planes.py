"""The six planes that bound the mesh: free, sliding or fixed, and the lowest one as a moving base.

A plane holds the nodes on it and beyond it. Sliding removes the velocity and force normal to the
plane, fixed all of it. A moving base gives its nodes its own velocity and acceleration.
"""

from dataclasses import dataclass
from typing import NamedTuple

from mpmgeo.numerics.jit import inlined
from mpmgeo.parameters import parameter
from mpmgeo.state.sorting import Walls

KINDS = ("free", "sliding", "fixed")
FREE, SLIDING, FIXED, BASE = range(4)


def _plane(where):
    doc = f"Condition on the plane {where}; sliding if not said"
    return parameter(doc, choices=KINDS, default=None)


@dataclass(frozen=True)
class BoundaryConditions:
    """Conditions of the six bounding planes: free, sliding (no normal velocity) or fixed."""

    plane_X0: str | None = _plane("of lowest x")
    plane_Y0: str | None = _plane("of lowest y")
    plane_Z0: str | None = _plane("of lowest z")
    plane_Xn: str | None = _plane("of highest x")
    plane_Yn: str | None = _plane("of highest y")
    plane_Zn: str | None = _plane("of highest z")

    def kinds(self) -> dict[str, str]:
        """Return plane name → kind, with sliding where nothing was said."""
        return {name: kind or "sliding" for name, kind in vars(self).items()}


class Planes(NamedTuple):
    """Kinds of the six planes for kernels, and whether upper sides win over a base at its edges.

    If they do, the lower sides hold what comes before the base: what base nodes keep of their own.
    """

    x0: int
    y0: int
    z0: int
    xn: int
    yn: int
    zn: int
    upper_wins: bool

    @classmethod
    def of(cls, conditions: BoundaryConditions):
        """Return the symbols of the boundary conditions of a case."""
        return cls(*(KINDS.index(kind) for kind in conditions.kinds().values()), upper_wins=False)

    @property
    def walls(self) -> Walls:
        """Return the planes that hold still; a base moves, and particles with it."""
        return Walls(*(kind in (SLIDING, FIXED) for kind in self[:6]))

    @property
    def cutting(self) -> Walls:
        """Return the planes at which shapes end, if they do: all that hold or move nodes."""
        return Walls(*(kind != FREE for kind in self[:6]))


@inlined
def touches(corner, cells, side):
    """Tell whether a block's nodes along one axis can lie on or beyond a plane."""
    return corner <= 0 or corner * side + side > cells


@inlined
def _keep(kind, beyond):
    """Return the factors of the components normal and tangential to a plane."""
    if not beyond or kind in (FREE, BASE):
        return 1.0, 1.0
    return 0.0, 0.0 if kind == FIXED else 1.0


@inlined
def constrain(planes, mesh, I, J, K, x, y, z, base, on_base):
    """Return the components of a nodal vector as the planes leave them.

    `base`: the vector of the moving base; `on_base`: whether base nodes take it or keep their own.
    """
    nx, tx = _keep(planes.x0, I <= 0)
    ny, ty = _keep(planes.y0, J <= 0)
    nz, tz = _keep(planes.z0, K <= 0)
    px, sx = _keep(planes.xn, mesh.nx <= I)
    py, sy = _keep(planes.yn, mesh.ny <= J)
    pz, sz = _keep(planes.zn, mesh.nz <= K)
    upper_x, upper_y, upper_z = px * sy * sz, sx * py * sz, sx * sy * pz
    if planes.z0 == BASE and K <= 0:
        if on_base:
            x, y, z = base[0], base[1], base[2]
        elif planes.upper_wins:
            x, y, z = x * nx * ty, y * tx * ny, z * tx * ty
        if planes.upper_wins:
            return x * upper_x, y * upper_y, z * upper_z
        return x, y, z
    return x * upper_x * nx * ty * tz, y * upper_y * tx * ny * tz, z * upper_z * tx * ty * nz
