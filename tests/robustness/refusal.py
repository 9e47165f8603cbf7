"""What the program says when it refuses to run."""

import json
from pathlib import Path

from mpmgeo import cli


def refusal(capsys, *words):
    """Return the messages of the command with some words: exit code 2, no traceback, no files."""
    assert cli.main([*words, "--output", "out"]) == cli.BAD_INPUT
    shown = capsys.readouterr().err
    assert "Traceback" not in shown
    assert "nothing was run" in shown
    assert not Path("out").exists()
    return shown


def refusal_of(case, capsys):
    """Return the messages about a case."""
    Path("case.json").write_text(json.dumps(case))
    return refusal(capsys, "case.json")
