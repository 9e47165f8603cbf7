"""What effects take from a state that comes from a file is looked at before it is used."""

from types import SimpleNamespace

import numpy as np
import pytest

from mpmgeo.boundaries.base_motion import BaseMotion
from mpmgeo.boundaries.planes import Planes
from mpmgeo.mpm.effects.base import Base
from mpmgeo.mpm.effects.reactions import Reactions
from mpmgeo.mpm.terrain.contact import Contact


def base(**state):
    motion = BaseMotion(record=None)
    made = Base(motion)
    planes = Planes(0, 0, 0, 0, 0, 0, upper_wins=False)
    made.join(SimpleNamespace(planes=planes, bound=lambda planes: None))
    made.take({"velocity": [1, 0.0, 2.5], "ended": False} | state)
    return motion.velocity


def contact(**state):
    made = SimpleNamespace(near=SimpleNamespace(cell=[0.5, 0.5, 0.5]))
    Contact.take(made, {"offset": [0.1, 0.0, -0.2], "way": 0.3} | state)
    return made.offset


def reactions(**state):
    made = Reactions({1}, tools=1)
    made.join(SimpleNamespace(reactions=None))
    made.take(state)
    return made.solver.reactions


def test_sound_ones_are_taken():
    assert base() == (1, 0.0, 2.5)
    assert contact() == (0.1, 0.0, -0.2)
    assert reactions() is None
    assert reactions(forces=np.ones((7, 3))).sum() == 21.0


def test_numbers_are_doubles():
    """Kernels cannot take a whole number of any size."""
    assert [type(v) for v in base(velocity=[10**30, 1, 0])] == [float, float, float]


@pytest.mark.parametrize("speed", [1e300, -1e300, float("inf"), float("nan")])
def test_a_ground_that_is_torn_away_still_has_a_place(speed):
    made = SimpleNamespace(near=SimpleNamespace(cell=[0.5, 0.5, 0.5]), offset=(0.0, 0.0, 0.0))
    Contact.follow(made, SimpleNamespace(after=(speed, 0.25, 0.0)), 0.5)
    assert abs(made.offset[0]) == 0.5e6 and made.offset[1:] == (0.125, 0.0)


@pytest.mark.parametrize(
    ("take", "state"),
    [
        (base, {"velocity": [1, 2]}),
        (base, {"velocity": "fast"}),
        (base, {"velocity": [1, 2, float("nan")]}),
        (base, {"velocity": [1, 2, None]}),
        (base, {"ended": 1}),
        (base, {"ended": None}),
        (contact, {"offset": [1e300, 0.0, 0.0]}),
        (contact, {"offset": [float("inf"), 0.0, 0.0]}),
        (contact, {"offset": 3.0}),
        (contact, {"way": -1.0}),
        (contact, {"way": float("nan")}),
        (contact, {"way": "far"}),
        (reactions, {"forces": np.ones((6, 3))}),
        (reactions, {"forces": np.ones((7, 3), int)}),
        (reactions, {"forces": [1.0]}),
    ],
)
def test_others_are_refused_by_name(take, state):
    (name,) = state
    with pytest.raises(ValueError, match=f"^{name} "):
        take(**state)
