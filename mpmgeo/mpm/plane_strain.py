"""Plane strain: where nothing changes across the material, one layer of it is solved for all.

Between two sliding planes of an axis the layers of a body that spans the thickness, and on which
nothing acts that differs from layer to layer, do all the same: velocities across are zero, and so
are the strains. What nodes in a row across have is in one ratio, that of their masses,

    mᵢⱼₖ = mᵢₖ Σ S_j(y)/L,    vᵢⱼₖ = vᵢₖ,    fᵢⱼₖ/mᵢⱼₖ = fᵢₖ/mᵢₖ,

the sum over the L layers, as long as Σ ∂S_j/∂y over the layers is zero at the nodes between the
planes. So a particle that has the mass and the volume of its whole column moves in the plane as
each of them, with a stencil of one node across.
"""

import numpy as np

from mpmgeo.mpm.columns import EXTENSIVE, ROUND_OFF, SHEAR, are_same, to_layer
from mpmgeo.mpm.persistence import state_of
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import corners_of, cut, keys_of
from mpmgeo.state.layout import SIDE


class PlaneStrain:
    """A solver of one layer that shows all of them: the state of the `whole` follows when asked.

    `plane`: the solver of the layer, `whole`: that of all, `columns`: who stands for whom. Once
    the layers differ, because somebody has given them other values, the whole is solved.
    """

    def __init__(self, plane, whole, columns):
        self.plane, self.whole, self.columns = plane, whole, columns
        self.acting = plane
        self._shown = None  # steps of the layer in the state that the whole shows
        plane.departures.all_of = columns.rows_of
        self._across = whole.population.position[:, columns.axis]
        self._rows = [np.sort(s.row) for s in whole.sets]

    def __getattr__(self, name):
        if name in ("acting", "plane"):
            raise AttributeError(name)
        return getattr(self.acting, name)

    @property
    def is_plane(self):
        """Whether one layer is solved for all."""
        return self.acting is self.plane

    @property
    def across(self):
        """The axis along which nothing changes, None once the whole is solved."""
        return self.columns.axis if self.is_plane else None

    @property
    def count(self):
        """Number of all particles."""
        return self.whole.count

    @property
    def time_step(self):
        """The time step [s]."""
        return self.acting.time_step

    @time_step.setter
    def time_step(self, step):
        """Let the next steps be of another length [s]."""
        self.acting.time_step = step

    @property
    def active(self):
        """Number of particles that have not left the mesh."""
        return self.acting.active * (self.columns.layers if self.is_plane else 1)

    @property
    def shape(self):
        """The shape functions of the whole."""
        return self.whole.shape

    @property
    def planes(self):
        """The planes that bound the mesh."""
        return self.whole.planes

    @property
    def sets(self):
        """All particles, as they are now."""
        return self.shown().sets

    @property
    def grid(self):
        """The grid of all particles, as it is now."""
        return self.shown().grid

    def arrange(self):
        """Bring the particles in the order that looking for them by place needs."""
        self.shown().arrange()

    def shown(self):
        """Return the solver of the whole in the state of the layer."""
        if self.is_plane and self._shown != self.plane.steps:
            self._show()
            self._shown = self.plane.steps
        return self.whole

    def _show(self):
        plane, whole = self.plane, self.whole
        whole.time, whole.steps = plane.time, plane.steps
        whole.time_step, whole.previous = plane.time_step, plane.previous
        whole.population, whole.moved_origin = plane.population, plane.moved_origin
        whole.gone = whole.count
        for s, here, rows in zip(plane.sets, whole.sets, self._rows, strict=True):
            self._spread(s, here, rows)
        self._show_nodes()
        for here in whole.sets:
            here.lie_in(whole.grid)

    def _spread(self, s, here, rows):
        """Give a set of the whole the state of that of the layer, particles in the order of rows,
        those that left the mesh behind the others."""
        axis, layers = self.columns.axis, self.columns.layers
        place = np.empty(self.whole.count, np.int64)
        place[s.row] = np.arange(len(s.row))
        at = place[self.columns.first[rows]]
        if s.active < len(s.row):
            order = np.argsort(at >= s.active, kind="stable")
            rows, at = rows[order], at[order]
        for name, values in s.arrays().items():
            if name != "row":
                np.take(values, at, axis=0, out=getattr(here, name))
        for name in EXTENSIVE:
            if getattr(here, name) is not None:
                getattr(here, name)[...] /= layers
        here.row[:] = rows
        here.x[:, axis] = self._across[rows]
        here.start = np.array([0, s.active * layers])
        here.chunk = cut(here.start)

    def _show_nodes(self):
        """Give the grid of the whole the nodes of the layer, with their share of its mass."""
        axis, plane, whole = self.columns.axis, self.plane.grid, self.whole.grid
        first, share = self._shares()
        corner = np.repeat(corners_of(plane.keys), len(first), axis=0)
        corner[:, axis] = np.tile(first, len(plane.keys))
        whole.cover(np.sort(keys_of(corner)))
        if not len(plane.keys):
            return
        corner = whole.active_corner.copy()
        corner[:, axis] = 0
        at = np.minimum(np.searchsorted(plane.active, keys_of(corner)), len(plane.active) - 1)
        known = plane.active[at] == keys_of(corner)
        records = plane.records().reshape(-1, *plane.sides, 8)[at]
        records = np.repeat(records, SIDE, axis=1 + axis)
        records[~known] = 0.0
        j = whole.active_corner[:, axis, None] * SIDE + np.arange(SIDE)
        shares = share[np.clip(j + len(share) // 2, 0, len(share) - 1)]
        shape = [len(at), 1, 1, 1]
        shape[1 + axis] = SIDE
        shares = shares.reshape(shape)
        records[..., 6] *= shares
        records *= (shares > 0.0)[..., None]
        whole.records()[:] = records.reshape(len(at), -1, 8)

    def _shares(self):
        """Return the block corners that layers have across, and the share of each node there.

        Node 0 stands in the middle of the shares.
        """
        axis, whole = self.columns.axis, self.whole
        mesh, shape, s = whole.grid.mesh, whole.shape, whole.sets[0]
        S, n = width(shape), mesh[6 + axis]
        half = s.half[axis] if isinstance(s.half, tuple) else s.half[0, axis]
        share, corners = np.zeros(2 * (n + 2 * S) + 1), set()
        for y in np.unique(self._across):
            g = y * mesh[3 + axis]
            first = int(np.floor(g - 0.5 * (S - 2)))
            corners.add(first // SIDE)
            beyond = float(max(-first, 0)), float(max(first + S - 1 - n, 0))
            weights = stencil(shape, g - first - 0.5 * (S - 1), half, beyond)[:S]
            for node, weight in enumerate(weights, first + len(share) // 2):
                share[node] += weight / self.columns.layers
        return np.array(sorted(corners)), share

    # Other values, and other states

    def assigned(self):
        """Take the values that the particles of the whole have been given."""
        if self.is_plane and not self._fold():
            self._hand_over(self.plane, self.whole)

    def restart(self):
        """Count time and displacements from now on, at rest, with the present stresses."""
        was_plane = self.is_plane
        self.unfold()
        self.whole.restart()
        if was_plane:
            self.fold()
            for restarted in self.plane.asked["restarted"]:
                restarted(self.plane)
            self._shown = None

    def restore(self, kept):
        """Go back to the state that `keep` returned."""
        self.acting.restore(kept)
        self._shown = None

    def solver_of(self, state):
        """Return the solver that a state is one of, which acts from now on."""
        rows = getattr(state.get("set0.row"), "shape", None)
        self.acting = self.plane if rows == self.plane.sets[0].row.shape else self.whole
        self._shown = None
        return self.acting

    def fold(self):
        """Solve one layer from now on, if all are the same."""
        if not self.is_plane and self._fold():
            self._hand_over(self.whole, self.plane)

    def unfold(self):
        """Solve the whole from now on."""
        if self.is_plane:
            self.shown()
            self._hand_over(self.plane, self.whole)

    def _hand_over(self, old, new):
        """Let another solver act, whose particles have the state of the old one."""
        state, owners = state_of(old), new.owners()
        for name in owners.keys() - {"", "grid", *_names_of_sets(new)}:
            head = f"{name}."
            owners[name].take({n[len(head) :]: v for n, v in state.items() if n.startswith(head)})
        new.time, new.steps, new.peak_energy = old.time, old.steps, old.peak_energy
        new.time_step, new.previous = old.time_step, old.previous
        new.population, new.moved_origin = old.population, old.moved_origin
        new.clock, new.gone, self.acting = old.clock, sum(len(s.row) for s in new.sets), new
        new.arrange()
        for resumed in new.asked["resumed"]:
            resumed(new)

    def _fold(self):
        """Give the layer the values of the whole; return False if the layers differ."""
        for s, here in zip(self.plane.sets, self.whole.sets, strict=True):
            place = np.empty(self.whole.count, np.int64)
            place[here.row] = np.arange(len(here.row))
            if not self._is_uniform(here, place[self.columns.first[here.row]]):
                return False
            for name, values in here.arrays().items():
                if name != "row":
                    np.take(values, place[s.row], axis=0, out=getattr(s, name))
            to_layer(s, self.columns)
        return True

    def _is_uniform(self, here, at):
        """Tell whether the particles of a set are those `at` which stand for them, and plane."""
        axis = self.columns.axis
        for name, values in here.arrays().items():
            if name == "x":
                values = np.delete(values, axis, axis=1)
            if name != "row" and not are_same(values, values[at]):
                return False
        across = here.v[:, axis], here.stress[:, SHEAR[axis]]
        sizes = np.abs(here.v).max(), np.abs(here.stress).max()
        return all(
            np.abs(a).max() <= ROUND_OFF * size for a, size in zip(across, sizes, strict=True)
        )


def _names_of_sets(solver):
    return [f"set{number}" for number in range(len(solver.sets))]
