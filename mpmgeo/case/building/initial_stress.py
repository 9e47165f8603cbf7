"""The stresses at the start: of a file, or those of overburden and water table.

    σ′v = σv − u,    σ′h = K0 σ′v,    u = ρw g max(min(table, ground) − h, 0)

σv is the weight of what lies above (`mpm/overburden.py`), h the height against gravity. Water that
stands on the ground is no load of the program's, so that pressures count from the ground there.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.case.building.fluid import prescribe
from mpmgeo.case.building.sets import load_stress
from mpmgeo.loads import Gravity
from mpmgeo.mpm.overburden import overburden
from mpmgeo.region import within

SLACK = 1e-9
"""Share of K0 by which a law's own limits may be exceeded through round-off."""


class Down(NamedTuple):
    """Gravity at the start: its axis, the sign of what is up on it, its size [m/s²]."""

    axis: int
    up: float
    size: float


def down(case) -> Down:
    """Return gravity at the start; raises ValueError for one that is not along an axis."""
    gravity, factor = case.gravity, 1.0
    if isinstance(gravity, Gravity):
        factor = 1.0 if gravity.course is None else gravity.course.at(0.0)
        gravity = gravity.value
    g = factor * np.array(gravity)
    if np.count_nonzero(g) != 1:
        wanted = "along an axis" if g.any() else "not zero"
        raise ValueError(
            f"gravity: is {g.tolist()} at the start; initial_stress needs one {wanted}"
        )
    axis = int(np.abs(g).argmax())
    return Down(axis, -float(np.sign(g[axis])), abs(float(g[axis])))


def begin(case, sets, population, laws, tools, notes):
    """Give the particles the stresses and pore pressures that a case begins with.

    `laws` (n,): position in `case.materials` of each particle's law; `tools`: prescribed velocities
    or None. Raises ValueError for a file that does not fit, gravity that is not along an axis, or a
    K0 that a law cannot bear.
    """
    if case.load_state:
        load_stress(case, sets, len(population.position))
    elif case.initial_stress is not None:
        _rest(case, sets, population, laws, tools, notes)


def _rest(case, sets, population, laws, tools, notes):
    """Give all particles stresses in equilibrium with their weight, and say so."""
    g = down(case)
    _soak(case, sets, population, laws, g)
    others = [axis for axis in range(3) if axis != g.axis]
    x, size = population.position, population.size
    height = g.up * x[:, g.axis]
    weight = g.size * _borne(case, sets, population, tools, g.axis)
    total, ground = overburden(x[:, others], size[:, others], height, size[:, g.axis], weight)
    u = _pressures(case, sets, population, laws, g, height, ground, notes)
    vertical = total - u
    k0 = []
    for index in sorted(np.unique(laws), key=lambda index: case.materials[index].id):
        rows, law = laws == index, case.materials[index]
        k0.append(f"{law_k0(case, law):.3g} of material {law.id}")
        _check_k0(case, law, float(vertical[rows].max()))
    for s in sets:
        σ = vertical[s.row]
        s.stress[:, others] = -law_k0(case, case.materials[laws[s.row[0]]]) * σ[:, None]
        s.stress[:, g.axis] = -σ
    notes.append(
        f"initial_stress: vertical stress up to {total.max(initial=0.0):.4g} Pa, of which pore "
        f"pressure {u[total.argmax()] if len(u) else 0.0:.4g} Pa; K0 {', '.join(k0)}"
    )


def law_k0(case, law) -> float:
    """Return horizontal over vertical effective stress of a material of a case at the start."""
    if law.is_fluid:
        return 1.0
    if law.k0 is not None:
        return law.k0
    return law.k0_at_rest if case.initial_stress.k0 is None else case.initial_stress.k0


def _check_k0(case, law, vertical):
    """Raise ValueError if a law cannot bear its K0 under the largest vertical stress [Pa]."""
    if vertical <= 0:
        return
    (low, high), k0 = law.k0_range(vertical), law_k0(case, law)
    if not low - SLACK <= k0 <= high + SLACK:
        key = f"materials: k0 of {law.id}" if law.k0 is not None else "initial_stress.k0"
        raise ValueError(
            f"{key}: {k0:g} is beyond the strength of material {law.id}, {law.type}, which under "
            f"{vertical:.4g} Pa bears {low:.4g} (active) to {high:.4g} (passive)"
        )


def _soak(case, sets, population, laws, g):
    """Give particles below the water table the mass of saturated ground, with one phase."""
    table = case.initial_stress.water_table
    if table is None or case.n_phases == 2:
        return
    below = g.up * (population.position[:, g.axis] - table) < 0
    for s in sets:
        law = case.materials[laws[s.row[0]]]
        if law.density_saturated is not None:
            s.m = np.where(below[s.row], law.density_saturated * s.V, s.m)


def _borne(case, sets, population, tools, axis):
    """Return the masses (n,) [kg] that what lies below has to bear.

    Not those of particles outside the mesh, nor of those whose velocity along gravity is given.
    """
    mass = np.zeros(len(population.position))
    for s in sets:
        if s.tool is None or not tools.given[s.tool, axis]:
            mass[s.row] = s.m if s.fluid is None else s.m + s.mf
    mesh = case.mesh
    return mass * within(mesh.origin, mesh.upper, population.position, mesh.zero)


def _pressures(case, sets, population, laws, g, height, ground, notes):
    """Return the pore pressures (n,) [Pa], after giving the particles those of the table."""
    start, two = case.initial_stress, case.n_phases == 2
    u = np.zeros(len(height))
    if start.water_table is None:
        for s in sets:
            pressure = s.pf if two else s.pressure
            u[s.row] = 0.0 if pressure is None else pressure
        return u
    table = g.up * start.water_table
    depth = np.maximum(np.minimum(table, ground) - height, 0.0)
    for s in sets:
        law = case.materials[laws[s.row[0]]]
        density = law.density_fluid if two else start.density_water
        u[s.row] = 0.0 if law.is_fluid and not two else density * g.size * depth[s.row]
    drowned = np.count_nonzero(table > ground + population.size[:, g.axis] / 2)
    if drowned:
        notes.append(
            f"initial_stress.water_table: stands above the ground over {drowned} particles; their "
            "pore pressures count from the ground, for water that stands on it is no load here"
        )
    if two:
        prescribe(case, population, u)
    for s in sets:
        (s.pf if two else s.pressure)[:] = u[s.row]
    return u
