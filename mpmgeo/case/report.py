"""What there is to say about a case file: errors, warnings and notes, each with its JSON path."""

import re
import sys
import warnings
from difflib import get_close_matches

from mpmgeo.values import LONGEST, shown


class CaseError(ValueError):
    """A case that cannot be simulated: all `problems`, and `warnings` and `notes` beside them."""

    def __init__(self, problems, warnings=(), notes=()):
        super().__init__("\n".join(problems))
        self.problems = list(problems)
        self.warnings = tuple(warnings)
        self.notes = tuple(notes)


class CaseWarning(UserWarning):
    """What is possible in a case, but hardly meant; `warnings.simplefilter` silences it."""


def show(texts):
    """Show texts as warnings about the line of the script that called this package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and _is_ours(frame):
        frame, level = frame.f_back, level + 1
    for text in texts:
        warnings.warn(text, CaseWarning, stacklevel=level)


def _is_ours(frame):
    return frame.f_globals.get("__name__", "").partition(".")[0] == __name__.partition(".")[0]


class Report:
    """Collects errors, warnings and notes; paths are tuples of canonical keys and list positions.

    `written` maps a path to the key that the user wrote in place of its last, canonical one.
    """

    def __init__(self):
        self.errors, self.warnings, self.notes = {}, {}, {}
        self.written = {}

    def error(self, path, message):
        """Add an error; the first one of a path stands."""
        self.errors.setdefault(path, self.line(path, message))

    def warn(self, path, message):
        """Add a warning, once."""
        self.warnings.setdefault((path, message), self.line(path, message))

    def note(self, path, message):
        """Add a note, once."""
        self.notes.setdefault((path, message), self.line(path, message))

    def line(self, path, message):
        """Return a message with its path before it."""
        return f"{self.where(path)}: {message}" if path else message

    def where(self, path):
        """Return the path as the user wrote it, like `body.soil.point_p2[1]`."""
        text = ""
        for depth, key in enumerate(path, start=1):
            key = self.written.get(path[:depth], key)
            text += f"[{key}]" if isinstance(key, int) else f".{shown_key(key)}"
        return text.removeprefix(".")

    def raise_errors(self, strict=False):
        """Raise CaseError if there are errors; `strict` counts warnings as errors."""
        problems = list(dict.fromkeys(self.errors.values()))
        warnings = list(self.warnings.values())
        if strict:
            problems, warnings = problems + warnings, []
        if problems:
            raise CaseError(problems, warnings, self.notes.values())


def shown_key(key) -> str:
    """Return a key as it stands in a path: bare if plain, quoted otherwise."""
    plain = re.fullmatch(r"[\w$. -]+", key) and len(key) <= LONGEST
    return key if plain and key.strip() == key else shown(key)


def nearest(word, known) -> str | None:
    """Return the known word most like a given one, whatever case and separators, if any is."""
    if not isinstance(word, str) or len(word) > LONGEST:
        return None
    plain = {_plain(candidate): candidate for candidate in known if isinstance(candidate, str)}
    close = get_close_matches(_plain(word), plain, n=1, cutoff=0.6)
    return plain[close[0]] if close else None


def _plain(word):
    return re.sub(r"[\W_]", "", word).casefold() or word
