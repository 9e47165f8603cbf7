"""What is shown of a run: words of the user are never markup, and a run may have no steps."""

import io
import json

import pytest
from assembly import simulate, two_blocks

from mpmgeo import cli
from mpmgeo.run.progress import Compilation, Progress
from mpmgeo.run.terminal import without_controls

TITLES = ["[/b]", "bulk modulus [kg]", "[link=x]a[/link] :smile:", "red \x1b[31m and \x07 bell"]


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self):
        return True


def progress(simulation, stream, message=None):
    """Run a simulation and return what is shown of it."""

    class Messenger:
        def begin(self, simulation):
            pass

        def after_step(self, simulation):
            if message and simulation.steps == 2:
                simulation.say(message)

        def end(self, simulation, error):
            pass

    with Compilation(lambda: None) as compilation:
        simulation.run(watchers=[Messenger(), Progress(compilation, stream)])
    return stream.getvalue()


@pytest.mark.parametrize("title", TITLES)
@pytest.mark.parametrize("stream", [io.StringIO, Terminal])
def test_a_title_is_shown_as_it_is(title, stream):
    simulation = simulate(two_blocks(time=0.0095, title=title))
    assert without_controls(title) in progress(simulation, stream())


@pytest.mark.parametrize("stream", [io.StringIO, Terminal])
def test_a_message_is_shown_as_it_is(stream):
    simulation = simulate(two_blocks(time=0.0095))
    assert "note: [/b] [kg] :smile:" in progress(simulation, stream(), "[/b] [kg] :smile:")


@pytest.mark.parametrize("stream", [io.StringIO, Terminal])
def test_a_run_that_is_at_its_end_has_no_speed(stream):
    simulation = simulate(two_blocks(time=0.0095)).run()
    assert "10 steps, 96 particles" in progress(simulation, stream())


def test_control_characters_are_spelled_out():
    assert without_controls("a\x1b[0m\tb\x9bc\nä") == "a\\x1b[0m\\x09b\\x9bc\nä"


def test_a_finished_run_may_be_resumed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    case = two_blocks(time=0.0095, snapshot={"every": 5}, title="[/b] [kg]")
    (tmp_path / "case.json").write_text(json.dumps(case))
    assert cli.main(["case.json", "--output", "out"]) == cli.DONE
    assert "[/b] [kg]" in capsys.readouterr().err
    files = {p: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()}
    assert cli.main(["--resume", "out/snapshots/snapshot_10.npz"]) == cli.DONE
    said = capsys.readouterr().err
    assert "Traceback" not in said and "the run is at its end already" in said
    assert {p: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()} == files
