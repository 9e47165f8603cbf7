"""The command line: options, exit codes, streams. The simulation itself is a stand-in here."""

import json
import os
import signal
import subprocess
import sys
from types import ModuleType

import numpy as np
import pytest

from mpmgeo import cli
from mpmgeo.case.building.lint import lint
from mpmgeo.run.watch import Diverged


@pytest.fixture
def case_file(tmp_path, monkeypatch):
    """A valid case file; the working directory is its folder."""
    monkeypatch.chdir(tmp_path)
    case = {
        "title": "Böschung",
        "time": 0.1,
        "time_step": 1e-3,
        "mesh": {"cells_number": [4, 4, 4], "cells_dimension": [0.5, 0.5, 0.5]},
        "material": [{"type": "elastic", "id": 1, "density": 2e3, "young": 1e6, "poisson": 0.3}],
        "body": [
            {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "material_id": 1}
        ],
    }
    file = tmp_path / "case.json"
    file.write_text(json.dumps(case), encoding="utf-8")
    return file


@pytest.fixture
def simulations(monkeypatch):
    """Put a stand-in for the simulation in place and return the list of those that were made."""
    made = []

    class Simulation:
        ends_with = None
        interrupted = goes_on = False
        snapshot = None
        steps = 1

        def __init__(self, case, output=None, threads=None):
            self.case, self.output, self.threads = case, output, threads
            self.time_step = case.time_step
            self.critical_time_step, self.stable_time_step = 2e-2, 1e-2
            self.messages = ["a note of the simulation"]
            self.has_run = False
            made.append(self)

        @property
        def warnings(self):
            return lint(self)

        def field(self, name):
            return {"position": np.zeros((1, 3)), "body": np.ones(1, dtype=np.uint32)}[name]

        def run(self, *_, **__):
            self.has_run = True
            if self.ends_with:
                raise self.ends_with

    module = ModuleType("mpmgeo.simulation")
    module.Simulation = Simulation
    monkeypatch.setitem(sys.modules, module.__name__, module)
    made.append(Simulation)
    return made


def text_of(capsys):
    return capsys.readouterr().err


@pytest.mark.parametrize("words", [["case.json"], ["--input", "case.json"], ["--input=case.json"]])
def test_a_case_runs(case_file, simulations, words, capsys):
    assert cli.main(words) == cli.DONE
    assert simulations[-1].has_run
    assert "note: a note of the simulation" in text_of(capsys)


def test_options_reach_the_simulation(case_file, simulations):
    assert cli.main(["case.json", "--output", "out", "--threads", "2"]) == cli.DONE
    assert str(simulations[-1].output) == "out"
    assert simulations[-1].threads == 2


def test_resolved_case_is_saved_beside_the_results(case_file, simulations, tmp_path):
    assert cli.main(["case.json", "--output", "new/folder"]) == cli.DONE
    saved = json.loads((tmp_path / "new/folder/resolved-case.json").read_text("utf-8"))
    assert saved["title"] == "Böschung"
    assert saved["critical_time_step_multiplier"] == 0.25
    assert cli.main(["new/folder/resolved-case.json", "--strict"]) == cli.DONE


def test_check_prints_the_resolved_case_and_runs_nothing(case_file, simulations, tmp_path, capsys):
    assert cli.main(["case.json", "--check"]) == cli.DONE
    assert json.loads(capsys.readouterr().out)["shape_function"] == "GIMP"
    assert not simulations[-1].has_run
    assert simulations[-1].output is None
    assert [file.name for file in tmp_path.iterdir()] == ["case.json"]


def test_quiet_keeps_warnings(case_file, simulations, capsys):
    case = json.loads(case_file.read_text())
    case_file.write_text(json.dumps(case | {"odd": 1, "results": {"fields": ["stress"]}}))
    assert cli.main(["case.json", "--quiet"]) == cli.DONE
    assert text_of(capsys) == "warning: odd: unknown key, ignored\n"


def test_strict_makes_warnings_errors(case_file, simulations, tmp_path, capsys):
    case = json.loads(case_file.read_text())
    case_file.write_text(json.dumps(case | {"odd": 1}))
    assert cli.main(["case.json", "--strict", "--output", "out"]) == cli.BAD_INPUT
    assert "error: odd: unknown key, ignored" in text_of(capsys)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("mode", [[], ["--check"]])
def test_tells_the_time_step_and_the_stable_one(case_file, simulations, capsys, mode):
    assert cli.main(["case.json", "--output", "out", *mode]) == cli.DONE
    step = json.loads(case_file.read_text())["time_step"]
    expected = f"note: time step {step:.4g} s; stable up to 0.01 s, critical 0.02 s"
    assert expected in capsys.readouterr().err


def test_strict_makes_lint_errors(case_file, simulations, tmp_path, capsys):
    case = json.loads(case_file.read_text())
    case_file.write_text(json.dumps(case | {"time_step": 0.05}))
    assert cli.main(["case.json", "--output", "out"]) == cli.DONE
    assert "warning: time_step: 0.05 s exceeds 0.01 s" in text_of(capsys)
    assert cli.main(["case.json", "--strict", "--output", "strict"]) == cli.BAD_INPUT
    assert "error: time_step: 0.05 s exceeds 0.01 s" in text_of(capsys)
    assert not (tmp_path / "strict").exists()


