"""What joins the steps of a solver beside its particles and its grid: loads, contact, damping.

An effect is asked at fixed places of a step, in the order of the solver's list. It changes what the
stages have left, or what they are about to use; the stages and schemes know no effect by name.
"""

from collections.abc import Iterator

HOOKS = (
    *("after_sort", "begin", "before_nodes", "after_nodes", "after_remap", "before_gather"),
    *("after_gather", "end", "stopped", "resumed", "restarted", "keeping"),
    *("cutting", "news"),
)
"""Methods that a solver calls in or between steps."""


class Effect:
    """Does nothing; an effect overrides what it needs. `name` begins the names of its state.

    `does_work`: whether it may do work on the material; then it adds that to the solver's ledger,
    `solver.ledger.put_in(work)`, if there is one, and without one nobody can tell of energy whether
    it was put in.
    """

    name = ""
    does_work = True

    def join(self, solver):
        """Look at a solver that has made no step, of which the effect is to be a part."""

    def after_sort(self, solver):
        """The particles have been sorted, and the grid may have other blocks."""

    def begin(self, solver, h):
        """A step begins, in which velocities change over h [s]."""

    def before_nodes(self, solver, task):
        """The tiles are full; `task` is about to integrate the momentum of the nodes."""

    def after_nodes(self, solver, h):
        """The nodes have velocity and acceleration."""

    def after_remap(self, solver, h):
        """The particles have put their new momentum into the tiles."""

    def before_gather(self, solver, h):
        """The particles are about to move; `h` None if their velocities stay."""

    def after_gather(self, solver):
        """The particles have moved; return how many more are outside their blocks now."""
        return 0

    def end(self, solver):
        """A step is done."""

    def stopped(self, solver):
        """The particles have been stopped."""

    def resumed(self, solver):
        """The solver has taken a state from which it goes on."""

    def restarted(self, solver):
        """Time counts from 0 again, at rest, with the stresses that there are."""

    def keeping(self, walls):
        """Return those of the planes, `walls`, that particles do not pass, as far as it knows."""
        return walls

    def cutting(self, walls):
        """Return those of the planes, `walls`, at which shapes may end, as far as it knows."""
        return walls

    def news(self, solver) -> Iterator:
        """Yield (topic, messages) for what the user should be told of, `messages` a function."""
        yield from ()

    def overrides(self, hook: str) -> bool:
        """Tell whether it does anything at a hook."""
        return getattr(type(self), hook) is not getattr(Effect, hook)

    def held(self) -> dict:
        """Return what a run that goes on needs of it, arrays and JSON values by name."""
        return {}

    def take(self, state: dict):
        """Go on with what `held` once returned, taking it out of `state`, which may be a file's.

        Raises KeyError for what is missing, ValueError for what cannot be (`state/checked.py`).
        """
