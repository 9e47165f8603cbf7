"""From a case file to a checked, frozen Case, or to a list of everything that is wrong with it."""

from dataclasses import MISSING, replace
from pathlib import Path

from mpmgeo.case.aliases import rename
from mpmgeo.case.checks import check
from mpmgeo.case.coordinates import reading_in_mesh
from mpmgeo.case.explain import validate
from mpmgeo.case.inactive import drop_inactive
from mpmgeo.case.kinds import Kind, declared, word_of
from mpmgeo.case.report import CaseError, Report, shown
from mpmgeo.case.schema import plain
from mpmgeo.case.spec import Case
from mpmgeo.case.text import read, survey

__all__ = ["CaseError", "load_case", "resolved"]

BROKEN = object()
"""Stands for a part of a case that cannot be made, for reasons that the report has."""

SCALARS = {"number": float, "integer": int, "boolean": bool, "text": str, "free": dict}


def load_case(source: str | Path | dict, strict: bool = False) -> Case:
    """Return the case that a JSON file, or a dict of the same form, describes.

    File names inside are looked up beside the case file (for a dict: in the working directory),
    then in the working directory. Raises CaseError with all problems; `strict` makes warnings
    problems too.
    """
    report = Report()
    tree = read(source)
    folder = Path.cwd() if isinstance(source, dict) else Path(source).absolute().parent
    if not survey(tree, report):
        report.raise_errors()
    rename(tree, report)
    drop_inactive(tree, report)
    validate(tree, report)
    builder = Builder(report, folder)
    case = builder.value(Kind("object", classes=(Case,)), {}, tree, ())
    check(tree, builder.parts, report)
    report.raise_errors(strict)
    return replace(
        case,
        notes=tuple(report.notes.values()),
        warnings=tuple(report.warnings.values()),
        folder=folder,
    )


def resolved(case: Case) -> dict:
    """Return the canonical JSON of a case with its defaults filled in and files as full paths."""
    return plain(case)


class Builder:
    """Makes the objects of a validated tree; `parts` maps the path of each sound one to it."""

    def __init__(self, report, folder):
        self.report = report
        self.folder = folder
        self.parts = {}

    def value(self, kind, metadata, value, path):
        """Return the value of a kind at a path, or BROKEN."""
        if path in self.report.errors:
            return BROKEN
        if kind.name == "object":
            return self._object(kind.classes, value, path)
        if kind.name == "file":
            return self._file(value, path)
        if kind.name in SCALARS:
            return None if value is None and kind.is_nullable else SCALARS[kind.name](value)
        if kind.name == "map":
            made = {k: self.value(kind.item, metadata, v, (*path, k)) for k, v in value.items()}
            return BROKEN if BROKEN in made.values() else made
        entries = sorted(value.items()) if isinstance(value, dict) else enumerate(value)
        if metadata["choices"] is not None:
            entries = [(i, word) for i, word in entries if word in metadata["choices"]]
        made = [self.value(kind.item, metadata, entry, (*path, name)) for name, entry in entries]
        return BROKEN if any(entry is BROKEN for entry in made) else tuple(made)

    def _object(self, classes, value, path):
        cls = classes[0]
        if word_of(cls) is not None:
            words = {word_of(c): c for c in classes}
            if (*path, "type") in self.report.errors:
                return BROKEN
            cls = words[value["type"]]
        keys = list(declared(cls))
        step = {item.key: item.key for item in keys}
        if isinstance(value, list):
            step = {item.key: index for index, item in enumerate(keys)}
            value = {item.key: entry for item, entry in zip(keys, value, strict=True)}
        arguments = {}
        for key, kind, field in keys:
            here = (*path, step[key])
            if key in value:
                arguments[field.name] = self.value(kind, field.metadata, value[key], here)
            elif field.default is MISSING:
                arguments[field.name] = BROKEN
        if any(argument is BROKEN for argument in arguments.values()):
            return BROKEN
        mesh = self.parts.get(("mesh",))  # declared, so made, before all that reads positions
        made = cls(**arguments)
        made = made if mesh is None else reading_in_mesh(made, mesh.origin)
        return self._sound(made, path, step)

    def _sound(self, made, path, step):
        """Return an object without problems, BROKEN otherwise."""
        problems = {}
        for key, message in made.problems() if hasattr(made, "problems") else ():
            problems.setdefault(key, []).append(message)
        for key, messages in problems.items():
            self.report.error((*path, step[key]), "; ".join(messages))
        if problems:
            return BROKEN
        for key, message in made.remarks() if hasattr(made, "remarks") else ():
            self.report.warn((*path, step[key]), message)
        self.parts[path] = made
        return made

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
