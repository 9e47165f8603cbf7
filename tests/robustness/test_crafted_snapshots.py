"""Snapshots whose checksum is right and whose content is not: a message, and no crash or memory."""

import io
import json
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest
from assembly import two_blocks
from refusal import refusal

import mpmgeo
from mpmgeo.state.grid import cut
from mpmgeo.state.snapshot import Snapshot, StoredSnapshot, write_snapshot

LITTLE = 2**25  # bytes that refusing a file may take
MUCH = 2**27  # bytes that a file claims


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The bytes of a snapshot after a few steps."""
    path = tmp_path_factory.mktemp("whole") / "s.npz"
    case = two_blocks(damping={"type": "kinetic"})
    mpmgeo.Simulation(mpmgeo.load_case(case)).step(4).save(path)
    return path.read_bytes()


@pytest.fixture
def parts(whole, tmp_path, monkeypatch):
    """Arrays and facts of the snapshot, to be changed and written by `resumed`."""
    monkeypatch.chdir(tmp_path)
    with np.load(io.BytesIO(whole)) as archive:
        arrays = {k: archive[k] for k in archive.files if k not in ("facts", "checksum")}
        return arrays, json.loads(str(archive["facts"]))


def written(arrays, facts):
    with Path("s.npz").open("wb") as file:
        write_snapshot(file, Snapshot(arrays, facts))


def resumed(capsys, arrays, facts):
    """Write a snapshot, resume it, and return what was said when it was refused."""
    written(arrays, facts)
    return refusal(capsys, "--resume", "s.npz")


def test_the_snapshot_itself_is_sound(parts, capsys):
    from mpmgeo import cli

    written(*parts)
    assert cli.main(["--resume", "s.npz", "--check"]) == cli.DONE


def start(values):
    """Return a change of the bounds of the first set, with chunks that fit."""

    def change(arrays):
        made = np.array(values(arrays["set0.start"]))
        arrays["set0.start"], arrays["set0.chunk"] = made, cut(made)

    return change


def entry(name, value):
    return lambda arrays: arrays.__setitem__(name, value(arrays[name].copy()))


def first_is(value):
    def change(array):
        array[0] = value
        return array

    return change


def heap(arrays):
    """As before the first sort, though no particle is said to be out of its place."""
    arrays["grid.keys"] = arrays["grid.keys"][:0]
    arrays["grid.records"] = arrays["grid.records"][:0]
    for name in ("set0", "set1"):
        arrays[f"{name}.start"] = np.array([0, len(arrays[f"{name}.row"])])
        arrays[f"{name}.chunk"] = cut(arrays[f"{name}.start"])


def departures(arrays, **changes):
    sound = {"time": np.array([0.1]), "count": np.array([2]), "rows": np.array([3, 4])}
    for name, array in (sound | {"position": np.ones((1, 3))} | changes).items():
        arrays[f"departures.{name}"] = array


FIRST = np.iinfo(np.int64)
ARRAYS = {
    "start beyond": (start(lambda s: [*s[:-1], 10**9]), "set0.start holds no bounds"),
    "start before": (start(lambda s: [-5, *s[1:]]), "set0.start holds no bounds"),
    "start that falls": (start(lambda s: [0, 9, 3, *s[3:]]), "set0.start holds no bounds"),
    "start that overflows": (
        start(lambda s: [0, FIRST.max, FIRST.min, *s[3:]]),
        "set0.start holds no bounds",
    ),
    "no start": (entry("set0.start", lambda s: s[:0]), "set0.start holds no bounds"),
    "start of doubles": (entry("set0.start", lambda s: s * 1.0), "set0.start is an array float64"),
    "start too short": (start(lambda s: [*s[:-2], s[-1]]), "are not the blocks of the particles"),
    "chunk beyond": (entry("set0.chunk", lambda c: c + 10**6), "set0.chunk does not fit"),
    "a row twice": (entry("set0.row", first_is(5)), "set0.row holds other particles"),
    "row beyond": (entry("set0.row", first_is(10**9)), "set0.row holds other particles"),
    "row below": (entry("set0.row", first_is(-1)), "set0.row holds other particles"),
    "keys in disorder": (entry("grid.keys", lambda k: k[::-1]), "grid.keys are not in order"),
    "a key twice": (entry("grid.keys", lambda k: k[[0, 0, *range(2, len(k))]]), "not in order"),
    "keys beyond": (entry("grid.keys", lambda k: k + 2**50), "outside the mesh"),
    "keys below": (entry("grid.keys", lambda k: k - 2**62), "outside the mesh"),
    "fewer keys": (entry("grid.keys", lambda k: k[1:]), "grid.records is an array"),
    "other records": (entry("grid.records", lambda r: r[:, :1]), "grid.records is an array"),
    "records of one": (entry("grid.records", lambda r: r[:1]), "grid.records is an array"),
    "no blocks": (heap, "are not the blocks of the particles"),
    "whole positions": (entry("set0.x", lambda x: x.astype(int)), "set0.x is an array int64"),
    "flat positions": (entry("set0.x", lambda x: x.ravel()), "set0.x is an array float64"),
    "an object as time": (lambda a: a.__setitem__("time", np.zeros(3)), "is no snapshot of a run"),
    "departures beyond": (lambda a: departures(a, rows=np.array([3, 96])), "there are not"),
    "departures below": (lambda a: departures(a, rows=np.array([-1, 4])), "there are not"),
    "fewer departures": (lambda a: departures(a, count=np.array([3])), "departures.count"),
    "negative count": (lambda a: departures(a, count=np.array([-2])), "departures.count"),
    "times of whole numbers": (lambda a: departures(a, time=np.array([1])), "departures.time"),
}


@pytest.mark.parametrize("name", ARRAYS)
def test_arrays(parts, name, capsys):
    arrays, facts = parts
    change, message = ARRAYS[name]
    change(arrays)
    assert message in resumed(capsys, arrays, facts)


def test_sound_departures_are_taken(parts):
    arrays, facts = parts
    departures(arrays)
    written(arrays, facts)
    (only,) = mpmgeo.Simulation.resume("s.npz").solver.departures
    assert only.time == 0.1 and only.rows.tolist() == [3, 4]


def deep(levels):
    tree = {}
    for _ in range(levels):
        tree = {"a": tree}
    return tree


STATE = {
    "time": ["soon", -1.0, True, float("nan"), float("inf"), 10**400, None, [0.1], {}],
    "steps": [1.5, -3, 10**30, "3", None, False],
    "gone": [0.5, -1, [], None],
    "peak_energy": ["much", float("nan"), []],
    "set0.x": ["text", 1.0],
    "kinetic damping.last_energy": ["much", None, float("inf"), [1.0]],
}


@pytest.mark.parametrize(("name", "value"), [(n, v) for n, vs in STATE.items() for v in vs])
def test_facts_of_the_state(parts, name, value, capsys):
    arrays, facts = parts
    facts["state"][name] = value
    said = resumed(capsys, arrays, facts)
    assert f"{name} is" in said or "is no snapshot of a run" in said


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("state", [1]),
        ("state", None),
        ("told", 3),
        ("told", [[]]),
        ("told", None),
        ("case", "case.json"),
        ("case", 3),
        ("case", []),
        ("fingerprint", 7),
        ("fingerprint", deep(600)),
    ],
)
def test_facts(parts, key, value, capsys):
    arrays, facts = parts
    said = resumed(capsys, arrays, facts | {key: value})
    assert "is no snapshot" in said or "is of another case" in said


def test_missing_facts(parts, capsys):
    arrays, facts = parts
    for key in ("told", "case", "fingerprint", "state"):
        fewer = {k: v for k, v in facts.items() if k != key}
        assert "is no snapshot of a run" in resumed(capsys, arrays, fewer)
    del facts["state"]["steps"]
    assert "the snapshot lacks steps" in resumed(capsys, arrays, facts)


LARGE = {
    "a known array": {"set0.x": np.zeros((MUCH // 24, 3))},
    "blocks": {"grid.keys": np.zeros(MUCH // 8, np.int64)},
    "nodes": {"grid.records": np.zeros((MUCH // 4096, 64, 8))},
    "bounds": {"set0.start": np.zeros(MUCH // 8, np.int64)},
    "departures": {f"departures.{n}": np.zeros(MUCH // 32) for n in ("time", "count", "rows")},
    "an unknown array": {"set7.x": np.zeros(MUCH // 8)},
}


@pytest.mark.parametrize("name", LARGE)
def test_a_small_file_takes_little_memory(parts, name, capsys):
    arrays, facts = parts
    written(arrays | LARGE[name], facts)
    _refused_with_little(capsys)


def test_large_facts_take_little_memory(parts, capsys):
    arrays, facts = parts
    written(arrays, facts | {"more": "x" * (MUCH // 4)})
    _refused_with_little(capsys)


def _refused_with_little(capsys):
    tracemalloc.start()
    try:
        refusal(capsys, "--resume", "s.npz")
        assert tracemalloc.get_traced_memory()[1] < LITTLE
    finally:
        tracemalloc.stop()


ONE, TWO = np.lib.format.write_array_header_1_0, np.lib.format.write_array_header_2_0


def npy(shape, data, write=ONE, descr="<f8"):
    file = io.BytesIO()
    heading = {"descr": descr, "fortran_order": False, "shape": shape}
    write(file, heading)
    return file.getvalue() + data


ODD = {
    "more than there is": npy((10**9,), b"\0" * 80),
    "less than there is": npy((1,), b"\0" * 80),
    "a negative length": npy((-10,), b"\0" * 80),
    "objects": npy((1,), b"\x80\x04N.", descr="|O"),
    "a long heading": npy((10,), b"\0" * 80, write=TWO),
    "no array": b"hello",
    "nothing": b"",
    "half a heading": npy((10,), b"")[:40],
}


@pytest.mark.parametrize("name", ODD)
def test_odd_headings(parts, name, capsys):
    written(*parts)
    with zipfile.ZipFile("s.npz", "a") as archive:
        archive.writestr("odd.npy", ODD[name])
    said = refusal(capsys, "--resume", "s.npz")
    assert "is no snapshot" in said or "broken" in said


def test_facts_that_are_no_text(parts, capsys):
    facts = np.frombuffer(np.array([0x110000], "<u4").tobytes(), "<U1").reshape(())
    with Path("s.npz").open("wb") as file:
        np.savez(file, facts=facts, checksum="0")
    assert "is no snapshot" in refusal(capsys, "--resume", "s.npz")


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_two_arrays_of_one_name(parts, capsys):
    written(*parts)
    with zipfile.ZipFile("s.npz", "a") as archive:
        archive.writestr("set0.x.npy", ODD["less than there is"])
    assert "is no snapshot" in refusal(capsys, "--resume", "s.npz")


def test_a_file_that_changes_while_it_is_read(parts):
    arrays, facts = parts
    written(arrays, facts)
    stored = StoredSnapshot("s.npz")
    written(arrays | {"set0.x": arrays["set0.x"][:-1]}, facts)
    with pytest.raises(ValueError, match="is no snapshot"):
        stored.entries(most=100)["set0.x"].read()
