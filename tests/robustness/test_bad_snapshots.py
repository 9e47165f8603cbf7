"""Snapshots and stress files that cannot be used: a clear message, exit code 2, nothing written."""

import io
import json
import zipfile

import numpy as np
import pytest
from refusal import refusal

import mpmgeo
from mpmgeo import cli
from mpmgeo.case.load import load_case
from mpmgeo.state.snapshot import Snapshot, write_snapshot
from mpmgeo.state.stress_file import NAME


@pytest.fixture
def snapshot(folder, case):
    """A snapshot of the initial state, beside its case file."""
    (folder / "case.json").write_text(json.dumps(case))
    mpmgeo.Simulation(load_case(folder / "case.json")).save(folder / "s.npz")
    return folder / "s.npz"


@pytest.fixture(autouse=True)
def nothing_is_written(folder):
    yield
    assert not (folder / "out").exists()


def npz(**arrays):
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def zipped(name, content):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(name, content)
    return file.getvalue()


FILES = {
    "missing": (None, "cannot be read (No such file or directory)"),
    "empty": (b"", "is no snapshot"),
    "text": (b"this is no snapshot", "is no snapshot"),
    "an array": (b"\x93NUMPY\x01\x00", "is no snapshot"),
    "pickle": (b"\x80\x04\x95\x05\x00\x00\x00\x00\x00\x00\x00\x8c\x01a\x94.", "is no snapshot"),
    "zip of text": (zipped("a.txt", "hello"), "is no snapshot"),
    "other arrays": (npz(x=np.zeros(3)), "is no snapshot"),
    "facts that are no JSON": (npz(facts="{", checksum="0"), "is no snapshot"),
    "facts that are a list": (npz(facts="[]", checksum="0"), "is no snapshot"),
    "an object array": (npz(facts=np.array([{}], dtype=object)), "is no snapshot"),
    "other format": (
        npz(facts='{"format": 99, "program": "mpmgeo 9.9"}', checksum="0"),
        "mpmgeo 9.9",
    ),
}


@pytest.mark.parametrize("name", FILES)
def test_file_that_is_no_snapshot(folder, name, capsys):
    content, message = FILES[name]
    if content is not None:
        (folder / "s.npz").write_bytes(content)
    shown = refusal(capsys, "--resume", "s.npz")
    assert "s.npz" in shown and message in shown


@pytest.mark.parametrize("share", [0.01, 0.3, 0.7, 0.999])
def test_snapshot_that_was_cut_short(snapshot, share, capsys):
    whole = snapshot.read_bytes()
    snapshot.write_bytes(whole[: int(share * len(whole))])
    assert "broken, or not complete" in refusal(capsys, "--resume", "s.npz")


def test_damaged_snapshot(snapshot, capsys):
    data = bytearray(snapshot.read_bytes())
    for place in range(len(data) // 10, len(data), len(data) // 10):
        data[place] ^= 0xFF
    snapshot.write_bytes(data)
    shown = refusal(capsys, "--resume", "s.npz")
    assert "broken" in shown or "is no snapshot" in shown


def rewritten(snapshot, change):
    """Write the snapshot again after a change of its entries, with the checksum it had."""
    with np.load(snapshot) as archive:
        entries = {name: archive[name] for name in archive.files}
    change(entries)
    with snapshot.open("wb") as file:
        np.savez(file, **entries)


def test_changed_numbers_do_not_fit_the_checksum(snapshot, capsys):
    def change(entries):
        entries["set0.x"][0, 0] += 1e-9

    rewritten(snapshot, change)
    assert "its checksum is wrong" in refusal(capsys, "--resume", "s.npz")


def test_other_version(snapshot, capsys):
    def change(entries):
        facts = json.loads(str(entries["facts"])) | {"program": "mpmgeo 0.0.1"}
        entries["facts"] = np.array(json.dumps(facts))

    rewritten(snapshot, change)
    shown = refusal(capsys, "--resume", "s.npz")
    assert "was written by mpmgeo 0.0.1" in shown and "this is mpmgeo" in shown


def test_other_case(snapshot, folder, case, capsys):
    case["gravity"] = [0, 0, -1.62]
    case["materials"]["soil"]["young"] = 1e7
    (folder / "other.json").write_text(json.dumps(case))
    shown = refusal(capsys, "other.json", "--resume", "s.npz")
    assert "is of another case, or its files have changed" in shown
    assert "gravity[2]" in shown and "young" in shown


def test_case_with_another_number_of_particles(snapshot, folder, case, capsys):
    case["body"]["block"]["point_p2"] = [1, 1, 1.5]
    (folder / "other.json").write_text(json.dumps(case))
    assert "is of another case" in refusal(capsys, "other.json", "--resume", "s.npz")


def test_what_does_not_change_results_may_differ(snapshot, folder, case):
    case |= {"title": "again", "n_threads": 1, "time": 0.003}
    (folder / "other.json").write_text(json.dumps(case))
    assert cli.main(["other.json", "--resume", "s.npz", "--check"]) == cli.DONE


def test_changed_file_of_the_case(snapshot, folder, capsys):
    record = folder / "record.csv"
    record.write_text(record.read_text().replace("0.5,", "0.6,"))
    assert "earthquake.file" in refusal(capsys, "--resume", "s.npz")


def test_missing_file_of_the_case(snapshot, folder, capsys):
    (folder / "record.csv").unlink()
    assert "there is no file" in refusal(capsys, "--resume", "s.npz")


def test_case_with_errors(snapshot, folder, case, capsys):
    case["time"] = -1
    (folder / "case.json").write_text(json.dumps(case))
    assert "time: -1 is not accepted" in refusal(capsys, "case.json", "--resume", "s.npz")


def test_arrays_of_other_particles(snapshot, folder, capsys):
    """A snapshot that is whole, and says that it is of the case, but is not."""
    with np.load(snapshot) as archive:
        arrays = {k: archive[k] for k in archive.files if k not in ("facts", "checksum")}
        facts = json.loads(str(archive["facts"]))
    for arrays_now, message in (
        (arrays | {"set0.x": arrays["set0.x"][:-1]}, "where the case needs"),
        ({k: v for k, v in arrays.items() if k != "set0.V"}, "the snapshot lacks set0.V"),
        (arrays | {"set9.x": arrays["set0.x"]}, "has set9.x, which the case does not know"),
    ):
        with snapshot.open("wb") as file:
            write_snapshot(file, Snapshot(arrays_now, facts))
        assert message in refusal(capsys, "--resume", "s.npz")


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        ({}, "snapshot.every: missing"),
        ({"every": 0}, "snapshot.every: 0 is not accepted"),
        ({"every": 1.5}, "snapshot.every: 1.5 is not accepted"),
        ({"every": 10, "keep": 0}, "snapshot.keep: 0 is not accepted"),
        (100, "snapshot: 100 is not accepted"),
    ],
)
def test_bad_plan(folder, case, plan, message, capsys):
    (folder / "case.json").write_text(json.dumps(case | {"snapshot": plan}))
    assert message in refusal(capsys, "case.json")


