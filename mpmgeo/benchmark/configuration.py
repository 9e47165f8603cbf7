"""The configuration of the kernel benchmark, with the keys of MPM-Geomechanics."""

import json
from dataclasses import dataclass, replace
from difflib import get_close_matches
from itertools import product
from pathlib import Path
from typing import NamedTuple

from mpmgeo.parameters import Counts, Vector

FILE = "benchmark-configuration.json"
"""Name of the file that is read from the working directory if none is named."""

MATRIX_CELLS = (100, 100, 100)
"""Number of cells in a matrix of runs, whose configuration says none."""

MOST = 2**31 - 1


@dataclass(frozen=True)
class Configuration:
    """What to time: numbers of particles and threads, the mesh [m] and what the kernels work on."""

    particles: int = 150_000
    threads: int = 10
    cell: Vector = (1.0, 1.0, 1.0)
    cells: Counts = (1, 1, 1)
    seed: int = 42
    interpolation: bool = True
    update: bool = True
    density: float = 2000.0
    trace_strain: float = 0.05
    young: float = 1000.0
    poisson: float = 0.3
    strain: float = 0.01
    velocity: Vector = (1.0, 2.0, 3.0)
    force: Vector = (1.0, 2.0, 3.0)
    strain_step: float = 0.01
    nodal_velocity: Vector = (1.0, 2.0, 3.0)
    spin_step: float = 0.01
    spin: Vector = (1.0, 2.0, 3.0)


KEYS = {
    ("global", "numParticles"): "particles",
    ("global", "numThreads"): "threads",
    ("global", "cellDimension"): "cell",
    ("global", "numCells"): "cells",
    ("global", "randomSeed"): "seed",
    ("global", "interpolationTest"): "interpolation",
    ("global", "updateTest"): "update",
    ("update", "UpdatePerformance_ParticleDensity_nParticles", "initialDensity"): "density",
    ("update", "UpdatePerformance_ParticleDensity_nParticles", "traceStrain"): "trace_strain",
    ("update", "ParticleStress_nParticles", "E"): "young",
    ("update", "ParticleStress_nParticles", "nu"): "poisson",
    ("update", "ParticleStress_nParticles", "epsilon0"): "strain",
    ("interpolation", "NodalMomentum_nParticles", "particleVelocity"): "velocity",
    ("interpolation", "NodalExternalForce_nParticles", "appliedForce"): "force",
    ("interpolation", "ParticleStrainIncrement_nParticles", "dt01"): "strain_step",
    ("interpolation", "ParticleStrainIncrement_nParticles", "nodalVelocity"): "nodal_velocity",
    ("interpolation", "ParticleVorticityIncrement_nParticles", "dt02"): "spin_step",
    ("interpolation", "ParticleVorticityIncrement_nParticles", "omega"): "spin",
}
"""Path of a key in the file → what it sets."""

UNREAD = {
    ("global", "particleSize"): "particles have the size 1",
    ("global", "particleMass"): "particles have the mass 1",
    ("executables",): "the kernels of this program are timed",
}
"""Keys without effect, and why."""

EMPTY = {
    ("interpolation", "NodalMass_nParticles"),
    ("interpolation", "NodalInternalForce_nParticles"),
}
"""Kernels without keys of their own, which the file names all the same."""

MATRIX = {("parameters", "particles"), ("parameters", "threads")}
"""Keys of a matrix of runs."""

POSITIVE = {"particles", "threads", "cell", "cells", "density", "young", "strain_step", "spin_step"}
WHOLE = {"particles", "threads", "cells", "seed"}


class Reading(NamedTuple):
    """Configurations, remarks on keys without effect or meaning, and on those that are absent."""

    configurations: list[Configuration]
    remarks: list[str]
    absences: list[str]


