"""A run that goes on from a snapshot ends in the same bits, files and messages as one that never
stopped, whatever the case and the number of threads."""

import shutil
from pathlib import Path

import numpy as np
import pytest

import mpmgeo
from mpmgeo.case.load import load_case
from mpmgeo.mpm.persistence import snapshot_of

DT = 4e-3
STEPS = 42
EVERY = 8
STOP = 29  # the step after which the first part is killed; the snapshot before is that of step 24
RECORD = "t,x,y,z\n" + "".join(f"{n * 0.01},{20 * (-1) ** n},0,3\n" for n in range(12))


class Killed(Exception):
    """What ends a run at once."""


class Kill:
    """A watcher that ends the run after a step."""

    def __init__(self, step):
        self.step = step

    def begin(self, simulation):
        pass

    def after_step(self, simulation):
        if simulation.steps == self.step:
            raise Killed

    def end(self, simulation, error):
        pass


def block(low, high, velocity, material=1):
    return {
        "type": "cuboid",
        "point_p1": low,
        "point_p2": high,
        "material_id": material,
        "initial_velocity": velocity,
    }


def case_of(**keys):
    """Return a case of two blocks that hit each other, and one that flies out of the mesh."""
    planes = {f"plane_{p}": "free" for p in ("X0", "Xn", "Y0", "Yn", "Zn")}
    mesh = {"cells_number": 3 * [8], "cells_dimension": 3 * [0.5], "boundary_conditions": planes}
    return {
        "time": STEPS * DT - DT / 2,
        "time_step": DT,
        "gravity": [0, 0, -9.81],
        "mesh": mesh,
        "materials": [ELASTIC | {"id": 1, "density": 1000.0}, ELASTIC],
        "body": [
            block([0.5, 0.5, 0.0], [1.5, 1.5, 1.0], [8, 3, 0]),
            block([2.5, 1.0, 0.5], [3.5, 2.0, 1.5], [-8, 0, 0], 2),
            block([2.5, 2.5, 2.5], [3.5, 3.5, 3.5], [12, 20, 15]),
        ],
        "snapshot": {"every": EVERY},
        "results": {
            "print": 7,
            "material_point_results": ["displacement", "velocity", "stress", "active"],
            "grid_nodal_results": ["mass", "velocity"],
        },
    } | keys


ELASTIC = {"type": "elastic", "id": 2, "density": 500.0, "young": 5e5, "poisson": 0.0}
PLASTIC = ELASTIC | {"type": "mohr-coulomb", "id": 1, "friction": 30, "cohesion": 1e3}
HYPERELASTIC = ELASTIC | {"type": "neo-hookean", "id": 1, "density": 1000.0}
PUSHED = {"name": "pushed", "body": 1, "velocity": [9, None, 1], "every": 5}
SHAKEN = {"earthquake": {"active": True, "file": "record.csv"}}
WET = {
    "n_phases": 2,
    "materials": [
        law
        | {
            "density": 2000.0,
            "density_fluid": 1000.0,
            "porosity": n,
            "bulk_fluid": 1e6,
            "hydraulic_conductivity": [1e-3, 1e-2, 1e-3],
        }
        for law, n in ((ELASTIC | {"id": 1}, 0.4), (ELASTIC, 0.2))
    ],
    "prescribed_pressure_box": [{"point_p1": [0, 0, 0], "point_p2": [9, 9, 0.3], "pressure": 50}],
    "pressure_force_box": [
        {"point_p1": [2, 0, 0], "point_p2": [9, 9, 9], "pressure_force": [0, 0, 1]}
    ],
}
HELD = ("damping", "compatibility")  # keys with which no particle leaves the mesh
OLD = {"compatibility": "mpm-geomechanics"}
LOCAL = {"damping": {"type": "local", "value": 0.3}}
SHARED = {"volumetric_locking": "cells", "materials": [PLASTIC, ELASTIC]}
KINETIC = {"damping": {"type": "kinetic"}}
ENERGY = {"results": {"print": 7, "energy": {"every": 3}}}
GROWING = {"ramp": {"type": "sine", "duration": 0.12}}
SWINGING = {"time": [0.01, 0.05, 0.11, 0.16], "factor": [0, 1, -1, 2]}
IN_TIME = {
    "gravity": {"value": [0, 0, -9.81]} | GROWING,
    "nodal_point_load": [{"point": [1, 1, 1], "force": [0, 0, -3000]} | SWINGING],
    "load_distributed_box": [
        {"point_p1": [0, 0, 0], "point_p2": [1, 2, 2], "load": [300, 0, 0]} | SWINGING,
        {"point_p1": [0, 0, 0], "point_p2": [4, 4, 4], "load": [0, 700, 0]},
        {"point_p1": [0.75, 0, 0], "point_p2": [4, 4, 4], "load": [0, 0, 900]} | GROWING,
    ],
}
WET_IN_TIME = {"pressure_force_box": [WET["pressure_force_box"][0] | SWINGING]}

