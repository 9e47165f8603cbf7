"""Signals before the time loop, and terminals that go away: exit code 130, no traceback."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import mpmgeo

ROOT = Path(mpmgeo.__file__).parents[1]
SCRIPT = """
import signal, sys, time
signal.signal(signal.SIGINT, {sigint})
from mpmgeo import cli
def serve(arguments):
    print("ready", flush=True)
    time.sleep(60)
    return 0
cli._serve = serve
sys.exit(cli.main(["case.json"]))
"""

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")


def start(sigint, **streams):
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT.format(sigint=sigint)],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        text=True,
        **streams,
    )
    assert process.stdout.readline() == "ready\n"
    return process


def finish(process):
    """Return what was said; a process that does not end is killed."""
    try:
        return process.communicate(timeout=30)[1]
    finally:
        process.kill()


@pytest.mark.parametrize("sigint", ["signal.SIG_IGN", "signal.default_int_handler"])
@pytest.mark.parametrize("number", [signal.SIGTERM, getattr(signal, "SIGHUP", None)])
def test_termination_counts_also_where_ctrl_c_is_ignored(sigint, number):
    """A shell without job control ignores Ctrl-C in what it starts with `&`."""
    process = start(sigint, stderr=subprocess.PIPE)
    process.send_signal(number)
    said = finish(process)
    assert process.returncode == 130
    assert said == "error: interrupted\n"


def test_a_terminal_that_is_gone_is_no_error():
    keyboard, screen = os.openpty()
    process = start("signal.default_int_handler", stderr=screen)
    os.close(screen)
    os.close(keyboard)
    process.send_signal(signal.SIGHUP)
    finish(process)
    assert process.returncode == 130
