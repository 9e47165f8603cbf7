"""Kinetic energy and the first particle that is not sound."""

import numpy as np
import pytest
from assembly import assemble

from mpmgeo.numerics.chunks import ALONE, crew_of
from mpmgeo.state.inspection import first_unsound, kinetic_energy
from mpmgeo.state.sorting import sort

BOTH = pytest.mark.parametrize("crew", [ALONE, crew_of(2)])


@pytest.fixture
def particles():
    """A sorted set of 200 particles, ten of which have left the mesh."""
    random = np.random.default_rng(3)
    position = random.uniform(0, 12, (200, 3))
    position[::20] = -5.0
    velocity, mass = random.normal(size=(200, 3)), random.uniform(1, 2, 200)
    solver = assemble(position, velocity=velocity, mass=mass)
    sort(solver.grid, solver.sets, ALONE)
    return solver.sets[0]


@BOTH
def test_energy_of_the_active_particles(particles, crew):
    s = particles
    expected = 0.5 * np.sum(s.m[:190] * (s.v[:190] ** 2).sum(axis=1))
    assert kinetic_energy(s, crew) == pytest.approx(expected, rel=1e-13)


def test_energy_has_the_same_bits_for_any_threads(particles):
    energies = {kinetic_energy(particles, crew) for crew in (ALONE, crew_of(2))}
    assert len(energies) == 1


@BOTH
def test_sound_particles(particles, crew):
    particles.stress[:] = 1e100
    assert first_unsound(particles, 100.0, crew) == -1


@BOTH
@pytest.mark.parametrize("array", ["x", "v", "stress"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_first_bad_number_is_found(particles, array, value, crew):
    """In any component; fast arithmetic must not delete the test."""
    values = getattr(particles, array)
    for component in range(values.shape[1]):
        kept = values[57:, component].copy()
        values[57, component] = values[130, component] = value
        assert first_unsound(particles, 100.0, crew) == 57
        values[57:, component] = kept


@BOTH
def test_speed_limit(particles, crew):
    particles.v[88] = [0.0, -101.0, 0.0]
    assert first_unsound(particles, 100.0, crew) == 88
    assert first_unsound(particles, 102.0, crew) == -1
    particles.v[88] = 1e200  # its square is infinite
    assert first_unsound(particles, 1e100, crew) == 88


@BOTH
def test_particles_that_left_do_not_count(particles, crew):
    particles.v[190:] = np.nan
    particles.x[195] = np.nan
    assert first_unsound(particles, 100.0, crew) == -1
    assert np.isfinite(kinetic_energy(particles, crew))
