"""A folder of results is one run's while it writes, and stays where it was when the run began.

The run holds a lock on a file in the folder. The system gives the lock back when the process ends,
however it ends, so a file that a killed run left blocks nobody. Where files cannot be locked, the
process that the file names tells whether a run is still on.
"""

import errno
import json
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path
from threading import get_ident
from typing import NamedTuple

NAME = ".mpmgeo-run"
"""The file that is locked; it says who runs."""

LONGEST = 10_000  # bytes of it that are looked at
FAR = 1 << 30  # the byte that is locked on Windows, where what is locked cannot be read

_claims = {}  # those of this process, by path


class Refused(OSError):
    """The folder is another run's, or is no longer where it was."""


class Claim(NamedTuple):
    """A folder as it was found, the number of its open lock file, and the thread that has it."""

    status: os.stat_result
    number: int
    thread: int


@contextmanager
def claimed(folder: Path | str | None, about: str) -> Iterator[None]:
    """Hold a folder, which is made if missing, for a run; `about` names its case to others.

    May be nested; None is no folder. Raises Refused if another run has it, OSError if it cannot be
    made.
    """
    if folder is None:
        yield
        return
    path = Path(folder).absolute()
    if path in _claims and _claims[path].thread == get_ident():
        yield
        return
    Path(folder).mkdir(parents=True, exist_ok=True)
    claim = Claim(path.stat(), _locked(path, folder, about), get_ident())
    _claims[path] = claim
    try:
        yield
    finally:
        del _claims[path]
        _release(path / NAME, claim.number)


def demand_place(path: Path | str) -> None:
    """Raise Refused if the folder of the run that a file belongs to is not where it was."""
    for folder in Path(path).absolute().parents if _claims else ():
        claim = _claims.get(folder)
        if claim is not None and not _is_same(folder, claim.status):
            text = "this folder of the output was moved away or removed while the run was on"
            raise Refused(errno.ENOENT, text, str(folder))


def _is_same(path, status):
    try:
        return os.path.samestat(path.stat(), status)
    except OSError:
        return False


def _locked(path, shown, about):
    """Return the number of the open lock file of a folder; Refused if another run has locked it."""
    file = path / NAME
    flags = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)
    while True:
        number = os.open(file, flags, 0o644)
        try:
            if not _lock(number, path):
                raise Refused(errno.EAGAIN, _holder(number), str(shown))
            if _is_same(file, os.fstat(number)):  # else its holder has just removed it
                _write(number, about)
                return number
        except BaseException:
            os.close(number)
            raise
        os.close(number)


def _lock(number, path):
    """Lock an open file; return whether nobody else has."""
    try:
        if os.name == "nt":
            import msvcrt

            os.lseek(number, FAR, os.SEEK_SET)
            msvcrt.locking(number, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        busy = isinstance(error, BlockingIOError | PermissionError)
        return False if busy else not _is_on(_read(number), path)
    return True


def _is_on(run, path):
    """Tell whether the process that a lock file names runs, as far as this machine knows."""
    process = run.get("process")
    if run.get("host") != socket.gethostname() or type(process) is not int or process <= 0:
        return False
    if process == os.getpid():
        return path in _claims
    try:
        os.kill(process, 0)
    except PermissionError:
        return True
    except (OSError, OverflowError):
        return False
    return True


def _read(number):
    try:
        os.lseek(number, 0, os.SEEK_SET)
        run = json.loads(os.read(number, LONGEST))
    except (OSError, ValueError, RecursionError):
        return {}
    return run if isinstance(run, dict) else {}


def _holder(number):
    run = _read(number)
    words = [str(run.get(key, "?"))[:200] for key in ("case", "process", "host", "start")]
    case, process, host, start = words
    return (
        f"another run writes its results here: {case}, process {process} on {host} since {start}; "
        "--output names another folder"
    )


def _write(number, about):
    run = {
        "case": about,
        "process": os.getpid(),
        "host": socket.gethostname(),
        "start": datetime.now().isoformat(" ", "seconds"),
    }
    with suppress(OSError):  # a full disk: the lock is there all the same
        os.ftruncate(number, 0)
        os.lseek(number, 0, os.SEEK_SET)
        os.write(number, json.dumps(run).encode())


def _release(file, number):
    """Remove a lock file while it is locked, so that it is no other run's, and unlock it."""
    with suppress(OSError):
        if _is_same(file, os.fstat(number)) and os.name != "nt":
            file.unlink()
    os.close(number)
    if os.name == "nt":  # where open files cannot be removed
        with suppress(OSError):
            file.unlink()
