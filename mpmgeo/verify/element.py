"""One point of a material, driven by strains or stresses: what a laboratory does with a sample.

    element = Element(law)
    element.control(stress={"xx": -100e3, "yy": -100e3, "zz": -100e3})
    path = element.control(strain={"zz": -0.05}, stress={"xx": -100e3, "yy": -100e3}, steps=500)

The point goes through the update of the particles. The strains that give wanted stresses are found
by Newton's method, step by step, with the tangent from differences; where the tangent is singular,
as in plastic flow, they are the smallest of those.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.materials.hyperelastic import is_hyperelastic
from mpmgeo.materials.rotation import ROTATIONS
from mpmgeo.mpm.core.point import advance
from mpmgeo.numerics.jit import compiled
from mpmgeo.state.particles import IDENTITY

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")
MOST_TRIES = 50
PROBE = 1e-8
"""Strain by which a tangent is measured."""
ACCURACY = 1e-10
"""Difference to a wanted stress, relative to the largest stress, that is none."""


class Path(NamedTuple):
    """What a point went through: strain, stress [Pa] (steps, 6), state (steps, k)."""

    strain: np.ndarray
    stress: np.ndarray
    state: np.ndarray

    def component(self, name: str) -> tuple[np.ndarray, np.ndarray]:
        """Return strain and stress (steps,) of the component xx, yy, zz, xy, yz or xz."""
        c = COMPONENTS.index(name)
        return self.strain[:, c], self.stress[:, c]


@compiled
def advance_points(law, rotation, strain, spin, V, stress, state, dt, F=None):
    """Update stress (n, 6), state (n, k), F (n, 9) for strains (n, 6) and spins (n, 3)."""
    for p in range(len(V)):
        e, w = strain[p], spin[p]
        ε = (e[0], e[1], e[2], e[3], e[4], e[5])
        W = w[0], w[1], w[2]
        advance(law, rotation, ε, W, V, stress, state, None, None, None, F, p, dt)


class Element:
    """A point of a material with its stress (6,) [Pa], strain (6,) [-] and state (k,).

    `F` (9,): deformation gradient of a law that wants one, None for others.
    """

    def __init__(self, law, stress=(0.0,) * 6, time_step=1e-3, as_mpm_geomechanics=False):
        self.symbols = law.symbols_as_mpm_geomechanics if as_mpm_geomechanics else law.symbols
        self.rotation = ROTATIONS[law.objective_rate]
        self.time_step = time_step
        self.stress = np.array(stress, float)
        self.strain = np.zeros(6)
        self.state = np.zeros(len(self.symbols.STATE))
        self.F = np.array(IDENTITY) if is_hyperelastic(self.symbols) else None

    def drive(self, strain, steps: int = 1, spin=(0.0, 0.0, 0.0)) -> Path:
        """Apply a strain (6,), and a spin W_xy, W_yz, W_xz, in equal steps; returns the path."""
        strain, spin = np.asarray(strain, float) / steps, np.asarray(spin, float) / steps
        return _path(self._apply(strain, *self._response(strain, spin)) for _ in range(steps))

    def control(self, strain=None, stress=None, steps: int = 1) -> Path:
        """Change strains by what `strain` says, bring stresses to what `stress` says, in steps.

        Both are dictionaries by component; strains of neither do not change. Raises RuntimeError
        where no strain gives the wanted stress.
        """
        given, wanted = strain or {}, stress or {}
        increment = np.zeros(6)
        for name, value in given.items():
            increment[COMPONENTS.index(name)] = value / steps
        free = [COMPONENTS.index(name) for name in wanted]
        start, end = self.stress[free], np.array(list(wanted.values()), float)
        targets = (start + (end - start) * n / steps for n in range(1, steps + 1))
        return _path(self._reach(increment, free, target) for target in targets)

    def _response(self, strain, spin=(0.0, 0.0, 0.0)):
        """Return stress, state and F after a strain increment, without applying it."""
        stress = self.stress[None].copy()
        state = self.state[None].copy() if len(self.state) else None
        F = None if self.F is None else self.F[None].copy()
        strain, spin = np.array(strain, float)[None], np.array(spin, float)[None]
        arguments = (strain, spin, np.ones(1), stress, state, self.time_step, F)
        advance_points(self.symbols, self.rotation, *arguments)
        state = self.state if state is None else state[0]
        return stress[0], state, None if F is None else F[0]

    def _apply(self, strain, stress, state, F):
        self.strain, self.stress, self.state, self.F = self.strain + strain, stress, state, F
        return self.strain, self.stress, self.state

    def _reach(self, strain, free, target):
        """Apply the strain that is given but for its `free` components and gives the target."""
        strain = strain.copy()
        for _ in range(MOST_TRIES):
            stress, *others = self._response(strain)
            error = stress[free] - target
            if np.abs(error).max(initial=0.0) <= ACCURACY * np.abs(stress).max():
                return self._apply(strain, stress, *others)
            probes = [self._response(strain + PROBE * np.eye(6)[c])[0][free] for c in free]
            tangent = (np.array(probes).T - stress[free][:, None]) / PROBE
            strain[free] -= np.linalg.lstsq(tangent, error, rcond=1e-6)[0]
        raise RuntimeError(f"no strain gives the stress {target} Pa after {stress} Pa")


def _path(steps):
    return Path(*map(np.array, zip(*steps, strict=True)))
