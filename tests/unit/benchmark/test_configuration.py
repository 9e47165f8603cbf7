"""The configuration of MPM-Geomechanics' benchmark, read with its defaults."""

import json
import re

import pytest

from mpmgeo.benchmark.configuration import FILE, KEYS, Configuration, read_configurations

# What MPM-Geomechanics ships beside its benchmark.
SHIPPED = {
    "global": {
        "numParticles": 150000,
        "numThreads": 1,
        "cellDimension": [1, 1, 1],
        "numCells": [100, 100, 100],
        "randomSeed": 42,
        "interpolationTest": True,
        "updateTest": True,
    },
    "update": {
        "UpdatePerformance_ParticleDensity_nParticles": {
            "initialDensity": 2000,
            "traceStrain": 0.05,
        },
        "ParticleStress_nParticles": {"E": 1000, "nu": 0.3, "epsilon0": 0.01},
    },
    "interpolation": {
        "NodalMass_nParticles": {"comment": "no keys"},
        "NodalMomentum_nParticles": {"particleVelocity": [1, 2, 3]},
        "NodalInternalForce_nParticles": {"comment": "no keys"},
        "NodalExternalForce_nParticles": {"appliedForce": [1, 2, 3]},
        "ParticleStrainIncrement_nParticles": {"dt01": 0.01, "nodalVelocity": [1, 2, 3]},
        "ParticleVorticityIncrement_nParticles": {"dt02": 0.01, "omega": [1, 2, 3]},
    },
}


@pytest.fixture
def read(tmp_path, monkeypatch):
    """A function that reads a tree from a file of the usual name."""
    monkeypatch.chdir(tmp_path)

    def read(tree):
        (tmp_path / FILE).write_text(json.dumps(tree))
        return read_configurations(None)

    return read


def test_built_in_values(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (only,), _, absences = read_configurations(None)
    assert only == Configuration()
    assert (only.particles, only.threads, only.cells) == (150000, 10, (1, 1, 1))
    assert len(absences) == len(KEYS)


def test_shipped_file(read):
    (only,), remarks, absences = read(SHIPPED)
    assert only == Configuration(threads=1, cells=(100, 100, 100))
    assert remarks == absences == []


def test_every_key_is_read(read):
    values = {bool: False, int: 7, float: 0.25, tuple: [4, 5, 6]}
    for keys, name in KEYS.items():
        default = getattr(Configuration, name)
        value = values[type(default)]
        tree = value
        for key in reversed(keys):
            tree = {key: tree}
        (only,), _, _ = read(tree)
        found = getattr(only, name)
        assert found == (tuple(value) if isinstance(value, list) else value) != default


def test_matrix(read):
    """The configuration of start-multi-benchmark: every pair, in a mesh of 100³ cells."""
    tree = {
        "executables": {"current": "MPM-Geomechanics-benchmark"},
        "parameters": {"particles": [150, 250], "threads": [1, 5, 10]},
    }
    found, remarks, _ = read(tree)
    pairs = [(c.particles, c.threads) for c in found]
    assert pairs == [(n, t) for n in (150, 250) for t in (1, 5, 10)]
    assert {c.cells for c in found} == {(100, 100, 100)}
    assert "executables: no effect, the kernels of this program are timed" in remarks


def test_keys_that_nobody_reads_are_told(read):
    _, remarks, _ = read({"global": {"particleSize": 2, "particleMass": 3}})
    assert remarks[:2] == [
        "global.particleSize: no effect, particles have the size 1",
        "global.particleMass: no effect, particles have the mass 1",
    ]


def test_lists_of_another_length_are_absent(read):
    (only,), _, absences = read({"global": {"cellDimension": [1, 2]}})
    assert only.cell == (1, 1, 1)
    assert any(remark.startswith("global.cellDimension: absent") for remark in absences)


@pytest.mark.parametrize(
    ("tree", "message"),
    [
        ([], "is a JSON object"),
        ({"global": {"numParticles": 0}}, "global.numParticles: 0 is not accepted; accepted: a wh"),
        ({"global": {"numParticles": "9"}}, 'global.numParticles: "9" is not accepted'),
        ({"global": {"numParticles": 1e30}}, "global.numParticles: 1e"),
        ({"global": {"numThreads": 1.5}}, "global.numThreads: 1.5 is not accepted"),
        ({"global": {"randomSeed": -1}}, "global.randomSeed: -1 is not accepted"),
        ({"global": {"updateTest": 1}}, "global.updateTest: 1 is not accepted; accepted: true or"),
        ({"global": {"cellDimension": 1}}, "global.cellDimension: 1 is not accepted; accepted: th"),
        ({"global": {"cellDimension": [1, 1, 0]}}, "global.cellDimension: 0 is not accepted"),
        ({"global": {"numCells": [1, 1, float("nan")]}}, "global.numCells: NaN is not accepted"),
        ({"update": {"ParticleStress_nParticles": {"nu": 0.5}}}, "nu: 0.5 is not accepted"),
        ({"parameters": {"particles": []}}, "parameters.particles: accepted is a list"),
        ({"parameters": {"particles": 5}}, "parameters.particles: accepted is a list"),
        ({"parameters": {"threads": [0]}}, "parameters.threads: 0 is not accepted"),
    ],
)
def test_what_cannot_be_used_is_refused(read, tree, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        read(tree)


@pytest.mark.parametrize("text", [b"", b"{", b"\xff\xfe{", b"[" * 100_000])
def test_no_json(tmp_path, text):
    file = tmp_path / "c.json"
    file.write_bytes(text)
    with pytest.raises(ValueError, match="not JSON"):
        read_configurations(file)


def test_unknown_keys_are_told(read):
    tree = {
        "thrads": [1],
        "global": {"numParticels": 3, "comment": "free"},
        "update": {"ParticleStress_nParticles": {"E": 5.0, "epsilon": 0.2}},
    }
    (only,), remarks, _ = read(tree)
    assert only == Configuration(young=5.0)
    assert remarks == [
        "thrads: no such key, it has no effect",
        'global.numParticels: no such key, it has no effect; did you mean "global.numParticles"?',
        "update.ParticleStress_nParticles.epsilon: no such key, it has no effect; "
        'did you mean "update.ParticleStress_nParticles.epsilon0"?',
    ]