CASES = {
    "USL": {},
    "MUSL": {"stress_scheme_update": "MUSL"},
    "USF": {"stress_scheme_update": "USF"},
    "NPC": {"stress_scheme_update": "NPC", "shape_function": "LME"},
    "NPC-CD, kinetic damping": KINETIC | {"stress_scheme_update": "NPC-CD"},
    "kinetic damping": KINETIC,
    "local damping": LOCAL,
    "local damping in the old form": LOCAL | OLD,
    "local damping in the old form, MUSL": LOCAL | OLD | {"stress_scheme_update": "MUSL"},
    "shared cells": SHARED,
    "shared cells, USF": SHARED | {"stress_scheme_update": "USF"},
    "earthquake": SHAKEN,
    "earthquake in the old form": SHAKEN | OLD,
    "earthquake in the old form, MUSL": SHAKEN | OLD | {"stress_scheme_update": "MUSL"},
    "Mohr–Coulomb": {"materials": [PLASTIC, ELASTIC]},
    "neo-Hookean": {"materials": [HYPERELASTIC, ELASTIC]},
    "energy, neo-Hookean": ENERGY | {"materials": [HYPERELASTIC, ELASTIC]},
    "prescribed velocity": {"prescribed_velocity": [PUSHED]},
    "APIC, prescribed velocity": {"transfer": "apic", "prescribed_velocity": [PUSHED]},
    "TPIC, MUSL, energy": ENERGY | {"transfer": "tpic", "stress_scheme_update": "MUSL"},
    "two phases": WET,
    "two phases, MUSL": WET | {"stress_scheme_update": "MUSL"},
    "two phases, kinetic damping": WET | KINETIC,
    "two phases on a moving base": WET | SHAKEN,
    "point load": {"nodal_point_load": [[[1, 1, 1], [0, 0, -3000]]]},
    "loads in time": IN_TIME,
    "loads in time, energy": IN_TIME | ENERGY,
    "loads in time, two phases": WET | IN_TIME | WET_IN_TIME,
    "energy": ENERGY,
    "energy, USF": ENERGY | {"stress_scheme_update": "USF"},
    "energy, Mohr–Coulomb": ENERGY | {"materials": [PLASTIC, ELASTIC]},
    "energy, kinetic damping": ENERGY | KINETIC,
    "energy, prescribed velocity": ENERGY | {"prescribed_velocity": [PUSHED]},
    "every step": {"results": {"print": 0, "material_point_results": ["stress"]}},
}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    (tmp_path / "record.csv").write_text(RECORD)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def killed_and_resumed(case, output, stop=STOP, threads=None):
    """Return a simulation that was killed after step `stop` and went on from its last snapshot."""
    with pytest.raises(Killed):
        mpmgeo.Simulation(case, output, threads=1).run(watchers=[Kill(stop)])
    path = output / "snapshots" / f"snapshot_{stop // EVERY * EVERY}.npz"
    return mpmgeo.Simulation.resume(path, output=output, threads=threads).run()


def content(folder):
    """Return the content of all files of a folder, but for the snapshots, by name."""
    files = [path for path in folder.rglob("*") if path.is_file() and path.suffix != ".npz"]
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def assert_same_state(one, other):
    first, second = snapshot_of(one.solver), snapshot_of(other.solver)
    assert first.facts == second.facts
    assert first.arrays.keys() == second.arrays.keys()
    for name, array in first.arrays.items():
        assert array.tobytes() == second.arrays[name].tobytes(), name


@pytest.mark.parametrize("name", CASES)
def test_bits_and_files_are_those_of_a_run_that_never_stopped(folder, name):
    case = load_case(case_of(**CASES[name]))
    whole = mpmgeo.Simulation(case, folder / "whole").run()
    resumed = killed_and_resumed(case, folder / "parts")
    assert whole.steps == resumed.steps == STEPS
    assert whole.solver.departures or not case_of(**CASES[name]).keys().isdisjoint(HELD)
    assert_same_state(whole, resumed)
    assert content(folder / "whole") == content(folder / "parts")
    assert set(resumed.messages) <= set(whole.messages)


