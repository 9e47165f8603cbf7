"""Files that appear complete or not at all, and files that grow."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from mpmgeo.output.claim import demand_place


@contextmanager
def whole_file(path: Path | str) -> Iterator[BinaryIO]:
    """Open a file for writing bytes; it takes its name, and the place of an older one, at the end.

    Missing folders are made, unless that of the run has been moved away. If writing fails nothing
    is left behind and an older file stays as it was; the OSError, which names the file, goes on to
    the caller. Links that lie in the way are replaced, not followed.
    """
    path = Path(path)
    beside = path.with_name(path.name + ".part")
    demand_place(path)
    with _named(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        beside.unlink(missing_ok=True)
        try:
            with beside.open("xb") as file:
                yield file
            beside.replace(path)
        except BaseException:
            with suppress(OSError):
                beside.unlink()
            raise


def append(path: Path | str, text: str) -> None:
    """Put a text at the end of a file, which is no link; raises OSError that names the file."""
    demand_place(path)
    flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND
    flags |= getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)  # each on some systems only
    with _named(path), os.fdopen(os.open(path, flags, 0o666), "ab") as file:
        file.write(text.encode())


@contextmanager
def _named(path):
    """Let errors of the system that name no file, as that of a full disk, name this one."""
    try:
        yield
    except OSError as error:
        if error.filename is None:
            error.filename = str(path)
        raise
