"""What the planes across bear in plane strain."""

from mpmgeo.effect import Effect


class Across(Effect):
    """The forces of the two planes between which the material stands, beside those in the plane.

    They are the total stress across, over the area: F = ∓ Σ σ V/thickness.
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
        force = sum(_total_stress(s, self.axis) for s in solver.sets) / self.thickness
        solver.reactions[self.axis, self.axis] = -force
        solver.reactions[3 + self.axis, self.axis] = force

    def resumed(self, solver):
        """Know the forces that were measured before."""
        self._last = solver.reactions


def _total_stress(s, axis):
    """Return the total normal stress along an axis, summed over the volume of a set [N m]."""
    at = slice(0, s.active)
    total = s.stress[at, axis] if s.pressure is None else s.stress[at, axis] - s.pressure[at]
    return float(total @ s.V[at])
