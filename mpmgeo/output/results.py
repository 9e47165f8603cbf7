"""Write the results of a run: particle files, grid files, their collections, kinetic energy."""

from mpmgeo.naming import GHOSTS
from mpmgeo.output.energy import EnergySeries, earlier_rows
from mpmgeo.output.grid_fields import grid_arrays
from mpmgeo.output.mesh_cells import all_cells, block_cells
from mpmgeo.output.particle_fields import particle_arrays
from mpmgeo.output.pvd import Collection, remove_previous
from mpmgeo.output.vtu import write_hexahedra, write_points
from mpmgeo.state.grid import SIDE

TERRAIN = "centroid_points_stl_contact"
MANY_CELLS = (
    10_000_000  # above this a grid file holds the touched blocks only, unless asked for all
)


class ResultFiles:
    """Watches a run and writes what the case asks for into a folder; `outputs`: when."""

    def __init__(self, folder, case, outputs):
        self.results = case.results
        of_fluid = case.results.fluid_fields if case.n_phases == 2 else ()
        self.fields = case.results.particle_fields + of_fluid
        self.mesh = case.mesh
        self.outputs = outputs
        self.folder = folder
        self.particles = Collection(folder / "particles" / "particleTimeSerie.pvd")
        self.grid = Collection(folder / "grid" / "gridTimeSerie.pvd")
        self.terrain = Collection(folder / TERRAIN / f"{TERRAIN}TimeSerie.pvd")
        self.written = None  # step of the last output
        self._cells = None

    def begin(self, simulation):
        """Remove the files of another run before, or go on with those of this one."""
        path = self.folder / "time-energy.csv"
        if simulation.goes_on:
            self._go_on(simulation, path)
            return
        for collection in self._collections(simulation):
            _, left = remove_previous(collection.path)
            if left:
                simulation.say(
                    f"{collection.path.parent} holds {len(left)} other .vtu files, "
                    f"the first of them {left[0].name}; files of this run may replace some"
                )
        self.energy = EnergySeries(path)
        self._write(simulation, first=True)

    def _collections(self, simulation):
        terrain = () if simulation.solver.ground is None else (self.terrain,)
        return (self.particles, self.grid, *terrain)

    def _go_on(self, simulation, path):
        """Take up the files as they were when the run had come to this state."""
        is_due = self.outputs.are_due(simulation)
        for collection in self._collections(simulation):
            collection.take_up(simulation.label, is_due)
        self.energy = EnergySeries(path, earlier_rows(path, simulation.label, is_due))
        self.written = simulation.steps

    def after_step(self, simulation):
        """Write an output if one is due."""
        if self.outputs.are_due(simulation):
            self._write(simulation)

    def end(self, simulation, error):
        """Write the last state of a run that did not come to its end."""
        is_cut_short = simulation.interrupted or simulation.stopped is not None
        if (error or is_cut_short) and self.written != simulation.steps:
            self._write(simulation)

    def _write(self, simulation, first=False):
        label = simulation.label
        if simulation.solver.ground is not None:
            simulation.arrange()
        if first or not self.results.particles_once:
            self._write_particles(simulation, label)
        if first or not self.results.grid_once:
            self._write_grid(simulation, label)
        if simulation.solver.ground is not None and (first or not self.results.terrain_once):
            self._write_terrain(simulation, label)
        self.energy.add(label, simulation.output_energy())
        self.written = simulation.steps

    def _write_particles(self, simulation, label):
        number = len(self.particles.entries) + 1
        path = self.particles.path.parent / f"particles_{number}.vtu"
        arrays = particle_arrays(simulation.solver, self.fields)
        write_points(path, simulation.field("position"), arrays)
        self.particles.add(label, path)
        self.particles.write()

    def _write_grid(self, simulation, label):
        number = len(self.grid.entries) + 1
        path = self.grid.path.parent / f"eulerianGrid_{number}.vtu"
        cells = self._grid_cells(simulation)
        arrays = grid_arrays(simulation.solver, cells.node_id, self.results.grid_fields)
        write_hexahedra(path, cells.points, cells.connectivity, arrays, {"CellId": cells.cell_id})
        self.grid.add(label, path)
        self.grid.write()

    def _write_terrain(self, simulation, label):
        number = len(self.terrain.entries) + 1
        path = self.terrain.path.parent / f"{TERRAIN}_{number}.vtu"
        solver = simulation.solver
        centre, normal = solver.ground.triangles()
        values = {
            "stl_density_levelset": lambda: solver.ground.density_at(solver, centre),
            "stl_normal": lambda: normal,
        }
        arrays = {key: values[key]() for key in self.results.terrain_fields}
        write_points(path, centre + solver.population.zero, arrays)
        self.terrain.add(label, path)
        self.terrain.write()

    def _grid_cells(self, simulation):
        if self._cells is not None:
            return self._cells
        x, y, z = (n + 4 for n in self.mesh.cells_number)
        if x * y * z <= MANY_CELLS or self.results.grid_all_cells:
            cells = all_cells(self.mesh)
            if not self.results.grid_once:
                self._cells = cells
            return cells
        if not self.grid.entries:
            simulation.say(
                f"the mesh has {x * y * z} cells; grid files hold those near particles "
                '(all of them with "grid_all_cells": true in results)'
            )
        simulation.arrange()
        return block_cells(self.mesh, simulation.solver.grid.active_corner * SIDE + GHOSTS)
