"""What all tests share; the modules beside this file can be imported by every test."""

import os
import signal

# Before numba is imported: threads are tested on machines with one processor too.
os.environ.setdefault("NUMBA_NUM_THREADS", str(max(2, os.cpu_count() or 1)))

import pytest
from hypothesis import settings

# A shell may have told the tests to ignore signals; programs that they start would inherit that.
for name, handler in (("SIGINT", signal.default_int_handler), ("SIGHUP", signal.SIG_DFL)):
    number = getattr(signal, name, None)
    if number is not None and signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, handler)

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
