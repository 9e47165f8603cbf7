"""The stages of two phases against the same steps as sums over all particles and nodes."""

import numpy as np
import pytest

import mpmgeo
from mpmgeo.materials.law import update_stress
from mpmgeo.shapes.shape import cut_of, stencil, width
from mpmgeo.verify.dense_grid import Box, free_components

STEPS = 12
WALLS = {"plane_X0": "free", "plane_Y0": "sliding", "plane_Z0": "fixed", "plane_Zn": "free"}


def scene(**keys):
    """Two saturated bodies that meet in a corner of a mesh of flat cells."""
    soil = {
        "type": "elastic",
        "id": 1,
        "density": 2600.0,
        "young": 2e6,
        "poisson": 0.2,
        "density_fluid": 1000.0,
        "porosity": 0.4,
        "bulk_fluid": 4e6,
        "hydraulic_conductivity": [1e-3, 1e-2, 1e-4],
    }
    other = {"id": 2, "porosity": 0.25, "density_fluid": 900.0, "hydraulic_conductivity": 3 * [0.1]}
    block = {"type": "cuboid", "point_p1": [0.3, -0.5, -1.0], "point_p2": [0.75, -0.3, -0.85]}
    ball = {"type": "sphere", "center": [0.6, -0.35, -0.7], "diameter": 0.25}
    return {
        "time": 1.0,
        "time_step": 2e-4,
        "n_phases": 2,
        "gravity": [3.0, 0.0, -9.81],
        "mesh": {
            "cells_number": [5, 5, 8],
            "cells_dimension": [0.15, 0.1, 0.075],
            "origin": [0.3, -0.5, -1.0],
            "boundary_conditions": {"plane_Y0": "fixed", "plane_Zn": "free"},
            "boundary_conditions_fluid": WALLS,
        },
        "materials": [soil, soil | other],
        "body": [block | {"material_id": 1}, ball | {"material_id": 2}],
    } | keys


class Twin:
    """All particles in row order, with dense matrices of weights W (n, nodes) and slopes G."""

    def __init__(self, solver, smooth):
        self.s, self.smooth, self.steps = solver, smooth, 0
        mesh, n = solver.grid.mesh, solver.count
        self.box = Box.of(mesh, solver.planes, ghosts=3)
        self.planes = free_components(self.box, solver.planes).reshape(-1, 3)
        self.walls = free_components(self.box, solver.effect("fluid").walls).reshape(-1, 3)
        for name in ("x", "v", "vf", "stress", "m", "mf", "pf", "V", "pull", "half", "free"):
            first = getattr(solver.sets[0], name)
            columns = 3 if name == "half" else first.shape[1] if first.ndim > 1 else 0
            all_rows = np.zeros((n, columns) if columns else n)
            for s in solver.sets:
                all_rows[s.row] = getattr(s, name)
            setattr(self, name, all_rows)
        self.fluid = np.zeros((n, 6))
        self.law = [None] * n
        for s in solver.sets:
            self.fluid[s.row] = s.fluid
            for row in s.row:
                self.law[row] = s.law

    def weights(self):
        """Return W and G for the present positions."""
        S, count = width(self.s.shape), [c + 1 + 2 * self.box.ghosts for c in self.box.cells]
        W, G = np.zeros((len(self.x), *count)), np.zeros((len(self.x), *count, 3))
        for p, x in enumerate(self.x):
            g = x / self.box.cell
            first = np.floor(g - 0.5 * (S - 2)).astype(int)
            middle = g - first - 0.5 * (S - 1)
            inputs = middle, self.half[p], first, self.box.lower, self.box.upper
            parts = [
                np.array(stencil(self.s.shape, s, l, cut_of(self.s.shape, walls, f)))
                for s, l, f, *walls in zip(*inputs, strict=True)
            ]
            i, j, k = (slice(f + self.box.ghosts, f + self.box.ghosts + S) for f in first)
            w, d = [a[:S] for a in parts], [a[S:] for a in parts]
            W[p, i, j, k] = np.einsum("i,j,k", *w)
            for axis in range(3):
                along = [d[a] / self.box.cell[a] if a == axis else w[a] for a in range(3)]
                G[p, i, j, k, axis] = np.einsum("i,j,k", *along)
        return W.reshape(len(self.x), -1), G.reshape(len(self.x), -1, 3)

    def means(self, value):
        """Return the means over the particles of one material in each cell."""
        cell = np.floor(self.x / self.box.cell).astype(int)
        cell = np.column_stack([cell, self.s.population.material])
        _, cell = np.unique(cell, axis=0, return_inverse=True)
        return (np.bincount(cell, self.V * value) / np.bincount(cell, self.V))[cell]

    def share_pressures(self):
        cell = np.floor(self.x / self.box.cell).astype(int)
        _, cell = np.unique(cell, axis=0, return_inverse=True)
        weight = self.V * self.free
        with np.errstate(invalid="ignore"):
            mean = np.bincount(cell, weight * self.pf) / np.bincount(cell, weight)
        self.pf = np.where(self.free > 0, mean[cell], self.pf)

    def nodal(self, W, values):
        return W.T @ values

    def forces(self, W, G):
        """Return the accelerations without drag, of solid and fluid, and the drag coefficient."""
        ρ, d = self.fluid[:, 1], self.fluid[:, 3:]
        xx, yy, zz, xy, yz, xz = self.stress.T
        σ = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        if self.s.cells is not None:
            mean = (xx + yy + zz) / 3
            σ = σ + (self.means(mean) - mean) * np.eye(3)[:, :, None]
        inner = -np.einsum("p,abp,pnb->na", self.V, σ, G)
        push = np.einsum("p,pna->na", self.V * self.pf, G)
        n = (W.T @ (self.mf / ρ) / self.volume)[:, None]
        pull, gravity = W.T @ self.pull, np.array(self.s.gravity)
        solid = inner + self.M[:, None] * gravity + (1 - n) * push - pull
        fluid = n * push + self.F[:, None] * gravity + pull
        drag = W.T @ ((self.mf**2 / self.V)[:, None] * d)
        return solid / self.M[:, None], fluid / self.F[:, None], drag, n

    def step(self):
        """USL or MUSL, with all that the solver does with walls, drag and damping."""
        dt, h = self.s.time_step, self.s.time_step * (0.5 if self.steps == 0 else 1.0)
        if self.smooth:
            self.share_pressures()
        W, G = self.weights()
        here = W.sum(axis=0) > 0
        W, G, planes, walls = W[:, here], G[:, here], self.planes[here], self.walls[here]
        self.M, self.F, self.volume = W.T @ self.m, W.T @ self.mf, W.T @ self.V
        v = planes * (W.T @ (self.m[:, None] * self.v)) / self.M[:, None]
        u = walls * (W.T @ (self.mf[:, None] * self.vf)) / self.F[:, None]
        a, b, c, n = self.forces(W, G)
        a, b = planes * a, walls * b
        w, wf = planes / self.M[:, None], walls / self.F[:, None]
        D = c * (u - v + h * (b - a)) / (1 + h * c * (w + wf))
        a, b = a + w * D, b - wf * D
        if self.s.damping:
            a, b = self.damped(a, v, planes), self.damped(b, u, walls)
        moving = self.M[:, None] > self.s.cutoff
        v, u = v + h * a * moving, u + h * b * moving
        self.v, self.vf = self.v + h * W @ a, self.vf + h * W @ b
        drift = v
        if self.s.scheme.__name__.startswith("musl"):
            v = planes * (W.T @ (self.m[:, None] * self.v)) / self.M[:, None]
            u = walls * (W.T @ (self.mf[:, None] * self.vf)) / self.F[:, None]
        q = v + n * (u - v)
        porosity = 1 - self.m / (self.fluid[:, 2] * self.V)
        self.pf -= self.free * self.fluid[:, 0] / porosity * dt * np.einsum("pna,na->p", G, q)
        self.strain(np.einsum("na,pnb->pab", v, G) * dt, dt)
        self.x = self.x + dt * W @ drift
        self.steps += 1

    def damped(self, a, v, free):
        a0, v0 = free * a, free * v
        size, speed = (np.linalg.norm(z, axis=1, keepdims=True) for z in (a0, v0))
        return a - self.s.damping[0].α * size * np.divide(v0, speed, where=speed > 0, out=0 * v0)

    def strain(self, L, dt):
        if self.s.cells is not None:
            θ = np.trace(L, axis1=1, axis2=2)
            L = L + (self.means(θ) - θ)[:, None, None] * np.eye(3) / 3
        e = (L + L.transpose(0, 2, 1)) / 2
        strain = np.stack(
            [e[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))], 1
        )
        self.V = self.V * (1 + strain[:, :3].sum(axis=1))
        for p, law in enumerate(self.law):
            self.stress[p] = update_stress(law, tuple(self.stress[p]), tuple(strain[p]), (), dt)


