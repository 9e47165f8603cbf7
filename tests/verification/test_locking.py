"""The cure of volumetric locking: Cook's membrane, energy, what it must leave as it is."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate
from skfem import (
    Basis,
    BilinearForm,
    ElementQuad2,
    ElementVector,
    FacetBasis,
    LinearForm,
    MeshQuad,
    asm,
    condense,
    solve,
)
from skfem.helpers import ddot, div, sym_grad
from skfem.models.elasticity import lame_parameters

SCHEMES = ["USL", "MUSL", "USF"]
CELLS = {"volumetric_locking": "cells"}
WIDTH, LEFT, RIGHT, TOP = 48.0, 44.0, (44.0, 60.0), 62.0  # [m] of Cook's membrane
YOUNG, POISSON, LOAD = 1e6, 0.4999, 1000.0  # load [N/m]


def deflection_of_elements(count):
    """Return the mean deflection [m] of the loaded edge by count² quadratic elements.

    Plane strain; the volume strain is integrated at 2 × 2 points.
    """
    side = np.linspace(0.0, 1.0, count + 1)
    square = MeshQuad.init_tensor(side, side)
    s, t = square.p
    low, high = LEFT * s, LEFT + (RIGHT[1] - LEFT) * s
    mesh = MeshQuad(np.array([WIDTH * s, low + t * (high - low)]), square.t)
    element = ElementVector(ElementQuad2())
    full, reduced = Basis(mesh, element, intorder=5), Basis(mesh, element, intorder=2)
    λ, G = lame_parameters(YOUNG, POISSON)
    shape = BilinearForm(lambda u, v, w: 2 * G * ddot(sym_grad(u), sym_grad(v)))
    volume = BilinearForm(lambda u, v, w: λ * div(u) * div(v))
    edge = FacetBasis(mesh, element, facets=mesh.facets_satisfying(lambda x: x[0] == WIDTH))
    mean = asm(LinearForm(lambda v, w: v[1] / (RIGHT[1] - RIGHT[0])), edge)
    clamped = full.get_dofs(lambda x: x[0] == 0.0).all()
    u = solve(*condense(asm(shape, full) + asm(volume, reduced), LOAD * mean, D=clamped))
    return mean @ u


def membrane(h, **keys):
    """Return the case of Cook's membrane in cells of h [m], four particles in each at rest."""
    outline = [[0, 0, 0], [WIDTH, 0, RIGHT[0]], [WIDTH, 0, RIGHT[1]], [0, 0, LEFT]]
    body = {
        "type": "polygon_2d",
        "points": outline,
        "extrude_direction": "y",
        "extrude_displacement": h,
        "discretization_length": h,
    }
    last = {
        "point_p1": [WIDTH - h / 2, 0, 0],
        "point_p2": [WIDTH, h, TOP],
        "load": [0, 0, LOAD * h],
    }
    return scene(
        [round(WIDTH / h) + 2, 1, round(TOP / h) + 1],
        h,
        [body],
        materials=[
            {"type": "elastic", "id": 1, "density": 1e3, "young": YOUNG, "poisson": POISSON}
        ],
        boundary_conditions={"plane_X0": "fixed", "plane_Z0": "free", "plane_Zn": "free"}
        | {"plane_Xn": "free"},
        critical_time_step_multiplier=0.26,
        damping={"type": "kinetic"},
        load_distributed_box=[last],
        **{"time": 12.0} | keys,
    )


def deflection(h, **keys):
    """Return the mean deflection [m] of the last column of particles at rest."""
    simulation = simulate(membrane(h, **keys))
    last = simulation.field("position")[:, 0] > WIDTH - h / 2
    simulation.run()
    return simulation.field("displacement")[last, 2].mean()


@pytest.mark.slow
def test_cooks_membrane():
    """Nearly incompressible, small displacements: within 5 % of finite elements, not without."""
    expected = deflection_of_elements(16)
    assert expected == pytest.approx(deflection_of_elements(8), rel=0.01)
    assert deflection(2.0, **CELLS) == pytest.approx(expected, rel=0.05)
    assert deflection(2.0) < 0.7 * expected


