"""The cache of compiled kernels: never code of older sources, never another kernel's."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest

import mpmgeo
from mpmgeo.numerics import cache, jit
from mpmgeo.numerics.chunks import ALONE, CHUNKS, crew_of

PACKAGE = Path(mpmgeo.__file__).parent


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the package's sources and a function that says which cache folder it would use."""
    package = tmp_path / "mpmgeo"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(numba.config, "CACHE_DIR", numba.config.CACHE_DIR)

    def folder():
        module(package / "numerics" / "jit.py")
        return Path(numba.config.CACHE_DIR)

    return package, folder


def module(path):
    """Import a file as a new module of its name."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


def test_equal_sources_share_the_folder(copy):
    _, folder = copy
    assert folder() == folder()
    assert folder().is_dir() and folder().parent.name == "mpmgeo"
    assert folder().name == Path(jit._cache_folder()).name


@pytest.mark.parametrize(
    "source",
    [
        "numerics/simd.py",
        "materials/elastic.py",
        "shapes/gimp.py",
        "boundaries/planes.py",
        "state/grid.py",
        "mpm/tile.py",
    ],
)
def test_folder_depends_on_every_source_of_kernels(copy, source):
    package, folder = copy
    before = folder()
    with (package / source).open("a") as file:
        file.write("# edited\n")
    assert folder() != before


def test_folder_depends_on_new_sources(copy):
    package, folder = copy
    before = folder()
    (package / "materials" / "new_law.py").write_text("STATE = ()\n")
    assert folder() != before


def test_folder_outlives_edits_of_what_has_no_kernels(copy):
    package, folder = copy
    before = folder()
    for source in ("case/load.py", "output/vtu.py", "run/progress.py"):
        (package / source).write_text("")
    assert folder() == before


@pytest.mark.parametrize("name", sorted(jit.NO_KERNELS))
def test_folders_without_kernels_have_none(name):
    for source in (PACKAGE / name).rglob("*.py"):
        text = source.read_text(encoding="utf-8")
        assert "numerics.jit" not in text and "njit" not in text, source


def test_unwritable_home_falls_back(copy, monkeypatch, tmp_path):
    _, folder = copy
    blocked = tmp_path / "file"
    blocked.write_text("")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(blocked))
    monkeypatch.setattr(cache.tempfile, "tempdir", str(tmp_path / "elsewhere"))
    assert folder().is_relative_to(tmp_path / "elsewhere")


def test_one_kernel_in_the_cache_serves_every_crew(tmp_path, monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    source = tmp_path / "loops.py"
    source.write_text(
        "from mpmgeo.numerics.chunks import blockwise\n@blockwise\ndef fill(c, a):\n    a[c] = c\n"
    )
    written = []
    for crew, hits in ((ALONE, 0), (crew_of(2), 1), (ALONE, 1)):
        fill, a = module(source).fill, np.zeros(CHUNKS)
        fill(crew, a)
        assert sum(fill.stats.cache_hits.values()) == hits
        written.append(a)
    assert all((a == np.arange(CHUNKS)).all() for a in written)


LAW = """
from typing import NamedTuple
from mpmgeo.materials.law import update_stress
class Mine(NamedTuple):
    E: float
    STATE = ()
@update_stress.register(Mine)
def mine(law, stress, strain, state, dt):
    return (FACTOR * law.E, 0.0, 0.0, 0.0, 0.0, 0.0)
"""
KERNEL = """
from mpmgeo.materials.law import update_stress
from mpmgeo.numerics.jit import compiled
@compiled
def kernel(law):
    zero = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return update_stress(law, zero, zero, (), 1.0)[0]
"""
USE_MINE = "from kernel import kernel; from my_law import Mine; print(kernel(Mine(10.0)))"
USE_ELASTIC = """
from kernel import kernel
from mpmgeo.materials import Elastic
print(kernel(Elastic(id=1, density=1.0, young=1.0, poisson=0.25).symbols))
"""


@pytest.fixture
def user(tmp_path):
    """A function that runs a script in a user's folder, which has a law and a kernel for it."""
    (tmp_path / "kernel.py").write_text(KERNEL)
    path = os.pathsep.join([str(tmp_path), str(PACKAGE.parent)])
    variables = {"NUMBA_CACHE_DIR": str(tmp_path / "cache"), "PYTHONPATH": path}

    def run(script):
        done = subprocess.run(
            [sys.executable, "-B", "-c", script],
            env=os.environ | variables,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        return float(done.stdout)

    return run


def test_an_edited_law_of_a_user_is_compiled_anew(user, tmp_path):
    """A law outside the package is no source of the cache folder; its old code must not be used."""
    for factor in (1.0, 2.0):
        (tmp_path / "my_law.py").write_text(LAW.replace("FACTOR", str(factor)))
        assert user(USE_MINE) == 10.0 * factor


def test_a_law_of_a_user_does_not_disturb_others(user, tmp_path):
    """Where that law cannot be imported, the cache must serve the other laws nevertheless."""
    assert user(USE_ELASTIC) == 0.0
    (tmp_path / "my_law.py").write_text(LAW.replace("FACTOR", "3.0"))
    assert user(USE_MINE) == 30.0
    (tmp_path / "my_law.py").unlink()
    assert user(USE_ELASTIC) == 0.0
