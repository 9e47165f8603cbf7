"""The particles of a case as the solver holds them: a set for each material and each tool."""

from pathlib import Path

import numpy as np

from mpmgeo.case.building.pressure import bind_pressure
from mpmgeo.materials.hyperelastic import is_hyperelastic
from mpmgeo.materials.rotation import ROTATIONS
from mpmgeo.output.particle_fields import WITH_STRAIN
from mpmgeo.state.particles import IDENTITY, ParticleSet
from mpmgeo.state.stress_file import NAME as STRESS_FILE
from mpmgeo.state.stress_file import read_stress

FLOOR = 0.5  # part of the smallest half-size in a set below which none of its particles shrinks
HALF = 0.5  # cells: the largest half-size for which the shapes sum to one


def particle_sets(case, population, velocity, laws, tool, contact, notes):
    """Return a particle set for each material in use, and apart for each tool."""
    cell = np.array(case.mesh.cells_dimension)
    pressure = bind_pressure(case, population.position, notes)
    strained = not case.results.needed_fields.isdisjoint(WITH_STRAIN)
    touches, follows = contact is not None, case.particle_domain == "updated"
    sets = []
    for index, number in np.unique(np.column_stack([laws, tool]), axis=0):
        rows, law = np.flatnonzero((laws == index) & (tool == number)), case.materials[index]
        volume, half = population.size[rows].prod(axis=1), population.size[rows] / cell / 2
        symbols = law.symbols if case.compatibility is None else law.symbols_as_mpm_geomechanics
        variables = len(symbols.STATE)
        sets.append(
            ParticleSet(
                law=symbols,
                rotation=ROTATIONS[law.objective_rate],
                row=rows,
                x=population.position[rows],
                v=velocity[rows],
                C=np.zeros((len(rows), 3, 3)) if case.transfer.is_affine else None,
                m=law.density * volume,
                V=volume,
                stress=np.zeros((len(rows), 6)),
                half=_half_sizes(half, follows, notes),
                force=None if population.force is None else population.force[rows],
                state=np.zeros((len(rows), variables)) if variables else None,
                F=np.tile(IDENTITY, (len(rows), 1)) if is_hyperelastic(symbols) else None,
                pressure=None if pressure is None else pressure[rows],
                strain=np.zeros((len(rows), 6)) if strained else None,
                work=np.zeros((len(rows), 2)) if case.results.energy is not None else None,
                due=np.zeros(len(rows)) if touches else None,
                contact=np.zeros((len(rows), contact.columns)) if touches else None,
                domain=np.hstack([half**2, np.zeros_like(half)]) if follows else None,
                least=tuple((FLOOR * half.min(axis=0)).tolist()) if follows else None,
                tool=int(number) if number >= 0 else None,
            )
        )
    return sets


def load_stress(case, sets, count):
    """Give the particles the stresses of the file beside the case, or where the run begins."""
    folders = dict.fromkeys((case.folder, Path.cwd()))
    found = [folder / STRESS_FILE for folder in folders if (folder / STRESS_FILE).is_file()]
    if not found:
        where = " or ".join(map(str, folders))
        raise ValueError(f"load_state: there is no file {STRESS_FILE} in {where}")
    stress = read_stress(found[0], count)
    for s in sets:
        s.stress[:] = stress[s.row]


def _half_sizes(half, follows, notes):
    """Return half-sizes in cells as one triple if all particles keep the same, else a row each."""
    if (half > HALF * (1 + 1e-9)).any():
        notes.append("particles larger than a cell interpolate as if they were one cell large")
    half = np.minimum(half, HALF)
    if not follows and (np.ptp(half, axis=0) < 1e-12).all():
        return tuple(float(l) for l in half[0])
    return np.ascontiguousarray(half)
