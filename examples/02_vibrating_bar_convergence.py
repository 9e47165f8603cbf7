"""How the error of a vibrating bar falls with the cell size, for four schemes.

Updating the stress last (USL, MUSL) is of second order, updating it first (USF) of first order,
since the first stress then counts the motion of a step that is still to be done. Central
differences (NPC-CD) begin with whole steps and are of second order.
"""

from mpmgeo import Simulation, load_case
from mpmgeo.verify.bar import Bar
from mpmgeo.verify.convergence import refine, relative_error

BAR = Bar(length=25.0, young=100.0, density=1.0, velocity_peak=1e-3)
CELLS = (10, 20, 40)
DURATION = 0.8 * BAR.period


def error(cells, scheme):
    """Return the relative error of the displacement after DURATION."""
    simulation = Simulation(load_case(BAR.case(cells, scheme, DURATION)))
    x = BAR.start(simulation)
    simulation.step(round(DURATION / simulation.time_step))
    return relative_error(
        simulation.field("displacement")[:, 0], BAR.displacement(x, simulation.time)
    )


studies = {
    scheme: refine(lambda cells, scheme=scheme: error(cells, scheme), CELLS, BAR.length)
    for scheme in ("USL", "MUSL", "USF", "NPC-CD")
}


def plot():
    import matplotlib.pyplot as plt

    for scheme, study in studies.items():
        plt.loglog(study.size, study.error, "o-", label=f"{scheme}: order {study.order:.2f}")
    plt.xlabel("cell size [m]")
    plt.ylabel("relative error of the displacement")
    plt.legend()
    plt.show()


if __name__ == "__main__":
    plot()
