"""Terzaghi's column: undrained at first, drained at last, and in between as the series says."""

import numpy as np
import pytest
from scenes import initial_position, scene, simulate

from mpmgeo.verify.terzaghi import Terzaghi

HEIGHT, LOAD, YOUNG, POISSON, GRAINS, WATER, POROSITY = 1.0, 1000.0, 1e8, 0.25, 2600.0, 1000.0, 0.4
FACTORS = (0.1, 0.3, 0.5, 1.0)
DRAINED = {"plane_Zn": "free"}


def exact(conductivity=1e-4, bulk=5e7):
    modulus = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
    weight = WATER * 9.81
    return Terzaghi(HEIGHT, LOAD, modulus, POROSITY, bulk, conductivity, weight)


def column(cells, problem, **keys):
    """Return the case of a column of that many cells, one cell wide, under the load."""
    h = HEIGHT / cells
    soil = {
        "type": "elastic",
        "id": 1,
        "density": GRAINS,
        "young": YOUNG,
        "poisson": POISSON,
        "density_fluid": WATER,
        "porosity": POROSITY,
        "bulk_fluid": problem.bulk_fluid,
        "hydraulic_conductivity": 3 * [problem.conductivity],
    }
    body = {"type": "cuboid", "material_id": 1, "point_p1": [0, 0, 0], "point_p2": [h, h, HEIGHT]}
    top = {"point_p1": [0, 0, HEIGHT - h / 2], "point_p2": [h, h, HEIGHT]}
    case = scene(
        [1, 1, cells + 2],
        h,
        [body],
        materials=[soil],
        n_phases=2,
        critical_time_step_multiplier=0.5,
        load_distributed_box=[top | {"load": [0, 0, -LOAD * h * h]}],
        boundary_conditions=DRAINED,
        **{"time": problem.time(1.0)} | keys,
    )
    case["mesh"]["boundary_conditions_fluid"] = DRAINED
    return case


def at_the_start(cells, problem, **keys):
    """Return the simulation of the column in which load, pressure and stress balance already."""
    p = problem.initial_pressure
    pressure = [{"material_id": 1, "pressure": p}]
    simulation = simulate(column(cells, problem, initial_pressure_material=pressure, **keys))
    stress = np.zeros((simulation.solver.count, 6))
    stress[:, 2] = p - LOAD
    stress[:, :2] = (p - LOAD) * POISSON / (1 - POISSON)
    simulation.assign("stress", stress)
    return simulation


def of_cells(simulation, cells, values):
    """Return the means (cells,) of a field, from the base up: a pressure is that of its cell."""
    cell = (initial_position(simulation)[:, 2] / HEIGHT * cells).astype(int)
    return np.bincount(cell, values) / np.bincount(cell)


def errors(cells, **keys):
    """Return the errors of U and the largest of the pressure, over p₀, at all time factors."""
    problem = exact()
    simulation = at_the_start(cells, problem, **keys)
    fine = (np.arange(20 * cells) + 0.5) * HEIGHT / (20 * cells)
    found = []
    for factor in FACTORS:
        simulation.run(until=problem.time(factor))
        pressure = simulation.field("pressure") / problem.initial_pressure
        series = problem.pressure(fine, simulation.time) / problem.initial_pressure
        profile = of_cells(simulation, cells, pressure) - series.reshape(cells, 20).mean(axis=1)
        degree = 1 - pressure.mean() - problem.degree(simulation.time)
        found.append((degree, np.abs(profile).max()))
    return np.array(found)


def test_series():
    """Values of the textbooks, and of the sum where it is quickest."""
    problem = exact()
    table = {0.05: 0.2523, 0.1: 0.3568, 0.3: 0.6132, 0.5: 0.7640, 0.848: 0.9, 1.0: 0.9313}
    for factor, degree in table.items():
        assert problem.degree(problem.time(factor)) == pytest.approx(degree, abs=1e-4)
    base = [problem.pressure([0.0], problem.time(t))[0] for t in (0.1, 0.5, 1.0)]
    assert np.array(base) / problem.initial_pressure == pytest.approx(
        [0.9493, 0.3708, 0.1080], 1e-3
    )
    # the settlement at last is that of the drained skeleton
    assert problem.settlement(problem.time(9.0)) == pytest.approx(LOAD * HEIGHT / problem.modulus)


def test_consolidation():
    """U within 1 %, the profile of pressure within 2 %; halved cells halve the errors at least."""
    coarse, fine = errors(5), errors(10)
    assert np.abs(fine[:, 0]).max() < 0.003
    assert fine[:, 1].max() < 0.006
    assert np.abs(fine[:, 0]).max() < np.abs(coarse[:, 0]).max() / 2
    assert fine[:, 1].max() < coarse[:, 1].max() / 2


@pytest.mark.slow
def test_consolidation_converges():
    """With damping, which takes out the waves of the start, to second order."""
    found = [errors(cells, damping={"type": "local", "value": 0.1}) for cells in (5, 10, 20)]
    profile = np.array([error[:, 1].max() for error in found])
    assert (profile[1:] < profile[:-1] / 3).all()
    assert profile[-1] < 1e-3
    assert np.abs(found[-1][:, 0]).max() < 5e-4


@pytest.mark.slow
def test_consolidation_with_musl():
    """Less damped by itself, so it gets some; errors are larger and become smaller."""
    keys = {"stress_scheme_update": "MUSL", "damping": {"type": "local", "value": 0.1}}
    coarse, fine = errors(5, **keys), errors(10, **keys)
    assert np.abs(fine[:, 0]).max() < 0.01
    assert fine[:, 1].max() < 0.02
    assert (fine[:, 1] < coarse[:, 1]).all()


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_consolidation_with_sizes_that_follow(scheme):
    """U within 1.5 %, the profile within 2 %: strains are small, so sizes hardly matter."""
    keys = {"stress_scheme_update": scheme, "damping": {"type": "local", "value": 0.1}}
    found = errors(5, particle_domain="updated", **keys)
    assert np.abs(found[:, 0]).max() < 0.015
    assert found[:, 1].max() < 0.02


@pytest.mark.parametrize("bulk", [2e7, 5e7, 5e8])
def test_undrained_start(bulk):
    """A sudden load, nearly no drainage: the pressure is p₀ when the waves have died down."""
    problem = exact(conductivity=1e-7, bulk=bulk)
    keys = {"damping": {"type": "local", "value": 0.5}, "time": 0.15}
    simulation = simulate(column(10, problem, **keys)).run()
    pressure = of_cells(simulation, 10, simulation.field("pressure"))
    stress = of_cells(simulation, 10, simulation.field("stress")[:, 2])
    assert pressure[:8] == pytest.approx(problem.initial_pressure, rel=0.01)
    assert stress[:8] == pytest.approx(problem.initial_pressure - LOAD, rel=0.01)
