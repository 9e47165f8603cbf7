"""The file of a snapshot gives back what was put into it."""

import numpy as np

from mpmgeo.state.snapshot import Snapshot, StoredSnapshot, write_snapshot

ARRAYS = {
    "set0.x": np.random.default_rng(1).normal(size=(100, 3)),
    "set0.row": np.arange(100),
    "empty": np.empty((0, 3)),
    "small": np.array([1, 2], dtype=np.int32),
    "odd": np.array([np.nan, np.inf, -0.0, 5e-324]),
    "sliced": np.arange(20.0)[::2],
}
FACTS = {"time": 0.1 + 0.2, "steps": 3, "peak": None, "words": ["a", "ö"]}


def written(path):
    with path.open("wb") as file:
        write_snapshot(file, Snapshot(ARRAYS, FACTS))
    return path


def test_arrays_and_facts_come_back(tmp_path):
    stored = StoredSnapshot(written(tmp_path / "s.npz"))
    arrays = {name: entry.read() for name, entry in stored.entries(most=0).items()}
    stored.verify()
    facts = stored.facts
    assert arrays.keys() == ARRAYS.keys()
    for name, array in ARRAYS.items():
        assert arrays[name].dtype == array.dtype
        assert arrays[name].tobytes() == array.tobytes()
    assert {key: facts[key] for key in FACTS} == FACTS


def test_it_is_a_compressed_npz_archive(tmp_path):
    with np.load(written(tmp_path / "s.npz")) as archive:
        np.testing.assert_array_equal(archive["set0.row"], ARRAYS["set0.row"])
    whole = sum(array.nbytes for array in ARRAYS.values())
    assert (tmp_path / "s.npz").stat().st_size < whole + 3000
