"""The cases in inputs/ with something wrong in one of their files, whatever it may be."""

import copy
import json
import random
import shutil
from pathlib import Path

INPUTS = Path(__file__).parents[2] / "inputs"
CASES = sorted(path.parent.name for path in INPUTS.glob("*/case.json"))
DATA = (".csv", ".json", ".msh", ".stl")

FACTORS = (0, -1, 1e-300, 1e-30, 1e-6, 1e-3, 0.1, 0.5, 2, 10, 1e3, 1e6, 1e12, 1e30, 1e90, 1e200)
WORDS = (
    *("", "y", "none", "all", "box", "soil", "fixed", "gmsh", "cuboid", "kinetic", "newtonian"),
    *("mohr-coulomb", "USF", "MUSL", "linear", "case.json", "no/such.file", "\x00", "ü", "1e3"),
)
KEYS = ("type", "id", "active", "value", "file", "name", "dt", "material_id", "fields", "")
SCRAPS = (b"NaN", b"1e999", b"-", b"//", b"[[", b"}", b",", b"\n", b"\xff\xfe", b"\0", b"endfacet")


def junk(rng):
    """Return a JSON value of any kind."""
    return rng.choice(
        (
            *(None, True, False, 0, -1, 1, 0.5, 2**31, 10**400, 1e300, float("nan"), float("inf")),
            *([], {}, [1], [1, 2, 3], [[0, 0, 0]], {"a": 1}, rng.choice(WORDS), rng.random()),
        )
    )


def places(node):
    """Yield parent and key of all values of a tree."""
    for key, value in node.items() if isinstance(node, dict) else enumerate(node):
        yield node, key
        if isinstance(value, dict | list):
            yield from places(value)


def change(tree, rng):
    """Change one value or key of a tree, which has some."""
    parent, key = rng.choice(list(places(tree)))
    value, how = parent[key], rng.randrange(10)
    if how < 5 and isinstance(value, int | float) and abs(value) < 1e300:
        parent[key] = value * rng.choice(FACTORS)
    elif how < 6:
        del parent[key]
    elif how < 7:
        parent[key] = [value]
    elif how < 8 and isinstance(parent, dict):
        parent[rng.choice((*KEYS, str(key)[:-1]))] = parent.pop(key)
    elif how < 9:
        other = rng.choice(list(parent) if isinstance(parent, dict) else range(len(parent)))
        parent[key] = copy.deepcopy(parent[other])
    else:
        parent[key] = junk(rng)


def spoil(content, rng):
    """Return the bytes of a file with a few of them gone, doubled, changed or between others."""
    start = rng.randrange(len(content) + 1)
    end = min(start + rng.choice((0, 1, 2, 10, 1000, len(content))), len(content))
    middle = rng.choice((b"", content[start:end] * 2, rng.choice(SCRAPS), rng.randbytes(4)))
    return content[:start] + middle + content[end:]


class Mutants:
    """Mutants of a case in a folder of their own, which has to be the working directory; each
    begins with the sound files."""

    def __init__(self, name, folder):
        self.folder = folder / name
        shutil.copytree(INPUTS / name, self.folder)
        self.sound = {path: path.read_bytes() for path in self._files()}
        self.tree = json.loads(self.sound[self.case])
        self.tree.pop("expected", None)
        self._changed = None

    @property
    def case(self):
        """Path of the case file."""
        return self.folder / "case.json"

    def _files(self):
        return sorted(path for path in self.folder.iterdir() if path.suffix in DATA)

    def make(self, seed):
        """Make the mutant of a number; return its case, or the path of its case file."""
        rng = random.Random(seed)
        if self._changed is not None:
            self._changed.write_bytes(self.sound[self._changed])
        self._changed = None
        if rng.random() < 0.15:
            self._changed = rng.choice(list(self.sound))
            self._changed.write_bytes(spoil(self.sound[self._changed], rng))
            return self.case
        tree = copy.deepcopy(self.tree)
        for _ in range(rng.choice((1, 1, 2, 3))):
            change(tree, rng)
        return tree
