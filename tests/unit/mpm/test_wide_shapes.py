"""Stencils of any width: a step compared with plain sums, and fields that it must keep."""

from itertools import product

import numpy as np
import pytest
from assembly import RUBBER, assemble, by_row, nodes
from models import Spline6, Spline10

from mpmgeo.shapes import SHAPES, shape_of
from mpmgeo.shapes.shape import cut_of, stencil, width

ALL = {name: shape_of(name) for name in SHAPES} | {"spline6": Spline6(), "spline10": Spline10()}
SHAPE = pytest.mark.parametrize("shape", ALL.values(), ids=ALL)
CELL, CELLS = np.array([0.5, 0.25, 1.0]), np.array([11, 9, 13])
MESH = {"cell": tuple(CELL), "cells": tuple(CELLS.tolist())}
GRAVITY = np.array([1.0, -2.0, -9.81])
HALF = (0.25, 0.125, 0.375)
DT = 1e-3


def plain_step(solver, h):
    """Return x, v, V, stress of all particles after a step of stress last, on a dense grid."""
    shape, ghosts = solver.shape, width(solver.shape)
    x, v, m, V, stress = (by_row(solver, name) for name in ("x", "v", "m", "V", "stress"))
    g = x / CELL
    first = np.floor(g - 0.5 * (ghosts - 2)).astype(int)
    s = g - first - 0.5 * (ghosts - 1)
    no_cut = cut_of(shape, None, 0)
    values = [[stencil(shape, s[p, a], HALF[a], no_cut) for a in range(3)] for p in range(len(x))]
    N, G = np.split(np.array(values), 2, axis=2)
    G = G / CELL[:, None]
    σ = stress[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
    terms = []
    for i, j, k in product(range(ghosts), repeat=3):
        node = tuple((first + [i, j, k] + ghosts).T)
        w = N[:, 0, i] * N[:, 1, j] * N[:, 2, k]
        slope = np.stack([G[:, 0, i], N[:, 0, i], N[:, 0, i]], axis=1)
        slope *= np.stack([N[:, 1, j], G[:, 1, j], N[:, 1, j]], axis=1)
        slope *= np.stack([N[:, 2, k], N[:, 2, k], G[:, 2, k]], axis=1)
        terms.append((node, w, slope))
    room = tuple(CELLS + 2 * ghosts + 1)
    M, P, F = np.zeros(room), np.zeros((*room, 3)), np.zeros((*room, 3))
    for node, w, slope in terms:
        np.add.at(M, node, w * m)
        np.add.at(P, node, (w * m)[:, None] * v)
        force = (w * m)[:, None] * GRAVITY - V[:, None] * np.einsum("pij,pj->pi", σ, slope)
        np.add.at(F, node, force)
    M[M == 0] = np.inf
    A = F / M[..., None]
    U = P / M[..., None] + A * h
    L = sum(U[node][:, :, None] * slope[:, None, :] for node, _, slope in terms)
    x = x + DT * sum(w[:, None] * U[node] for node, w, _ in terms)
    v = v + h * sum(w[:, None] * A[node] for node, w, _ in terms)
    ε = 0.5 * (L + L.transpose(0, 2, 1)) * DT
    trace = np.trace(ε, axis1=1, axis2=2)
    λ, G2 = RUBBER.symbols
    new = stress + G2 * ε[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
    new[:, :3] += λ * trace[:, None]
    return {"x": x, "v": v, "V": V * (1 + trace), "stress": new}


@SHAPE
def test_two_steps_agree_with_plain_sums(shape):
    """Particles all over the mesh, to its corners: blocks on both sides of zero."""
    random = np.random.default_rng(width(shape))
    position = random.uniform(0.02, 0.98, (200, 3)) * CELLS * CELL
    solver = assemble(
        position,
        velocity=random.normal(size=(200, 3)),
        stress=random.normal(size=(200, 6)) * 1e3,
        mass=random.uniform(1.0, 3.0, 200),
        volume=CELL.prod() / 8,
        shape=shape,
        half=HALF,
        split=2,
        gravity=tuple(GRAVITY),
        time_step=DT,
        **MESH,
    )
    for h in (DT / 2, DT):
        expected = plain_step(solver, h)
        solver.step()
        for name, values in expected.items():
            size = np.abs(values).max()
            np.testing.assert_allclose(by_row(solver, name), values, rtol=0, atol=1e-11 * size)


def lattice(shape, count=8, **more):
    """Return the solver of count³ particles that stand evenly, one in each cell, inside a mesh."""
    steps = np.stack(np.meshgrid(*[np.arange(count) + 0.5] * 3, indexing="ij"), -1).reshape(-1, 3)
    position = (steps + 3.0) * CELL
    cells = 3 * (count + 10,)
    solver = assemble(position, shape=shape, half=HALF, **(MESH | {"cells": cells}), **more)
    solver.small = True  # whatever the count, so that no other kernels are compiled
    return solver


@SHAPE
def test_mass_and_momentum_reach_the_nodes(shape):
    random = np.random.default_rng(1)
    solver = lattice(
        shape,
        velocity=random.normal(size=(512, 3)),
        stress=random.normal(size=(512, 6)) * 1e6,
        mass=random.uniform(1, 2, 512),
        gravity=tuple(GRAVITY),
    )
    solver.arrange()
    m, p = by_row(solver, "m"), by_row(solver, "m") @ by_row(solver, "v")
    solver.scatter()
    solver.update_momentum(0.0)
    _, mass, velocity, acceleration = nodes(solver)
    assert mass.sum() == pytest.approx(m.sum(), rel=1e-13)
    assert mass @ velocity == pytest.approx(p, rel=1e-12)
    # inner forces cancel: 1e6 Pa on 512 particles leave nothing but the weight
    size = np.abs(mass[:, None] * acceleration).sum()
    assert np.abs(mass @ acceleration - m.sum() * GRAVITY).max() < 1e-13 * size


@SHAPE
def test_rigid_translation(shape):
    """Over many cells and blocks: velocities stay, no stress appears.

    The widest shapes have nodes of hardly any mass, whose velocities are round-off.
    """
    velocity = np.array([30.0, 10.0, 40.0])
    solver = lattice(shape, velocity=velocity, mass=125.0, cutoff=1e-10, time_step=DT)
    start = by_row(solver, "x")
    for _ in range(50):
        solver.step()
    assert by_row(solver, "v") == pytest.approx(np.tile(velocity, (512, 1)), rel=1e-9)
    moved = by_row(solver, "x") - start
    assert moved == pytest.approx(np.tile(50 * DT * velocity, (512, 1)), rel=1e-9)
    assert np.abs(by_row(solver, "stress")).max() < 1e-9 * RUBBER.young
    assert by_row(solver, "V") == pytest.approx(np.full(512, 0.125), rel=1e-9)


@SHAPE
def test_gradient_of_a_linear_field(shape):
    """Nodes get the exact velocity where particles stand evenly around, and give it back."""
    gradient = np.array([[1.0, 0.5, 0.2], [0.1, -2.0, 0.4], [0.3, 0.6, 0.7]])
    solver = lattice(shape, count=2 * width(shape) + 2, time_step=DT)
    offset = by_row(solver, "x") - by_row(solver, "x").mean(axis=0)
    solver.sets[0].v[:] = offset @ gradient.T
    solver.step()
    inner = (np.abs(offset) < CELL).all(axis=1)
    assert np.count_nonzero(inner) == 8
    ε = (gradient + gradient.T) / 2 * DT
    λ, G2 = RUBBER.symbols
    expected = (λ * np.trace(ε) * np.eye(3) + G2 * ε)[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
    assert by_row(solver, "stress")[inner] == pytest.approx(np.tile(expected, (8, 1)), rel=1e-10)
    assert by_row(solver, "V")[inner] == pytest.approx(np.full(8, 0.125 * (1 + np.trace(ε))))
    assert by_row(solver, "v")[inner] == pytest.approx(offset[inner] @ gradient.T, rel=1e-12)
