"""Newmark's method: what the two forms have in common, what they damp, bear and refuse."""

from math import ceil, exp

import numpy as np
import pytest
from assembly import simulate, two_blocks

import mpmgeo
from mpmgeo.verify.bar import Bar
from mpmgeo.verify.stability import Trial, block

BAR = Bar()
BOTH = pytest.mark.parametrize("word", ["NPC", "NPC-CD"])


def vibrated(word, gamma, courant=0.5, cells=20):
    """Return velocities of a bar after a period, those of the mode, and (ωΔt) of the run."""
    case = BAR.case(cells, word, BAR.period, courant) | {"npc": {"gamma": gamma}}
    simulation = mpmgeo.Simulation(case)
    x = BAR.start(simulation)
    steps = ceil(BAR.period / simulation.time_step - 1e-9)
    simulation.step(steps)
    velocity = simulation.field("velocity")[:, 0]
    return velocity, BAR.velocity(x, 0.0), BAR.angular_frequency * simulation.time_step


@pytest.mark.parametrize(
    "word, gamma, α", [("NPC", 0.5, 0.5), ("NPC", 0.8, 0.2), ("NPC-CD", 1, 0.5)]
)
def test_damping(word, gamma, α):
    """½ α ωΔt of the critical damping: a mode falls by e^(−π α ωΔt) in a period."""
    velocity, mode, Ω = vibrated(word, gamma)
    left = velocity @ mode / (mode @ mode)
    assert left == pytest.approx(exp(-np.pi * α * Ω), abs=0.02)
    assert left < 1 - 0.8 * np.pi * α * Ω


@pytest.mark.parametrize("word, gamma", [("NPC", 1.0), ("NPC-CD", 0.5)])
def test_without_damping(word, gamma):
    velocity, mode, _ = vibrated(word, gamma)
    assert velocity @ mode / (mode @ mode) == pytest.approx(1.0, abs=0.01)


def test_two_names_of_one_recursion():
    """Central differences with γ = 1 are the paper's form with γ = ½, but for positions."""
    paper, central = vibrated("NPC", 0.5)[0], vibrated("NPC-CD", 1.0)[0]
    assert central == pytest.approx(paper, abs=1e-4 * np.abs(paper).max())


@pytest.mark.parametrize("word, gamma", [("NPC", 0.5), ("NPC", 1.0), ("NPC-CD", 0.5)])
def test_the_stable_step_is_stated(word, gamma):
    case = block(2, 0.3, stress_scheme_update=word, npc={"gamma": gamma})
    trial = Trial(case)
    assert not trial.diverges(0.95 * trial.limit)
    assert trial.diverges(1.7 * trial.limit)


@BOTH
def test_stopped_particles_have_no_acceleration(word):
    case = two_blocks(stress_scheme_update=word, gravity=[0.0, 0.0, -9.81])
    solver = simulate(case).step(3).solver
    assert all(s.a[: s.active].any() for s in solver.sets)
    solver.stop()
    assert not any(s.a[: s.active].any() for s in solver.sets)


def problems(case):
    with pytest.raises(mpmgeo.CaseError) as caught:
        mpmgeo.load_case(case)
    return str(caught.value)


@BOTH
def test_what_is_refused(word):
    case = two_blocks(stress_scheme_update=word)
    assert f'no balance of energy with "{word}"' in problems(case | {"results": {"energy": {}}})
    old = problems(case | {"compatibility": "mpm-geomechanics"})
    assert f'no "{word}"; accepted with compatibility: "USL", "MUSL", "USF"' in old
    assert f'"{word}" is for one phase' in problems(case | {"n_phases": 2})


def test_central_differences_need_half_of_the_new_acceleration():
    case = two_blocks(stress_scheme_update="NPC-CD", npc={"gamma": 0.4})
    assert 'npc.gamma: "NPC-CD" diverges with 0.4; accepted: 0.5 to 1' in problems(case)
    assert mpmgeo.load_case(case | {"stress_scheme_update": "NPC"}).npc.gamma == 0.4


def test_numbers_without_effect_are_noted():
    case = mpmgeo.load_case(two_blocks(npc={"gamma": 0.6}, lme={"gamma": 2.0}))
    assert any(note.startswith("npc: has no effect") for note in case.notes)
    assert any(note.startswith("lme: has no effect") for note in case.notes)
    same = mpmgeo.load_case(two_blocks(npc={"gamma": 0.5}, lme={"gamma": 3.0}))
    assert not any("has no effect" in note for note in same.notes)
