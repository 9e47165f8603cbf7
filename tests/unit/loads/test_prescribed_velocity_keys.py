import numpy as np
import pytest

from mpmgeo.loads import PrescribedVelocity


def of_file(tmp_path, text):
    file = tmp_path / "v.csv"
    file.write_text(text)
    return PrescribedVelocity(plane="Z0", file=file)


def test_constant_velocity_with_a_free_component():
    motion = PrescribedVelocity(body=1, velocity=(1.0, None, -2.0)).motion
    for t in (0.0, 3.0):
        np.testing.assert_array_equal(motion.at(t), [1, np.nan, -2])
        np.testing.assert_array_equal(motion.displacement(t), [t, np.nan, -2 * t])


TABLES = {
    "commas": "time,vx,vy,vz\n1,,0,2\n3,,0,6\n",
    "words": "1 null 0 2\n3 null 0 6",
    "semicolons": "t;vx;vy;vz\n\n1;null;0;2\n3;;0;6\n",
}


@pytest.mark.parametrize("text", TABLES.values(), ids=TABLES)
def test_table(tmp_path, text):
    """Linear between the rows, constant before the first and after the last one."""
    motion = of_file(tmp_path, text).motion
    for t, v in ((0, 2), (1, 2), (2, 4), (3, 6), (9, 6)):
        np.testing.assert_array_equal(motion.at(t), [np.nan, 0, v])
    for t, way in ((0, 0), (0.5, 1), (1, 2), (2, 5), (3, 10), (4, 16)):
        assert motion.displacement(t)[2] == pytest.approx(way)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no line with time and three velocities"),
        ("time,vx,vy,vz\n", "no line with time and three velocities"),
        ("0,1,0\n", "no line with time and three velocities"),
        ("0,0,0,0\n0,1,0\n", "line 2: needs time and three velocities"),
        ("0,0,0,0\n1,x,0,0\n", "line 2: 'x' is not a number"),
        ("0,0,,0\n1,0,0,0\n", "line 2: a column is free in all lines or in none"),
        ("0,,,\n1,,,\n", "all components are free"),
        ("0,0,0,nan\n", "line 1: not all numbers are finite"),
        ("0,0,0,0\n1,0,0,inf\n", "line 2: not all numbers are finite"),
        ("1,0,0,0\n0,0,0,0\n", "line 2: time 0 s does not exceed the time before it, 1 s"),
        ("0,0,0,0\n0,0,0,0\n", "line 2: time 0 s does not exceed the time before it, 0 s"),
        (",0,0,0\n1,0,,x\n", "line 2: 'x' is not a number"),
    ],
)
def test_bad_tables(tmp_path, text, message):
    ((key, problem),) = of_file(tmp_path, text).complaints()
    assert key == "file"
    assert message in problem


def test_who_is_meant():
    position = np.array([[0, 0, 0], [1, 1, 1], [2, 2, 2]], float)
    body = np.array([1, 2, 2])
    still = (0.0, 0.0, 0.0)
    box = PrescribedVelocity(point_p1=(0, 0, 0), point_p2=(1, 1, 1), velocity=still)
    assert box.chooses(position, body).tolist() == [True, True, False]
    second = PrescribedVelocity(body=2, velocity=still)
    assert second.chooses(position, body).tolist() == [False, True, True]
    plane = PrescribedVelocity(plane="Yn", velocity=still)
    assert not plane.chooses(position, body).any()
    assert (plane.side, box.side) == ((1, 1), None)


def test_a_box_at_the_origin_is_a_box():
    """Its corner has no true component."""
    entry = PrescribedVelocity(point_p1=(0, 0, 0), point_p2=(0, 0, 0), velocity=(1.0, None, None))
    assert list(entry.problems()) == []
