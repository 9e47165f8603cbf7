"""The vibrating bar: order of convergence, error bounds, and energy over ten periods."""

import numpy as np
import pytest
from scenes import simulate

from mpmgeo.verify.bar import Bar
from mpmgeo.verify.convergence import refine, relative_error

BAR = Bar()
CELLS = [10, 20, 40, 80]
DURATION = 0.8 * BAR.period  # the displacement is 95 % of its peak, far from its zeros
ORDER = {"USL": 1.8, "MUSL": 1.8, "USF": 0.9}
# At 80 cells. The first stress of USF counts a step of motion before it is done: an error of ω Δt.
ERROR = {"USL": 1e-4, "MUSL": 1e-4, "USF": 1e-2}


def displacement_error(cells, scheme):
    """Return the relative L2 error of the displacement over all particles."""
    simulation = simulate(BAR.case(cells, scheme, DURATION))
    x = BAR.start(simulation)
    simulation.step(round(DURATION / simulation.time_step))
    exact = BAR.displacement(x, simulation.time)
    return relative_error(simulation.field("displacement")[:, 0], exact)


@pytest.mark.parametrize("scheme", ORDER)
def test_displacement_converges(scheme):
    study = refine(lambda cells: displacement_error(cells, scheme), CELLS, BAR.length)
    assert study.order >= ORDER[scheme], study
    assert study.orders[1:].min() >= ORDER[scheme], study
    assert study.error[-1] < ERROR[scheme], study


def energies(scheme, cells=25, periods=10):
    """Return the kinetic and the strain energy [J] after every step."""
    simulation = simulate(BAR.case(cells, scheme, periods * BAR.period))
    BAR.start(simulation)
    volume = simulation.field("volume")
    rows = []
    for _ in range(round(periods * BAR.period / simulation.time_step)):
        simulation.step()
        strain = volume @ simulation.field("stress")[:, 0] ** 2 / (2 * BAR.young)
        rows.append((simulation.kinetic_energy(), strain))
    return np.array(rows).T


@pytest.mark.parametrize("scheme", ORDER)
def test_total_energy_does_not_drift(scheme):
    """Below 1 % at any instant over ten periods.

    Velocities live halfway between the instants of the stresses, so the kinetic energy that belongs
    to a stress is the mean of the two beside it: of its own step and the next. USF makes the stress
    of a step from the velocities of the step before, so that there it is its own and the last.
    """
    kinetic, strain = energies(scheme)
    earlier, later = kinetic[:-1], kinetic[1:]
    total = (earlier + later) / 2 + (strain[1:] if scheme == "USF" else strain[:-1])
    assert np.abs(total / total[0] - 1).max() < 0.01
