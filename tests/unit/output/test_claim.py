"""A folder of results is one run's at a time, and stays where it was."""

import errno
import json
import os
import socket
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import mpmgeo
from mpmgeo.output.claim import NAME, Refused, claimed
from mpmgeo.output.whole_file import append, whole_file

ROOT = Path(mpmgeo.__file__).parents[1]
HOLD = """
import sys, time
from mpmgeo.output.claim import claimed
with claimed(sys.argv[1], "dam.json"):
    print("held", flush=True)
    time.sleep(600)
"""

posix = pytest.mark.skipif(os.name == "nt", reason="signals and locks of POSIX")


@pytest.fixture
def other(tmp_path):
    """Another process that holds the folder `out`."""
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path / "out")],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout.readline() == "held\n"
    yield process
    process.kill()
    process.communicate()


def test_a_second_run_is_refused_and_told_of_the_first(tmp_path, other):
    with pytest.raises(Refused) as refused, claimed(tmp_path / "out", "slope.json"):
        pass
    said = str(refused.value)
    for word in ("dam.json", f"process {other.pid} on {socket.gethostname()} since 20", "--output"):
        assert word in said
    assert str(tmp_path / "out") == refused.value.filename
    with claimed(tmp_path / "another", "slope.json"):
        pass


def test_the_command_line_says_so(tmp_path, other, monkeypatch, capsys):
    from assembly import two_blocks

    from mpmgeo import cli

    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.json").write_text(json.dumps(two_blocks()))
    assert cli.main(["case.json", "--output", "out"]) == cli.BAD_INPUT
    said = capsys.readouterr().err
    assert f"error: out: another run writes its results here: dam.json, process {other.pid}" in said
    assert [path.name for path in (tmp_path / "out").iterdir()] == [NAME]


def test_what_a_killed_run_left_does_not_block(tmp_path, other):
    other.kill()
    other.wait()
    assert (tmp_path / "out" / NAME).exists()
    with claimed(tmp_path / "out", "slope.json"):
        run = json.loads((tmp_path / "out" / NAME).read_text())
        assert run["case"] == "slope.json" and run["process"] == os.getpid()
    assert not list((tmp_path / "out").iterdir())


@pytest.mark.parametrize("left", [b"", b"\xff{", b"[]", b'{"process": "x"}', b"[" * 9000])
def test_nor_does_a_file_that_says_nothing(tmp_path, left):
    (tmp_path / NAME).write_bytes(left)
    with claimed(tmp_path, "slope.json"):
        pass


def test_the_same_run_may_claim_again_and_another_thread_may_not(tmp_path):
    caught = []

    def work():
        try:
            with claimed(tmp_path, "other"):
                pass
        except Refused as error:
            caught.append(error)

    with claimed(tmp_path, "a"), claimed(tmp_path, "a"):
        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
    assert len(caught) == 1
    with claimed(tmp_path, "a"):
        pass


@posix
def test_without_locks_the_process_tells(tmp_path, monkeypatch, other):
    import fcntl

    def unsupported(*_):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", unsupported)
    with pytest.raises(Refused, match=f"process {other.pid} "), claimed(tmp_path / "out", "a"):
        pass
    other.kill()
    other.wait()
    with claimed(tmp_path / "out", "a"), claimed(tmp_path / "out", "a"):
        pass


@posix
def test_a_link_in_place_of_the_lock_is_not_followed(tmp_path):
    target = tmp_path / "target"
    target.write_text("mine")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / NAME).symlink_to(target)
    with pytest.raises(OSError), claimed(tmp_path / "out", "a"):
        pass
    assert target.read_text() == "mine"


@posix
@pytest.mark.parametrize("replaced", [False, True])
def test_a_folder_that_was_moved_away_is_not_made_again(tmp_path, replaced):
    out, moved = tmp_path / "out", tmp_path / "moved"
    with claimed(out, "a"):
        with whole_file(out / "particles" / "p.vtu") as file:
            file.write(b"1")
        out.rename(moved)
        if replaced:
            out.mkdir()
        with pytest.raises(Refused, match="moved away"), whole_file(out / "grid" / "g.vtu"):
            pass
        with pytest.raises(Refused, match="moved away"):
            append(out / "time-energy.csv", "0,0\n")
    assert out.exists() == replaced and not (out / "grid").exists()


@posix
def test_a_run_whose_folder_is_moved_away_stops(tmp_path):
    from assembly import simulate, two_blocks

    class Mover:
        def begin(self, simulation):
            pass

        def after_step(self, simulation):
            if simulation.steps == 20:
                (tmp_path / "out").rename(tmp_path / "moved")

        def end(self, simulation, error):
            pass

    simulation = simulate(two_blocks(results={"print": 10}), output=tmp_path / "out")
    with pytest.raises(Refused, match="moved away"):
        simulation.run(watchers=[Mover()])
    assert not (tmp_path / "out").exists() and simulation.steps < 30
    assert len(list((tmp_path / "moved" / "particles").glob("*.vtu"))) >= 4


def test_a_run_without_output_claims_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with claimed(None, "a"):
        assert not list(tmp_path.iterdir())
