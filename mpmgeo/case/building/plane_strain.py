"""Whether a case is one of plane strain, and the solver of one layer that then solves it."""

from dataclasses import replace

import numpy as np

from mpmgeo.boundaries.planes import FREE, SLIDING
from mpmgeo.mpm.columns import SHEAR, Columns, are_same, seen_in_plane, to_layer
from mpmgeo.mpm.effects.across import Across
from mpmgeo.mpm.plane_strain import PlaneStrain
from mpmgeo.mpm.solver import SMALL
from mpmgeo.shapes.shape import UNIFORM, widths
from mpmgeo.state.grid import Grid

AXES = "xyz"
THICKEST = {"GIMP": np.inf, "linear": np.inf}
"""Cells across up to which a shape carries all layers alike; 2 for the others."""


class Obstacle(Exception):
    """What stands in the way of plane strain, one sentence without a full stop."""


def in_plane_strain(case, whole, assembled, notes):
    """Return what solves a case: one layer for all if that is the same, else the solver `whole`.

    `assembled(sets, grid, shape, planes)` returns a solver with effects of its own. A note says
    that one layer is solved, or what stands in the way where two sliding planes suggest it.
    """
    axes = [a for a in range(3) if whole.planes[a] == whole.planes[3 + a] == SLIDING]
    reasons, found = {}, {}
    for axis in axes:
        try:
            _check_case(case, whole, axis)
            found[axis] = _columns(case, whole, axis)
        except Obstacle as obstacle:
            reasons[axis] = str(obstacle)
    if not found:
        if reasons and _is_thin(case, axes):
            axis = min(reasons, key=lambda a: case.mesh.cells_number[a])
            notes.append(f"plane strain across {AXES[axis]} is not used: {reasons[axis]}")
        return whole
    columns = max(found.values(), key=lambda c: c.layers * case.mesh.cells_number[c.axis])
    along = AXES[columns.axis]
    does = "the steps leave it out"
    if columns.layers > 1:
        does = f"one layer of particles is solved for all {columns.layers}"
    notes.append(f"plane strain: nothing changes along {along}; {does}")
    return PlaneStrain(_of_layer(whole, columns, assembled), whole, columns)


def _is_thin(case, axes):
    """Tell whether somebody may have meant plane strain: few cells between the planes."""
    return any(case.mesh.cells_number[axis] <= 2 for axis in axes)


def _check_case(case, whole, axis):
    """Raise Obstacle if something acts that is not the same in all layers, or not built for it."""
    if case.compatibility is not None:
        raise Obstacle("compatibility asks for the steps of MPM-Geomechanics")
    if case.n_phases == 2:
        raise Obstacle("it is for one phase")
    if case.terrain_contact is not None:
        raise Obstacle("particles touch a terrain")
    if case.particle_domain == "updated":
        raise Obstacle('particle_domain is "updated"')
    if case.largest_gravity[axis] != 0.0:
        raise Obstacle("gravity has a component across")
    if case.nodal_point_load:
        raise Obstacle("a nodal_point_load acts on one place across")
    names = {effect.name for effect in whole.effects}
    if "body force" in names:
        raise Obstacle("a body_force may differ across")
    in_time = whole.effect("loads in time")
    if in_time is not None and in_time.changes("force"):
        raise Obstacle("a load on particles changes in time")
    base, tools = whole.effect("base"), whole.effect("tools")
    if base is not None and base.motion.record.acceleration[:, axis].any():
        raise Obstacle("the base moves across")
    if tools is not None:
        if any(plane is not None and plane[0] == axis for plane in tools.planes):
            raise Obstacle("a plane across has a prescribed_velocity")
        if any(np.nan_to_num(motion.velocity[:, axis]).any() for motion in tools.velocities):
            raise Obstacle("a prescribed_velocity has a component across")
    cells = case.mesh.cells_number[axis]
    most = THICKEST.get(case.shape_function, 2)
    if cells > most:
        raise Obstacle(f"{case.shape_function} allows it up to {most} cells thick")


def _columns(case, whole, axis):
    """Return who stands in a row across; raise Obstacle if they are not all the same."""
    population, mesh = whole.population, whole.grid.mesh
    x, n = population.position, mesh[6 + axis]
    others = [a for a in range(3) if a != axis]
    layers = np.unique(x[:, axis])
    L, h = len(layers), mesh[axis]
    if len(x) % L or L % n:
        raise Obstacle("particles do not stand in the same layers everywhere")
    even = (np.arange(L) + 0.5) * n * h / L
    if np.abs(layers - even).max() > 1e-9 * h:
        raise Obstacle("particles do not fill the thickness evenly")
    order = np.lexsort((x[:, axis], x[:, others[1]], x[:, others[0]]))
    rows = order.reshape(-1, L)
    at = x[rows]
    if (at[..., axis] != layers).any() or (at[..., others] != at[:, :1, others]).any():
        raise Obstacle("particles do not stand in rows across")
    first = np.empty(len(x), np.int64)
    first[rows] = rows.min(axis=1)[:, None]
    columns = Columns(axis, first, L)
    size = population.size
    if np.abs(size[:, axis] * L - n * h).max() > 1e-9 * n * h or (size != size[first]).any():
        raise Obstacle("particles differ in size across")
    for s in whole.sets:
        _check_set(s, columns)
    return columns


def _check_set(s, columns):
    """Raise Obstacle unless the particles of a set are the same in all layers."""
    place = np.full(len(columns.first), -1)
    place[s.row] = np.arange(len(s.row))
    at = place[columns.first[s.row]]
    if (at < 0).any():
        raise Obstacle("layers are of different materials")
    for name, values in s.arrays().items():
        if name not in ("row", "x") and not are_same(values, values[at]):
            raise Obstacle(f"particles begin with different values across ({name})")
    if s.v[:, columns.axis].any():
        raise Obstacle("particles begin with a velocity across")
    if s.stress[:, SHEAR[columns.axis]].any():
        raise Obstacle("particles begin with shear stresses across")


def _of_layer(whole, columns, assembled):
    """Return the solver of the layer."""
    axis, mesh = columns.axis, whole.grid.mesh
    shape = UNIFORM[axis](whole.shape)
    sets = [_layer_of(s, columns) for s in whole.sets]
    grid = Grid(mesh, widths(shape), seen_in_plane(mesh, axis))
    kinds = list(whole.planes)
    kinds[axis] = kinds[3 + axis] = FREE
    thickness = mesh[axis] * mesh[6 + axis]
    planes = type(whole.planes)(*kinds)
    solver = assembled(sets, grid, shape, planes, [], Across(axis, thickness))
    solver.small = sum(len(s.row) for s in sets) <= SMALL
    return solver


def _layer_of(s, columns):
    """Return the particles of a set that stand for all."""
    at = np.flatnonzero(columns.first[s.row] == s.row)
    arrays = {name: values[at].copy() for name, values in s.arrays().items()}
    layer = replace(s, **arrays)
    to_layer(layer, columns)
    return layer