def read_configurations(path: Path | str | None) -> Reading:
    """Return the configurations of a file, and remarks on its keys.

    A file with `parameters` asks for every pair of its `particles` and `threads`; of `None` the
    file of the usual name counts if it exists, else the defaults. Raises ValueError with path and
    value of what cannot be used, OSError for a file that cannot be read.
    """
    if path is None:
        path = FILE if Path(FILE).is_file() else None
    tree = {} if path is None else _tree(path)
    remarks = [
        f"{'.'.join(keys)}: no effect, {why}" for keys, why in UNREAD.items() if _get(tree, keys)[0]
    ]
    remarks += _unknown(tree, ())
    values, absences = {}, []
    for keys, name in KEYS.items():
        is_there, value = _get(tree, keys)
        if is_there and _is_short(value, name):
            is_there = False
        if is_there:
            values[name] = _value(name, value, ".".join(keys))
        else:
            default = getattr(Configuration, name)
            absences.append(f"{'.'.join(keys)}: absent, {default} is used")
    if "parameters" not in tree:
        return Reading([Configuration(**values)], remarks, absences)
    base = Configuration(**{"cells": MATRIX_CELLS, **values})
    pairs = product(*(_series(tree["parameters"], name) for name in ("particles", "threads")))
    matrix = [replace(base, particles=n, threads=t) for n, t in pairs]
    return Reading(matrix, remarks, absences)


def _tree(path):
    try:
        tree = json.loads(Path(path).read_bytes())
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise ValueError(f"{path}: not JSON ({str(error)[:80]})") from None
    if not isinstance(tree, dict):
        raise ValueError(f"{path}: a configuration is a JSON object {{ … }}")
    return tree


def _unknown(tree, above):
    """Return a remark for each key that nobody knows, with the nearest one that is known."""
    known = {".".join(keys) for keys in (*KEYS, *UNREAD, *MATRIX)}
    remarks = []
    for key, value in tree.items():
        keys = (*above, key)
        path = ".".join(keys)
        if path in known or key == "comment":
            continue
        if isinstance(value, dict) and any(name.startswith(f"{path}.") for name in known):
            remarks += _unknown(value, keys)
        elif keys not in EMPTY:
            near = get_close_matches(path, known, n=1)
            hint = f'; did you mean "{near[0]}"?' if near else ""
            remarks.append(f"{path}: no such key, it has no effect{hint}")
    return remarks


def _get(tree, keys):
    """Return whether there is a value at a path, and the value."""
    for key in keys:
        if not isinstance(tree, dict) or key not in tree:
            return False, None
        tree = tree[key]
    return True, tree


def _is_short(value, name):
    """Tell whether a list has not three entries, for which MPM-Geomechanics takes the default."""
    wanted = isinstance(getattr(Configuration, name), tuple)
    return wanted and isinstance(value, list) and len(value) != 3


def _value(name, value, path):
    default = getattr(Configuration, name)
    if isinstance(default, tuple):
        if not isinstance(value, list):
            raise _refusal(path, value, "three numbers")
        return tuple(_number(name, entry, path) for entry in value)
    if isinstance(default, bool):
        if not isinstance(value, bool):
            raise _refusal(path, value, "true or false")
        return value
    return _number(name, value, path)


def _number(name, value, path):
    kind = "a whole number" if name in WHOLE else "a number"
    if name in POSITIVE:
        kind += " above 0"
    is_number = type(value) in (int, float) and abs(value) <= MOST
    is_whole = is_number and value == int(value)
    if not is_number or (name in WHOLE and not is_whole) or (name in POSITIVE and value <= 0):
        raise _refusal(path, value, kind)
    if name == "poisson" and not -1 < value < 0.5:
        raise _refusal(path, value, "a number above -1, below 0.5")
    if name == "seed" and value < 0:
        raise _refusal(path, value, "a whole number at least 0")
    return int(value) if name in WHOLE else float(value)


def _refusal(path, value, accepted):
    return ValueError(f"{path}: {json.dumps(value)} is not accepted; accepted: {accepted}")


def _series(parameters, name):
    value = parameters.get(name) if isinstance(parameters, dict) else None
    if value is None:
        return [getattr(Configuration, name)]
    if not isinstance(value, list) or not value:
        raise ValueError(f"parameters.{name}: accepted is a list of whole numbers above 0")
    return [_number(name, entry, f"parameters.{name}") for entry in value]
