"""Whether the particles of a case fit into its mesh and into memory, before any is made."""

import os
from math import prod
from pathlib import Path

import numpy as np

from mpmgeo.positions import shown

MANY = 1_000_000
"""Particle positions of a body that are made without a look at the mesh."""

PER_POSITION, PER_PARTICLE = 60, 450
"""Bytes that a position to look at, and a particle with its share of the grid, need."""

CONTROL_GROUP = Path("/sys/fs/cgroup/memory.max")


def check_sizes(parts, mesh, report):
    """Report bodies of a great many particles, of which most cannot lie in the mesh, or which
    memory cannot hold together; `parts` of active bodies."""
    cell, total = np.array(mesh.cells_dimension), 0.0
    for part in parts:
        if hasattr(part.made, "lattice") and _misses(part.made.lattice(cell), mesh, part, report):
            continue
        positions, particles = part.made.demand(cell)
        total += positions * PER_POSITION + particles * PER_PARTICLE
    memory = memory_of_machine()
    if memory is not None and total > memory:
        report.error(
            ("body",),
            f"the particles need about {total / 1e9:.3g} GB of memory, more than the "
            f"{memory / 1e9:.3g} GB there are",
        )


def _misses(lattice, mesh, part, report):
    """Tell whether a body has a great many positions, most of them outside the mesh; report it."""
    inside = _inside(lattice, mesh)
    is_lost = lattice.number > MANY and lattice.number > 10 * inside
    if is_lost:
        high = lattice.start + lattice.cell * lattice.cells
        report.error(
            part.path,
            f"needs {lattice.number:.3g} particle positions, of which {inside:.3g} can lie in "
            f"the mesh; the body reaches from {shown(lattice.start)} to {shown(high)}, the "
            f"mesh from {shown(mesh.origin)} to {shown(mesh.upper)}",
        )
    return is_lost


def _inside(lattice, mesh):
    """Return how many positions of a lattice lie in the box of the mesh."""
    step = lattice.size
    first = np.ceil((np.array(mesh.origin) - lattice.start) / step - 0.5)
    last = np.floor((np.array(mesh.upper) - lattice.start) / step - 0.5)
    most = np.array(lattice.cells) * lattice.per_cell - 1
    return prod(np.maximum(np.minimum(last, most) - np.maximum(first, 0) + 1, 0).tolist())


def memory_of_machine() -> float | None:
    """Return the memory that the machine, or the control group, has [bytes]; None if unknown."""
    try:
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None
    try:
        return min(memory, int(CONTROL_GROUP.read_text()))
    except (OSError, ValueError):  # none, or "max"
        return memory