CASES = {
    "USL": {},
    "MUSL, damped": {
        "stress_scheme_update": "MUSL",
        "damping": {"type": "local", "value": 0.3},
        "pore_pressure_smoothing": False,
    },
    "USL, shared cells": {"volumetric_locking": "cells"},
    "USL, linear": {"shape_function": "linear"},
    "USL, quadratic": {"shape_function": "quadratic-bspline"},
    "MUSL, cubic": {"shape_function": "cubic-bspline", "stress_scheme_update": "MUSL"},
}


@pytest.mark.parametrize("name", CASES)
def test_steps_are_those_of_the_twin(name):
    low, high = [0, -1, -1], [2, 0, -0.95]
    case = scene(
        prescribed_pressure_box=[{"point_p1": low, "point_p2": high, "pressure": 100.0}],
        pressure_force_box=[{"point_p1": low, "point_p2": high, "pressure_force": [1, 0, 2]}],
        **CASES[name],
    )
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case))
    random = np.random.default_rng(3)
    count = simulation.solver.count
    simulation.assign("velocity", random.uniform(-3, 3, (count, 3)))
    simulation.assign("stress", random.uniform(-1e4, 1e4, (count, 6)))
    simulation.assign("velocity_fluid", random.uniform(-3, 3, (count, 3)))
    simulation.assign("pressure", random.uniform(0, 1e4, count))
    twin = Twin(simulation.solver, case.get("pore_pressure_smoothing", True))
    for _ in range(STEPS):
        simulation.step()
        twin.step()
    names = {"position": "x", "velocity": "v", "velocity_fluid": "vf", "stress": "stress"}
    for key, attribute in (names | {"pressure": "pf", "volume": "V"}).items():
        found, wanted = simulation.field(key), getattr(twin, attribute)
        found = found - simulation.case.mesh.origin if key == "position" else found
        assert np.abs(found - wanted).max() < 1e-9 * np.abs(wanted).max(), key
    assert simulation.field("active").all()
