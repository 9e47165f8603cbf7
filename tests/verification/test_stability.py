"""The stable time step that a simulation states is stable, and not far from the longest one.

A share of the grid that `benchmarks/stability.py` bisects: at 0.95 of the limit the energy of a
block of noise does not grow, at 1/0.6 of it it does.
"""

from itertools import product

import numpy as np
import pytest

import mpmgeo
from mpmgeo.run.watch import Diverged
from mpmgeo.verify import limits
from mpmgeo.verify.stability import OFFSETS, Trial, block

GIMP, LINEAR = "GIMP", "linear"
METHODS = [("USL", GIMP), ("MUSL", GIMP), ("USF", GIMP), ("MUSL", LINEAR), ("USF", LINEAR)]
OF_TWO_PHASES = [method for method in METHODS if method[0] != "USF"]
EDGES = [(1, 1, 1), (1, 1, 5)]
SOUND, UNSOUND, DEFAULT = 0.95, 1 / 0.6, 0.25


def check(method, count, poisson, edges, conductivity=None, offsets=OFFSETS, steps=600, **keys):
    """Assert that the limit holds at all places on the grid, and at one is not far from the end."""
    keys |= dict(zip(("stress_scheme_update", "shape_function"), method, strict=True))
    cases = [block(count, poisson, edges, o, conductivity, **keys) for o in offsets]
    trials = [Trial(case) for case in cases]
    limit = trials[0].limit
    where = (method, count, poisson, edges, conductivity)
    assert limit > DEFAULT, where
    assert not any("stable" in text for text in trials[0].simulation.warnings), where
    assert not any(trial.diverges(SOUND * limit, steps) for trial in trials), where
    assert any(trial.diverges(UNSOUND * limit, steps) for trial in trials), where


@pytest.mark.parametrize("method", METHODS, ids=" ".join)
@pytest.mark.parametrize("poisson", [0.0, 0.49])
def test_one_phase(method, poisson):
    check(method, 2, poisson, (1, 1, 1))


@pytest.mark.parametrize("method", METHODS, ids=" ".join)
def test_shared_volume_strain(method):
    check(method, 2, 0.49, (1, 1, 1), volumetric_locking="cells")


@pytest.mark.parametrize("scheme, transfer", [("USL", "tpic"), ("MUSL", "tpic"), ("MUSL", "apic")])
def test_particles_with_a_velocity_gradient(scheme, transfer):
    check((scheme, GIMP), 2, 0.3, (1, 1, 1), offsets=OFFSETS[::3], transfer=transfer)


@pytest.mark.parametrize("edges", EDGES, ids=str)
@pytest.mark.parametrize("count", [1, 3])
def test_sizes_of_particles_and_cells(count, edges):
    check(("USL", GIMP), count, 0.3, edges)


@pytest.mark.parametrize("method", OF_TWO_PHASES, ids=" ".join)
@pytest.mark.parametrize("conductivity", [1e-6, 1.0])
def test_two_phases(method, conductivity):
    check(method, 2, 0.3, (1, 1, 1), conductivity, offsets=(0.001, 0.249, 0.499), steps=400)


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS, ids=" ".join)
def test_one_phase_over_the_grid(method):
    for edges, count, poisson in product(EDGES, (1, 2, 3, 4), (0.0, 0.3, 0.49)):
        check(method, count, poisson, edges)


@pytest.mark.slow
@pytest.mark.parametrize("method", OF_TWO_PHASES, ids=" ".join)
def test_two_phases_over_the_grid(method):
    for edges, count, conductivity in product(EDGES, (1, 2, 3, 4), (1e-6, 1e-3, 1.0)):
        check(method, count, 0.3, edges, conductivity, offsets=(0.001, 0.249, 0.499), steps=400)


@pytest.mark.parametrize(
    ("place", "share"), [("critical_time_step_multiplier", 0.9), ("time_step", 0.95)]
)
def test_a_block_that_diverges_is_warned_of_and_the_diagnosis_names_the_limit(place, share):
    """Shares of the critical time step with USL and GIMP, of a cube that falls."""
    case = limits.block()
    critical = mpmgeo.Simulation(case).critical_time_step
    case |= {"time_step": share * critical} if place == "time_step" else {place: share}
    simulation = mpmgeo.Simulation(case)
    limit = f"{simulation.stable_time_step:.4g} s, up to which USL with GIMP is stable"
    (warning,) = simulation.warnings
    assert f"exceeds {limit} here" in warning and '"MUSL"' in warning
    with pytest.raises(Diverged, match=f"exceeds {limit}"):
        simulation.run()


def test_the_same_block_runs_with_what_the_warning_proposes():
    for keys in ({"critical_time_step_multiplier": 0.35}, {"stress_scheme_update": "MUSL"}):
        case = limits.block() | {"critical_time_step_multiplier": 0.9} | keys
        simulation = mpmgeo.Simulation(case)
        assert simulation.warnings == []
        simulation.step(400)
        assert np.isfinite(simulation.kinetic_energy())
        simulation.check()
