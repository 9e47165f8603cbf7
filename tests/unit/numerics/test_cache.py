"""The folder of compiled kernels is the user's own, and no file in it can end a run."""

import importlib.util
import os
import stat
import subprocess
import sys
from pathlib import Path

import numba
import pytest

import mpmgeo
from mpmgeo.numerics import cache
from mpmgeo.numerics.cache import own_folder
from mpmgeo.numerics.jit import remarks

ROOT = Path(mpmgeo.__file__).parents[1]

posix = pytest.mark.skipif(not hasattr(os, "geteuid"), reason="owners and modes of POSIX")


@pytest.fixture
def places(tmp_path, monkeypatch):
    """The user's folder for caches, which does not exist, and that for temporary files."""
    home, temporary = tmp_path / "home" / "cache", tmp_path / "temporary"
    temporary.mkdir()
    temporary.chmod(0o1777)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(home))
    monkeypatch.setattr(cache.tempfile, "tempdir", str(temporary))
    monkeypatch.setattr(cache, "troubles", [])
    return home, temporary


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


@posix
def test_folders_are_made_for_the_user_alone(places):
    home, _ = places
    assert Path(own_folder("abc")) == home / "mpmgeo" / "abc"
    assert mode(home) == mode(home / "mpmgeo") == mode(home / "mpmgeo" / "abc") == 0o700
    assert own_folder("abc") == own_folder("abc") and not cache.troubles


@pytest.fixture
def no_home(places):
    """A user's folder that cannot be used; returns that for temporary files."""
    home, temporary = places
    home.parent.mkdir()
    home.write_text("")
    return temporary


@posix
def test_a_folder_in_a_shared_place_has_the_users_number(no_home):
    own = no_home / f"mpmgeo-{os.geteuid()}"
    assert Path(own_folder("abc")) == own / "abc"
    assert mode(own) == mode(own / "abc") == 0o700


@posix
@pytest.mark.parametrize("inner", ["", "abc"])
@pytest.mark.parametrize("wrong", [0o777, 0o770, 0o702])
def test_a_folder_that_others_can_write_to_is_refused(no_home, inner, wrong):
    own_folder("abc")
    (no_home / f"mpmgeo-{os.geteuid()}" / inner).chmod(wrong)
    assert own_folder("abc") == ""
    assert "can be written by other users" in cache.troubles[0]


@posix
@pytest.mark.parametrize("inner", ["", "abc"])
def test_a_link_is_refused(no_home, tmp_path, inner):
    made = Path(own_folder("abc"))
    planted = made if inner else made.parent
    planted.rename(tmp_path / "elsewhere")
    planted.symlink_to(tmp_path / "elsewhere")
    assert own_folder("abc") == ""
    assert "a link" in cache.troubles[0]


@posix
def test_a_folder_of_another_user_is_refused(places, monkeypatch):
    """Whoever made it: here the user becomes another one."""
    _, temporary = places
    own_folder("abc")
    me = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: me + 1)
    (temporary / f"mpmgeo-{me + 1}").mkdir(mode=0o700)
    assert own_folder("abc") == ""
    assert "belongs to another user" in cache.troubles[0]


@posix
def test_a_chosen_place_where_anybody_can_replace_folders_is_refused(places):
    home, temporary = places
    home.mkdir(parents=True)
    home.chmod(0o777)
    assert Path(own_folder("abc")).is_relative_to(temporary)
    home.chmod(0o1777)
    assert Path(own_folder("abc")).is_relative_to(home)


def test_a_user_without_home_and_temporary_folder_has_no_cache(places, monkeypatch):
    def none(*_):
        raise RuntimeError("Could not determine home directory.")

    def nowhere():
        raise FileNotFoundError(2, "No usable temporary directory found")

    monkeypatch.delenv("NUMBA_CACHE_DIR")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(cache.Path, "home", none)
    monkeypatch.setattr(cache.tempfile, "gettempdir", nowhere)
    assert own_folder("abc") == ""
    assert "Could not determine home directory" in cache.troubles[0]
    assert "No usable temporary directory" in cache.troubles[0]


