"""The run that compiles its kernels has the bits of every later run, and of one that goes on."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from assembly import simulate
from terrains import plane, text_of

import mpmgeo
from mpmgeo.run.progress import Compilation

STEPS = 12
FIELDS = ("position", "velocity", "stress", "volume")
SCHEMES = ("USL", "MUSL", "USF")
NAMES = [f"{s} {kind}" for kind in ("threaded", "serial") for s in SCHEMES] + ["water", "terrain"]
WATER = {
    "density_fluid": 1000.0,
    "porosity": 0.4,
    "bulk_fluid": 1e6,
    "hydraulic_conductivity": [1e-3, 1e-3, 1e-2],
}


def block(scheme, width, water=None, **keys):
    """Return a case: a soft block of `width` × 0.8 × 0.8 m is thrown on the floor."""
    body = {"type": "cuboid", "point_p1": [0.4, 0.2, 0.0], "point_p2": [0.4 + width, 1.0, 0.8]}
    soft = {"type": "elastic", "id": 1, "density": 1000.0, "young": 1e5, "poisson": 0.3}
    return {
        "time": 1.0,
        "time_step": 5e-4,
        "stress_scheme_update": scheme,
        "shape_function": "GIMP" if scheme == "USL" else "linear",
        "gravity": [0, 0, -9.81],
        "mesh": {
            "cells_number": [24, 12, 12],
            "cells_dimension": [0.1, 0.1, 0.1],
            "boundary_conditions": {"plane_Z0": "fixed"},
        },
        "materials": [soft | (water or {})],
        "body": [body | {"material_id": 1, "initial_velocity": [-2.0, 1.0, -1.0]}],
    } | keys


def case_of(name, folder):
    """Return a case: 4,608 particles take threaded kernels, 512 serial ones."""
    if name == "water":
        return block("USL", 0.9, WATER, n_phases=2, time_step=1e-4)
    if name == "terrain":
        file = folder / "ground.stl"
        file.write_text(text_of(plane(5.0, 0.1)))
        return block(
            "USL", 0.9, terrain_contact={"active": True, "stl_mesh": str(file), "friction": 0.4}
        )
    scheme, kind = name.split()
    return block(scheme, 0.1 if kind == "serial" else 0.9)


def write(path, simulation):
    """Do the rest of the steps and write the fields."""
    simulation.step(STEPS - simulation.steps)
    np.savez(path, **{key: simulation.field(key) for key in FIELDS})


def run_all(folder, first):
    """Run all cases, the first time with snapshots half-way, and later from these, too."""
    for name in NAMES:
        simulation = simulate(case_of(name, folder), threads=1)
        assert simulation.solver.small == name.endswith("serial")
        snapshot = folder / f"snapshot {name}.npz"
        if first:
            simulation.step(STEPS // 2).save(snapshot)
            write(folder / f"first {name}.npz", simulation)
        else:
            write(folder / f"second {name}.npz", simulation)
            write(folder / f"resumed {name}.npz", mpmgeo.Simulation.resume(snapshot, threads=1))


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A folder with the results of two processes, of which the first finds an empty cache."""
    folder = tmp_path_factory.mktemp("runs")
    path = [*(str(f) for f in Path(__file__).parents[:2]), str(Path(mpmgeo.__file__).parents[1])]
    variables = {"NUMBA_CACHE_DIR": str(folder / "cache"), "PYTHONPATH": os.pathsep.join(path)}
    for label in ("first", "second"):
        done = subprocess.run(
            [sys.executable, __file__, folder, label],
            env=os.environ | variables,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        compiled = float(done.stdout)
        assert compiled > 0 if label == "first" else compiled == 0
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_first_run_later_run_and_resumed_run_have_the_same_bits(results, name):
    first, second, resumed = (
        np.load(results / f"{label} {name}.npz") for label in ("first", "second", "resumed")
    )
    assert np.abs(first["stress"]).max() > 100.0
    for key in FIELDS:
        assert (first[key] == second[key]).all(), key
        assert (first[key] == resumed[key]).all(), key


if __name__ == "__main__":
    with Compilation(lambda: None) as compilation:
        run_all(Path(sys.argv[1]), first=sys.argv[2] == "first")
    print(compilation.seconds)
