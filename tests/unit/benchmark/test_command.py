"""The command `mpmgeo benchmark`: all nine kernels right, their lines and numbers."""

import json
import re

import numpy as np
import pytest

from mpmgeo import cli
from mpmgeo.benchmark.command import HEADER
from mpmgeo.benchmark.configuration import Configuration
from mpmgeo.benchmark.kernels import KERNELS
from mpmgeo.benchmark.scene import PLACEMENTS, Scene

NAMES = {
    "contributionNodes",
    "particleDensity",
    "particleStress",
    "nodalMass",
    "nodalMomentum",
    "nodalInternalForce",
    "nodalExternalForce",
    "particleStrainIncrement",
    "particleVorticityIncrement",
}
LINE = re.compile(r"^\[ PERF \] (\w+) took ([\d.e+-]+) ms$", re.MULTILINE)

uneven = Configuration(particles=777, threads=1, cell=(1.0, 0.5, 2.0), cells=(3, 1, 2), seed=5)


@pytest.mark.parametrize("placement", PLACEMENTS)
@pytest.mark.parametrize("kernel", KERNELS, ids=lambda kernel: kernel.name)
def test_kernel_is_right_twice(kernel, placement):
    job = kernel(Scene(uneven, placement))
    for _ in range(2):
        if hasattr(job, "prepare"):
            job.prepare()
        job.run()
        assert job.error() < 1e-12


@pytest.mark.parametrize("kernel", KERNELS, ids=lambda kernel: kernel.name)
def test_errors_are_seen(kernel):
    job = kernel(Scene(uneven, "first cell"))
    if hasattr(job, "prepare"):
        job.prepare()
    job.run()
    if hasattr(job, "out"):
        job.out[5] += 0.01
    elif hasattr(job, "stress") and job.stress is not None and job.name == "particleStress":
        job.stress[5, 1] += 0.01
    else:
        job.scene.grid.nodes[: 64 * 8] += 0.01
    assert job.error() > 1e-6


def test_placements():
    first, spread = (Scene(uneven, placement).particles.x for placement in PLACEMENTS)
    assert (first >= 0).all() and (first <= 2.0).all()
    assert len(np.unique(np.floor(spread / uneven.cell), axis=0)) > 60


@pytest.fixture
def folder(tmp_path, monkeypatch, threads):
    threads(1)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_lines_table_and_csv(folder, capsys):
    tree = {"global": {"numParticles": 300, "numThreads": 1}}
    (folder / "c.json").write_text(json.dumps(tree))
    assert cli.main(["benchmark", "c.json", "--repeats", "3", "--csv", "t.csv"]) == cli.DONE
    shown = capsys.readouterr()
    assert {name for name, _ in LINE.findall(shown.out)} == NAMES
    assert shown.out.count("[ SPREAD ]") == 9
    assert "absent" not in shown.err
    header, *rows = (folder / "t.csv").read_text().splitlines()
    assert header == HEADER
    assert len(rows) == 18
    for row in rows:
        count, threads, _, _, middle, fastest, slowest, each = row.split(",")
        assert (count, threads) == ("300", "1")
        assert 0 < float(fastest) <= float(middle) <= float(slowest)
        assert float(each) == pytest.approx(1e6 * float(middle) / 300, rel=1e-4)


@pytest.mark.parametrize(
    ("flags", "count"), [((True, False), 6), ((False, True), 3), ((False, False), 9)]
)
def test_suites(folder, flags, count, capsys):
    keys = {"numParticles": 50, "numThreads": 1}
    keys |= dict(zip(("interpolationTest", "updateTest"), flags, strict=True))
    (folder / "benchmark-configuration.json").write_text(json.dumps({"global": keys}))
    assert cli.main(["benchmark", "--repeats", "1", "--log"]) == cli.DONE
    shown = capsys.readouterr()
    assert len(LINE.findall(shown.out)) == count
    assert "global.numCells: absent, (1, 1, 1) is used" in shown.err


def test_matrix(folder, capsys):
    tree = {"parameters": {"particles": [20, 30], "threads": [1, 1000]}}
    (folder / "m.json").write_text(json.dumps(tree))
    assert cli.main(["benchmark", "m.json", "--repeats", "1"]) == cli.DONE
    shown = capsys.readouterr()
    assert len(LINE.findall(shown.out)) == 4 * 9
    assert "note: 1000 threads asked for" in shown.err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["none.json"], "none.json: No such file"),
        (["bad.json"], "error: bad.json: not JSON"),
        (["--repeats", "0"], "--repeats needs a whole number above 0"),
        (["--repeats", "x"], "invalid int value"),
        (["a.json", "b.json"], "unrecognized arguments"),
    ],
)
def test_wrong_command_lines(folder, words, message, capsys):
    (folder / "bad.json").write_text("{")
    assert cli.main(["benchmark", *words]) == cli.BAD_INPUT
    shown = capsys.readouterr().err
    assert message in shown
    assert "Traceback" not in shown


def test_a_wrong_result_is_told(folder, monkeypatch, capsys):
    monkeypatch.setattr("mpmgeo.benchmark.kernels.NodalMass.error", lambda self: 0.5)
    (folder / "c.json").write_text('{"global": {"numParticles": 20, "numThreads": 1}}')
    assert cli.main(["benchmark", "c.json", "--repeats", "1"]) == cli.DIVERGED
    assert "error: nodalMass, first cell: wrong by 0.5" in capsys.readouterr().err
