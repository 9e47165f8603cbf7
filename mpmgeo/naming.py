"""Names and numbers in cases and their results."""

import re
from collections.abc import Iterator

PLANES = ("X0", "Y0", "Z0", "Xn", "Yn", "Zn")
"""The six planes that bound the mesh."""

ENERGIES = ("kinetic", "strain", "external", "plastic", "damping", "balance")
"""The figures of a balance of energy."""

GHOSTS = 2
"""Layers of nodes around the mesh that numbers of nodes count, as in MPM-Geomechanics."""

NAME = re.compile(r"[\w+-][\w .+-]{0,59}")


def name_problems(name: str) -> Iterator[tuple[str, str]]:
    """Yield ("name", message) if a name, empty for none, cannot be that of a file."""
    if name and (not NAME.fullmatch(name) or name.endswith((" ", "."))):
        shown = name.encode("ascii", "backslashreplace").decode()[:60]
        accepted = "up to 60 letters, digits, blanks and any of _ . + -, as in the name of a file"
        yield "name", f'"{shown}" is not accepted; accepted: {accepted}'
