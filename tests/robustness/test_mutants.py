"""Whatever happens to a file of a case that ships: it runs or is refused, in time and in memory."""

import os
import sys
from time import perf_counter

import pytest
from mutants import CASES, Mutants

import mpmgeo
from mpmgeo.case.building.lint import lint
from mpmgeo.case.load import CaseError, load_case
from mpmgeo.case.meaning import sizes
from mpmgeo.run.progress import peak_memory
from mpmgeo.run.watch import Diverged

LONGEST = 20.0  # s for one mutant
LARGEST = 2 * 2**30  # bytes
LARGE = ("bodies_in_flight", "column_collapse", "dam_break")
"""Cases that take longer than the others."""

STEP_EVERY = 20  # mutants of which one makes three steps


def kind(solver):
    """Return what chooses the kernels of a solver: another kind would compile new ones."""
    sets = [
        (type(s.law), type(s.half), s.rotation, s.tool is None, type(s.fluid), *s.arrays())
        for s in solver.sets
    ]
    models = [type(model) for model in (*solver.damping, solver.early_damping, *solver.effects)]
    return sets, models, type(solver.shape), solver.scheme, type(solver.planes), solver.small


def try_one(source, known, steps):
    """Load, build and perhaps step a mutant; return whether it came that far."""
    try:
        case = load_case(source)
        simulation = mpmgeo.Simulation(case)
        lint(simulation)
        if steps and kind(simulation.solver) == known:
            simulation.step(3).check()
    except (CaseError, ValueError) as error:
        assert str(error)
        return False
    except Diverged:
        return True
    return True


def run(name, folder, seeds):
    mutants = Mutants(name, folder)
    os.chdir(mutants.folder)
    sound = mpmgeo.Simulation(load_case(mutants.case))
    known = kind(sound.solver)
    sound.step(3)  # compiles the kernels, which takes longer than a mutant may
    ran = 0
    for seed in seeds:
        start = perf_counter()
        try:
            ran += try_one(mutants.make(seed), known, steps=seed % STEP_EVERY == 0)
        except BaseException:
            print(f"mutant {seed} of {name}", file=sys.stderr)
            raise
        assert perf_counter() - start < LONGEST, f"mutant {seed} of {name}"
    return ran


@pytest.fixture(autouse=True)
def little_memory(monkeypatch, tmp_path):
    """Let cases be refused that need more memory than the bound; go back to where we are."""
    monkeypatch.chdir(tmp_path)
    before = peak_memory()
    monkeypatch.setattr(sizes, "memory_of_machine", lambda: LARGEST / 2)
    yield
    assert peak_memory() - before < LARGEST


@pytest.mark.parametrize("name", CASES)
def test_a_few_mutants(name, tmp_path):
    assert run(name, tmp_path, range(1, 20)) > 0


def test_there_are_many():
    assert len(CASES) * 2000 - len(LARGE) * 1200 >= 20_000


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_many_mutants(name, tmp_path):
    number = 800 if name in LARGE else 2000
    assert run(name, tmp_path, range(1000, 1000 + number)) > number / 10
