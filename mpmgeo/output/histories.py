"""Histories: csv files to which a run adds a row every so many steps."""

import numpy as np

from mpmgeo.naming import ENERGIES, PLANES
from mpmgeo.output.probes.probe import VECTOR
from mpmgeo.output.whole_file import append, whole_file

ROWS = 1000
"""Rows that are kept in memory at most."""


class History:
    """A csv file of the time [s] and the numbers of a sampler, begun anew by `begin`.

    The sampler has `columns` and `row()`, the numbers now or None; one for which particles must be
    in order says `looks_by_place = True`. Rows are kept in memory until `flush`. Raises OSError if
    the file cannot be written.
    """

    def __init__(self, path, every, sampler):
        self.path, self.every, self.sampler = path, every, sampler
        self._rows = []

    @property
    def header(self):
        """The first line of the file."""
        return ",".join(["time", *self.sampler.columns]) + "\n"

    def begin(self, time, goes_on):
        """Make the file; one that `goes_on` keeps the rows of an earlier run up to `time` [s]."""
        rows = self._rows_until(time) if goes_on else []
        with whole_file(self.path) as file:
            file.write("".join([self.header, *rows]).encode())

    def _rows_until(self, time):
        """Return the lines of the file up to a time, none if it is not a file of this history."""
        try:
            lines = self.path.read_text(encoding="utf-8").splitlines(keepends=True)
        except (OSError, UnicodeDecodeError):
            return []
        if lines[:1] != [self.header]:
            return []
        return [line for line in lines[1:] if line.endswith("\n") and _time(line) <= time]

    def add(self, time):
        """Take a row."""
        numbers = self.sampler.row()
        if numbers is None:
            return
        row = np.asarray(numbers, float).tolist()
        self._rows.append(",".join(map(repr, [float(time), *row])) + "\n")
        if len(self._rows) >= ROWS:
            self.flush()

    def flush(self):
        """Put the rows into the file."""
        if self._rows:
            append(self.path, "".join(self._rows))
            self._rows.clear()

    def cut(self, time):
        """Drop the rows after a time."""
        self.flush()
        self.begin(time, goes_on=True)


def _time(line):
    try:
        return float(line.partition(",")[0])
    except ValueError:
        return float("inf")


class Histories:
    """Watches a run and keeps its histories; their files are complete at `outputs` and at the
    end."""

    def __init__(self, histories, outputs):
        self.histories = histories
        self.outputs = outputs

    def begin(self, simulation):
        """Make the files with their first rows."""
        goes_on = simulation.goes_on
        for history in self.histories:
            history.begin(simulation.label, goes_on)
        if not goes_on:
            self._add(simulation)
            self._flush()

    def after_step(self, simulation):
        """Add the rows that are due."""
        self._add(simulation)
        if self.outputs.are_due(simulation):
            self._flush()

    def end(self, simulation, error):
        """Complete the files; without rows later than the state of a run that was cut short."""
        for history in self.histories:
            if error is None:
                history.flush()
            else:
                history.cut(simulation.label)

    def _add(self, simulation):
        due = [h for h in self.histories if simulation.steps % h.every == 0]
        if any(getattr(history.sampler, "looks_by_place", False) for history in due):
            simulation.arrange()
        for history in due:
            history.add(simulation.label)

    def _flush(self):
        for history in self.histories:
            history.flush()


class ToolForces:
    """Velocity, way and force on the material of a prescribed velocity, by its number."""

    def __init__(self, simulation, number, motion):
        self.simulation, self.number, self.motion = simulation, number, motion
        self.columns = [
            f"{key}_{axis}" for key in ("velocity", "displacement", "force") for axis in VECTOR
        ]

    def row(self):
        """Return the numbers now, NaN in free components; None before the first step."""
        time, forces = self.simulation.time, self.simulation.solver.reactions
        if forces is None:
            return None
        velocity, way = self.motion.at(time), self.motion.displacement(time)
        force = np.where(np.isnan(velocity), np.nan, forces[len(PLANES) + self.number])
        return [*velocity, *way, *force]


class EnergyRows:
    """The balance of energy of a simulation."""

    columns = ENERGIES

    def __init__(self, simulation):
        self.solver = simulation.solver

    def row(self):
        """Return the figures of the last row that is due [J]."""
        return self.solver.ledger.row()


def histories_of(simulation, folder):
    """Return the histories that the case of a simulation asks for, in a folder.

    Raises ValueError for a probe of what does not exist.
    """
    made = [
        History(folder / "probes" / f"{probe.name}.csv", probe.every, probe.sampler(simulation))
        for probe in simulation.probes
    ]
    energy = simulation.case.results.energy
    if energy is not None:
        made.append(History(folder / "energy.csv", energy.every, EnergyRows(simulation)))
    for number, entry in enumerate(simulation.case.prescribed_velocity):
        path = folder / "reactions" / f"{entry.name}.csv"
        made.append(History(path, entry.every, ToolForces(simulation, number, entry.motion)))
    return made
