"""The nine kernels that MPM-Geomechanics times, done by the code of this program.

A record carries mass, momentum and external force of a node together, so that the kernels of these
three do the same work here. The check of a kernel compares with what is known exactly.
"""

import numpy as np

from mpmgeo.benchmark.loops import Spins, Strain, Strains, Stretch, SumTiles, SumWeights
from mpmgeo.mpm.core.transfer import Scatter as ScatterWork
from mpmgeo.mpm.task import Task
from mpmgeo.numerics.simd import LANES

ZERO = (0.0, 0.0, 0.0)


class ContributionNodes:
    """The weights of the 27 nodes of every particle; they sum to one."""

    name, suite = "contributionNodes", "update"

    def __init__(self, scene):
        self.scene, self.out = scene, np.zeros(scene.configuration.particles)

    def run(self):
        """Do the work that is timed."""
        self.scene.visit(SumWeights(), (self.out,))

    def error(self):
        """Return the largest relative error of the last run."""
        return np.abs(self.out - 1).max()


class ParticleDensity:
    """Volumes and densities after a volume strain."""

    name, suite = "particleDensity", "update"

    def __init__(self, scene):
        c = scene.configuration
        self.scene, self.trace = scene, c.trace_strain
        self.before = np.full(c.particles, 1 / c.density)
        self.V, self.out = self.before.copy(), np.zeros(c.particles)
        self.expected = c.density / (1 + c.trace_strain)

    def prepare(self):
        """Undo the last run."""
        self.V[:] = self.before

    def run(self):
        """Do the work that is timed."""
        self.scene.visit(Stretch(self.trace), (self.scene.particles.m, self.V, self.out))

    def error(self):
        """Return the largest relative error of the last run."""
        return np.abs(self.out / self.expected - 1).max()


class ParticleStress:
    """Elastic stress of a uniaxial strain."""

    name, suite = "particleStress", "update"

    def __init__(self, scene):
        self.scene, self.stress = scene, np.zeros((scene.configuration.particles, 6))
        ε, law = scene.configuration.strain, scene.particles.law
        self.strain = (ε, 0.0, 0.0, 0.0, 0.0, 0.0)
        self.expected = np.array([law.λ + law.G2, law.λ, law.λ, 0, 0, 0]) * ε

    def prepare(self):
        """Undo the last run."""
        self.stress[:] = 0.0

    def run(self):
        """Do the work that is timed."""
        self.scene.visit(Strain(self.scene.particles.law, self.strain), (self.stress,))

    def error(self):
        """Return the largest relative error of the last run."""
        return np.abs(self.stress - self.expected).max() / max(np.abs(self.expected).max(), 1e-300)


class Scatter:
    """Something of the particles summed at the nodes; subclasses say what."""

    suite = "interpolation"
    lanes = slice(0, 1)
    stress = force = None

    def __init__(self, scene):
        self.scene = scene
        self.velocity = np.zeros((scene.configuration.particles, 3))
        self.set_up(scene.configuration)

    def set_up(self, configuration):
        """Choose what is summed."""
        self.expected = np.array([float(configuration.particles)])

    def run(self):
        """Do the work that is timed."""
        g, s = self.scene.grid, self.scene.particles
        arrays = (self.velocity, None, s.m, s.V, self.stress, None, self.force, None)
        self.scene.visit(ScatterWork(ZERO, 0.0), arrays, (g.tiles,))
        self.scene.over_nodes(Task(SumTiles(), (g.tiles,), g.scratch, (g.nodes,)))

    def error(self):
        """Return the error of the sum over all nodes in the last run, relative to its size."""
        records = self.scene.grid.records().reshape(-1, LANES)
        total = records[:, self.lanes].sum(axis=0)
        size = np.abs(records[:, self.lanes]).sum()
        return np.abs(total - self.expected).max() / max(size, 1e-300)


class NodalMass(Scatter):
    """Mass."""

    name = "nodalMass"


class NodalMomentum(Scatter):
    """Momentum of particles with the same velocity."""

    name, lanes = "nodalMomentum", slice(1, 4)

    def set_up(self, configuration):
        """Choose what is summed."""
        self.velocity[:] = configuration.velocity
        self.expected = configuration.particles * np.array(configuration.velocity)


class NodalInternalForce(Scatter):
    """Internal force of a stress with all components 1; it sums to zero."""

    name, lanes = "nodalInternalForce", slice(4, 7)

    def set_up(self, configuration):
        """Choose what is summed."""
        self.stress, self.expected = np.ones((configuration.particles, 6)), np.zeros(3)


class NodalExternalForce(Scatter):
    """External force, the same on every particle."""

    name, lanes = "nodalExternalForce", slice(4, 7)

    def set_up(self, configuration):
        """Choose what is summed."""
        self.force = np.tile(configuration.force, (configuration.particles, 1))
        self.expected = self.force.sum(axis=0)


class Gather:
    """Something of the nodes' velocities gathered at the particles; subclasses say what."""

    suite = "interpolation"

    def __init__(self, scene):
        self.scene = scene
        self.out = np.zeros((scene.configuration.particles, self.components))
        self.set_up(scene.configuration)

    def prepare(self):
        """Give the nodes their velocities."""
        self.scene.set_nodal_velocity(self.velocity)

    def run(self):
        """Do the work that is timed."""
        self.scene.visit(self.work(self.dt), (self.out,), nodes=self.scene.grid.nodes)

    def error(self):
        """Return the largest error of the last run, relative to the largest component."""
        return np.abs(self.out - self.expected).max() / max(np.abs(self.expected).max(), 1e-300)


class ParticleStrainIncrement(Gather):
    """Strain increment where the velocity is (a x, b y, c z)."""

    name, work, components = "particleStrainIncrement", Strains, 6

    def set_up(self, configuration):
        """Choose the velocity."""
        rates = np.array(configuration.nodal_velocity)
        self.dt = configuration.strain_step
        self.velocity = lambda x: x * rates
        self.expected = np.array([*rates * self.dt, 0, 0, 0])


class ParticleVorticityIncrement(Gather):
    """Spin increment where the velocity is ω × x."""

    name, work, components = "particleVorticityIncrement", Spins, 3

    def set_up(self, configuration):
        """Choose the velocity."""
        ω = np.array(configuration.spin)
        self.dt = configuration.spin_step
        self.velocity = lambda x: np.cross(ω, x)
        self.expected = np.array([-ω[2], -ω[0], ω[1]]) * self.dt


KERNELS = (
    ContributionNodes,
    ParticleDensity,
    ParticleStress,
    NodalMass,
    NodalMomentum,
    NodalInternalForce,
    NodalExternalForce,
    ParticleStrainIncrement,
    ParticleVorticityIncrement,
)
