"""What all tests share; the modules beside this file can be imported by every test."""

import os

# Before numba is imported: threads are tested on machines with one processor too.
os.environ.setdefault("NUMBA_NUM_THREADS", str(max(2, os.cpu_count() or 1)))

import pytest
from hypothesis import settings

# Kernels may be compiled inside an example, so examples have no deadline.
settings.register_profile("mpmgeo", deadline=None, print_blob=True)
settings.load_profile("mpmgeo")


@pytest.fixture
def threads():
    """A function that sets numba's number of threads, which is put back after the test."""
    import numba

    before = numba.get_num_threads()
    yield numba.set_num_threads
    numba.set_num_threads(before)


@pytest.fixture(scope="module")
def uncached():
    """Keep kernels out of the disk cache that are made for classes which only the tests know."""
    from numba.core.caching import NullCache

    from mpmgeo.mpm import grid_update, transfer

    kernels = [*vars(transfer).values(), *vars(grid_update).values()]
    twins = [twin for k in kernels if hasattr(k, "serial") for twin in (k, k.serial)]
    before = [twin._cache for twin in twins]
    for twin in twins:
        twin._cache = NullCache()
    yield
    for twin, cache in zip(twins, before, strict=True):
        twin._cache = cache
