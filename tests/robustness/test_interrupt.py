"""Ctrl-C, SIGTERM and SIGHUP: the step is finished, the last outputs whole, the exit code 130."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from assembly import two_blocks

import mpmgeo
from mpmgeo.simulation import Simulation

ROOT = Path(mpmgeo.__file__).parents[1]
PATIENCE = 120.0  # s, for kernels may have to be compiled first

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")


@pytest.fixture
def case(tmp_path):
    """A case that would run for hours, with an output every 100 steps."""
    shown = {
        "print": 10_000_000,
        "material_point_results": ["id", "velocity"],
        "grid_nodal_results": ["mass"],
    }
    keys = two_blocks(time=1e6, results=shown)
    keys["mesh"]["boundary_conditions"] = {}
    (tmp_path / "case.json").write_text(json.dumps(keys))
    return keys


def start(folder):
    """Start a run from the command line, wait for its third output, return the process."""
    process = subprocess.Popen(
        [sys.executable, "-m", "mpmgeo", "case.json"],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    end = time.monotonic() + PATIENCE
    while not (folder / "particles" / "particles_3.vtu").exists():
        if process.poll() is not None or time.monotonic() > end:
            process.kill()
            pytest.fail(f"the run did not begin: {process.communicate()}")
        time.sleep(0.01)
    return process


def finish(process):
    """Return the exit code and what was said."""
    try:
        _, said = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    return process.returncode, said


def listed(path):
    entries = list(ElementTree.parse(path).iter("DataSet"))
    return [(float(entry.get("timestep")), path.parent / entry.get("file")) for entry in entries]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", None)])
def test_the_first_signal_ends_the_run_in_good_order(case, tmp_path, number):
    process = start(tmp_path)
    process.send_signal(number)
    code, said = finish(process)
    assert code == 130, said
    assert "interrupted after step" in said and "Traceback" not in said
    step = int(said.partition("interrupted after step ")[2].split(",")[0])
    particles = listed(tmp_path / "particles" / "particleTimeSerie.pvd")
    grid = listed(tmp_path / "grid" / "gridTimeSerie.pvd")
    assert len(particles) == len(grid) >= 3
    last = particles[-1][0]
    assert last == pytest.approx(step * 1e-3) and grid[-1][0] == last
    rows = (tmp_path / "time-energy.csv").read_text().splitlines()[1:]
    assert [float(row.split(",")[0]) for row in rows] == [t for t, _ in particles]
    on_disk = {path.name for path in tmp_path.rglob("*.vtu")}
    assert on_disk == {path.name for _, path in particles + grid}
    for _, path in particles[-2:] + grid[-2:]:
        assert all(np.isfinite(v).all() for v in meshio.read(path).point_data.values())
    assert not list(tmp_path.rglob("*.part"))


def test_the_last_files_are_those_of_a_run_that_ends_there(case, tmp_path):
    process = start(tmp_path)
    process.send_signal(signal.SIGINT)
    assert finish(process)[0] == 130
    last, path = listed(tmp_path / "particles" / "particleTimeSerie.pvd")[-1]
    twin = Simulation(mpmgeo.load_case(case)).run(until=last - 1e-6)
    assert twin.time == last
    mesh = meshio.read(path)
    assert (mesh.points == twin.field("position")).all()
    assert (mesh.point_data["Velocity"] == twin.field("velocity")).all()


@pytest.mark.parametrize("numbers", [2 * [signal.SIGINT], 2 * [signal.SIGTERM]])
def test_the_second_signal_ends_what_the_first_cannot(case, tmp_path, numbers):
    """A run that hangs in a step, here in a watcher's place, ends at the second signal."""
    script = tmp_path / "hang.py"
    script.write_text(
        "import sys, time\n"
        "from mpmgeo.simulation import Simulation\n"
        "def hang(self):\n"
        "    print('hanging', flush=True)\n"
        "    while True:\n"
        "        time.sleep(0.05)\n"
        "Simulation.advance = hang\n"
        "from mpmgeo.cli import main\n"
        "sys.exit(main(['case.json']))\n"
    )
    process = subprocess.Popen(
        [sys.executable, str(script)],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout.readline() == "hanging\n"
        process.send_signal(numbers[0])
        time.sleep(0.5)
        assert process.poll() is None, "the first signal only asks"
        process.send_signal(numbers[1])
        code, said = finish(process)
    finally:
        process.kill()
    assert code == 130 and "Traceback" not in said, said
    for name in ("particles/particleTimeSerie.pvd", "grid/gridTimeSerie.pvd"):
        for _, path in listed(tmp_path / name):
            meshio.read(path)


def test_an_interrupted_simulation_goes_on(case):
    """For scripts: the run returns early, and the next one goes on to the same bits."""

    class Interrupt:
        def begin(self, simulation):
            pass

        def after_step(self, simulation):
            if simulation.steps == 30:
                os.kill(os.getpid(), signal.SIGINT)

        def end(self, simulation, error):
            assert error is None

    simulation = Simulation(mpmgeo.load_case(case)).run(watchers=[Interrupt()])
    assert simulation.interrupted and simulation.steps == 30
    simulation.run(until=0.0595)
    assert not simulation.interrupted and simulation.steps == 60
    twin = Simulation(mpmgeo.load_case(case)).step(60)
    assert (simulation.field("position") == twin.field("position")).all()
