"""What the planes across bear in plane strain."""

from mpmgeo.effect import Effect


class Across(Effect):
    """The forces of the two planes between which the material stands, beside those in the plane.

    They are the stress across, over the area: F = ∓ Σ σ V/thickness.
    """

    name = "across"
    does_work = False

    def __init__(self, axis, thickness):
        self.axis, self.thickness = axis, thickness
        self._last = None

    def before_nodes(self, solver, task):
        """Add them, if the forces of planes have been measured in this step."""
        if solver.reactions is None or solver.reactions is self._last:
            return
        self._last = solver.reactions
        sums = (s.stress[: s.active, self.axis] @ s.V[: s.active] for s in solver.sets)
        force = sum(sums) / self.thickness
        solver.reactions[self.axis, self.axis] = -force
        solver.reactions[3 + self.axis, self.axis] = force

    def resumed(self, solver):
        """Know the forces that were measured before."""
        self._last = solver.reactions
