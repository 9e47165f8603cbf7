"""What lies above each particle, as bricks above each other."""

import numpy as np
import pytest

from mpmgeo.mpm.overburden import overburden

UNIT = 1000.0  # N/m³


def lattice(low, high, spacing):
    """Return centres and edges (n, 3) of the bricks that fill a box."""
    low, high, spacing = (np.array(a, float) for a in (low, high, spacing))
    counts = np.round((high - low) / spacing).astype(int)
    axes = [l + s * (np.arange(n) + 0.5) for l, s, n in zip(low, spacing, counts, strict=True)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return x, np.broadcast_to(spacing, x.shape)


def stress(*lattices, shuffle=None):
    """Return the stresses and the ground of the bricks of some lattices, and their centres."""
    x, size = (np.concatenate(parts) for parts in zip(*lattices, strict=True))
    if shuffle is not None:
        order = shuffle.permutation(len(x))
        x, size = x[order], size[order]
    weight = UNIT * size.prod(axis=1)
    return (*overburden(x[:, :2], size[:, :2], x[:, 2], size[:, 2], weight), x)


def test_a_column_bears_what_is_above_and_half_of_itself():
    found, ground, x = stress(lattice([0, 0, 0], [1, 1, 4], [0.5, 0.5, 0.25]))
    assert found == pytest.approx(UNIT * (4 - x[:, 2]), rel=1e-12)
    assert (ground == 4).all()


def test_lattices_of_other_spacing_and_place_stand_on_each_other():
    """Whatever the order of the particles, and where the faces of one lie in the other."""
    lower = lattice([0, 0, 0], [3, 3, 2], [0.5, 0.5, 0.5])
    upper = lattice([-0.3, -0.3, 2], [3.3, 3.3, 5], [0.4, 0.3, 0.2])
    found, ground, x = stress(lower, upper, shuffle=np.random.default_rng(1))
    assert found == pytest.approx(UNIT * (5 - x[:, 2]), rel=1e-9)
    assert ground == pytest.approx(5)


def test_what_covers_half_of_a_particle_weighs_half():
    below = lattice([0, 0, 0], [1, 1, 1], [1, 1, 1])
    above = lattice([0, 0, 1], [0.5, 1, 2], [0.5, 1, 1])
    found, _, _ = stress(below, above)
    assert found == pytest.approx([0.5 * UNIT + 0.5 * UNIT, 0.5 * UNIT])


def test_gaps_and_overhangs_weigh_what_is_in_them():
    below = lattice([0, 0, 0], [2, 1, 1], [1, 1, 1])
    roof = lattice([1, 0, 4], [3, 1, 6], [1, 1, 1])
    found, ground, x = stress(below, roof)
    assert found[:2] == pytest.approx([0.5 * UNIT, 2.5 * UNIT])
    assert ground[:2] == pytest.approx([1, 6])
    assert found[2:] == pytest.approx(UNIT * (6 - x[2:, 2]))


def test_weights_of_scattered_particles_are_borne_in_the_mean():
    """Bricks that do not tile: the stress at the bottom is the weight over the base, to 2 %."""
    random = np.random.default_rng(2)
    x = random.uniform(0, 4, (20_000, 3))
    size = np.full_like(x, (64 / len(x)) ** (1 / 3))
    found, _ = overburden(x[:, :2], size[:, :2], x[:, 2], size[:, 2], UNIT * size.prod(axis=1))
    inner = (np.abs(x[:, :2] - 2) < 1.5).all(axis=1) & (x[:, 2] < 0.5)
    assert found[inner].mean() == pytest.approx(UNIT * (4 - x[inner, 2]).mean(), rel=0.02)


def test_nothing_bears_nothing():
    empty = np.empty((0, 2)), np.empty((0, 2)), np.empty(0), np.empty(0), np.empty(0)
    assert all(len(part) == 0 for part in overburden(*empty))


def test_bricks_of_a_line_may_overlap_and_differ_in_thickness():
    """As the sum over all of them, one by one."""
    random = np.random.default_rng(3)
    height, thickness = random.uniform(0, 5, 200), random.uniform(0.1, 2, 200)
    weight, one = random.uniform(1, 2, 200), np.ones((200, 2))
    found, ground = overburden(0 * one, one, height, thickness, weight)
    top = height + thickness / 2
    share = np.clip((top[None] - height[:, None]) / thickness, 0, 1)
    assert found == pytest.approx(share @ weight)
    assert ground == pytest.approx(top.max())
