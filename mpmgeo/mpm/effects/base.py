"""The base as a part of a step: its motion, and the planes that it makes."""

from mpmgeo.boundaries.base_motion import STILL
from mpmgeo.effect import Effect
from mpmgeo.state.checked import truth_from, vector_from


class Base(Effect):
    """Moves the base, the lowest plane or a terrain, as `motion`, a `BaseMotion`, says."""

    name = "base"

    def __init__(self, motion):
        self.motion = motion

    def join(self, solver):
        """Make the lowest plane the base, if it is."""
        self.solver = solver
        self.planes = self.motion.planes(solver.planes)
        solver.bound(self.planes)

    def begin(self, solver, h):
        """Take the base on by a step, until its record ends."""
        if self.motion.ended:
            return
        solver.motion = self.motion.advance(solver.time, h)
        if self.motion.ended:
            solver.bound(self.motion.planes_after(solver.planes))

    def restarted(self, solver):
        """Follow the record from its beginning."""
        self.take({"velocity": [0.0, 0.0, 0.0], "ended": False})

    def news(self, solver):
        """Tell when the record ends."""
        if self.motion.ended:
            yield (
                "record",
                lambda: [
                    f"the record of the base ended before {solver.time:.6g} s; "
                    f"{self.motion.afterwards} from then on"
                ],
            )

    def held(self):
        """Return the velocity of the base, and whether its record has ended."""
        return {"velocity": self.motion.velocity, "ended": bool(self.motion.ended)}

    def take(self, state):
        """Go on with what `held` once returned, with the planes that follow from it."""
        motion, planes = self.motion, self.planes
        motion.velocity, motion.ended = vector_from(state, "velocity"), truth_from(state, "ended")
        self.solver.bound(motion.planes_after(planes) if motion.ended else planes)
        self.solver.motion = STILL
