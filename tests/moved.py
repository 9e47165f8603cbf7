"""Cases moved in space, with their files, by what their declarations call positions."""

import json
import re
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

import numpy as np
import terrains

import mpmgeo
from mpmgeo.bodies import gmsh, lattice, polygon_2d
from mpmgeo.boundaries.stl import read_stl
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.case.load import load_case, resolved
from mpmgeo.loads import point
from mpmgeo.positions import resolution

FAR = (500_000.0, 4_500_000.0, 100.0)  # m, as in UTM coordinates
WITH_POSITIONS = ("stl_mesh", "file", "mesh_file", "pore_pressure_field")


def moved(case, by, folder):
    """Return a case, moved `by` (3,) [m] in doubles, as a dict; its files are put into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    tree = resolved(in_mesh(case, tuple(-o for o in by)))
    _move_files(tree, by, folder)
    return tree


def rounded(case, by, folder):
    """Return a case, moved `by` (3,) [m] and back in doubles, as a dict."""
    there = load_case(moved(case, by, folder / "there"))
    return moved(there, tuple(-o for o in by), folder)


def simulate(tree, steps=0):
    """Return the simulation of a case given as a dict after some steps."""
    return mpmgeo.Simulation(load_case(tree)).step(steps)


@contextmanager
def known_as_badly_as(by):
    """Let tolerances be those of coordinates that are moved `by` (3,) [m]."""

    def there(zero, *positions):
        return resolution(np.add(zero, by), *positions)

    with (
        patch.object(gmsh, "resolution", there),
        patch.object(lattice, "resolution", there),
        patch.object(point, "resolution", there),
        patch.object(polygon_2d, "resolution", there),
        patch("mpmgeo.region.resolution", there),
    ):
        yield


def _move_files(tree, by, folder):
    entries = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in entries:
        if isinstance(value, dict | list):
            _move_files(value, by, folder)
        elif key in WITH_POSITIONS and (move := MOVES.get(value.rpartition(".")[2])):
            path = folder / f"{len(list(folder.iterdir()))}_{value.rpartition('/')[2]}"
            path.write_text(move(value, np.array(by)))
            tree[key] = str(path)


def _stl(path, by):
    return terrains.text_of(read_stl(path).corner + by)


def _entries(path, by):
    entries = json.loads(Path(path).read_text())
    for entry in entries:
        entry["position"] = (np.array(entry["position"]) + by).tolist()
    return json.dumps(entries)


def _msh(path, by):
    """Move the nodes of a text of version 2.2."""
    before, nodes, after = re.split(r"(?<=\$Nodes\n)|(?=\$EndNodes)", Path(path).read_text())
    count, *rows = nodes.splitlines()
    rows = [row.split() for row in rows]
    rows = [[n, *map(repr, (np.array(x, float) + by).tolist())] for n, *x in rows]
    return before + "\n".join([count, *map(" ".join, rows)]) + "\n" + after


MOVES = {"stl": _stl, "json": _entries, "msh": _msh}
