"""What acts on the material, as a case has it: loads, prescribed motions, contact.

The class of an action says in its own file where it stands in a case, what it needs and what it
does not go with; field, schema, checks and remarks of a case follow from that.
"""

from collections.abc import Iterator
from math import inf
from typing import ClassVar

import numpy as np

from mpmgeo.effect import Effect


class Action:
    """Something that a case may ask for under a key of its own.

    The class variables: `key`, the key at the top of the case, with one sentence, `about`;
    `is_several`: a case holds any number of it, as a list or as an object with names;
    `may_be_list`: each may be the list of its required values, without keys; `switch`: the key of
    its own that turns it on, without which nothing of it is read; `needs_two_phases`: without
    effect with one; `one_phase_only`: why it does not go with two, "" if it does; `called`: what
    the names of entries in a list begin with, if it has names; `in_mesh`: keys of its points that
    have to lie in the mesh. A key `material_id` has to be the id of a material.

    Besides the members below it has what it does, as one or more of

    - `particle_force(position)`: the forces (n, 3) [N] on particles that start at `position`
      (n, 3) [m],
    - `fluid_force(position)`: the same on the fluid in their pores,
    - `wets(position, material)`: which (n,) of them have its `pressure` [Pa] in their pores at the
      start; `is_kept`: for the whole run,
    - `effect(actions, mesh)`: what all of the case's together do during a step,

    or it is bound to the solver in `case/building/`. By then all positions, its own and those that
    it is given, are in coordinates of the mesh. The two forces of an `InTime` are multiplied by the
    factor in time of its `course`, step by step, unless that is None.
    """

    key: ClassVar[str]
    about: ClassVar[str]
    is_several: ClassVar[bool] = True
    may_be_list: ClassVar[bool] = False
    switch: ClassVar[str | None] = None
    needs_two_phases: ClassVar[bool] = False
    one_phase_only: ClassVar[str] = ""
    called: ClassVar[str | None] = None
    in_mesh: ClassVar[tuple[str, ...]] = ()

    def complaints(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for all that makes its file unusable."""
        yield from ()

    def remarks_on_file(self) -> Iterator[str]:
        """Yield what the user should know about its file, which can be used."""
        yield from ()

    def idle(self, position: np.ndarray, body: np.ndarray, cell: np.ndarray) -> str | None:
        """Return why nothing happens at the start, None if something does.

        position (n, 3) [m] and number of the body (n,) of all particles; cell (3,) [m].
        """
        return None

    def ends(self) -> tuple[str, float]:
        """Return what in its file ends before a longer run does, and when [s]."""
        return "", inf

    @classmethod
    def effect(cls, actions: tuple["Action", ...], mesh) -> Effect | None:
        """Return what all those of a case do during a step in a `Mesh`, None if nothing."""
        return None