@pytest.mark.parametrize(
    ("error", "code", "message"),
    [
        (Diverged("step 7: particle 3 is lost"), cli.DIVERGED, "step 7: particle 3 is lost"),
        (KeyboardInterrupt(), cli.INTERRUPTED, "interrupted"),
        (OSError(28, "No space left on device", "a.vtu"), cli.BAD_INPUT, "a.vtu: No space left"),
        (MemoryError(), cli.BAD_INPUT, "more memory than there is"),
    ],
)
def test_ends_of_a_run(case_file, simulations, capsys, error, code, message):
    simulations[0].ends_with = error
    assert cli.main(["case.json"]) == code
    assert message in text_of(capsys)


def test_errors_of_files_say_that_these_are_the_output(case_file, simulations, capsys):
    simulations[0].ends_with = OSError(28, "No space left on device", "a.vtu")
    assert cli.main(["case.json"]) == cli.BAD_INPUT
    assert "a.vtu: No space left on device (this is the output of the run)" in text_of(capsys)
    assert cli.main(["case.json", "--output", "case.json"]) == cli.BAD_INPUT
    assert "case.json: File exists (this is the output of the run)" in text_of(capsys)


def test_messages_do_not_steer_the_terminal(case_file, simulations, capsys):
    simulations[0].ends_with = Diverged("[/b] \x1b[31m red")
    assert cli.main(["case.json"]) == cli.DIVERGED
    assert "error: [/b] \\x1b[31m red" in text_of(capsys)


def test_interrupted_run(case_file, simulations):
    simulations[0].interrupted = True
    assert cli.main(["case.json"]) == cli.INTERRUPTED


def test_termination_acts_like_ctrl_c(case_file, simulations):
    before = signal.getsignal(signal.SIGTERM)
    simulations[0].run = lambda *_, **__: os.kill(os.getpid(), signal.SIGTERM)
    assert cli.main(["case.json"]) == cli.INTERRUPTED
    assert signal.getsignal(signal.SIGTERM) is before


def test_simulation_that_cannot_be_built(case_file, simulations, monkeypatch, capsys):
    def refuse(*_, **__):
        raise ValueError("no grid of that size")

    monkeypatch.setattr(simulations[0], "__init__", refuse)
    assert cli.main(["case.json"]) == cli.BAD_INPUT
    assert "error: no grid of that size" in text_of(capsys)


def test_output_that_is_a_file(case_file, simulations, capsys):
    assert cli.main(["case.json", "--output", "case.json"]) == cli.BAD_INPUT
    assert "case.json: File exists" in text_of(capsys)


def test_many_messages_are_cut(case_file, simulations, capsys):
    case = json.loads(case_file.read_text())
    case_file.write_text(json.dumps(case | {f"odd {n}": n for n in range(150)}))
    assert cli.main(["case.json", "--quiet"]) == cli.DONE
    lines = text_of(capsys).splitlines()
    assert len(lines) == 101
    assert lines[-1] == "warning: and 50 more"


@pytest.mark.parametrize("word", cli.RESERVED)
def test_words_of_later_subcommands_are_reserved(tmp_path, monkeypatch, word, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main([word, "case.json"]) == cli.BAD_INPUT
    assert f"the word {word} is reserved" in text_of(capsys)


def test_a_file_may_have_a_reserved_name(case_file, simulations):
    case_file.rename(case_file.with_name("check"))
    assert cli.main(["check"]) == cli.DONE


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "name a case file"),
        (["a.json", "b.json"], "name one case file"),
        (["a.json", "--input", "b.json"], "name one case file"),
        (["a.json", "--threads", "0"], "'0' is no number of threads"),
        (["a.json", "--threads", "two"], "'two' is no number of threads"),
        (["a.json", "--threads", "-1"], "threads"),
        (["a.json", "--thrads", "2"], "unrecognized arguments"),
        (["--output"], "expected one argument"),
        (["none.json"], 'there is no file "none.json"'),
        (["."], "is a folder"),
    ],
)
def test_wrong_command_lines(tmp_path, monkeypatch, words, message, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(words) == cli.BAD_INPUT
    assert message in text_of(capsys)


def test_help(capsys):
    assert cli.main(["--help"]) == cli.DONE
    assert "Exit codes: 0 done, 2 bad input, 3 the run diverged, 130" in capsys.readouterr().out


def test_help_names_the_subcommands(capsys):
    assert cli.main(["--help"]) == cli.DONE
    assert all(f"mpmgeo {command}" in capsys.readouterr().out for command in cli.COMMANDS)


@pytest.mark.parametrize("option", ["--version", "--help"])
def test_nothing_heavy_is_imported_for(option):
    """Run in a new process, since this one has everything imported already."""
    program = (
        "import sys; from mpmgeo.cli import main; code = main(sys.argv[1:]);"
        "heavy = {'numpy', 'numba', 'jsonschema', 'vtkmodules', 'rich'} & set(sys.modules);"
        "sys.exit(str(heavy) if heavy else code)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, option], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(("mpmgeo", "usage: mpmgeo"))


def test_module_is_runnable(tmp_path):
    done = subprocess.run(
        [sys.executable, "-m", "mpmgeo", str(tmp_path / "none.json")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == cli.BAD_INPUT
    assert "Traceback" not in done.stderr
