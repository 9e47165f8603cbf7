"""The way of a case file: read it, find what it means, or tell all that is wrong with it."""

import os
from dataclasses import replace
from pathlib import Path

from mpmgeo.case.canonical import plain
from mpmgeo.case.meaning.checks import check
from mpmgeo.case.meaning.draft import draft
from mpmgeo.case.reading.aliases import rename
from mpmgeo.case.reading.explain import validate
from mpmgeo.case.reading.inactive import drop_inactive
from mpmgeo.case.reading.method import fill_method
from mpmgeo.case.reading.named import number_names
from mpmgeo.case.reading.text import read, survey, survey_moved
from mpmgeo.case.report import CaseError, CaseWarning, Report, show
from mpmgeo.case.spec import Case

__all__ = ["CaseError", "CaseWarning", "load_case", "resolved"]


def load_case(source: str | Path | dict, strict: bool = False) -> Case:
    """Return the case that a JSON file, or a dict of the same form, describes.

    File names inside are looked up beside the case file (for a dict: in the working directory),
    then in the working directory. Warnings are of the category CaseWarning. Raises CaseError with
    all problems, `strict` makes warnings problems too; TypeError for a source of another kind.
    """
    if not isinstance(source, str | os.PathLike | dict):
        kind = type(source).__name__
        raise TypeError(f"a case is the path of its file, or a dict of the same form, no {kind}")
    report = Report()
    folder = Path.cwd() if isinstance(source, dict) else Path(source).absolute().parent
    made = draft(_tree(source, report), folder, report)
    check(made, report)
    report.raise_errors(strict)
    show(report.warnings.values())
    return replace(
        made.whole.made,
        notes=tuple(report.notes.values()),
        warnings=tuple(report.warnings.values()),
        folder=folder,
    )


def _tree(source, report):
    """Return the tree of a case in canonical keys, looked at by the schema."""
    tree = read(source)
    if not survey(tree, report):
        report.raise_errors()
    rename(tree, report)
    fill_method(tree)
    drop_inactive(tree, report)
    survey_moved(tree, report)
    number_names(tree, report)
    validate(tree, report)
    return tree


def resolved(case: Case) -> dict:
    """Return the canonical JSON of a case with its defaults filled in and files as full paths."""
    return plain(case)
