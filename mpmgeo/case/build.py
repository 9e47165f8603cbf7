"""From a case to the solver that runs it: the only place that knows every package."""

from math import inf
from pathlib import Path

import numpy as np

from mpmgeo.boundaries.base_motion import BaseMotion, BaseMotionAsMPMGeomechanics
from mpmgeo.boundaries.planes import Planes
from mpmgeo.case.bindings import bind_pressure, bind_terrain, bind_tools
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.case.populate import populate
from mpmgeo.case.saturate import saturate
from mpmgeo.damping import KineticDamping, LocalDamping
from mpmgeo.loads.point import GHOSTS
from mpmgeo.materials import saturation
from mpmgeo.materials.rotation import ROTATIONS
from mpmgeo.mpm.point_loads import PointLoads
from mpmgeo.mpm.schemes import SCHEMES, SCHEMES_OF_TWO_PHASES
from mpmgeo.mpm.solver import Solver
from mpmgeo.mpm.two_phase import PoreFluid
from mpmgeo.output.particle_fields import WITH_STRAIN
from mpmgeo.shapes import SHAPES
from mpmgeo.state.grid import Grid, Mesh
from mpmgeo.state.particles import ParticleSet
from mpmgeo.state.stress_file import NAME as STRESS_FILE
from mpmgeo.state.stress_file import read_stress

TOUCH = 1e-12  # cells by which a particle must reach over a node; less is round-off
HALF = 0.5  # cells: the largest half-size for which the shapes sum to one


def build(case):
    """Return the solver of a case and notes for the user, one sentence each.

    Raises ValueError for a record or geometry that cannot be used.
    """
    notes = []
    case = in_mesh(case, case.mesh.origin)
    population, velocity, law = populate(case, notes)
    mesh = Mesh.of(case.mesh.cells_dimension, case.mesh.cells_number)
    shape = SHAPES[case.shape_function]
    legacy = case.compatibility is not None
    damping = case.damping.value if isinstance(case.damping, LocalDamping) else 0.0
    delayed = legacy and case.stress_scheme_update != "USF"
    tools, tool = bind_tools(case, population, velocity)
    contact = bind_terrain(case, mesh, shape.width, population, notes)
    sets = _sets(case, population, velocity, law, tool, contact is not None, notes)
    if case.n_phases == 2:
        saturate(case, sets, population, law)
    if case.load_state:
        _load_stress(case, sets, len(population.position))
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
        base=_base(case, notes),
        point_loads=_point_loads(case),
        local=damping if damping and not delayed else None,
        delayed=damping if damping and delayed else None,
        leaky=legacy,
        settles=isinstance(case.damping, KineticDamping),
        cutoff=0.0 if legacy else TOUCH**shape.edge * lightest,
        tools=tools,
        fluid=_pore_fluid(case),
        contact=contact,
        measured=_measured(case),
    )
    return solver, notes


def critical_time_step(case, velocity):
    """Return the time [s] in which a wave crosses a cell, particles moving at `velocity` (n, 3).

    The shortest of the materials in use, in the smallest cell size; for MPM-Geomechanics the mean
    cell size over the largest wave speed of all materials. With two phases the pore fluid counts.
    """
    cell = case.mesh.cells_dimension
    if case.compatibility is not None:
        return sum(cell) / 3 / max(law.sound_speed() for law in case.materials)
    used = {number for body in case.body if body.active for number in body.materials}
    fastest = np.sqrt((velocity**2).sum(axis=1).max(initial=0.0))
    laws = [law for law in case.materials if law.id in used]
    if case.n_phases == 1:
        return min((law.critical_time_step(min(cell), fastest) for law in laws), default=inf)
    steps = (saturation.critical_time_step(law, min(cell), fastest) for law in laws)
    return min(steps, default=inf)


def time_step(case, velocity):
    """Return the time step of a case [s]: as given, or a share of the critical one."""
    if case.time_step:
        return case.time_step
    return case.critical_time_step_multiplier * critical_time_step(case, velocity)


