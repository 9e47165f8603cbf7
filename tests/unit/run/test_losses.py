"""What is said about particles that leave, and about the speed of those that are left."""

import io

import numpy as np
from assembly import simulate, two_blocks

from mpmgeo.run.progress import Compilation, Progress


def leaving():
    case = two_blocks(time=0.5)
    case["body"][1]["initial_velocity"] = [20.0, 0.0, 0.0]
    return simulate(case)


class Watch:
    """Adds up the particles that are active after each step."""

    total = 0

    def begin(self, simulation):
        pass

    def after_step(self, simulation):
        self.total += np.count_nonzero(simulation.field("active"))

    def end(self, simulation, error):
        pass


def test_the_sum_is_printed_at_the_end_with_its_mass():
    stream, simulation = io.StringIO(), leaving()
    with Compilation(lambda: None) as compilation:
        simulation.run(watchers=[Progress(compilation, stream)])
    gone = simulation.field("active") == 0
    mass = simulation.field("mass")
    shown = stream.getvalue()
    assert f"note: {np.count_nonzero(gone)} particles left the mesh, the last of them" in shown
    assert f"s: {mass[gone].sum():.4g} kg of {mass.sum():.4g} kg" in shown
    assert sum("left the mesh" in message for message in simulation.messages) == 1


def test_speed_counts_active_particles_only():
    stream, simulation, watch = io.StringIO(), leaving(), Watch()
    with Compilation(lambda: None) as compilation:
        progress = Progress(compilation, stream)
        simulation.run(watchers=[watch, progress])
    assert progress._work == watch.total < simulation.steps * simulation.solver.count


def test_nothing_is_said_if_none_left():
    simulation = simulate(two_blocks()).run()
    assert not any("left the mesh" in message for message in simulation.messages)
