"""A run that is killed or interrupted at any moment goes on, and ends as if it had not been."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LIMIT = 120  # s to wait for what a small run does in a few
CASE = {
    "time": 1.9995,
    "time_step": 1e-3,
    "gravity": [0, 0, -9.81],
    "mesh": {"cells_number": [6, 6, 6], "cells_dimension": [0.5, 0.5, 0.5]},
    "materials": [{"type": "elastic", "id": 1, "density": 1e3, "young": 1e6, "poisson": 0.25}],
    "body": [
        {
            "type": "cuboid",
            "point_p1": [1, 1, 0.5],
            "point_p2": [2, 2, 1.5],
            "material_id": 1,
            "initial_velocity": [0.3, 0, 0],
        }
    ],
    "snapshot": {"every": 50},
    "results": {"print": 16, "material_point_results": ["displacement", "stress"]},
}


def start(folder, *words):
    return subprocess.Popen(
        [sys.executable, "-m", "mpmgeo", *words],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


def snapshots(folder):
    found = (folder / "snapshots").glob("snapshot_*.npz")
    return sorted(found, key=lambda path: int(path.stem.partition("_")[2]))


def content(folder):
    files = [p for p in folder.rglob("*") if p.is_file() and p.suffix not in (".npz", ".part")]
    return {str(p.relative_to(folder)): p.read_bytes() for p in files}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The files of a run that was left alone."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "case.json").write_text(json.dumps(CASE))
    run = start(folder, "case.json", "--output", "out")
    _, said = run.communicate(timeout=LIMIT)
    assert run.returncode == 0, said
    return content(folder / "out")


def stop_somewhere(folder, word, *words):
    """Start a run, stop it by a signal after its third snapshot, and return its exit code."""
    run = start(folder, *words)
    end = time.monotonic() + LIMIT
    while len(snapshots(folder / "out")) < 2 and run.poll() is None and time.monotonic() < end:
        time.sleep(0.01)
    time.sleep(0.05)
    run.send_signal(word)
    _, said = run.communicate(timeout=LIMIT)
    return run.returncode, said


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("word", [signal.SIGKILL, signal.SIGINT, signal.SIGTERM])
def test_stopped_run_ends_as_one_that_was_left_alone(tmp_path, whole, word):
    (tmp_path / "case.json").write_text(json.dumps(CASE))
    code, said = stop_somewhere(tmp_path, word, "case.json", "--output", "out")
    assert code == (-signal.SIGKILL if word == signal.SIGKILL else 130), said
    last = snapshots(tmp_path / "out")[-1].relative_to(tmp_path)
    if word != signal.SIGKILL:
        assert f"mpmgeo --resume {last}" in re.sub(r"\s+", " ", said)
    resumed = start(tmp_path, "--resume", str(last))
    _, said = resumed.communicate(timeout=LIMIT)
    assert resumed.returncode == 0, said
    assert content(tmp_path / "out") == whole
