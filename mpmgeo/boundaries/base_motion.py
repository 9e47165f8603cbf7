"""The lowest plane as a moving base: its velocity from a record of accelerations.

v ← v + a(t) h,  h half a step at first, as for the particles
"""

from typing import NamedTuple

from mpmgeo.boundaries.planes import BASE, FIXED, SLIDING, Planes


class Motion(NamedTuple):
    """Motion of the base in a step: velocity before and after [m/s], acceleration [m/s²].

    `drives`: whether base nodes take the velocity, or only the acceleration.
    """

    before: tuple
    after: tuple
    acceleration: tuple
    drives: bool


ZERO = (0.0, 0.0, 0.0)
STILL = Motion(ZERO, ZERO, ZERO, True)


def _changed(velocity, acceleration, h):
    """Return v + a h."""
    return tuple(v + a * h for v, a in zip(velocity, acceleration, strict=True))


class BaseMotion:
    """The base follows a record: all its nodes move with its velocity, until the record ends.

    `is_plane`: whether the base is the lowest plane, not a terrain.
    """

    afterwards = "the base is held"

    def __init__(self, record, is_plane=True):
        self.record = record
        self.is_plane = is_plane
        self.velocity = ZERO
        self.ended = False

    def planes(self, planes: Planes) -> Planes:
        """Return the planes with the lowest one as base, if it is."""
        return planes._replace(z0=BASE) if self.is_plane else planes

    def advance(self, t, h) -> Motion:
        """Return the motion in the step from time t [s] on, where velocities change by h a."""
        acceleration = self.record.at(t)
        self.ended = acceleration is None
        if self.ended:
            self.velocity = ZERO
            return STILL
        before = self.velocity
        self.velocity = _changed(before, acceleration, h)
        return Motion(before, self.velocity, acceleration, True)

    def planes_after(self, planes: Planes) -> Planes:
        """Return the planes when the record has ended: the base is held, the others stay."""
        return planes


class BaseMotionAsMPMGeomechanics(BaseMotion):
    """The base as MPM-Geomechanics moves it, for comparison with old results.

    All other planes slide and the upper ones win at edges; the first record counts as zero; USL
    gives the base only the acceleration, MUSL one increment of velocity too much; afterwards all
    planes are fixed.
    """

    afterwards = "all planes are fixed"

    def __init__(self, record, remaps, is_plane=True):
        super().__init__(record, is_plane)
        self.remaps = remaps

    def planes(self, planes: Planes) -> Planes:
        """Return sliding planes on a base."""
        lowest = BASE if self.is_plane else SLIDING
        return Planes(SLIDING, SLIDING, lowest, SLIDING, SLIDING, SLIDING, upper_wins=True)

    def advance(self, t, h) -> Motion:
        """Return the motion in the step from time t [s] on, where velocities change by h a."""
        times = self.record.time
        self.ended = t >= times[-1]
        if self.ended:
            return STILL
        acceleration = self.record.at(t) if t > times[0] else ZERO
        self.velocity = _changed(self.velocity, acceleration, h)
        return Motion(self.velocity, self.velocity, acceleration, self.remaps)

    def planes_after(self, planes: Planes) -> Planes:
        """Return planes that are all fixed, if one of them was the base."""
        return Planes(*[FIXED] * 6, upper_wins=False) if self.is_plane else planes
