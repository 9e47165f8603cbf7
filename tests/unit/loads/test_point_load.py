import numpy as np
import pytest

from mpmgeo.case.coordinates import in_mesh
from mpmgeo.loads import PointLoad


def node(position, origin=(0, 0, 0), cell=(1, 1, 1)):
    load = PointLoad(point=position, force=(0, 0, -1))
    return in_mesh(load, origin).node(cell).tolist()


def test_indices_count_the_two_ghost_layers():
    assert node((0, 0, 0)) == [2, 2, 2]
    assert node((3, 4, 5)) == [5, 6, 7]


@pytest.mark.parametrize(("x", "index"), [(0.49, 2), (0.5, 3), (0.51, 3), (1.5, 4), (-0.2, 2)])
def test_the_nearest_node_and_the_upper_one_halfway(x, index):
    assert node((x, x, x)) == [index] * 3


def test_halfway_is_not_decided_by_round_off():
    # 0.15 / 0.1 is 1.4999999999999998 in floating point.
    assert node((0.15, 0.25, 0.35), cell=(0.1, 0.1, 0.1)) == [4, 5, 6]


def test_origin_and_anisotropic_cells():
    position = np.array([-1.0, 2.0, 0.3]) + np.array([0.5, 0.25, 2.0]) * [3.2, 1.9, 0.4]
    assert node(tuple(position), (-1.0, 2.0, 0.3), (0.5, 0.25, 2.0)) == [5, 4, 2]


def test_halfway_far_away_is_not_decided_by_round_off_either():
    """4500000.15 is 1.4999999944… cells from 4500000."""
    origin = (5e5, 4.5e6, 0.0)
    position = (500_000.15, 4_500_000.15, 0.15)
    assert node(position, origin, (0.1, 0.1, 0.1)) == [4, 4, 4]


def test_one_without_particles_is_told_of_where_the_user_has_put_it():
    load = PointLoad(point=(500_001.5, 4_500_000.25, 2.0), force=(0, 0, -1))
    load = in_mesh(load, (5e5, 4.5e6, 0.0))
    cell, body = np.full(3, 0.5), np.ones(1)
    assert load.idle(np.array([[1.5, 0.25, 1.5]]), body, cell) is None
    reason = load.idle(np.zeros((1, 3)), body, cell)
    assert reason.startswith("no particle near [500001.5, 4500000.25, 2.0];")
