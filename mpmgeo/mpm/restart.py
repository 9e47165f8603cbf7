"""A new beginning from the stresses that there are: after the ground has come to rest."""

import numpy as np


def restart(solver):
    """Set time, steps, displacements, strains and velocities to zero; the rest stays as it is.

    Stresses, pressures, volumes, variables of laws and what has left the mesh are those of before.
    """
    position = solver.population.position.copy()
    for s in solver.sets:
        position[s.row] = s.x
        if s.strain is not None:
            s.strain[:] = 0.0
        s.stop()
    solver.population = solver.population._replace(position=position)
    solver.moved_origin = True
    solver.time, solver.steps, solver.previous = 0.0, 0, 0.0
    solver.peak_energy = solver.reactions = None
    for restarted in solver.asked["restarted"]:
        restarted(solver)


def origin_of(solver) -> dict[str, np.ndarray]:
    """Return from where displacements count, by name, if not from where the particles began."""
    return {"origin": solver.population.position} if solver.moved_origin else {}
