"""The Boussinesq problem in a box, by finite elements: smooth sides and bottom, free top.

Near the force the solution is singular, which no element can follow. So the displacement is split
into that of the half-space, exact and singular, and a smooth rest; the elements solve for the rest,
driven by what the half-space solution leaves on the walls. By symmetry a quarter of the box is
enough.
"""

import numpy as np
from skfem import (
    Basis,
    ElementHex2,
    ElementVector,
    FacetBasis,
    LinearForm,
    MeshHex,
    asm,
    condense,
    solve,
)
from skfem.models.elasticity import lame_parameters, linear_elasticity

from mpmgeo.verify.half_space import HalfSpace

ROUND_OFF = 1e-9


class BoxUnderForce:
    """A box `side` (2,) [m] wide and `depth` [m] deep with a force in the middle of its top."""

    def __init__(self, ground: HalfSpace, side, depth, elements):
        self.ground = ground
        half = [np.linspace(0, s / 2, elements // 2 + 1) for s in side]
        mesh = MeshHex.init_tensor(*half, np.linspace(-depth, 0, elements + 1))
        element = ElementVector(ElementHex2())
        self.basis = Basis(mesh, element, intorder=4)
        stiffness = asm(
            linear_elasticity(*lame_parameters(ground.young, ground.poisson)), self.basis
        )
        walls = mesh.facets_satisfying(lambda x: self._on_wall(x).any(axis=0))
        pull = LinearForm(self._pull).assemble(FacetBasis(mesh, element, facets=walls, intorder=6))
        prescribed, values = self._supports()
        self.rest = solve(*condense(stiffness, -pull, x=values, D=prescribed))

    def displacement(self, position):
        """Return the displacement (n, 3) [m] at points (n, 3) [m] relative to the force, z up."""
        sign = np.where(position[:, :2] < 0, -1.0, 1.0)
        quarter = np.column_stack([np.abs(position[:, :2]), position[:, 2]])
        rest = (self.basis.probes(quarter.T) @ self.rest).reshape(3, -1).T
        rest[:, :2] *= sign
        return self.ground.displacement(position) + rest

    def _on_wall(self, x):
        extent = np.abs(self.basis.mesh.p).max(axis=1)
        return np.abs(x) > extent[:, None] - ROUND_OFF

    def _pull(self, v, w):
        """Traction of the half-space solution on the walls, times the test function."""
        s = np.moveaxis(self.ground.stress(np.moveaxis(w.x, 0, -1)), -1, 0)
        tensor = np.array([[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]])
        return np.einsum("ij...,j...,i...->...", tensor, w.n, v)

    def _supports(self):
        """Return the dofs that are given, and a vector with their values [m]."""
        at = self.basis.doflocs
        component = np.empty(at.shape[1], int)
        for axis in range(3):
            component[self.basis.get_dofs(elements=True).all(f"u^{axis + 1}")] = axis
        dofs = np.arange(len(component))
        normal = np.abs(at[component, dofs])
        symmetric = (component < 2) & (normal < ROUND_OFF)
        walls = self._on_wall(at)[component, dofs]
        values = np.zeros(len(component))
        values[walls] = -self.ground.displacement(at[:, walls].T)[
            np.arange(walls.sum()), component[walls]
        ]
        return np.flatnonzero(symmetric | walls), values
