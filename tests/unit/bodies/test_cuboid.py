import numpy as np
import pytest

from mpmgeo.bodies import Cuboid

UNIT = np.ones(3)


def cuboid(p1, p2, **keys):
    return Cuboid(material_id=1, point_p1=p1, point_p2=p2, **keys)


def test_one_cell_holds_eight_particles_x_fastest():
    cloud = cuboid((1, 2, 3), (2, 3, 4)).generate(UNIT)
    expected = [
        (1.25, 2.25, 3.25), (1.75, 2.25, 3.25), (1.25, 2.75, 3.25), (1.75, 2.75, 3.25),
        (1.25, 2.25, 3.75), (1.75, 2.25, 3.75), (1.25, 2.75, 3.75), (1.75, 2.75, 3.75),
    ]  # fmt: skip
    np.testing.assert_array_equal(cloud.position, expected)
    np.testing.assert_array_equal(cloud.size, np.full((8, 3), 0.5))
    assert cloud.notes == ()


def test_cells_run_with_x_outermost():
    position = cuboid((0, 0, 0), (2, 3, 4)).generate(UNIT).position
    cells = np.floor(position[::8])
    assert cells.tolist() == [list(index) for index in np.ndindex(2, 3, 4)]


def test_cells_are_anchored_at_p1_not_at_the_mesh():
    position = cuboid((0.1, 0.2, 0.3), (1.1, 1.2, 1.3)).generate(UNIT).position
    np.testing.assert_allclose(position.min(axis=0), [0.35, 0.45, 0.55], rtol=1e-15)


def test_anisotropic_cells():
    cell = np.array([0.5, 0.25, 2.0])
    cloud = cuboid((0, 0, 0), (1, 1, 2), particles_per_direction=(1, 2, 5)).generate(cell)
    assert len(cloud.position) == 2 * 4 * 1 * 10
    np.testing.assert_allclose(cloud.size, np.tile([0.5, 0.125, 0.4], (80, 1)), rtol=1e-15)
    assert len(np.unique(cloud.position[:, 2])) == 5
    assert len(np.unique(cloud.position[:, 1])) == 8


@pytest.mark.parametrize("per_cell", [(1, 1, 1), (2, 2, 2), (3, 1, 2)])
@pytest.mark.parametrize("cell", [(0.1, 0.1, 0.1), (0.25, 0.2, 0.5)])
def test_mass_is_density_times_volume_and_the_centre_is_kept(per_cell, cell):
    p1, p2 = np.array([0.6, -0.4, 7.0]), np.array([1.6, 0.6, 8.0])
    body = cuboid(tuple(p1), tuple(p2), particles_per_direction=per_cell)
    cloud = body.generate(np.array(cell))
    density = 1800.0
    mass = density * cloud.size.prod(axis=1)
    assert mass.sum() == pytest.approx(density * 1.0, rel=1e-12)
    centre = mass @ cloud.position / mass.sum()
    np.testing.assert_allclose(centre, (p1 + p2) / 2, rtol=1e-12)


def test_a_partial_cell_is_filled_whole_with_a_note():
    cloud = cuboid((0, 0, 0), (1.3, 1, 1)).generate(UNIT)
    assert len(cloud.position) == 16
    assert cloud.size.prod(axis=1).sum() == 2.0
    (note,) = cloud.notes
    assert "along x, 1.3 m" in note


def test_an_empty_box_is_a_problem():
    assert list(cuboid((0, 0, 0), (1, 1, 1)).problems()) == []
    ((key, message),) = cuboid((0, 2, 0), (1, 1, 1)).problems()
    assert key == "point_p2"
    assert message == "y is 1 and must exceed that of point_p1, 2"
    assert len(list(cuboid((1, 1, 1), (1, 1, 1)).problems())) == 3


def test_a_box_beyond_the_floating_point_range_is_refused():
    with pytest.raises(ValueError, match="about inf particle positions"):
        cuboid((-1e308, 0, 0), (1e308, 1, 1)).generate(UNIT)


def test_declarations():
    body = cuboid((0, 0, 0), (1, 1, 1))
    assert (body.type, body.active, body.initial_velocity) == ("cuboid", True, (0.0, 0.0, 0.0))
    assert body.particles_per_direction == (2, 2, 2)


def test_messages_about_large_coordinates_have_their_digits():
    body = Cuboid(point_p1=(0, 4_500_000.2, 0), point_p2=(1, 4_500_000.1, 1), material_id=1)
    ((key, message),) = body.problems()
    assert key == "point_p2"
    assert message == "y is 4500000.1 and must exceed that of point_p1, 4500000.2"
