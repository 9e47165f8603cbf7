"""The solver that runs a case, put together of its parts."""

import numpy as np

from mpmgeo.boundaries.planes import Planes
from mpmgeo.case.building.fluid import pore_fluid, saturate
from mpmgeo.case.building.in_time import in_time
from mpmgeo.case.building.initial_stress import begin
from mpmgeo.case.building.motions import base, bind_tools
from mpmgeo.case.building.outputs import instants_of
from mpmgeo.case.building.pace import pace
from mpmgeo.case.building.plane_strain import in_plane_strain
from mpmgeo.case.building.population import populate
from mpmgeo.case.building.rest import equilibrium
from mpmgeo.case.building.sets import particle_sets
from mpmgeo.case.building.terrain import bind_terrain
from mpmgeo.case.building.time_step import on_scaling, time_step
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.damping import LocalDamping
from mpmgeo.loads import LOADS
from mpmgeo.mpm.locking import CellMeans
from mpmgeo.mpm.schemes import scheme_of
from mpmgeo.mpm.solver import Solver
from mpmgeo.shapes import AS_MPM_GEOMECHANICS, shape_of
from mpmgeo.shapes.shape import widths
from mpmgeo.state.grid import Grid, Mesh

TOUCH = 1e-12  # cells by which a particle must reach over a node; less is round-off


def build(case, body_force=None, starts=True):
    """Return the solver of a case and notes for the user, one sentence each.

    `starts`: whether it has the stresses of the start; a run that goes on has its own.
    `body_force`: None, or a function (t, X) that returns accelerations, see `effects.body_force`.
    Raises ValueError for a record or geometry that cannot be used.
    """
    notes = []
    case = in_mesh(case, case.mesh.origin)
    population, velocity, law = populate(case, notes)
    mesh = Mesh.of(case.mesh.cells_dimension, case.mesh.cells_number)
    legacy = case.compatibility is not None
    name = case.shape_function
    shape = AS_MPM_GEOMECHANICS[name] if legacy else shape_of(name, case)
    tools, tool = bind_tools(case, population, velocity)
    contact = bind_terrain(case, mesh, shape.width, population, notes)
    sets = particle_sets(case, population, velocity, law, tool, contact, notes)
    if case.n_phases == 2:
        saturate(case, sets, population, law)
    if starts:
        begin(case, sets, population, law, tools, notes)
    lightest = min((float(s.m.min()) for s in sets), default=0.0)
    notes += on_scaling(case, velocity)
    cutoff = 0.0 if legacy else TOUCH**shape.edge * lightest
    damping, early = _damping(case)

    def assembled(sets, grid, shape, planes, said, *further):
        """Return a solver of particles in a grid, with effects of its own and some further ones."""
        own = _effects(case, population, contact, body_force, said)
        return Solver(
            grid=grid,
            sets=sets,
            population=population,
            shape=shape,
            scheme=scheme_of(case.stress_scheme_update, case),
            planes=planes,
            time_step=time_step(case, velocity),
            gravity=case.largest_gravity,
            effects=(*own, *further),
            damping=damping,
            early_damping=early,
            transfer=case.transfer.symbols,
            leaky=legacy,
            cutoff=cutoff,
            scaling=case.density_scaling,
            cells=CellMeans() if case.volumetric_locking == "cells" else None,
        )

    planes = Planes.of(case.mesh.boundary_conditions)
    solver = assembled(sets, Grid(mesh, widths(shape)), shape, planes, notes)
    if case.plane_strain == "auto":
        solver = in_plane_strain(case, solver, assembled, notes)
    return solver, notes


def _effects(case, population, contact, body_force, notes):
    """Return what joins the steps of a case."""
    legacy, velocity = case.compatibility is not None, np.zeros_like(population.position)
    mesh = Mesh.of(case.mesh.cells_dimension, case.mesh.cells_number)
    effects = (
        pace(case, instants_of(case)),
        base(case, notes),
        bind_tools(case, population, velocity)[0],
        pore_fluid(case),
        contact,
        *_of_loads(case, mesh),
        _reactions(case),
        *(_of_damping(kind, legacy) for kind in case.dampings),
        equilibrium(case),
        _domains(case),
        _ledger(case),
        in_time(case, population.position),
        _body_force(case, body_force),
    )
    return [effect for effect in effects if effect is not None]


def _damping(case):
    """Return the models of damping at the nodes, and the one that acts as in MPM-Geomechanics."""
    acting = [kind for kind in case.dampings if kind.symbols is not None]
    early = []
    if case.compatibility is not None and case.stress_scheme_update != "USF":
        early = [kind for kind in acting if kind.type == LocalDamping.type][:1]
    models = tuple(kind.symbols for kind in acting if kind not in early)
    return models, early[0].symbols if early else None


def _of_damping(kind, legacy):
    """Return what a kind of damping does with the particles as a whole, None for nothing."""
    return kind.effect_as_mpm_geomechanics() if legacy else kind.effect()


def _of_loads(case, mesh):
    """Return what the loads of a case do during a step."""
    return [load.effect(getattr(case, load.key), mesh) for load in LOADS if load.is_several]


def _domains(case):
    """Return what lets the sizes of particles follow their material, None if they stay."""
    if case.particle_domain == "initial":
        return None
    from mpmgeo.mpm.effects.domains import Domains

    return Domains()


def _body_force(case, acceleration):
    """Return what gives the particles a script's body force, None without."""
    if acceleration is None:
        return None
    from mpmgeo.mpm.effects.body_force import BodyForce

    if case.n_phases == 2:
        raise ValueError("body_force is for one phase; leave it out")
    return BodyForce(acceleration)


def _ledger(case):
    """Return what keeps the balance of energy, None if nobody asks."""
    if case.results.energy is None:
        return None
    from mpmgeo.mpm.effects.ledger import Ledger

    return Ledger(case.results.energy.every, case.stress_scheme_update == "USF")


def _reactions(case):
    """Return what measures the forces of planes and prescribed velocities, None if nobody asks."""
    planes = [probe.every for probe in case.results.probes if probe.type == "planes"]
    intervals = {*planes, *(entry.every for entry in case.prescribed_velocity)}
    if not intervals:
        return None
    from mpmgeo.mpm.effects.reactions import Reactions

    return Reactions(intervals, len(case.prescribed_velocity))
