"""The guard: when it looks, and what is left when the run diverges."""

from types import SimpleNamespace

import numpy as np
import pytest
from assembly import simulate, two_blocks

from mpmgeo.run.outputs import EverySteps
from mpmgeo.run.watch import EVERY, Diverged, Guard


class Checked:
    """A simulation of nothing that writes down in which steps it is checked and kept."""

    def __init__(self, fails_in=None):
        self.case = SimpleNamespace(time=1e9)
        self.steps, self.time, self.time_step, self.fails_in = 0, 0.0, 1.0, fails_in
        self.checked, self.kept, self.restored = [], [], 0

    def check(self):
        self.checked.append(self.steps)
        if self.steps == self.fails_in:
            raise Diverged

    def keep(self):
        self.kept.append(self.steps)

    def restore(self):
        self.restored += 1


def watch(simulation, outputs, steps):
    guard = Guard(EverySteps(outputs))
    guard.begin(simulation)
    error = None
    try:
        for _ in range(steps):
            simulation.steps += 1
            simulation.time += 1.0
            guard.after_step(simulation)
    except Diverged as caught:
        error = caught
    guard.end(simulation, error)


@pytest.mark.parametrize("outputs", [1, 7, 30, 1000])
def test_checks_before_every_output_and_now_and_then(outputs):
    simulation = Checked()
    watch(simulation, outputs, 120)
    due = [n for n in range(1, 121) if n % EVERY == 0 or n % outputs == 0]
    assert simulation.checked == due
    assert simulation.kept == [0, *due]
    assert not simulation.restored


def test_checks_the_last_state():
    simulation = Checked()
    simulation.case.time = 9.0
    watch(simulation, 1000, 9)
    assert simulation.checked == [9]


def test_what_fails_the_check_is_not_kept():
    simulation = Checked(fails_in=EVERY)
    watch(simulation, 20, 100)
    assert simulation.kept == [0, 20, 40]
    assert simulation.restored == 1


def test_other_errors_keep_the_state():
    simulation = Checked()
    guard = Guard(EverySteps(10))
    guard.begin(simulation)
    guard.end(simulation, OSError())
    assert not simulation.restored


def test_a_diverged_simulation_shows_its_last_sound_state():
    """NaN in step 5 is found at the output of step 10; the state is that of step 0 again."""
    simulation = simulate(two_blocks(results={"print": 5}))
    start = {key: simulation.field(key) for key in ("position", "velocity", "stress", "volume")}

    class Poison:
        def begin(self, simulation):
            pass

        def after_step(self, simulation):
            if simulation.steps == 5:
                simulation.solver.sets[1].stress[3, 1] = np.nan

        def end(self, simulation, error):
            pass

    with pytest.raises(Diverged, match="step") as caught:
        simulation.run(watchers=[Poison()])
    assert simulation.output_interval == 10
    assert simulation.steps == 0 and simulation.time == 0.0
    for key, values in start.items():
        assert (simulation.field(key) == values).all()
    assert simulation.field("active").all()
    assert "nan" not in str(caught.value).partition("stress was")[2]
