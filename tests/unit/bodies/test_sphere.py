import numpy as np
import pytest

from mpmgeo.bodies import Sphere


def sphere(center=(0.0, 0.0, 0.0), diameter=2.0, **keys):
    return Sphere(material_id=1, center=center, diameter=diameter, **keys)


def by_loops(body, cell):
    radius = body.diameter / 2
    base = np.array(body.center) - radius
    number = np.ceil(body.diameter / cell * (1 - 1e-9)).astype(int)
    step = cell / body.particles_per_direction
    return np.array(
        [
            position
            for index in np.ndindex(*number)
            for inner in np.ndindex(*body.particles_per_direction)
            if np.linalg.norm(
                (position := base + cell * index + (np.array(inner) + 0.5) * step) - body.center
            )
            <= radius
        ]
    )


@pytest.mark.parametrize("per_cell", [(2, 2, 2), (1, 2, 3)])
@pytest.mark.parametrize("cell", [(0.5, 0.5, 0.5), (0.25, 0.4, 0.5)])
def test_positions_and_order_are_those_of_plain_loops(per_cell, cell):
    body = sphere((1.0, -2.0, 0.5), 2.0, particles_per_direction=per_cell)
    cell = np.array(cell)
    cloud = body.generate(cell)
    np.testing.assert_allclose(cloud.position, by_loops(body, cell), rtol=1e-12)
    np.testing.assert_array_equal(cloud.size, np.tile(cell / per_cell, (len(cloud.size), 1)))


def test_z_runs_fastest_within_a_cell():
    position = sphere(diameter=20.0).generate(np.array([1.0, 1.0, 1.0])).position
    middle = position[(np.abs(position) < 1).all(axis=1) & (position > 0).all(axis=1)]
    assert middle[:3].tolist() == [[0.25, 0.25, 0.25], [0.25, 0.25, 0.75], [0.25, 0.75, 0.25]]


def test_the_particles_are_symmetric_about_the_centre():
    center = np.array([0.3, 1000.7, -2.1])
    body = sphere(tuple(center), diameter=1.2)
    offset = body.generate(np.array([0.1, 0.2, 0.3])).position - center
    for axis in range(3):
        mirrored = offset * np.where(np.arange(3) == axis, -1, 1)
        assert {tuple(row) for row in offset.round(9)} == {tuple(row) for row in mirrored.round(9)}


def test_volume_tends_to_that_of_the_ball():
    errors = []
    for cell in (0.2, 0.1, 0.05):
        cloud = sphere().generate(np.full(3, cell))
        errors.append(abs(cloud.size.prod(axis=1).sum() / (4 / 3 * np.pi) - 1))
    assert errors[0] < 0.02
    assert errors[2] < 0.002


def test_a_diameter_that_is_no_multiple_of_the_cell_gets_a_note():
    assert sphere().generate(np.full(3, 0.1)).notes == ()
    (note,) = sphere().generate(np.full(3, 0.3)).notes
    assert note.startswith("the diameter, 2 m, is not a multiple of the cell")


def test_sizes_at_the_ends_of_the_floating_point_range():
    assert len(sphere(diameter=1e200).generate(np.full(3, 1e199)).position) == 4224
    with pytest.raises(ValueError, match="positions"):
        sphere(diameter=1e308).generate(np.full(3, 1e-5))


def test_a_ball_smaller_than_a_cell_may_be_empty():
    cloud = sphere(diameter=0.1).generate(np.ones(3))
    assert cloud.position.shape == cloud.size.shape == (0, 3)
