"""Static states by kinetic damping: a column under its weight, a cantilever under load."""

import numpy as np
import pytest
from scenes import cuboid, initial_position, scene, simulate

from mpmgeo.verify.beam import Cantilever
from mpmgeo.verify.column import Column

# Kinetic damping stops the particles; USF then never sees the strain of the step before, so that
# its displacements are too large by an error of first order in the time step.
SETTLEMENT = {"USL": 0.005, "MUSL": 0.005, "USF": 0.06}


@pytest.mark.parametrize("scheme", SETTLEMENT)
def test_column_under_its_weight(scheme):
    """Stress within 0.5 % of its largest value, and so the displacement: strains are of 0.4 %."""
    column = Column(height=5.0, young=20e6, poisson=0.2, density=2000.0, gravity=9.81)
    material = {"type": "elastic", "id": 1, "density": 2000.0, "young": 20e6, "poisson": 0.2}
    case = scene(
        [1, 1, 24],
        0.25,
        [cuboid([0, 0, 0], [0.25, 0.25, column.height])],
        materials=[material],
        time=2.0,
        critical_time_step_multiplier=0.5,
        gravity=[0, 0, -column.gravity],
        damping={"type": "kinetic"},
        stress_scheme_update=scheme,
    )
    simulation = simulate(case).run()
    z = initial_position(simulation)[:, 2]
    settlement = column.vertical_displacement(z)
    u = simulation.field("displacement")[:, 2]
    assert np.abs(u - settlement).max() < SETTLEMENT[scheme] * np.abs(settlement).max()
    pressure = column.vertical_stress(z)
    # A particle bears the mean stress of its cell, so pairs of particles are compared.
    found = simulation.field("stress")[:, 2].reshape(-1, 8).mean(axis=1)
    assert np.abs(found - pressure.reshape(-1, 8).mean(axis=1)).max() < 0.005 * -pressure.min()
    assert np.abs(simulation.field("displacement")[:, :2]).max() < 1e-12


def test_cantilever_under_end_load():
    """A load shared by the particles of the last cells bends the beam as in theory, to 2 %."""
    beam = Cantilever(length=2.0, depth=0.4, young=100e6, poisson=0.0)
    cell, load = 0.1, 4000.0
    case = scene(
        [22, 1, 8],
        cell,
        [cuboid([0, 0, 0], [beam.length, cell, beam.depth])],
        origin=[0.0, 0.0, -0.2],
        materials=[{"type": "elastic", "id": 1, "density": 2000.0, "young": 100e6, "poisson": 0.0}],
        time=1.0,
        critical_time_step_multiplier=0.5,
        damping={"type": "kinetic"},
        load_distributed_box=[
            {
                "point_p1": [beam.length - cell, 0, 0],
                "point_p2": [beam.length, cell, beam.depth],
                "load": [0, 0, -load * cell],
            }
        ],
        boundary_conditions={"plane_X0": "fixed", "plane_Z0": "free", "plane_Zn": "free"},
    )
    simulation = simulate(case).run()
    loaded = beam.length - cell / 2
    last = initial_position(simulation)[:, 0] > beam.length - cell
    shorter = Cantilever(loaded, beam.depth, beam.young, beam.poisson)
    expected = -shorter.under_end_load(load, np.array([loaded]))[0]
    assert simulation.field("displacement")[last, 2].mean() == pytest.approx(expected, rel=0.02)
