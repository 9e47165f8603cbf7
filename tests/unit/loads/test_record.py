from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mpmgeo.loads import BaseAcceleration, Record, read_record

ORACLES = Path(__file__).parents[3].parent / "shared" / "oracles"
TABLE = np.array([[0.0, 1.0, -2.0, 0.5], [0.1, 2.0, 0.0, -1e-3], [0.25, -3.5, 4.0, 9.81]])
ROWS = [[repr(float(value)) for value in row] for row in TABLE]


def written(tmp_path, text):
    path = tmp_path / "record.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def assert_is_the_table(record):
    np.testing.assert_array_equal(record.time, TABLE[:, 0])
    np.testing.assert_array_equal(record.acceleration, TABLE[:, 1:])
    assert record.time.dtype == record.acceleration.dtype == np.float64


@pytest.mark.parametrize("heading", ["", "t,ax,ay,az\n", "time [s]; acceleration\n", "\n", "#\n"])
@pytest.mark.parametrize("separator", [",", ";", "\t", " ", "   ", ", ", " ; ", ",\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_every_separator_with_and_without_heading(tmp_path, heading, separator, end):
    text = heading + "\n".join(separator.join(row) for row in ROWS) + "\n"
    path = written(tmp_path, text.replace("\n", end))
    record = read_record(path, header=bool(heading))
    assert_is_the_table(record)
    assert record.warnings == ()


def test_further_columns_empty_lines_and_blanks_are_ignored(tmp_path):
    lines = ["", "  " + ",".join(ROWS[0]) + ",7,x", " \t ", ",".join(ROWS[1]) + ",", ""]
    path = written(tmp_path, "\n".join([*lines, ",".join(ROWS[2]) + "   "]))
    assert_is_the_table(read_record(path, header=False))


@pytest.mark.parametrize("heading", ["\ufefft,ax,ay,az".encode(), b"t;a in m/s\xb2;;"])
def test_a_heading_in_any_encoding(tmp_path, heading):
    rows = "\n".join(",".join(row) for row in ROWS)
    assert_is_the_table(read_record(written(tmp_path, heading + b"\n" + rows.encode()), True))


def test_a_byte_order_mark_before_numbers(tmp_path):
    text = "\ufeff" + "\n".join(",".join(row) for row in ROWS)
    assert_is_the_table(read_record(written(tmp_path, text), False))


def test_numbers_in_the_heading_are_dropped_with_a_warning(tmp_path):
    path = written(tmp_path, "\n".join(" ".join(row) for row in ROWS))
    record = read_record(path, header=True)
    np.testing.assert_array_equal(record.time, TABLE[1:, 0])
    (warning,) = record.warnings
    assert str(path) in warning
    assert '"header": false' in warning


@pytest.mark.parametrize(
    ("text", "header", "message"),
    [
        ("", True, "no line with time and three accelerations"),
        ("", False, "no line with time and three accelerations"),
        ("t ax ay az\n", True, "no line with time and three accelerations"),
        ("\n \n\t\n", False, "no line with time and three accelerations"),
        ("t,ax,ay,az\n0,0,0,0\n", False, "line 1: 't' is not a number; a heading needs"),
        ("t\n0,0,0,0\n", False, "line 1: needs time and three accelerations, has 't'; a heading"),
        ("t\n0,0,0\n", True, "line 2: needs time and three accelerations, has '0,0,0'"),
        ("t\n0,0,0,\n", True, "line 2: needs time and three accelerations"),
        ("t\n0 0 0 0\n1 0 0\n", True, "line 3: needs time"),
        ("t\n0,0,,0\n", True, "line 2: '' is not a number"),
        ("t\n0,0,zero,0\n", True, "line 2: 'zero' is not a number"),
        ("t\n0;0,1;0;0\n", True, "line 2: '0,1' has a decimal comma; write a point"),
        ("t\n0 0 0 0\n\n1 0 x 0\n", True, "line 4: 'x' is not a number"),
        ("t\n0,0,nan,0\n", True, "line 2: not all numbers are finite: '0,0,nan,0'"),
        ("t\n0,0,0,0\n1,inf,0,0\n", True, "line 3: not all numbers are finite"),
        ("t\nnan,0,0,0\n", True, "line 2: not all numbers are finite"),
        ("t\n0,0,0,0\n1,0,1e999,0\n", True, "line 3: not all numbers are finite"),
        ("t\n0 0 0 0\n2 0 0 0\n\n1 0 0 0\n", True, "line 5: time 1 s does not exceed"),
        ("t\n0 0 0 0\n1 0 0 0\n1 0 0 0\n", True, "line 4: time 1 s does not exceed"),
        (b"\x00\x01\x02\xff" * 50, False, "line 1: needs time"),
        (b"t\n\xff\xfe0,0,0,0\n", True, "is not a number"),
    ],
)
def test_a_malformed_file_is_refused_by_name_and_line(tmp_path, text, header, message):
    path = written(tmp_path, text)
    with pytest.raises(ValueError) as refusal:
        read_record(path, header)
    assert message in str(refusal.value)
    assert str(path) in str(refusal.value)
    assert len(str(refusal.value)) < 300 + len(str(path))


def test_a_missing_file_and_a_folder_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"nowhere\.csv: cannot be read \(No such file"):
        read_record(tmp_path / "nowhere.csv")
    with pytest.raises(ValueError, match="cannot be read"):
        read_record(tmp_path)


@given(st.binary(max_size=60), st.booleans())
def test_any_bytes_give_a_record_or_a_clear_error(tmp_path_factory, content, header):
    path = tmp_path_factory.mktemp("any") / "record.csv"
    path.write_bytes(content)
    try:
        record = read_record(path, header)
    except ValueError as problem:
        assert str(path) in str(problem)
    else:
        assert record.acceleration.shape == (len(record.time), 3)
        assert np.isfinite(record.acceleration).all()


def test_interpolation():
    record = Record(TABLE[:, 0], TABLE[:, 1:])
    assert record.at(-1e-12) == (0, 0, 0)
    for row in TABLE:
        assert record.at(row[0]) == tuple(row[1:])
    np.testing.assert_allclose(record.at(0.05), [1.5, -1.0, 0.2495], rtol=1e-14)
    np.testing.assert_allclose(record.at(0.2), [-5 / 3, 8 / 3, 2 / 3 * 9.81 - 1e-3 / 3], rtol=1e-14)
    assert record.at(np.nextafter(0.25, 1)) is None


def test_interpolation_agrees_with_numpy():
    generator = np.random.default_rng(3)
    time = np.cumsum(generator.uniform(0.01, 0.1, 200)) + 5
    record = Record(time, generator.normal(size=(200, 3)))
    for t in generator.uniform(time[0], time[-1], 300):
        expected = [np.interp(t, time, column) for column in record.acceleration.T]
        np.testing.assert_allclose(record.at(t), expected, rtol=1e-12, atol=1e-14)


def test_a_record_may_start_late_and_have_one_line():
    record = Record(np.array([2.0]), np.array([[1.0, 2.0, 3.0]]))
    assert record.at(1.9) == (0, 0, 0)
    assert record.at(2.0) == (1, 2, 3)
    assert record.at(2.1) is None


@pytest.mark.parametrize(
    ("file", "lines"),
    [
        ("seismic_column/base_acceleration_space.csv", 1000),
        ("seismic_terrain/base_acceleration_scaled.csv", 1000),
        ("vibrating_base/base_acceleration.csv", 40000),
    ],
)
def test_records_of_the_oracles(file, lines):
    path = ORACLES / file
    if not path.exists():
        pytest.skip("no oracles here")
    record = read_record(path, header=True)
    assert record.acceleration.shape == (lines, 3)
    assert record.warnings == ()


def test_the_declaration(tmp_path):
    assert list(BaseAcceleration().problems()) == []
    assert list(BaseAcceleration(active=True).problems()) == [
        ("file", "is required when active is true")
    ]
    path = written(tmp_path, "t ax ay az\n" + "\n".join(" ".join(row) for row in ROWS))
    base = BaseAcceleration(active=True, file=path)
    assert list(base.problems()) == []
    assert_is_the_table(base.record())
