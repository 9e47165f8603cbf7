"""Contact with the terrain of a case."""

import numpy as np

from mpmgeo.boundaries.distance import Ground
from mpmgeo.positions import mean_edge, shown

RIM = 0.01  # cells by which a point may be beyond the border of a terrain
MARGIN = 4  # cells around the mesh in which distances are needed
SAMPLE = 20_000  # particles that are looked at before the run, at least


def bind_terrain(case, mesh, width, population, notes):
    """Return the contact of a case with its terrain, None without.

    Raises ValueError if the surface misses the mesh, or most particles begin below it.
    """
    terrain = case.terrain_contact
    if terrain is None:
        return None
    from mpmgeo.mpm.terrain.contact import Contact, ContactAsMPMGeomechanics

    notes += terrain.surface.notes
    legacy = case.compatibility is not None
    surface = terrain_in_mesh(case, legacy)
    if not len(surface.corner):
        low, high = terrain.surface.corner.min(axis=(0, 1)), terrain.surface.corner.max(axis=(0, 1))
        raise ValueError(
            f"{terrain.stl_mesh}: no triangle in the mesh, {shown(case.mesh.origin, terrain.zero)} "
            f"to {shown(case.mesh.upper, terrain.zero)}; the surface reaches from "
            f"{shown(low, terrain.zero)} to {shown(high, terrain.zero)}"
        )
    cell = mean_edge(case.mesh.cells_dimension)
    symbols = terrain.symbols(cell)
    around = surface if legacy else _meeting(case, terrain.surface, symbols.D + MARGIN * cell)
    box = (case.mesh.origin, case.mesh.upper)
    ground = Ground.of(around, *box, max(RIM * cell, terrain.resolution), by_plane=legacy)
    kind = ContactAsMPMGeomechanics if legacy else Contact
    contact = kind(symbols, surface, ground, mesh, width)
    if legacy:
        contact.keeps_density = _wants_density(case.results)
    _look_below(terrain, contact, population, legacy, notes)
    return contact


def _wants_density(results):
    """Tell whether files of the grid or of the terrain hold the density."""
    of_grid = not results.grid_once and "density_levelset" in results.grid_fields
    of_terrain = not results.terrain_once and "stl_density_levelset" in results.terrain_fields
    return of_grid or of_terrain


def terrain_in_mesh(case, legacy):
    """Return the part of the terrain that can be touched: all triangles whose box meets the mesh.

    As in MPM-Geomechanics, only those with a corner inside.
    """
    surface = case.terrain_contact.surface
    if legacy:
        low, high = np.array(case.mesh.origin), np.array(case.mesh.upper)
        inside = ((surface.corner >= low) & (surface.corner <= high)).all(axis=2).any(axis=1)
        return surface.part(inside)
    return _meeting(case, surface, 0.0)


def _meeting(case, surface, margin):
    """Return the triangles whose box comes nearer than `margin` [m] to the mesh."""
    low, high = np.array(case.mesh.origin) - margin, np.array(case.mesh.upper) + margin
    lowest, highest = surface.corner.min(axis=1), surface.corner.max(axis=1)
    return surface.part(((lowest <= high) & (highest >= low)).all(axis=1))


def _look_below(terrain, contact, population, legacy, notes):
    """Note, or refuse, that particles begin below the ground."""
    sample = slice(None, None, max(1, len(population.position) // SAMPLE))
    position, size = population.position[sample], population.size[sample]
    below = np.flatnonzero(contact.distance(position) < -0.5 * size.max(axis=1))
    if not len(below):
        return
    where = shown(position[below[0]], terrain.zero)
    message = (
        f"{terrain.stl_mesh}: {len(below)} of {len(position)} particles begin below the surface, "
        f"one at {where}; the outside of a triangle is where its corners run anticlockwise"
    )
    if 2 * len(below) > len(position) and not legacy:
        raise ValueError(f"{message}: is the surface inside out?")
    notes.append(message)