@pytest.fixture
def kernel(tmp_path, monkeypatch):
    """A function that imports a kernel anew, as a later process does; its cache is `kept`."""
    kept = tmp_path / "kept"
    kept.mkdir()
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(kept))
    source = tmp_path / "source.py"
    source.write_text(
        "from mpmgeo.numerics.jit import compiled\n@compiled\ndef twice(x):\n    return 2 * x\n"
    )

    def made():
        spec = importlib.util.spec_from_file_location("source", source)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module.twice

    made.files = lambda ending: sorted(kept.rglob(f"*{ending}"))
    return made


def flipped(content):
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


DAMAGES = {
    "empty": lambda content: b"",
    "cut": lambda content: content[: len(content) // 2],
    "one bit": flipped,
    "of something else": lambda content: b"this is no kernel" * 100,
}


@pytest.mark.parametrize("name", DAMAGES)
@pytest.mark.parametrize("ending", [".nbi", ".nbc"])
def test_a_damaged_file_is_made_anew(kernel, ending, name):
    assert kernel()(1.5) == 3.0
    (file,) = kernel.files(ending)
    whole = file.read_bytes()
    file.write_bytes(DAMAGES[name](whole))
    twice = kernel()
    assert twice(1.5) == 3.0 and not sum(twice.stats.cache_hits.values())
    again = kernel()
    assert again(1.5) == 3.0 and sum(again.stats.cache_hits.values()) == 1


def test_what_a_file_would_do_when_it_is_read_does_not_happen(kernel, tmp_path):
    """An index as numba itself would read it, with a command inside."""
    kernel()(1.5)
    (file,) = kernel.files(".nbi")
    touch = tmp_path / "executed"
    file.write_bytes(b"cposix\nsystem\n(S'touch " + str(touch).encode() + b"'\ntR.")
    assert kernel()(1.5) == 3.0
    assert not touch.exists()


def test_a_kernel_under_the_name_of_another_is_not_used(kernel):
    """As two processes may leave it that write at the same time."""
    twice = kernel()
    assert (twice(1.5), twice(2)) == (3.0, 4)
    one, other = kernel.files(".nbc")
    other.write_bytes(one.read_bytes())
    again = kernel()
    assert (again(1.5), again(2)) == (3.0, 4)


@posix
def test_a_full_disk_does_not_end_a_run_and_is_said(tmp_path):
    """The process may write no byte to a file, as on a full disk."""
    (tmp_path / "source.py").write_text(
        "import resource\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (0, resource.RLIM_INFINITY))\n"
        "from mpmgeo.numerics.jit import compiled, remarks\n"
        "@compiled\n"
        "def twice(x):\n"
        "    return 2 * x\n"
        "print(twice(1.5), *remarks())\n"
    )
    variables = {"NUMBA_CACHE_DIR": str(tmp_path / "cache"), "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-B", str(tmp_path / "source.py")],
        env=os.environ | variables,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("3.0 compiled kernels are not kept (")
    assert f"{tmp_path / 'cache' / 'mpmgeo'}" in done.stdout and "File too large" in done.stdout
    assert "last bits may differ" in done.stdout


def test_a_run_says_what_happens_to_its_kernels(monkeypatch):
    from assembly import two_blocks

    monkeypatch.setattr(cache, "troubles", troubles := [])
    monkeypatch.setattr("mpmgeo.numerics.jit.troubles", troubles)
    simulation = mpmgeo.Simulation(mpmgeo.load_case(two_blocks()))
    assert not remarks()
    troubles.append("/kept: No space left on device")
    simulation.step(2)
    said = [m for m in simulation.messages if "/kept: No space left on device" in m]
    assert said == remarks() and len(said) == 1
