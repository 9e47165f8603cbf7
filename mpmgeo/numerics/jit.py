"""Compilation: decorators for kernels, a cache folder that never serves code of older sources."""

import hashlib
import os
import tempfile
import types
from pathlib import Path

import numba

# Without nnan and ninf: the compiler may neither delete a NaN test nor assume that a NaN is inside.
FAST = {"nsz", "arcp", "contract", "afn", "reassoc"}
OPTIONS = {"fastmath": FAST, "error_model": "numpy"}


NO_KERNELS = {"bodies", "case", "loads", "output", "run", "verify"}


def _cache_folder():
    """Return a folder named after the sources, since numba does not notice an edited helper."""
    package = Path(__file__).parents[1]
    digest = hashlib.sha256(numba.__version__.encode())
    for folder in sorted(f for f in package.iterdir() if f.is_dir() and f.name not in NO_KERNELS):
        for source in sorted(folder.glob("*.py")):
            digest.update(source.read_bytes())
    home = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    places = [Path(home) if home else Path.home() / ".cache", Path(tempfile.gettempdir())]
    for place in places:
        folder = place / "mpmgeo" / digest.hexdigest()[:16]
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return str(folder)
    return ""


numba.config.CACHE_DIR = _cache_folder()


def inlined(function):
    """Compile a helper that disappears into the kernels that call it."""
    return numba.njit(forceinline=True, **OPTIONS)(function)


def compiled(function):
    """Compile a function for one thread."""
    return numba.njit(cache=bool(numba.config.CACHE_DIR), **OPTIONS)(function)


def blockwise(function):
    """Compile a loop over blocks for threads, and as `.serial` for scenes too small for them.

    Numba's cache tells functions apart by name and not by options, so the serial one gets its own.
    """
    cache = bool(numba.config.CACHE_DIR)
    twin = types.FunctionType(
        function.__code__, function.__globals__, function.__name__ + "_serial"
    )
    twin.__qualname__ = twin.__name__
    twin.__module__ = function.__module__
    threaded = numba.njit(parallel=True, cache=cache, **OPTIONS)(function)
    threaded.serial = numba.njit(cache=cache, **OPTIONS)(twin)
    return threaded
