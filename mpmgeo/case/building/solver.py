"""The solver that runs a case, put together of its parts."""

from mpmgeo.boundaries.planes import Planes
from mpmgeo.case.building.fluid import pore_fluid, saturate
from mpmgeo.case.building.motions import base_motion, bind_tools
from mpmgeo.case.building.point_loads import point_loads
from mpmgeo.case.building.population import populate
from mpmgeo.case.building.sets import load_stress, particle_sets
from mpmgeo.case.building.terrain import bind_terrain
from mpmgeo.case.building.time_step import time_step
from mpmgeo.damping import KineticDamping, LocalDamping
from mpmgeo.mpm.schemes import SCHEMES, SCHEMES_OF_TWO_PHASES
from mpmgeo.mpm.solver import Solver
from mpmgeo.shapes import SHAPES
from mpmgeo.state.grid import Grid, Mesh

TOUCH = 1e-12  # cells by which a particle must reach over a node; less is round-off


def build(case):
    """Return the solver of a case and notes for the user, one sentence each.

    Raises ValueError for a record or geometry that cannot be used.
    """
    notes = []
    population, velocity, law = populate(case, notes)
    mesh = Mesh.of(case.mesh.origin, case.mesh.cells_dimension, case.mesh.cells_number)
    shape = SHAPES[case.shape_function]
    legacy = case.compatibility is not None
    damping = case.damping.value if isinstance(case.damping, LocalDamping) else 0.0
    delayed = legacy and case.stress_scheme_update != "USF"
    tools, tool = bind_tools(case, population, velocity)
    contact = bind_terrain(case, mesh, shape.width, population, notes)
    sets = particle_sets(case, population, velocity, law, tool, contact is not None, notes)
    if case.n_phases == 2:
        saturate(case, sets, population, law)
    if case.load_state:
        load_stress(case, sets, len(population.position))
    schemes = SCHEMES if case.n_phases == 1 else SCHEMES_OF_TWO_PHASES
    lightest = min((float(s.m.min()) for s in sets), default=0.0)
    solver = Solver(
        grid=Grid(mesh, shape.width),
        sets=sets,
        population=population,
        shape=shape,
        scheme=schemes[case.stress_scheme_update],
        planes=Planes.of(case.mesh.boundary_conditions),
        time_step=time_step(case, velocity),
        gravity=case.gravity,
        base=base_motion(case, notes),
        point_loads=point_loads(case),
        local=damping if damping and not delayed else None,
        delayed=damping if damping and delayed else None,
        leaky=legacy,
        settles=isinstance(case.damping, KineticDamping),
        cutoff=0.0 if legacy else TOUCH**shape.edge * lightest,
        tools=tools,
        fluid=pore_fluid(case),
        contact=contact,
        measured=_measured(case),
    )
    return solver, notes


def _measured(case):
    """Return the intervals of steps at which the forces of planes and tools are wanted."""
    planes = [probe.every for probe in case.results.probes if probe.type == "planes"]
    return tuple(sorted({*planes, *(entry.every for entry in case.prescribed_velocity)}))
