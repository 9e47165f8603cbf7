import meshio
import numpy as np
import pytest
import pyvista

from mpmgeo.output.vtu import TYPES, write_hexahedra, write_points

STRESS = [f"Stress_{component}" for component in ("XX", "YY", "ZZ", "XY", "XZ", "YZ")]
generator = np.random.default_rng(4)


def every_field(n):
    return {
        "Particle Id": np.arange(n, dtype=np.uint64) + 2**60,
        "Material Id": np.arange(n, dtype=np.uint32) + 2**31,
        "Particle Active": (np.arange(n) % 2).astype(np.uint8),
        "Displacement": generator.normal(size=(n, 3)),
        "Distance-levelset": generator.normal(size=n),
        "Velocity": generator.normal(size=(n, 3)) * 1e-300,
        **{name: generator.normal(size=n) * 1e300 for name in STRESS},
    }


def stress_only(n):
    return {name: generator.normal(size=n) for name in STRESS}


def vector_then_scalar(n):
    return {"Displacement": generator.normal(size=(n, 3)), "s": generator.normal(size=n)}


def no_field(n):
    return {}


def every_type(n):
    return {name: np.arange(n).astype(dtype) for dtype, name in TYPES.items()}


def assert_same(read, written):
    assert set(read) == set(written)
    for name, values in written.items():
        assert read[name].dtype == values.dtype, name
        np.testing.assert_array_equal(read[name], values, err_msg=name)


@pytest.mark.parametrize(
    "fields", [every_field, stress_only, vector_then_scalar, no_field, every_type]
)
@pytest.mark.parametrize("n", [*range(1, 13), 100, 1001])
def test_points_read_back_by_pyvista_and_meshio(tmp_path, fields, n):
    path = tmp_path / "particles_1.vtu"
    position = generator.normal(size=(n, 3))
    written = fields(n)
    write_points(path, position, written)

    grid = pyvista.read(path)
    assert grid.points.dtype == np.float64
    np.testing.assert_array_equal(grid.points, position)
    assert (grid.celltypes == 1).all()
    assert grid.n_cells == n
    np.testing.assert_array_equal(grid.cell_connectivity, np.arange(n))
    assert_same(dict(grid.point_data), written)

    mesh = meshio.read(path)
    assert mesh.points.dtype == np.float64
    np.testing.assert_array_equal(mesh.points, position)
    (cells,) = mesh.cells
    assert cells.type == "vertex"
    np.testing.assert_array_equal(cells.data, np.arange(n)[:, None])
    assert_same(mesh.point_data, written)


@pytest.mark.parametrize("n", [1, 2, 3, 4, 50])
def test_hexahedra_read_back_by_pyvista_and_meshio(tmp_path, n):
    path = tmp_path / "grid_1.vtu"
    unit = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    layers = [unit + [0, 0, height] for height in range(n + 1)]
    points = np.concatenate(layers)
    connectivity = np.arange(8) + 4 * np.arange(n)[:, None]
    on_points = {"Mass": generator.normal(size=4 * n + 4), "Velocity": points * 2}
    on_cells = {"CellId": np.arange(n, dtype=np.uint64), "v": generator.normal(size=(n, 3))}
    write_hexahedra(path, points, connectivity, on_points, on_cells)

    grid = pyvista.read(path)
    assert (grid.celltypes == 12).all()
    np.testing.assert_array_equal(grid.cell_connectivity.reshape(n, 8), connectivity)
    np.testing.assert_allclose(grid.compute_cell_sizes()["Volume"], np.ones(n), rtol=1e-12)
    assert_same(dict(grid.point_data), on_points)
    assert_same(dict(grid.cell_data), on_cells)

    mesh = meshio.read(path)
    (cells,) = mesh.cells
    assert cells.type == "hexahedron"
    np.testing.assert_array_equal(cells.data, connectivity)
    np.testing.assert_array_equal(mesh.points, points)
    assert_same(mesh.point_data, on_points)
    assert_same({name: values for name, (values,) in mesh.cell_data.items()}, on_cells)


def test_values_that_are_not_finite_survive(tmp_path):
    values = np.array([np.nan, np.inf, -np.inf, -0.0, 5e-324])
    write_points(tmp_path / "a.vtu", np.zeros((5, 3)), {"v": values})
    read = pyvista.read(tmp_path / "a.vtu")["v"]
    assert read.tobytes() == values.tobytes()


def test_no_points(tmp_path):
    write_points(tmp_path / "a.vtu", np.zeros((0, 3)), {"id": np.zeros(0, np.uint64)})
    grid = pyvista.read(tmp_path / "a.vtu")
    assert (grid.n_points, grid.n_cells) == (0, 0)


def test_arrays_that_are_not_contiguous(tmp_path):
    position = np.asfortranarray(generator.normal(size=(7, 3)))
    stress = generator.normal(size=(7, 6))
    write_points(tmp_path / "a.vtu", position[::-1], {"xx": stress[:, 0], "v": stress[:, ::2]})
    grid = pyvista.read(tmp_path / "a.vtu")
    np.testing.assert_array_equal(grid.points, position[::-1])
    assert_same(dict(grid.point_data), {"xx": stress[:, 0], "v": stress[:, ::2]})


def test_names_with_markup_and_letters_beyond_ascii(tmp_path):
    name = "σ <a> & \"b\" 'c'"
    write_points(tmp_path / "a.vtu", np.zeros((2, 3)), {name: np.ones(2)})
    assert list(pyvista.read(tmp_path / "a.vtu").point_data) == [name]
    assert list(meshio.read(tmp_path / "a.vtu").point_data) == [name]


@pytest.mark.parametrize(
    ("field", "error", "message"),
    [
        (np.zeros(4), ValueError, r"'f' of shape \(4,\) needs 5 rows"),
        (np.zeros((5, 3, 3)), ValueError, "'f' of shape"),
        (np.zeros(5, dtype=bool), TypeError, "'f' has the type bool"),
        (np.zeros(5, dtype=complex), TypeError, "unknown to VTK"),
    ],
)
def test_a_field_that_does_not_fit_is_refused_and_nothing_written(tmp_path, field, error, message):
    with pytest.raises(error, match=message):
        write_points(tmp_path / "a.vtu", np.zeros((5, 3)), {"f": field})
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_leaves_nothing_behind_and_the_old_file_intact(tmp_path):
    resource = pytest.importorskip("resource")
    write_points(tmp_path / "old.vtu", np.zeros((1, 3)), {})
    old = (tmp_path / "old.vtu").read_bytes()
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, limits[1]))
    try:
        for name in ("old.vtu", "new.vtu"):
            with pytest.raises(OSError):
                write_points(tmp_path / name, np.zeros((10_000, 3)), {})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert [path.name for path in tmp_path.iterdir()] == ["old.vtu"]
    assert (tmp_path / "old.vtu").read_bytes() == old


def test_the_order_of_fields_is_kept(tmp_path):
    names = ["b", "a", "Z", "0"]
    write_points(tmp_path / "a.vtu", np.zeros((2, 3)), {name: np.ones(2) for name in names})
    heading = (tmp_path / "a.vtu").read_bytes()
    places = [heading.index(f'Name="{name}"'.encode()) for name in names]
    assert places == sorted(places)
