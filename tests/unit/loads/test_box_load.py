import numpy as np
import pytest

from mpmgeo.case.coordinates import in_mesh
from mpmgeo.loads import BoxLoad

BOX = BoxLoad(point_p1=(0, 0, 0), point_p2=(1, 2, 3), load=(6.0, -12.0, 0.5))


def test_the_particles_inside_share_the_load():
    position = np.random.default_rng(2).uniform(-1, 4, (500, 3))
    inside = ((position >= 0) & (position <= [1, 2, 3])).all(axis=1)
    force = BOX.particle_force(position)
    assert force.shape == (500, 3)
    assert not force[~inside].any()
    np.testing.assert_array_equal(force[inside], np.tile(force[inside][0], (inside.sum(), 1)))
    np.testing.assert_allclose(force.sum(axis=0), BOX.load, rtol=1e-12)


def test_the_box_is_closed():
    position = np.array([[0, 0, 0], [1, 2, 3], [1, 0, 3], [1 + 1e-9, 2, 3], [0, -1e-9, 0]])
    assert BOX.contains(position).tolist() == [True, True, True, False, False]


@pytest.mark.parametrize("position", [np.zeros((0, 3)), np.full((3, 3), 9.0)])
def test_without_a_particle_nothing_happens(position):
    np.testing.assert_array_equal(BOX.particle_force(position), np.zeros_like(position))


def test_a_box_turned_round_is_a_problem_a_flat_one_is_not():
    assert list(BOX.problems()) == []
    assert list(BoxLoad(point_p1=(0, 0, 1), point_p2=(1, 1, 1), load=(0, 0, 1)).problems()) == []
    (problem,) = BoxLoad(point_p1=(0, 0, 2), point_p2=(1, 1, 1), load=(0, 0, 1)).problems()
    assert problem == ("point_p2", "z is 1, below that of point_p1, 2")


def test_faces_of_a_box_far_away_belong_to_it():
    """Particles on them may be off by what doubles resolve there, a nanometre, and not more."""
    corners = {"point_p1": (5e5, 4_500_000.1, 0.0), "point_p2": (500_001.0, 4_500_000.2, 1.0)}
    box = in_mesh(BoxLoad(**corners, load=(0.0, 0.0, 1.0)), (5e5, 4.5e6, 0.0))
    y = np.array([0.1, 0.2, 0.1 - 1e-8, 0.2 + 1e-8])
    position = np.stack([np.full(4, 0.5), y, np.full(4, 0.5)], axis=1)
    assert box.contains(position).tolist() == [True, True, False, False]
