"""Compilation: decorators for kernels, a cache folder that never serves code of older sources."""

import hashlib
import sys
from pathlib import Path

import numba
from numba.extending import register_jitable

from mpmgeo.numerics.cache import complain, keep, own_folder, troubles
from mpmgeo.numerics.environment import Unusable, examine

examine()
if numba.config.DISABLE_JIT:
    raise Unusable("numba is set not to compile, but this program runs compiled")

# Without nnan and ninf: the compiler may neither delete a NaN test nor assume that a NaN is inside.
FAST = {"nsz", "arcp", "contract", "afn", "reassoc"}
OPTIONS = {"fastmath": FAST, "error_model": "numpy"}
INLINED = {**OPTIONS, "forceinline": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


NO_KERNELS = {"bodies", "case", "loads", "output", "run"}


def _cache_folder():
    """Return a folder named after the sources, since numba does not notice an edited helper."""
    package = Path(__file__).parents[1]
    digest = hashlib.sha256(numba.__version__.encode())
    for folder in sorted(f for f in package.iterdir() if f.is_dir() and f.name not in NO_KERNELS):
        for source in sorted(folder.rglob("*.py")):
            digest.update(source.read_bytes())
    return own_folder(digest.hexdigest()[:16])


numba.config.CACHE_DIR = _cache_folder()
_cached = []  # every function with a place in the cache


def keep_apart(source):
    """Move the cache of all kernels to a folder of its own for this version of the file `source`.

    For code outside the package that kernels are compiled with, a user's law: numba would not
    notice when it changes, and could not read its cache when it is gone.
    """
    if not numba.config.CACHE_DIR:
        return
    path = Path(source)
    content = path.read_bytes() if path.is_file() else source.encode()
    folder = Path(numba.config.CACHE_DIR) / hashlib.sha256(content).hexdigest()[:16]
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        numba.config.CACHE_DIR = str(folder)
    except OSError as error:
        complain(error)
        numba.config.CACHE_DIR = ""
    for function in _cached:
        keep(function)


def remarks():
    """Return what keeps two runs of a case from having the same bits, one sentence each."""
    if numba.config.CACHE_DIR and not troubles:
        return []
    reason = troubles[0] if troubles else "there is no folder for them"
    return [
        f"compiled kernels are not kept ({reason}; $NUMBA_CACHE_DIR can name another folder): "
        "every run compiles them anew, so last bits may differ from run to run"
    ]


def inlined(function):
    """Compile a helper that disappears into the kernels that call it; Python calls it as it is."""
    return register_jitable(**INLINED)(function)


def compiled(function):
    """Compile a function; while it runs, other threads of Python run, too."""
    dispatcher = numba.njit(nogil=True, **OPTIONS)(function)
    if numba.config.CACHE_DIR:
        keep(dispatcher)
        _cached.append(dispatcher)
    return dispatcher


def prepare():
    """Load numba's compiler now, and without scipy, as a program's process may.

    Numba imports scipy where it is installed, for a BLAS that no kernel here uses: a third of a
    second at the start of every run. Scripts that use the library keep numba as it is.
    """
    from numba.core.registry import cpu_target

    hidden = "scipy" not in sys.modules
    if hidden:
        sys.modules["scipy"] = None
    try:
        cpu_target.typing_context.refresh()
        cpu_target.target_context.refresh()
    finally:
        if hidden:
            del sys.modules["scipy"]
