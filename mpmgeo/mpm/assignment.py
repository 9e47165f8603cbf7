"""A state that a script gives the particles, in row order."""

import numpy as np

from mpmgeo.materials.hyperelastic import is_hyperelastic, stress_of
from mpmgeo.mpm.core.domain import MOST
from mpmgeo.numerics.jit import compiled
from mpmgeo.numerics.matrices import row_of

SHAPES = {
    "velocity": (3,),
    "stress": (6,),
    "displacement": (3,),
    "deformation_gradient": (3, 3),
    "velocity_fluid": (3,),
    "pressure": (),
}
"""Shape of what a particle has of each key."""

OF_THE_FLUID = ("velocity_fluid", "pressure")

ARRAYS = {"velocity": "v", "stress": "stress", "velocity_fluid": "vf", "pressure": "pf"}


@compiled
def _stress(law, F, stress):
    for p in range(len(F)):
        σ = stress_of(law, row_of(F, p))
        for c in range(6):
            stress[p, c] = σ[c]


def assign(solver, key, values):
    """Give all particles of a solver the `values` (n, …) of a key of SHAPES; SI units.

    Raises KeyError for another key, ValueError for another shape or what cannot be.
    """
    fluid = any(s.fluid is not None for s in solver.sets)
    known = [name for name in SHAPES if fluid or name not in OF_THE_FLUID]
    if key not in known:
        raise KeyError(f"{key!r} cannot be assigned; what can: {', '.join(known)}")
    values, shape = np.asarray(values, float), (solver.count, *SHAPES[key])
    if values.shape != shape:
        raise ValueError(f"{key} has the shape {shape}, not {values.shape}")
    if key == "displacement":
        _displace(solver, values)
    elif key == "deformation_gradient":
        _deform(solver, values)
    else:
        _put(solver, key, values)
    solver.assigned()


def _put(solver, key, values):
    """Set an array of the particles."""
    if key == "stress" and any(is_hyperelastic(s.law) for s in solver.sets):
        raise ValueError(
            "stress: that of a neo-hookean material follows from the deformation_gradient; "
            "assign that"
        )
    for s in solver.sets:
        s.assign(ARRAYS[key], values)


def _displace(solver, u):
    """Set the positions by the displacements u (n, 3) [m]."""
    if solver.ground is not None:
        raise ValueError("displacement: particles in contact with a terrain cannot be displaced")
    for s in solver.sets:
        s.x[:] = solver.population.position[s.row] + u[s.row]
    solver.gone = solver.count  # so that the next step sorts


def _deform(solver, F):
    """Set volumes, and of laws that keep F also that and the stress."""
    J = np.linalg.det(F)
    if not (J > 0.0).all():
        row = int(np.argmin(J > 0.0))
        raise ValueError(f"deformation_gradient: det is {J[row]:g} in row {row}; accepted: > 0")
    V = solver.population.size.prod(axis=1) * J
    for s in solver.sets:
        s.V[:] = V[s.row]
        if s.F is not None:
            s.F[:] = F[s.row].reshape(-1, 9)
            _stress(s.law, s.F, s.stress)
        if s.domain is not None:
            _deform_domain(solver, s, F[s.row])


def _deform_domain(solver, s, F):
    """Set second moments and half-sizes (`core.domain`) by deformation gradients (n, 3, 3)."""
    cell = np.array(solver.grid.mesh[:3])
    half = 0.5 * solver.population.size[s.row] / cell
    A = F * cell / cell[:, None]
    B = np.einsum("nij,nj,nkj->nik", A, half**2, A)
    s.domain[:] = B[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
    s.half[:] = np.clip(np.sqrt(s.domain[:, :3]), s.least, MOST)