@pytest.mark.parametrize("keys", [SHAKEN, SHAKEN | OLD], ids=["", "in the old form"])
def test_the_record_has_ended_before_the_snapshot(folder, keys):
    case = load_case(case_of(**keys))
    whole = mpmgeo.Simulation(case).run()
    resumed = killed_and_resumed(case, folder / "parts", 35)
    assert resumed.solver.effect("base").motion.ended
    assert_same_state(whole, resumed)


@pytest.mark.parametrize("threads", [1, 2])
def test_any_number_of_threads(folder, threads):
    """Enough particles that the kernels use threads."""
    keys = {"mesh": case_of()["mesh"] | {"cells_number": [20, 20, 20]}}
    bodies = [
        block([1, 1, 0.5], [6, 5, 4.5], [5, 3, -9]),
        block([6.5, 1, 1], [9, 3, 3], [9, 9, 9], 2),
    ]
    case = load_case(case_of(body=bodies, time=12 * DT, **keys))
    whole = mpmgeo.Simulation(case, threads=3 - threads).run()
    assert whole.solver.count > 4096
    assert_same_state(whole, killed_and_resumed(case, folder / "parts", 10, threads))


def test_the_initial_state_and_the_end_are_states_too(folder):
    case = load_case(case_of())
    whole = mpmgeo.Simulation(case).run()
    mpmgeo.Simulation(case).save(folder / "start.npz")
    whole.save(folder / "end.npz")
    assert_same_state(whole, mpmgeo.Simulation.resume(folder / "start.npz").run())
    again = mpmgeo.Simulation.resume(folder / "end.npz")
    assert_same_state(whole, again)
    for a, b in zip(whole.nodes(), again.nodes(), strict=True):
        np.testing.assert_array_equal(a, b)


def test_resuming_twice_and_from_an_earlier_snapshot(folder):
    case = load_case(case_of(snapshot={"every": EVERY, "keep": 99}))
    whole = mpmgeo.Simulation(case, folder / "whole").run()
    killed_and_resumed(case, folder / "parts")
    early = folder / "parts" / "snapshots" / f"snapshot_{EVERY}.npz"
    resumed = mpmgeo.Simulation.resume(early, output=folder / "parts").run()
    assert_same_state(whole, resumed)
    assert content(folder / "whole") == content(folder / "parts")


def test_a_longer_time_lets_a_finished_run_go_on(folder):
    case = load_case(case_of(time=(STEPS - 10) * DT - DT / 2))
    mpmgeo.Simulation(case, folder / "out").run()
    path = folder / "out" / "snapshots" / f"snapshot_{STEPS - 10}.npz"
    longer = load_case(case_of())
    resumed = mpmgeo.Simulation.resume(path, longer, folder / "out").run()
    assert_same_state(mpmgeo.Simulation(longer).run(), resumed)


def test_only_the_latest_snapshots_are_kept(folder):
    def steps(out):
        return sorted(int(p.stem.partition("_")[2]) for p in Path(out, "snapshots").iterdir())

    mpmgeo.Simulation(load_case(case_of()), folder / "two").run()
    assert steps("two") == [STEPS // EVERY * EVERY, STEPS]
    case = load_case(case_of(snapshot={"every": EVERY, "keep": 4}))
    mpmgeo.Simulation(case, folder / "four").run()
    assert steps("four") == [24, 32, 40, 42]
    shutil.copy(folder / "four/snapshots/snapshot_24.npz", folder / "four/snapshots/mine.npz")
    with pytest.raises(Killed):
        mpmgeo.Simulation(case, folder / "four").run(watchers=[Kill(9)])
    assert sorted(p.name for p in (folder / "four/snapshots").iterdir()) == [
        "mine.npz",
        "snapshot_8.npz",
    ]


def test_running_on_in_parts_is_running_at_once(folder):
    """A script may run a simulation piece by piece into one folder."""
    case = load_case(case_of())
    mpmgeo.Simulation(case, folder / "whole").run()
    parts = mpmgeo.Simulation(case, folder / "parts")
    parts.run(until=10.5 * DT)
    parts.run(until=24.5 * DT)
    parts.run()
    assert content(folder / "whole") == content(folder / "parts")


def test_histories_go_on(folder):
    probe = {"type": "box", "point_p1": [0, 0, 0], "point_p2": [4, 4, 4], "fields": ["velocity"]}
    results = case_of()["results"] | {"probes": [probe | {"name": "all", "every": 3}]}
    case = load_case(case_of(results=results))
    mpmgeo.Simulation(case, folder / "whole").run()
    killed_and_resumed(case, folder / "parts")
    assert "probes/all.csv" in {name.replace("\\", "/") for name in content(folder / "whole")}
    assert content(folder / "whole") == content(folder / "parts")
