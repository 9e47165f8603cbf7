import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mpmgeo.bodies.lattice import MOST_POSITIONS, Lattice


def lattice(start=(0, 0, 0), extent=(1, 1, 1), cell=(1, 1, 1), per_cell=(2, 2, 2)):
    return Lattice.over(start, extent, cell, per_cell)


def by_loops(box, fastest):
    """Every position by plain loops: cells with z fastest, then positions within the cell."""
    nx, ny, nz = box.cells
    px, py, pz = box.per_cell
    if fastest == "x":
        within = [(q, r, s) for s in range(pz) for r in range(py) for q in range(px)]
    else:
        within = [(q, r, s) for q in range(px) for r in range(py) for s in range(pz)]
    return np.array(
        [
            box.start + box.cell * (np.array(cell) + (np.array(inner) + 0.5) / box.per_cell)
            for cell in np.ndindex(nx, ny, nz)
            for inner in within
        ]
    )


@pytest.mark.parametrize("fastest", ["x", "z"])
@pytest.mark.parametrize("per_cell", [(2, 2, 2), (1, 1, 1), (1, 2, 3), (4, 1, 2)])
def test_order_is_that_of_plain_loops(fastest, per_cell):
    box = lattice((-1, 2, 0.5), (1.5, 1.0, 0.9), (0.5, 0.25, 0.3), per_cell)
    cloud = box.cloud(fastest)
    assert cloud.position.dtype == cloud.size.dtype == np.float64
    np.testing.assert_allclose(cloud.position, by_loops(box, fastest), rtol=1e-14)
    size = np.array([0.5, 0.25, 0.3]) / per_cell
    np.testing.assert_allclose(cloud.size, np.tile(size, (box.number, 1)), rtol=1e-15)
    assert len(cloud.size) == len(cloud.position) == box.number


@pytest.mark.parametrize("fastest", ["x", "z"])
def test_keep_takes_positions_out_without_changing_the_order(fastest):
    box = lattice(extent=(3, 2, 4), per_cell=(1, 2, 3))
    keep = np.random.default_rng(1).random((3, 4, 12)) < 0.4
    every = box.cloud(fastest).position
    index = np.round((every / box.size) - 0.5).astype(int)
    expected = every[keep[tuple(index.T)]]
    np.testing.assert_array_equal(box.cloud(fastest, keep).position, expected)


@pytest.mark.parametrize(
    ("extent", "cell", "cells"),
    [
        (0.9 - 0.6, 0.1, 3),
        (0.4 - 0.1, 0.1, 3),
        (1.0 - 0.7, 0.1, 3),
        (0.7 - 0.4, 0.1, 3),
        (0.3, 0.1, 3),
        (1.3, 1.0, 2),
        (3.0 * (1 + 0.9e-9), 1.0, 3),
        (3.0 * (1 - 0.9e-9), 1.0, 3),
        (3.0 * (1 + 1e-8), 1.0, 4),
        (1e-6, 1.0, 1),
    ],
)
def test_cells_are_counted_up_but_not_from_round_off(extent, cell, cells):
    assert lattice(extent=(extent,) * 3, cell=(cell,) * 3).cells == (cells,) * 3


@given(
    st.integers(1, 2000),
    st.floats(1e-3, 10),
    st.floats(-1000, 1000),
)
def test_a_multiple_of_the_cell_anywhere_has_that_many_cells(number, cell, low):
    extent = (low + number * cell) - low
    box = lattice(extent=(extent, cell, cell), cell=(cell,) * 3, per_cell=(1, 1, 1))
    assert box.cells == (number, 1, 1)
    assert box.surplus() == []


def test_too_many_positions_are_refused_before_memory_is_taken():
    assert lattice(extent=(1000, 1000, 125)).number == MOST_POSITIONS
    for extent in ((1000, 1000, 126), (1e300, 1e300, 1), (1e308, 1, 1)):
        with pytest.raises(ValueError, match="positions, more than the 1e"):
            lattice(extent=extent)
    with pytest.raises(ValueError, match="positions"):
        lattice(per_cell=(10**9, 10**9, 10**9))


def test_surplus_names_axis_size_cell_and_result():
    box = lattice(extent=(1.3, 2.0, 0.5), cell=(1.0, 1.0, 0.2))
    x, z = box.surplus()
    assert x == (
        "the size along x, 1.3 m, is not a multiple of the cell, 1 m: 2 whole cells make 2 m"
    )
    assert "along z" in z
    assert box.surplus("yz") == [z]
