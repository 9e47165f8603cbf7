"""Which outputs, rows and files come before a state."""

import pytest

from mpmgeo.output.earlier import earlier
from mpmgeo.output.energy import EnergySeries, earlier_rows
from mpmgeo.output.pvd import Collection


@pytest.mark.parametrize(
    ("times", "time", "is_due", "left"),
    [
        ([0, 1, 2, 3], 2, True, [0, 1, 2]),
        ([0, 1, 2, 3], 2.5, False, [0, 1, 2]),
        ([0, 1, 1.7], 1.7, False, [0, 1]),
        ([0, 1, 1.7, 2], 1.7, True, [0, 1, 1.7]),
        ([0], 0, False, [0]),
        ([0, 0, 1], 0, True, [0, 0]),
        ([], 1, True, []),
    ],
)
def test_outputs_that_come_before_a_state(times, time, is_due, left):
    assert earlier([(t,) for t in times], time, is_due) == [(t,) for t in left]


def test_rows_of_the_energy(tmp_path):
    series = EnergySeries(tmp_path / "e.csv")
    for n in range(4):
        series.add(0.1 * n, n / 3)
    whole = series.path.read_text()
    rows = earlier_rows(series.path, 0.2, is_due=True)
    EnergySeries(series.path, rows)
    assert series.path.read_text() == "".join(whole.splitlines(keepends=True)[:4])


@pytest.mark.parametrize(
    "text", [None, "", "other,head\n0,1\n", "time,energy\nno,number\n", "time,energy\n0,1"]
)
def test_what_is_no_energy_series_has_no_rows(tmp_path, text):
    if text is not None:
        (tmp_path / "e.csv").write_text(text)
    assert earlier_rows(tmp_path / "e.csv", 1.0, is_due=True) == []


def test_a_collection_goes_on(tmp_path):
    first = Collection(tmp_path / "a.pvd")
    for n in range(4):
        first.add(n / 3, tmp_path / f"p & {n}.vtu")
    first.write()
    second = Collection(tmp_path / "a.pvd")
    second.take_up(1 / 3, is_due=True)
    assert second.entries == first.entries[:2]
    other = Collection(tmp_path / "none.pvd")
    other.take_up(1.0, is_due=True)
    assert other.entries == []
