"""The fluid in the pores of a case: masses, pressures and forces at the start, walls."""

import numpy as np

from mpmgeo.boundaries.planes import Planes
from mpmgeo.materials import saturation


def saturate(case, sets, population, laws):
    """Give the particle sets of a case of two phases their fluid; its velocity is the solid's.

    `laws` (n,): position in `case.materials` of each particle's law.
    """
    pressure = np.zeros(len(population.position))
    held = prescribe(case, population, pressure)
    pull = _pull(case, population.position)
    for s in sets:
        law = case.materials[laws[s.row[0]]]
        solid, fluid = saturation.densities(law)
        s.fluid = saturation.pore_fluid(law, case.conductivity_gravity)
        s.m, s.mf = solid * s.V, fluid * s.V
        s.vf, s.pf = s.v.copy(), pressure[s.row]
        s.free = None if not held.any() else 1.0 - held[s.row]
        s.pull = None if pull is None else pull[s.row]


def prescribe(case, population, pressure):
    """Set the pore pressures (n,) [Pa] that loads say; return which (n,) are prescribed.

    Of several the last one counts, in the order of the list of loads.
    """
    position, material = population.position, population.material
    held = np.zeros(len(position), bool)
    for load in case.acting("wets"):
        wet = load.wets(position, material)
        pressure[wet] = load.pressure
        if load.is_kept:
            held |= wet
    return held


def _pull(case, position):
    """Return the forces (n, 3) [N] on the fluid against the solid, None without."""
    loads = case.acting("fluid_force")
    return sum(load.fluid_force(position) for load in loads) if loads else None


def pore_fluid(case):
    """Return the fluid in the pores of a case of two phases, None with one."""
    if case.n_phases == 1:
        return None
    from mpmgeo.mpm.pore_fluid.fluid import PoreFluid

    walls = Planes.of(case.mesh.boundary_conditions_fluid)
    return PoreFluid(walls, case.pore_pressure_smoothing)
