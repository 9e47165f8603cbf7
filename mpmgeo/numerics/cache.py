"""Where compiled kernels are kept between runs: a folder of one's own, files that are whole.

Numba executes what it finds in its cache, so nobody else may have put it there: the folder, and the
one that holds it, belong to the user, and no other can write to them. A file begins with a
checksum; one that is damaged, cut or of another kernel is as if it were not there, and is made
anew.
"""

import errno
import hashlib
import os
import pickle
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

import numba
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    NullCache,
    UserProvidedCacheLocator,
)

OTHERS = stat.S_IWGRP | stat.S_IWOTH

troubles = []
"""Why kernels are not kept, one reason each; empty as long as they are."""


def own_folder(name: str) -> str:
    """Return the path of a folder `name` for compiled kernels, made if missing, "" without one.

    It is in $NUMBA_CACHE_DIR, else $XDG_CACHE_HOME, else ~/.cache; if that cannot be used, in the
    folder for temporary files, with the user's number in its name.
    """
    refused = []
    for find in (_chosen, _temporary):
        try:
            place, inner = find()
            return str(_made(place, (inner, name)))
        except (OSError, RuntimeError) as error:  # RuntimeError: the user has no home
            refused.append(_reason(error))
    troubles.append("; ".join(refused))
    return ""


def complain(error: Exception) -> None:
    """Note why kernels are not kept."""
    troubles.append(_reason(error))


def _reason(error):
    reason = getattr(error, "strerror", None) or str(error)
    place = getattr(error, "filename", None)
    return f"{place}: {reason}" if place else reason


def _chosen():
    home = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    return Path(home).absolute() if home else Path.home() / ".cache", "mpmgeo"


def _temporary():
    user = f"-{os.geteuid()}" if hasattr(os, "geteuid") else ""
    return Path(tempfile.gettempdir()), f"mpmgeo{user}"


def _made(place, names):
    """Return a folder in folders in a place, made if missing; OSError if it is not the user's."""
    place.mkdir(mode=0o700, parents=True, exist_ok=True)
    _demand_own(place, place.stat(), is_place=True)
    folder = place
    for name in names:
        folder = folder / name
        with suppress(FileExistsError):
            folder.mkdir(mode=0o700)
        _demand_own(folder, folder.lstat())
    if not os.access(folder, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(folder))
    return folder


def _demand_own(path, status, is_place=False):
    """Raise OSError unless a folder is the user's and only the user's to write to.

    The place may be the system's, and may be everybody's if nobody can replace what others have
    there.
    """
    if not hasattr(os, "geteuid"):  # Windows, where such folders are the user's
        return
    if not stat.S_ISDIR(status.st_mode):
        raise NotADirectoryError(errno.ENOTDIR, "is no folder, or a link to one", str(path))
    if status.st_uid not in ({os.geteuid(), 0} if is_place else {os.geteuid()}):
        raise PermissionError(errno.EPERM, "belongs to another user", str(path))
    if status.st_mode & OTHERS and not (is_place and status.st_mode & stat.S_ISVTX):
        raise PermissionError(errno.EPERM, "can be written by other users", str(path))


def keep(dispatcher) -> None:
    """Let the kernels of a dispatcher be kept, and found again, in `numba.config.CACHE_DIR`."""
    try:
        dispatcher._cache = KernelCache(dispatcher.py_func)
    except (OSError, RuntimeError) as error:  # RuntimeError: numba can write to no folder
        dispatcher._cache = NullCache()
        complain(error)


class _Kernels(CompileResultCacheImpl):
    """Knows no folder beside the chosen one: in others may lie code of older sources."""

    _locator_classes = (UserProvidedCacheLocator,)


class KernelCache(FunctionCache):
    """Numba's cache of a function; a run goes on whatever befalls its files."""

    _impl_class = _Kernels

    def __init__(self, function):
        super().__init__(function)
        stamp = self._impl.locator.get_source_stamp()
        self._cache_file = SealedFiles(self._cache_path, self._impl.filename_base, stamp)

    def save_overload(self, sig, data):
        """Keep a kernel, or note that it cannot be written."""
        try:
            super().save_overload(sig, data)
        except OSError as error:
            error.filename = error.filename or self._cache_path
            complain(error)


class SealedFiles(IndexDataCacheFile):
    """Index and kernels of a function in files that begin with a checksum of the rest.

    A kernel's file holds its key too, for two processes may write one at the same time.
    """

    def load(self, key):
        """Return the kernel of a key, None if there is none that is whole."""
        name = self._load_index().get(key)
        found = _unsealed(self._data_path(name)) if name is not None else None
        return found[1] if found is not None and found[0] == key else None

    def save(self, key, data):
        """Write a kernel."""
        super().save(key, (key, data))

    def _load_index(self):
        head, overloads = _unsealed(self._index_path) or (None, {})
        return overloads if head == self._head else {}

    def _save_index(self, overloads):
        self._seal(self._index_path, (self._head, overloads))

    def _save_data(self, name, data):
        self._seal(self._data_path(name), data)

    @property
    def _head(self):
        return numba.__version__, self._source_stamp

    def _seal(self, path, value):
        content = self._dump(value)
        with self._open_for_write(path) as file:
            file.write(_seal_of(content) + content)


def _seal_of(content):
    return hashlib.sha256(content).digest()


def _unsealed(path):
    """Return the value in a sealed file, None if there is none that can be read and is whole."""
    try:
        with Path(path).open("rb") as file:
            seal, content = file.read(hashlib.sha256().digest_size), file.read()
        return pickle.loads(content) if seal == _seal_of(content) else None
    except Exception:  # no file, or one that names a law of a user's that is gone: anything
        return None
