"""Initial stresses that are possible, but hardly meant."""

from collections.abc import Iterator

import numpy as np

from mpmgeo.case.building.initial_stress import down, law_k0

FEW, MANY = 0.1, 5.0
"""Horizontal over vertical stress beyond which no ground has been found at rest."""


def unlikely_rest(case, simulation) -> Iterator[str]:
    """Yield warnings about a simulation that has not started yet, one sentence each.

    The case is in coordinates of the mesh.
    """
    if case.initial_stress is None or not simulation.solver.count:
        return
    population = simulation.solver.population
    g, used = down(case), set(population.material.tolist())
    for law in {law.id: law for law in reversed(case.materials)}.values():
        k0 = law_k0(case, law)
        if law.id in used and not FEW <= k0 <= MANY:
            yield (
                f"initial_stress: K0 {k0:.3g} of material {law.id}; ground at rest has {FEW:g} to "
                f"{MANY:g}"
            )
    pulled = np.count_nonzero(simulation.field("stress")[:, g.axis] > 0)
    if pulled:
        yield (
            f"initial_stress: {pulled} particles begin with pore pressures above the weight on "
            "them, with effective stresses in tension"
        )
    if case.initial_stress.water_table is not None:
        yield from _of_table(case, population, g)


def _of_table(case, population, g):
    x, half = population.position[:, g.axis], population.size[:, g.axis] / 2
    up, table = g.up, g.up * case.initial_stress.water_table
    height = case.initial_stress.water_table + case.mesh.zero[g.axis]
    key, at = "initial_stress.water_table", f"{height:g} m"
    if table > (up * x + half).max() + half.max():
        yield f"{key}: {at} is above all bodies"
    elif table <= (up * x - half).min():
        yield f"{key}: {at} is below all bodies, which stay dry"
    elif case.n_phases == 2 and (dry := np.count_nonzero(up * x > table)):
        yield (
            f"{key}: {dry} particles begin above {at}; with two phases their pores are full too, "
            "and that water will run down"
        )
