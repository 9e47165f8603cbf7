"""What scatter and gather conserve, and that the ways to lay out particles are equal."""

import numpy as np
import pytest
from assembly import assemble, by_row, nodes

GRAVITY = (1.0, -2.0, -9.81)
SCHEMES = pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])


def cloud(count=300, seed=0, **more):
    """Return the solver of particles anywhere in the mesh, with any velocity, stress and mass."""
    random = np.random.default_rng(seed)
    fields = {
        "velocity": random.normal(size=(count, 3)),
        "stress": 1e3 * random.normal(size=(count, 6)),
        "mass": random.uniform(100, 200, count),
        "gravity": GRAVITY,
        "cutoff": 1e-10,
    }
    return assemble(random.uniform(2.0, 10.0, (count, 3)), **(fields | more))


def scattered(**more):
    """Return nodal mass, velocity, acceleration after a scatter, nothing integrated, and solver."""
    solver = cloud(**more)
    solver.arrange()
    solver.scatter()
    solver.update_momentum(0.0)
    return *nodes(solver)[1:], solver


def test_mass_momentum_and_force_are_conserved():
    mass, velocity, acceleration, solver = scattered()
    m = by_row(solver, "m")
    assert mass.sum() == pytest.approx(m.sum(), rel=1e-14)
    assert mass @ velocity == pytest.approx(m @ by_row(solver, "v"), rel=1e-12)
    assert mass @ acceleration == pytest.approx(m.sum() * np.array(GRAVITY), rel=1e-10)


def test_internal_forces_make_no_moment():
    """A symmetric stress turns nothing: Σ x × f vanishes beside the weight's moment."""
    solver = cloud(gravity=(0.0, 0.0, 0.0))
    solver.arrange()
    solver.scatter()
    solver.update_momentum(0.0)
    index, mass, _, acceleration = nodes(solver)
    moments = np.cross(index, mass[:, None] * acceleration)
    assert np.abs(moments.sum(axis=0)).max() < 1e-12 * np.abs(moments).sum()


@SCHEMES
def test_a_step_keeps_the_momentum_of_a_free_cloud(scheme):
    solver = cloud(scheme=scheme, gravity=(0.0, 0.0, 0.0))
    m, before = by_row(solver, "m"), by_row(solver, "v")
    for _ in range(5):
        solver.step()
    size = np.abs(m[:, None] * by_row(solver, "v")).sum()
    assert np.abs(m @ by_row(solver, "v") - m @ before).max() < 1e-13 * size


@SCHEMES
def test_sets_are_a_matter_of_storage(scheme):
    """One material in three sets gives the result of one set, but for the order of sums."""
    results = []
    for split in (1, 3):
        solver = cloud(scheme=scheme, split=split)
        for _ in range(10):
            solver.step()
        results.append([by_row(solver, name) for name in ("x", "v", "V", "stress")])
    for one, three in zip(*results, strict=True):
        assert np.abs(one - three).max() < 1e-10 * np.abs(one).max()
        assert not (one == np.zeros_like(one)).all()


def test_sizes_of_each_particle():
    """A row for each particle does what one triple for all does, and every row counts."""
    triple = (0.5, 0.25, 0.125)
    rows = np.tile(triple, (300, 1))
    results = []
    for half in (triple, rows, np.where(np.arange(300)[:, None] == 0, 0.4, rows)):
        solver = cloud(half=half)
        solver.step()
        results.append(by_row(solver, "x"))
    one, each, other = results
    assert np.abs(one - each).max() < 1e-14
    assert np.abs(other[0] - each[0]).max() > 1e-9


def test_the_first_step_changes_velocities_by_half():
    """Velocities live between the positions."""
    solver = cloud(count=1, stress=np.zeros((1, 6)), velocity=np.zeros(3))
    speeds = []
    for _ in range(3):
        solver.step()
        speeds.append(by_row(solver, "v")[0] / np.array(GRAVITY))
    assert np.array(speeds) == pytest.approx(1e-3 * np.outer([0.5, 1.5, 2.5], [1, 1, 1]))
    fallen = by_row(solver, "x")[0] - solver.population.position[0]
    assert fallen == pytest.approx(1e-6 * (0.5 + 1.5 + 2.5) * np.array(GRAVITY))


@pytest.mark.parametrize("place", [4.0, 4.5, 4.25, 3.75, 8.0, 7.5])
def test_particles_on_the_edges_of_cells_and_stencils(place):
    """Wherever round-off may put them, they carry their mass to the nodes."""
    for hair in (-1e-16, 0.0, 1e-16):
        solver = assemble([3 * [place * (1 + hair)]], mass=5.0, velocity=(1.0, 2.0, 3.0))
        solver.step()
        _, mass, velocity, _ = nodes(solver)
        assert mass.sum() == pytest.approx(5.0, rel=1e-14)
        assert mass.min() > 0
        assert velocity == pytest.approx(np.tile([1.0, 2.0, 3.0], (len(mass), 1)))


def test_a_particle_in_each_corner_of_the_mesh():
    """Ghost nodes below zero and beyond the last one take part."""
    corners = [[x, y, z] for x in (0, 12) for y in (0, 12) for z in (0, 12)]
    solver = assemble(corners, mass=2.0)
    solver.step()
    index, mass, _, _ = nodes(solver)
    assert mass.sum() == pytest.approx(16.0, rel=1e-14)
    assert set(np.unique(index)) == {-1, 0, 1, 11, 12, 13}
