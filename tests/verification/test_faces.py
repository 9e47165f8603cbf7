"""Particles exactly on faces, edges and corners of cells, where slopes jump, with nobody beyond."""

import json
from pathlib import Path

import numpy as np
import pytest
from scenes import scene, simulate

SHAPES = ["GIMP", "linear"]
SCHEMES = ["USL", "MUSL", "USF"]
YOUNG = 1e6
PLACES = {
    "corner": [[1.0, 1.0, 1.0]],
    "edge": [[1.0, 1.1, 1.0]],
    "face": [[1.1, 1.0, 1.2]],
    "two on a line": [[1.0, 1.0, 1.0], [1.5, 1.0, 1.0]],
    "block of a lattice": [
        [0.5 * i, 0.5 * j, 0.5 * k] for i in (2, 3) for j in (2, 3) for k in (2, 3)
    ],
    "with others beyond": [[1.0, 1.0, 1.0], [1.2, 1.3, 0.9], [0.8, 1.0, 1.0]],
}


def particles(position, velocity, **keys):
    """Return the simulation of particles of 0.05 m³ in cells of ½ m, in steps of 1 ms."""
    body = {
        "type": "particles",
        "initial_velocity": velocity,
        "particles": {"position": position, "volume": [0.05] * len(position)},
    }
    return simulate(scene([6, 6, 6], 0.5, [body], time=1.0, time_step=1e-3, **keys))


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("velocity", [[1.0, 0.0, 0.0], [-0.6, 0.8, -0.3]])
def test_steady_flight_strains_nothing(place, scheme, shape, velocity):
    """Into the empty cells or out of them: no stress, no change of volume or velocity."""
    keys = {"shape_function": shape, "stress_scheme_update": scheme}
    simulation = particles(PLACES[place], velocity, **keys)
    for _ in range(3):
        simulation.step()
        assert np.abs(simulation.field("stress")).max() < 1e-12 * YOUNG
        assert np.abs(simulation.field("volume") / 0.05 - 1).max() < 1e-12
        assert np.abs(simulation.field("velocity") - velocity).max() < 1e-12


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("scheme", ["MUSL", "USF"])
def test_free_fall_strains_nothing(place, scheme):
    """From rest, with the schemes that make velocities of the particles' momentum."""
    keys = {"shape_function": "linear", "stress_scheme_update": scheme}
    simulation = particles(PLACES[place], [0, 0, 0], gravity=[1.0, -2.0, -9.81], **keys)
    simulation.step()
    assert np.abs(simulation.field("stress")).max() < 1e-12 * YOUNG


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_stressed_particles_keep_their_momentum(place, scheme):
    """What they put on nodes without other mass comes back to them."""
    keys = {"shape_function": "linear", "stress_scheme_update": scheme}
    simulation = particles(PLACES[place], [0.3, -0.2, 0.1], **keys)
    stress = np.random.default_rng(3).uniform(-1e3, 1e3, (len(PLACES[place]), 6))
    simulation.assign("stress", stress)
    mass = simulation.field("mass")
    before = mass @ simulation.field("velocity")
    simulation.step(2)
    force = 0.05 * 1e3 / 0.5  # that one of them puts on a node
    assert np.abs(mass @ simulation.field("velocity") - before).max() < 1e-12 * force


def test_as_mpm_geomechanics_nodes_without_mass_strain():
    """E v Δt/h, as in that program."""
    keys = {"shape_function": "linear", "compatibility": "mpm-geomechanics"}
    simulation = particles(PLACES["corner"], [1.0, 0.0, 0.0], **keys).step()
    stress = simulation.field("stress")[0]
    assert stress[0] == pytest.approx(-1.2 * YOUNG * 1e-3 / 0.5)  # λ + 2G = 1.2 E


FAULT = Path(__file__).parents[3] / "shared" / "failing" / "linear-particle-on-node" / "case.json"


@pytest.mark.skipif(not FAULT.exists(), reason="the input is not here")
def test_reported_particle():
    simulation = simulate(json.loads(FAULT.read_text())).run()
    assert np.abs(simulation.field("stress")).max() < 1e-9
    assert simulation.field("volume")[0] == pytest.approx(0.1, rel=1e-14)
