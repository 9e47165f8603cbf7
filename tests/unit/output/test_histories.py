"""Files of histories: complete at outputs and at the end, with all rows that are due."""

import numpy as np
import pytest
from assembly import simulate, two_blocks

from mpmgeo.output import histories
from mpmgeo.run.watch import Diverged

TIP = {"type": "particles", "ids": [0, 90], "fields": ["velocity"], "every": 5}
RAM = {"body": 2, "velocity": [3.0, None, -2.0], "every": 4}


def table(path):
    """Return the names of the columns and the numbers of a csv file."""
    header, *rows = path.read_text().splitlines()
    return header.split(","), np.array([list(map(float, row.split(","))) for row in rows])


class Watcher:
    """Calls a function after every step."""

    def __init__(self, action):
        self.after_step = action

    def begin(self, simulation):
        pass

    def end(self, simulation, error):
        pass


def run(folder, watchers=(), **keys):
    case = two_blocks(results={"print": 2, "probes": {"tip": TIP}}, **keys)
    return simulate(case, output=folder).run(watchers=watchers)


def test_rows_come_every_so_many_steps_with_all_digits(tmp_path):
    kept = {0: None}
    watcher = Watcher(lambda s: kept.update({s.steps: (s.time, s.field("velocity"))}))
    run(tmp_path, [watcher], gravity=[0, 0, -9.81])
    columns, rows = table(tmp_path / "probes" / "tip.csv")
    names = [f"particle{n}.velocity_{axis}" for n in (0, 90) for axis in "xyz"]
    assert columns == ["time", *names]
    assert len(rows) == 11
    assert rows[0].tolist() == [0, 0, 0, 0, 3, 1, -2]
    for number, step in enumerate(range(5, 51, 5), start=1):
        time, velocity = kept[step]
        assert rows[number].tolist() == [time, *velocity[0], *velocity[90]]


def test_prescribed_velocities_have_histories(tmp_path):
    simulation = run(tmp_path, prescribed_velocity={"the ram": RAM})
    columns, rows = table(tmp_path / "reactions" / "the ram.csv")
    keys = ("velocity", "displacement", "force")
    assert columns == ["time", *(f"{key}_{axis}" for key in keys for axis in "xyz")]
    assert rows[:, 0] == pytest.approx(np.arange(4, 51, 4) * simulation.time_step)
    assert (rows[:, [1, 3]] == [3, -2]).all()
    assert rows[:, 4] == pytest.approx(3 * rows[:, 0])
    assert rows[:, 6] == pytest.approx(-2 * rows[:, 0])
    assert np.isnan(rows[:, [2, 5, 8]]).all()
    assert np.isfinite(rows[:, [7, 9]]).all()


def test_plane_probes_begin_with_the_first_measured_step(tmp_path):
    probe = {"type": "planes", "every": 20}
    case = two_blocks(results={"probes": [probe]}, gravity=[0, 0, -9.81])
    simulation = simulate(case, output=tmp_path).run()
    _, rows = table(tmp_path / "probes" / "probe_1.csv")
    assert rows[:, 0] == pytest.approx(np.array([20, 40]) * simulation.time_step)
    assert simulation.solver.clock.seconds["reactions"] > 0


def test_rows_are_in_the_file_at_outputs(tmp_path):
    """Rows wait in memory in between."""
    path, seen = tmp_path / "probes" / "tip.csv", {}
    run(tmp_path, [Watcher(lambda s: seen.update({s.steps: len(table(path)[1])}))])
    assert seen == dict.fromkeys(range(1, 25), 1) | dict.fromkeys(range(25, 50), 6) | {50: 11}


def test_memory_is_bounded(tmp_path, monkeypatch):
    monkeypatch.setattr(histories, "ROWS", 2)
    path, seen = tmp_path / "probes" / "tip.csv", {}
    run(tmp_path, [Watcher(lambda s: seen.update({s.steps: len(table(path)[1])}))])
    assert (seen[9], seen[10], seen[15], seen[20]) == (1, 3, 3, 5)


def test_a_diverged_run_leaves_no_rows_after_its_last_sound_state(tmp_path, monkeypatch):
    monkeypatch.setattr("mpmgeo.run.watch.EVERY", 7)
    monkeypatch.setattr(histories, "ROWS", 1)

    def poison(simulation):
        if simulation.steps == 24:
            simulation.solver.sets[0].v[3] = np.nan

    with pytest.raises(Diverged):
        run(tmp_path, [Watcher(poison)])
    _, rows = table(tmp_path / "probes" / "tip.csv")
    assert rows[:, 0] == pytest.approx(np.arange(0, 21, 5) * 1e-3)


def test_labels_are_those_of_the_files(tmp_path):
    run(tmp_path, compatibility="mpm-geomechanics")
    _, rows = table(tmp_path / "probes" / "tip.csv")
    assert rows[:3, 0] == pytest.approx([0, 4e-3, 9e-3])


def test_an_old_file_is_begun_anew(tmp_path):
    (tmp_path / "probes").mkdir()
    (tmp_path / "probes" / "tip.csv").write_text("old\n")
    run(tmp_path)
    assert len(table(tmp_path / "probes" / "tip.csv")[1]) == 11


def test_a_run_in_two_parts_has_one_file(tmp_path):
    run(tmp_path / "whole")
    case = two_blocks(results={"print": 2, "probes": {"tip": TIP}})
    simulation = simulate(case, output=tmp_path / "parts")
    simulation.run(until=0.0225)
    simulation.run()
    whole, parts = ((tmp_path / name / "probes" / "tip.csv") for name in ("whole", "parts"))
    assert parts.read_text() == whole.read_text()


def test_a_file_of_other_columns_is_begun_anew(tmp_path):
    class Sampler:
        columns = ("a",)

        def row(self):
            return [1.0]

    path = tmp_path / "h.csv"
    path.write_text("time,b\n1.0,2.0\n")
    history = histories.History(path, 1, Sampler())
    history.begin(5.0, goes_on=True)
    assert path.read_text() == "time,a\n"


def test_nothing_is_written_without_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run(None, prescribed_velocity=[RAM])
    assert list(tmp_path.iterdir()) == []