def _pore_fluid(case):
    """Return the fluid in the pores of a case of two phases, None with one."""
    if case.n_phases == 1:
        return None
    walls = Planes.of(case.mesh.boundary_conditions_fluid)
    return PoreFluid(walls, case.pore_pressure_smoothing)


def _measured(case):
    """Return the intervals of steps at which the forces of planes and tools are wanted."""
    planes = [probe.every for probe in case.results.probes if probe.type == "planes"]
    return tuple(sorted({*planes, *(entry.every for entry in case.prescribed_velocity)}))


def _sets(case, population, velocity, laws, tool, touches, notes):
    """Return a particle set for each material in use, and apart for each tool."""
    cell = np.array(case.mesh.cells_dimension)
    pressure = bind_pressure(case, population.position, notes)
    strained = not case.results.needed_fields.isdisjoint(WITH_STRAIN)
    sets = []
    for index, number in np.unique(np.column_stack([laws, tool]), axis=0):
        rows, law = np.flatnonzero((laws == index) & (tool == number)), case.materials[index]
        volume = population.size[rows].prod(axis=1)
        symbols = law.symbols if case.compatibility is None else law.symbols_as_mpm_geomechanics
        variables = len(symbols.STATE)
        sets.append(
            ParticleSet(
                law=symbols,
                rotation=ROTATIONS[law.objective_rate],
                row=rows,
                x=population.position[rows],
                v=velocity[rows],
                m=law.density * volume,
                V=volume,
                stress=np.zeros((len(rows), 6)),
                half=_half_sizes(population.size[rows] / cell / 2, notes),
                force=None if population.force is None else population.force[rows],
                state=np.zeros((len(rows), variables)) if variables else None,
                pressure=None if pressure is None else pressure[rows],
                strain=np.zeros((len(rows), 6)) if strained else None,
                due=np.zeros(len(rows)) if touches else None,
                contact=np.zeros((len(rows), 9)) if touches else None,
                tool=int(number) if number >= 0 else None,
            )
        )
    return sets


def _load_stress(case, sets, count):
    """Give the particles the stresses of the file beside the case, or where the run begins."""
    folders = dict.fromkeys((case.folder, Path.cwd()))
    found = [folder / STRESS_FILE for folder in folders if (folder / STRESS_FILE).is_file()]
    if not found:
        where = " or ".join(map(str, folders))
        raise ValueError(f"load_state: there is no file {STRESS_FILE} in {where}")
    stress = read_stress(found[0], count)
    for s in sets:
        s.stress[:] = stress[s.row]


def _half_sizes(half, notes):
    """Return half-sizes in cells as one triple if all particles share it, else a row each."""
    if (half > HALF * (1 + 1e-9)).any():
        notes.append("particles larger than a cell interpolate as if they were one cell large")
    half = np.minimum(half, HALF)
    if (np.ptp(half, axis=0) < 1e-12).all():
        return tuple(float(l) for l in half[0])
    return np.ascontiguousarray(half)


def _base(case, notes):
    """Return the motion of the base, if the case has one."""
    earthquake = case.earthquake
    if earthquake is None or not earthquake.active:
        return None
    record = earthquake.record()
    notes += record.warnings
    is_plane = case.terrain_contact is None
    if case.compatibility is not None:
        return BaseMotionAsMPMGeomechanics(record, case.stress_scheme_update == "MUSL", is_plane)
    if is_plane and case.mesh.boundary_conditions.plane_Z0 is not None:
        notes.append("mesh.boundary_conditions.plane_Z0 gives way to the moving base")
    return BaseMotion(record, is_plane)


def _point_loads(case):
    """Return the point loads on the nodes nearest to their points, if the case has any."""
    loads = case.nodal_point_load
    if not loads:
        return None
    cell = np.array(case.mesh.cells_dimension)
    nodes = [load.node(cell) - GHOSTS for load in loads]
    return PointLoads(nodes, [load.force for load in loads])
