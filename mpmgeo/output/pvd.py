"""Collections of files over time (.pvd), as ParaView opens them."""

import os
import re
from html import escape
from pathlib import Path
from xml.etree import ElementTree

from mpmgeo.output.earlier import earlier
from mpmgeo.output.whole_file import whole_file


class Collection:
    """The files of one run with their times, written as a .pvd."""

    def __init__(self, path: Path | str):
        self.path = Path(path)
        self.entries: list[tuple[float, str]] = []

    def add(self, time: float, file: Path | str) -> None:
        """Append a file that shows the state at `time` [s]."""
        name = os.path.relpath(file, self.path.parent).replace(os.sep, "/")
        self.entries.append((float(time), name))

    def take_up(self, time: float, is_due: bool) -> None:
        """Begin with the files that an existing .pvd lists up to `time` [s].

        `is_due`: whether there is a file for that time.
        """
        self.entries = earlier(listed(self.path), time, is_due)

    def write(self) -> None:
        """Write the files added so far; may be repeated as the run goes on."""
        lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">']
        lines.append("<Collection>")
        lines += [
            f'<DataSet timestep="{time!r}" group="" part="0" file="{escape(name)}"/>'
            for time, name in self.entries
        ]
        lines += ["</Collection>", "</VTKFile>", ""]
        with whole_file(self.path) as file:
            file.write("\n".join(lines).encode())


def listed(path: Path | str) -> list[tuple[float, str]]:
    """Return time [s] and file name of all entries of a .pvd, none if it cannot be read."""
    try:
        entries = ElementTree.parse(path).iter("DataSet")
        return [(float(e.get("timestep", "nan")), e.get("file", "")) for e in entries]
    except (OSError, ElementTree.ParseError, ValueError):
        return []


def previous_files(path: Path | str) -> list[Path]:
    """Return the .vtu files that an existing .pvd lists, if they exist inside its folder.

    A missing or unreadable collection lists nothing.
    """
    path = Path(path)
    folder = path.parent.resolve()
    files = [(folder / name).resolve() for _, name in listed(path)]
    return [
        path.parent / file.relative_to(folder)
        for file in dict.fromkeys(files)
        if file.is_relative_to(folder) and file.suffix == ".vtu" and file.is_file()
    ]


def remove_previous(path: Path | str, pattern: str = "*.vtu") -> tuple[list[Path], list[Path]]:
    """Delete the .pvd of an earlier run and the files it lists; return (removed, left).

    `left` are the files matching `pattern` in its folder that it does not list: whoever made them,
    they are not deleted. Raises OSError if a file cannot be deleted.
    """
    path = Path(path)
    removed = previous_files(path)
    for file in removed:
        file.unlink()
    path.unlink(missing_ok=True)
    return removed, sorted(path.parent.glob(pattern), key=_by_number)


def _by_number(file):
    digits = re.findall(r"\d+", file.stem)
    return int(digits[-1]) if digits else -1, file.name
