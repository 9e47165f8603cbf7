"""What particles with a velocity gradient bring to the nodes and take from them."""

import numpy as np
import pytest
from assembly import assemble, by_row, planes

from mpmgeo.shapes import SHAPES
from mpmgeo.transfers import Apic, Flip, Tpic

CELL = (1.0, 0.5, 0.8)
COUNT = 300


def cloud(transfer, **more):
    """Return the solver of particles anywhere in the mesh, with any velocity and gradient."""
    random = np.random.default_rng(3)
    fields = {
        "velocity": random.normal(size=(COUNT, 3)),
        "gradient": random.normal(size=(COUNT, 3, 3)) if transfer.is_affine else None,
        "stress": 1e3 * random.normal(size=(COUNT, 6)),
        "mass": random.uniform(100, 200, COUNT),
        "cell": CELL,
        "transfer": transfer.symbols,
    }
    return assemble(random.uniform(3.0, 9.0, (COUNT, 3)) * CELL, **(fields | more))


def angular_momentum(solver):
    """Return Σ m x × v and what the gradients add, D = h²/4 being that of the quadratic spline."""
    m, x, v, C = (by_row(solver, name) for name in "mxvC")
    spin = np.square(CELL)[:, None] / 4 * C  # D ∂v/∂x, axis after axis
    i, j = [1, 2, 0], [2, 0, 1]
    return m @ np.cross(x, v) + m @ (spin[:, i, j] - spin[:, j, i])


@pytest.mark.parametrize(
    "transfer, scheme",
    [(Apic(), "MUSL"), (Tpic(), "USF"), (Flip(flip=0.7), "USL")],
    ids=["APIC, MUSL", "TPIC, USF", "PIC, USL"],
)
def test_momentum_stays(transfer, scheme):
    solver = cloud(transfer, scheme=scheme)
    m, before = by_row(solver, "m"), by_row(solver, "v")
    for _ in range(3):
        solver.step()
    v = by_row(solver, "v")
    assert np.abs(v - before).max() > 0.1
    assert np.abs(m @ (v - before)).max() < 1e-12 * np.abs(m[:, None] * v).sum()


def test_apic_keeps_the_angular_momentum():
    """Whatever the stresses; D is the same everywhere away from walls."""
    solver = cloud(Apic(), shape=SHAPES["quadratic-bspline"])
    before, x = angular_momentum(solver), by_row(solver, "x")
    size = np.abs(by_row(solver, "m")[:, None] * np.cross(x, by_row(solver, "v"))).sum()
    for _ in range(5):
        solver.step()
    assert np.abs(angular_momentum(solver) - before).max() < 1e-12 * size
    without = by_row(solver, "m") @ np.cross(by_row(solver, "x"), by_row(solver, "v"))
    assert np.abs(without - before).max() > 1e-4 * size


@pytest.mark.parametrize(
    "transfer, shape",
    [
        (Apic(), "GIMP"),
        (Apic(), "quadratic-bspline"),
        (Apic(), "cubic-bspline"),
        (Tpic(), "GIMP"),
        (Tpic(), "cubic-bspline"),
    ],
)
def test_a_linear_field_stays_as_it_is(transfer, shape):
    """At every particle, with nobody beyond or a wall beside it."""
    random = np.random.default_rng(5)
    x = random.uniform(0.0, 4.0, (200, 3)) * CELL
    L = random.normal(size=(3, 3))
    L[:, 0] = 0.0  # at rest on the wall x = 0
    L[0] = random.normal(size=3)
    solver = assemble(
        x,
        velocity=x @ L,
        gradient=np.broadcast_to(L, (200, 3, 3)),
        cell=CELL,
        shape=SHAPES[shape],
        transfer=transfer.symbols,
        planes=planes(plane_X0="free" if shape == "GIMP" else "sliding"),
    )
    solver.step()
    np.testing.assert_allclose(by_row(solver, "v"), x @ L, atol=1e-12)
    np.testing.assert_allclose(by_row(solver, "C"), np.broadcast_to(L, (200, 3, 3)), atol=1e-10)


def test_a_blend_is_between_flip_and_the_velocity_of_the_nodes():
    found = []
    for share in (1.0, 0.6, 0.0):
        solver = cloud(Flip(flip=share))
        solver.step()
        found.append(by_row(solver, "v"))
    flip, blend, pic = found
    np.testing.assert_allclose(blend, 0.6 * flip + 0.4 * pic, atol=1e-13)
    assert np.abs(flip - pic).max() > 0.1


def test_stopping_ends_what_particles_keep():
    solver = cloud(Tpic())
    solver.stop()
    assert not by_row(solver, "v").any() and not by_row(solver, "C").any()
