"""Settings of numba in the environment that no run can go with, found before numba meets them."""

import os

MOST_THREADS = 4096
LAYERS = ("default", "tbb", "omp", "workqueue", "safe", "threadsafe", "forksafe")


class Unusable(RuntimeError):
    """The environment keeps kernels from being compiled or run; the message says what to change."""


def examine(environment=os.environ) -> None:
    """Raise Unusable for settings with which kernels cannot run; blank ones count as not set."""
    given = {}
    for name in ("NUMBA_DISABLE_JIT", "NUMBA_NUM_THREADS", "NUMBA_THREADING_LAYER"):
        value = environment.get(name, "").strip()
        if value:
            given[name] = value
        else:
            environment.pop(name, None)
    if given.get("NUMBA_DISABLE_JIT", "0") != "0":
        _refuse(given, "NUMBA_DISABLE_JIT", "this program runs compiled, unset it")
    threads = given.get("NUMBA_NUM_THREADS", "1")
    if not (threads.isdecimal() and 1 <= int(threads[:9]) <= MOST_THREADS):
        _refuse(given, "NUMBA_NUM_THREADS", f"needs a whole number from 1 to {MOST_THREADS}")
    if given.get("NUMBA_THREADING_LAYER", LAYERS[0]) not in LAYERS:
        _refuse(given, "NUMBA_THREADING_LAYER", f"needs one of {', '.join(LAYERS)}")


def _refuse(given, name, wanted):
    raise Unusable(f"environment variable {name}: {given[name]!r} is not accepted, {wanted}")
