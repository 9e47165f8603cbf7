import numpy as np

from mpmgeo.output.energy import EnergySeries


def test_rows_are_there_at_once_with_all_digits(tmp_path):
    path = tmp_path / "run" / "time-energy.csv"
    series = EnergySeries(path)
    assert path.read_text() == "time,energy\n"
    rows = [(0, 0), (0.1 + 0.2, np.float64(1) / 3), (1e-17, 6.02e300)]
    for number, (time, energy) in enumerate(rows, start=1):
        series.add(time, energy)
        assert path.read_text().count("\n") == number + 1
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(table, rows)
    assert path.read_text().splitlines()[1] == "0.0,0.0"


def test_an_old_file_is_begun_anew(tmp_path):
    path = tmp_path / "time-energy.csv"
    path.write_text("old\nrows\n")
    EnergySeries(path)
    assert path.read_text() == "time,energy\n"
