"""Files of an earlier case in the folder of a run are told of, and not removed in silence."""

import pytest
from assembly import simulate, two_blocks

TIP = {"type": "particles", "ids": [0], "fields": ["velocity"]}


def run(folder, **keys):
    return simulate(two_blocks(**keys), output=folder).run()


def told(simulation):
    return [m for m in simulation.messages if "earlier run" in m]


@pytest.fixture
def rich(tmp_path):
    """A folder with snapshots, probes, reactions and stresses of a run."""
    probes = {"tip": TIP, "toe": TIP}
    ram = {"ram": {"body": 1, "velocity": [0, 0, 0]}}
    simulation = run(
        tmp_path,
        results={"print": 5, "probes": probes},
        prescribed_velocity=ram,
        snapshot={"every": 20},
        save_state=True,
    )
    assert told(simulation) == []
    return tmp_path


def test_what_stays_is_told_of(rich):
    before = sorted(rich.rglob("*.npz")) + sorted(rich.rglob("*.csv"))
    assert told(run(rich, results={"print": 5, "probes": {"toe": TIP}})) == [
        f"{rich / 'snapshots'} holds 2 of the files of an earlier run, which stay: "
        "snapshot_40.npz and others",
        f"{rich / 'probes'} holds 1 of the files of an earlier run, which stay: tip.csv",
        f"{rich / 'reactions'} holds 1 of the files of an earlier run, which stay: ram.csv",
        f"{rich} holds 1 of the files of an earlier run, which stay: particle_stress_data.json",
    ]
    assert sorted(rich.rglob("*.npz")) + sorted(rich.rglob("*.csv")) == before


def test_what_is_removed_is_told_of(rich):
    simulation = run(rich, snapshot={"every": 20}, results={"print": 5}, time=0.01)
    removed = [message for message in told(simulation) if "snapshots" in message]
    assert removed == [
        f"{rich / 'snapshots'} held 2 later snapshots of an earlier run, which were removed: "
        "snapshot_50.npz and others"
    ]


def test_a_folder_of_ones_own_is_not_told_of(tmp_path):
    (tmp_path / "snapshots").mkdir()
    (tmp_path / "probes").mkdir()
    (tmp_path / "probes" / "of_mine.txt").write_text("mine")
    assert told(run(tmp_path, snapshot={"every": 20})) == []
