"""One-way coupling: total stress balances the weight, the law knows the effective stress alone."""

import json

import numpy as np
import pytest
from scenes import cuboid, initial_position, scene, simulate

DENSITY, WATER, G, HEIGHT = 2000.0, 9810.0, 9.81, 3.0


def hydrostatic(path, cell, width):
    """Write the pressure under a table at the top at the corners of all cells; return the file."""
    z = np.arange(0.0, HEIGHT + cell / 2, cell)
    x = np.arange(0.0, width + cell / 2, cell)
    points = np.stack(np.meshgrid(x, x, z, indexing="ij"), -1).reshape(-1, 3)
    entries = [{"position": p.tolist(), "pressure": WATER * (HEIGHT - p[2])} for p in points]
    path.write_text(json.dumps(entries))
    return str(path)


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_saturated_column_bears_its_buoyant_weight(tmp_path, scheme):
    cell = 0.25
    file = hydrostatic(tmp_path / "p.json", cell, cell)
    case = scene(
        [1, 1, 14],
        cell,
        [cuboid([0, 0, 0], [cell, cell, HEIGHT])],
        materials=[{"type": "elastic", "id": 1, "density": DENSITY, "young": 20e6, "poisson": 0.2}],
        time=1.5,
        critical_time_step_multiplier=0.5,
        gravity=[0, 0, -G],
        damping={"type": "kinetic"},
        stress_scheme_update=scheme,
        hydro_mechanical_coupling={
            "enabled": True,
            "pore_pressure_field": file,
            "interpolation": "linear",
        },
        results={"probes": [{"type": "planes", "every": 1}]},
    )
    simulation = simulate(case).run()
    assert not [text for text in simulation.messages if not text.startswith("plane strain")]
    z = initial_position(simulation)[:, 2]
    pressure = simulation.field("pore_pressure")
    assert pressure == pytest.approx(WATER * (HEIGHT - z), rel=1e-9)
    np.testing.assert_array_equal(simulation.field("pressure"), pressure)
    effective = -(DENSITY * G - WATER) * (HEIGHT - z)
    # a particle bears the mean stress of its cell, so pairs of particles are compared
    vertical = simulation.field("stress")[:, 2]
    found, wanted = (s.reshape(-1, 8).mean(axis=1) for s in (vertical, effective))
    assert found == pytest.approx(wanted, abs=0.01 * -effective.min())
    forces, weight = simulation.reactions(), DENSITY * G * HEIGHT * cell**2
    assert forces["Z0"][2] == pytest.approx(weight, rel=1e-3)
    # the walls bear effective stress, K0 = ¼ of the vertical one, and water
    wall = HEIGHT**2 / 2 * cell * (WATER + 0.25 * (DENSITY * G - WATER))
    assert forces["X0"][0] == pytest.approx(wall, rel=0.01)


def test_what_finds_no_partner_is_told_once(tmp_path):
    file = tmp_path / "p.json"
    points = [[0.125, 0.125, 0.125], [9, 9, 9], [0, 0, -5]]
    file.write_text(json.dumps([{"position": p, "pressure": 5.0} for p in points]))
    case = scene(
        [2, 2, 2],
        0.5,
        [cuboid([0, 0, 0], [0.5, 0.5, 0.5])],
        time=1.0,
        hydro_mechanical_coupling={"enabled": True, "pore_pressure_field": str(file)},
        plane_strain="off",
    )
    simulation = simulate(case).step(2)
    assert simulation.field("pressure").tolist() == [5.0] + [0.0] * 7
    assert simulation.messages == [
        "hydro_mechanical_coupling: 2 of 3 points are near no particle, the first of them entry 2 "
        "at (9, 9, 9) m",
        "hydro_mechanical_coupling: 7 of 8 particles are near no point and keep the pore pressure "
        "0, the first of them row 1 at (0.375, 0.125, 0.125) m",
    ]


def test_a_case_without_pays_nothing():
    case = scene([2, 2, 2], 0.5, [cuboid([0, 0, 0], [0.5, 0.5, 0.5])], time=1.0)
    (only,) = simulate(case).solver.sets
    assert only.pressure is None
    assert only.strain is None
