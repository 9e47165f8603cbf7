"""Fill the pores of a case's particles: masses, pressures and forces of the fluid at the start."""

import numpy as np

from mpmgeo.materials.saturation import densities, pore_fluid


def saturate(case, sets, population, laws):
    """Give the particle sets of a case of two phases their fluid; its velocity is the solid's.

    `laws` (n,): position in `case.materials` of each particle's law.
    """
    pressure, held = _pressure(case, population)
    pull = _pull(case, population.position)
    for s in sets:
        law = case.materials[laws[s.row[0]]]
        solid, fluid = densities(law)
        s.fluid = pore_fluid(law, case.conductivity_gravity)
        s.m, s.mf = solid * s.V, fluid * s.V
        s.vf, s.pf = s.v.copy(), pressure[s.row]
        s.free = None if not held.any() else 1.0 - held[s.row]
        s.pull = None if pull is None else pull[s.row]


def _pressure(case, population):
    """Return the pore pressures (n,) [Pa] and which (n,) are prescribed.

    Boxes come first, then materials, then what is prescribed; of several the last one counts.
    """
    position = population.position
    pressure, held = np.zeros(len(position)), np.zeros(len(position), bool)
    for box in case.initial_pressure_box:
        pressure[box.contains(position)] = box.pressure
    for entry in case.initial_pressure_material:
        pressure[population.material == entry.material_id] = entry.pressure
    for box in case.prescribed_pressure_box:
        inside = box.contains(position)
        pressure[inside] = box.pressure
        held |= inside
    return pressure, held


def _pull(case, position):
    """Return the forces (n, 3) [N] on the fluid against the solid, None without."""
    if not case.pressure_force_box:
        return None
    pull = np.zeros_like(position)
    for box in case.pressure_force_box:
        pull[box.contains(position)] -= box.pressure_force
    return pull
