"""From a validated tree to a draft of its Case: every part that can be made, and where it stands.

Of a part that cannot be made the draft keeps what is sound, so that all mistakes are found at once.
"""

from collections import defaultdict
from dataclasses import MISSING
from pathlib import Path
from typing import NamedTuple

from mpmgeo.case.coordinates import reading_in_mesh
from mpmgeo.case.kinds import Kind, declared, listed, word_of
from mpmgeo.case.spec import Case
from mpmgeo.values import is_number, shown

BROKEN = object()
"""Stands for what cannot be made, for reasons that the report has."""

SCALARS = {"number": float, "integer": int, "boolean": bool, "text": str, "free": dict}

SOUND = {
    "integer": is_number,
    "boolean": lambda value: isinstance(value, bool),
    "text": lambda value: isinstance(value, str),
}
"""Kind → test of a value that the schema has not looked at."""


class Part(NamedTuple):
    """An object of a case and its place in the file.

    path: canonical keys and list positions that lead to it; steps: its keys, each with the last
    step of its path; given: the keys that the file has; values: what is known of its fields,
    defaults too; made: the object, None if it cannot be made.
    """

    path: tuple
    steps: dict
    given: frozenset
    values: dict
    made: object

    def at(self, *keys) -> tuple:
        """Return the path to which some of its keys lead, one inside the other."""
        first = tuple(self.steps.get(key, key) for key in keys[:1])
        return (*self.path, *first, *keys[1:])


class Draft:
    """The parts of a case, whole and broken ones."""

    def __init__(self):
        self._parts = {}
        self._entries = defaultdict(list)

    def add(self, part):
        """Add a part; entries of a list are added in the order of the case."""
        self._parts[part.path] = part
        self._entries[part.path[:-1]].append(part)

    @property
    def whole(self) -> Part:
        """Return the part that is the whole case."""
        return self._parts[()]

    def at(self, *path) -> Part | None:
        """Return the part at a path, None without."""
        return self._parts.get(path)

    def of(self, *path) -> list[Part]:
        """Return the part at a path, or the entries of a list of parts there, in order."""
        return [self._parts[path]] if path in self._parts else self._entries.get(path, [])

    def made(self, *path) -> list:
        """Return the objects at a path that could be made."""
        return [part.made for part in self.of(*path) if part.made is not None]


def draft(tree, folder, report) -> Draft:
    """Return the draft of a tree; reports what objects say of themselves, and missing files."""
    maker = _Maker(folder, report)
    maker.value(Kind("object", classes=(Case,)), {}, tree, ())
    return maker.draft


class _Maker:
    def __init__(self, folder, report):
        self.report = report
        self.folder = folder
        self.draft = Draft()

    def value(self, kind, metadata, value, path):
        """Return the value of a kind at a path, or BROKEN."""
        is_wrong = path in self.report.errors
        if kind.name == "object" and metadata.get("several") and isinstance(value, list):
            kind = Kind("list", kind)
        if kind.name == "fixed" and kind.classes and isinstance(value, dict):
            kind = Kind("object", classes=kind.classes)
        if kind.name == "object" and (isinstance(value, dict) or not is_wrong):
            return self._object(kind.classes, value, path)
        if is_wrong:
            return BROKEN
        if kind.name == "file":
            return self._file(value, path)
        if kind.name in SCALARS:
            is_itself = value in metadata["words"] or (value is None and kind.is_nullable)
            return value if is_itself else SCALARS[kind.name](value)
        if kind.name == "map":
            made = {k: self.value(kind.item, metadata, v, (*path, k)) for k, v in value.items()}
            return BROKEN if BROKEN in made.values() else made
        entries = sorted(value.items()) if isinstance(value, dict) else list(enumerate(value))
        if metadata["choices"] is not None:
            entries = [(index, word) for index, word in entries if word in metadata["choices"]]
            self.report.written |= {(*path, n): index for n, (index, _) in enumerate(entries)}
        made = [self.value(kind.item, metadata, entry, (*path, name)) for name, entry in entries]
        return BROKEN if any(entry is BROKEN for entry in made) else tuple(made)

    def _object(self, classes, value, path):
        """Add the part at a path to the draft; return its object or BROKEN."""
        cls = self._class(classes, value, path)
        if cls is None:
            known = {key: key for key in value}
            part = Part(path, known, frozenset(value), _loose(classes, value), None)
        else:
            part = self._part(cls, value, path)
        self.draft.add(part)
        return BROKEN if part.made is None else part.made

    def _class(self, classes, value, path):
        """Return the class that `"type"` chooses, None if it chooses none."""
        if word_of(classes[0]) is None:
            return classes[0]
        is_wrong = (*path, "type") in self.report.errors
        return None if is_wrong else {word_of(c): c for c in classes}[value["type"]]

    def _part(self, cls, value, path):
        keys = declared(cls)
        steps = {item.key: item.key for item in keys}
        if isinstance(value, list):
            steps |= listed(cls)
            value = dict(zip(listed(cls), value, strict=True))
        values = {}
        for key, kind, field in keys:
            if key in value:
                here = (*path, steps[key])
                values[field.name] = self.value(kind, field.metadata, value[key], here)
            else:
                values[field.name] = BROKEN if field.default is MISSING else field.default
        sound = {name: entry for name, entry in values.items() if entry is not BROKEN}
        part = Part(path, steps, frozenset(value), sound, None)
        is_broken = len(sound) < len(values) or path in self.report.errors
        return part if is_broken else self._tried(cls, part)

    def _tried(self, cls, part):
        """Return a part with its object, unless that has problems."""
        made, problems = self._reading(cls(**part.values)), {}
        for key, message in made.problems() if hasattr(made, "problems") else ():
            problems.setdefault(key, []).append(message)
        for key, messages in problems.items():
            self.report.error(part.at(key), "; ".join(messages))
        if problems:
            return part
        for key, message in made.remarks() if hasattr(made, "remarks") else ():
            self.report.warn(part.at(key), message)
        return part._replace(made=made)

    def _reading(self, made):
        """Return an object such that it reads positions in files as those of the mesh."""
        mesh = self.draft.at("mesh")  # declared, so added, before all that reads positions
        if mesh is None or mesh.made is None:
            return made
        return reading_in_mesh(made, mesh.made.origin)

    def _file(self, name, path):
        folders = dict.fromkeys((self.folder, Path.cwd()))
        for folder in folders:
            try:
                if (folder / name).is_file():
                    return folder / name
            except (OSError, ValueError):
                break
        where = " or ".join(str(folder) for folder in folders)
        self.report.error(path, f"there is no file {shown(name)} in {where}")
        return BROKEN


def _loose(classes, value):
    """Return what an object of unknown class gives for scalars of any of the classes."""
    found = {}
    for cls in classes:
        for key, kind, field in declared(cls):
            if key in value and kind.name in SOUND and SOUND[kind.name](value[key]):
                found.setdefault(field.name, value[key])
    return found
