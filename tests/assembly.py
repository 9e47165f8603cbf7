"""Scenes for tests: a solver made of arrays, without a case, and a small case."""

import numpy as np

import mpmgeo
from mpmgeo.boundaries.planes import BoundaryConditions, Planes
from mpmgeo.damping import KineticDamping, LocalDamping
from mpmgeo.materials.elastic import Elastic
from mpmgeo.mpm.schemes import SCHEMES
from mpmgeo.mpm.solver import Solver
from mpmgeo.shapes import SHAPES
from mpmgeo.shapes.shape import widths
from mpmgeo.state.grid import Grid, Mesh
from mpmgeo.state.particles import ParticleSet, Population

RUBBER = Elastic(id=1, density=1000.0, young=1e6, poisson=0.25)
SIDES = ("plane_X0", "plane_Y0", "plane_Z0", "plane_Xn", "plane_Yn", "plane_Zn")


def planes(default="free", **kinds):
    """Return the symbols of six planes of one kind, but for those that are named."""
    return Planes.of(BoundaryConditions(**(dict.fromkeys(SIDES, default) | kinds)))


def assemble(
    position,
    *,
    velocity=(0.0, 0.0, 0.0),
    stress=None,
    mass=1.0,
    volume=0.125,
    cells=(12, 12, 12),
    cell=(1.0, 1.0, 1.0),
    shape=SHAPES["GIMP"],
    half=(0.25, 0.25, 0.25),
    scheme="USL",
    law=RUBBER.symbols,
    split=1,
    local=None,
    delayed=None,
    settles=False,
    gradient=None,
    **more,
):
    """Return the solver of particles at `position` (n, 3) in a mesh with free planes.

    `split`: number of particle sets among which the particles are dealt in turn. `local`,
    `delayed`: share of local damping, in our form or that of MPM-Geomechanics; `settles`: whether
    there is kinetic damping; `gradient`: derivatives of velocity (n, 3, 3) that particles keep.
    `more`: fields of Solver; a time step of 1 ms, no gravity and no mass cut-off if not said.
    """
    position = np.array(position, float).reshape(-1, 3)
    n = len(position)
    velocity = np.array(np.broadcast_to(velocity, (n, 3)), float)
    stress = np.zeros((n, 6)) if stress is None else np.array(stress, float)
    mass = np.array(np.broadcast_to(mass, n), float)
    variables = len(law.STATE)
    sets = []
    for number in range(split):
        rows = np.arange(number, n, split)
        sets.append(
            ParticleSet(
                law=law,
                row=rows,
                x=position[rows],
                v=velocity[rows],
                C=None if gradient is None else np.array(gradient, float)[rows],
                m=mass[rows],
                V=np.full(len(rows), float(volume)),
                stress=stress[rows],
                half=half if isinstance(half, tuple) else half[rows],
                state=np.zeros((len(rows), variables)) if variables else None,
            )
        )
    size = np.full((n, 3), 0.5)
    body, material = np.ones(n, np.uint32), np.ones(n, np.int64)
    fields = {"planes": planes(), "time_step": 1e-3, "gravity": (0.0, 0.0, 0.0)} | more
    if local is not None:
        fields["damping"] = (LocalDamping(value=local).symbols,)
    if settles:
        fields["effects"] = (*fields.get("effects", ()), KineticDamping().effect())
    return Solver(
        grid=Grid(Mesh.of(cell, cells), widths(shape)),
        sets=sets,
        population=Population(position, size, body, material, None),
        shape=shape,
        scheme=SCHEMES[scheme],
        early_damping=None if delayed is None else LocalDamping(value=delayed).symbols,
        **fields,
    )


def by_row(solver, name):
    """Return an array of all sets in row order."""
    out = np.empty((solver.count, *getattr(solver.sets[0], name).shape[1:]))
    for s in solver.sets:
        out[s.row] = getattr(s, name)
    return out


def nodes(solver):
    """Return index (k, 3), mass (k,), velocity (k, 3), acceleration (k, 3) of nodes with mass."""
    records = solver.grid.records().reshape(-1, 8)
    used = records[:, 6] != 0
    index = solver.grid.indices().reshape(-1, 3)[used]
    return index, records[used, 6], records[used, :3], records[used, 3:6]


def two_blocks(**keys):
    """Return a case as a dict: a block of 32 particles flies over a heavier one of 64 at rest.

    The mesh has 8 × 6 × 10 cells of ½ m, all planes free; the first body has the second material.
    """
    soft = {"type": "elastic", "id": 4, "density": 1000.0, "young": 1e6, "poisson": 0.25}
    heavy = {"type": "elastic", "id": 9, "density": 2000.0, "young": 2e6, "poisson": 0.0}
    low = {"type": "cuboid", "material_id": 9, "point_p1": [1, 1, 1], "point_p2": [2, 2, 2]}
    high = {"type": "cuboid", "material_id": 4, "point_p1": [1, 1, 3], "point_p2": [2, 1.5, 4]}
    return {
        "time": 0.05,
        "time_step": 1e-3,
        "n_threads": 1,
        "mesh": {
            "cells_number": [8, 6, 10],
            "cells_dimension": [0.5, 0.5, 0.5],
            "boundary_conditions": dict.fromkeys(SIDES, "free"),
        },
        "materials": [soft, heavy],
        "body": [low, high | {"initial_velocity": [3.0, 1.0, -2.0]}],
    } | keys


def simulate(case, **options):
    """Return the simulation of a case given as a dict."""
    return mpmgeo.Simulation(mpmgeo.load_case(case), **options)