TENSOR = [[1, 4, 6], [4, 2, 5], [6, 5, 3]]
GOOD = [{"index": n, "stress": TENSOR} for n in range(128)]


def entry(**keys):
    return [GOOD[0] | keys, *GOOD[1:]]


STRESSES = {
    "missing": (None, f"load_state: there is no file {NAME} in"),
    "empty": ("", "not JSON"),
    "binary": (b"\xff\xfe\x00", "not JSON"),
    "no list": ('{"index": 0}', 'needs a list of objects with "index" and "stress"'),
    "fewer": (GOOD[:-1], "holds the stresses of 127 particles, the case has 128"),
    "more": ([*GOOD, {"index": 128, "stress": TENSOR}], "of 129 particles, the case has 128"),
    "numbers": ([*GOOD[:-1], 3], 'entry 128: "index" needs a whole number from 0 to 127'),
    "no index": (entry(index=None), 'entry 1: "index" needs a whole number'),
    "index 128": (entry(index=128), 'entry 1: "index" needs a whole number from 0 to 127'),
    "index -1": (entry(index=-1), 'entry 1: "index" needs a whole number from 0 to 127'),
    "index twice": (entry(index=5), "entry 6: the index 5 is there twice"),
    "no stress": (entry(stress=None), '"stress" needs three rows of three finite numbers'),
    "six numbers": (entry(stress=[1, 2, 3, 4, 5, 6]), '"stress" needs three rows of three'),
    "two rows": (entry(stress=TENSOR[:2]), '"stress" needs three rows of three'),
    "short row": (entry(stress=[*TENSOR[:2], [6, 5]]), '"stress" needs three rows of three'),
    "a word": (entry(stress=[[1, "a", 6], *TENSOR[1:]]), '"stress" needs three rows of three'),
    "NaN": (entry(stress=[[float("nan"), 4, 6], *TENSOR[1:]]), "three finite numbers"),
    "huge": (entry(stress=[[1e200, 4, 6], *TENSOR[1:]]), "three finite numbers"),
    "not symmetric": (entry(stress=[[1, 4, 6], [0, 2, 5], [6, 5, 3]]), '"stress" is not symmetric'),
}


@pytest.mark.parametrize("name", STRESSES)
def test_stress_file(folder, case, name, capsys):
    content, message = STRESSES[name]
    if isinstance(content, list):
        content = json.dumps(content)
    if content is not None:
        (folder / NAME).write_bytes(content if isinstance(content, bytes) else content.encode())
    block = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "material_id": 1}
    case |= {"load_state": True, "body": {"a": block, "b": block | {"point_p1": [0, 0, 0]}}}
    (folder / "case.json").write_text(json.dumps(case))
    assert message in refusal(capsys, "case.json")