def test_coarse_membrane():
    """Cells twice as large, half as long."""
    found = deflection(4.0, time=6.0, **CELLS)
    assert found == pytest.approx(deflection_of_elements(8), rel=0.08)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_uniform_strain_stays_as_it_is(scheme):
    """To round-off, in a flow that strains all particles alike, far from planes."""
    L = np.array([[0.3, 0.2, -0.1], [0.5, -0.4, 0.2], [0.1, 0.3, 0.6]])
    found = []
    for keys in ({}, CELLS):
        case = scene([8, 8, 8], 0.1, [cuboid([0.2] * 3, [0.6] * 3)], time=1.0, **keys)
        simulation = simulate(case | {"stress_scheme_update": scheme, "time_step": 1e-4})
        x = simulation.field("position")
        simulation.assign("velocity", (x - 0.4) @ L.T)
        simulation.assign("stress", np.tile([1e3, -2e3, 5e2, 3e2, 1e2, -4e2], (len(x), 1)))
        inside = (np.abs(x - 0.4) < 0.05).all(axis=1)
        simulation.step()
        found.append((simulation.field("stress")[inside], simulation.field("volume")[inside]))
    for own, shared in zip(*found, strict=True):
        np.testing.assert_allclose(own, shared, rtol=1e-13)


def vibrating(scheme, poisson=0.499, **keys):
    """Return energies (n,) in relation to the first one of a block that swings on a fixed base."""
    rubber = {"type": "elastic", "id": 1, "density": 1e3, "young": 1e6, "poisson": poisson}
    case = scene(
        [8, 1, 10],
        0.1,
        [cuboid([0.2, 0, 0], [0.5, 0.1, 0.8])],
        materials=[rubber],
        boundary_conditions={"plane_Z0": "fixed", "plane_Zn": "free"},
        time=0.2,
        critical_time_step_multiplier=0.4,
        stress_scheme_update=scheme,
        **keys,
    )
    simulation = simulate(case)
    z = simulation.field("position")[:, 2]
    simulation.assign("velocity", np.column_stack([0.05 * z**2, 0 * z, 0 * z]))
    energy = []
    while simulation.time < simulation.case.time:
        simulation.step(10)
        energy.append(
            simulation.solver.tally().kinetic.sum() + simulation.solver.tally().strain.sum()
        )
    return np.array(energy) / energy[0]


@pytest.mark.parametrize("scheme", ["MUSL", "USF"])
def test_energy_of_a_vibrating_block(scheme):
    """MUSL and USF keep it: force and strain of the cure do the same work."""
    assert vibrating(scheme, **CELLS) == pytest.approx(1.0, abs=2e-3)


def test_energy_that_usl_loses():
    """Less with the cure than without."""
    without, shared = vibrating("USL")[-1], vibrating("USL", **CELLS)[-1]
    assert without < shared < 1.0001
    assert 1.0 - shared < 0.6 * (1.0 - without)


def test_energy_of_water_that_falls_down():
    """Pressures within a cell differ where particles meet; the balance of energy stays."""
    h, water = 0.1, {"type": "newtonian", "id": 1, "density": 1e3, "bulk": 2e6, "viscosity": 1e-3}
    case = scene(
        [12, 1, 8],
        h,
        [cuboid([0, 0, 0], [0.4, h, 0.6])],
        materials=[water],
        boundary_conditions={"plane_Zn": "free"},
        time=0.5,
        gravity=[0, 0, -9.81],
        critical_time_step_multiplier=0.3,
        stress_scheme_update="MUSL",
        shape_function="linear",
        results={"energy": {"every": 10}},
        **CELLS,
    )
    simulation = simulate(case).run()
    energy = simulation.energy()
    assert energy["external"] > 10.0
    assert abs(energy["balance"]) < 0.03 * energy["external"]
    assert simulation.field("volume").sum() == pytest.approx(0.4 * 0.6 * h, rel=0.01)


def test_refused_with_compatibility():
    case = scene([4, 4, 4], 0.1, [cuboid([0] * 3, [0.2] * 3)], time=1.0, **CELLS)
    with pytest.raises(ValueError, match=r"volumetric_locking.*knows no cure of locking"):
        simulate(case | {"compatibility": "mpm-geomechanics"})
