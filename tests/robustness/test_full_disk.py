"""A disk that is full while a run writes: the message names the file and says that it is output."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from assembly import two_blocks

import mpmgeo

SCRIPT = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (6000, resource.RLIM_INFINITY))
from mpmgeo.cli import main
sys.exit(main(["case.json", "--output", "out"]))
"""


@pytest.mark.skipif(os.name == "nt", reason="limits of POSIX")
def test_a_file_that_cannot_be_written_is_named(tmp_path):
    """The process may write files of 6,000 bytes; the system's error has no name in it."""
    (tmp_path / "case.json").write_text(json.dumps(two_blocks(time=0.01)))
    done = subprocess.run(
        [sys.executable, "-B", "-c", SCRIPT],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(Path(mpmgeo.__file__).parents[1])},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2 and "Traceback" not in done.stderr
    expected = "particles_1.vtu: File too large (this is the output of the run)"
    assert expected in done.stderr
    files = [path.name for path in (tmp_path / "out").rglob("*") if path.is_file()]
    assert not [name for name in files if name.endswith((".vtu", ".part"))]
