"""Physics checks before a run: what is possible, but hardly meant."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from mpmgeo.case.building.limits import limits
from mpmgeo.case.building.locking import locking
from mpmgeo.case.building.overlap import overlaps
from mpmgeo.case.building.proportions import out_of_proportion
from mpmgeo.case.building.time_step import MARGIN
from mpmgeo.case.building.unlikely_start import unlikely_rest
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.case.spec import ACTIONS
from mpmgeo.positions import shown
from mpmgeo.region import within
from mpmgeo.run.diagnosis import method

CELLS_PER_WAVELENGTH = 10
"""Cells that a wave needs to travel without losing its shape."""

SIGNIFICANT = 0.99
"""Share of a record's power that lies below its highest significant frequency."""

VALUES_PER_PERIOD = 4
"""Values of a record, and time steps, that a wave needs not to be lost between them."""

COARSE = 0.01
"""Share of a cell to which the corners of a terrain should be known."""


def lint(simulation) -> list[str]:
    """Return warnings, one sentence each, about a simulation that has not started yet."""
    case = in_mesh(simulation.case, simulation.case.mesh.origin)
    position, body = simulation.field("position") - case.mesh.zero, simulation.field("body")
    return [
        *_time_step(simulation),
        *_outside(position, case.mesh),
        *_empty_bodies(case, body),
        *_actions(case, position, body),
        *_probes(case),
        *_terrain(case),
        *_record(case, simulation.time_step),
        *limits(case),
        *locking(case, position, partial(simulation.field, "material")),
        *out_of_proportion(case, position, body, simulation.time_step),
        *unlikely_rest(case, simulation),
        *overlaps(case, position, body, partial(simulation.field, "mass")),
    ]


def _time_step(simulation) -> Iterator[str]:
    step, stable = simulation.time_step, simulation.stable_time_step
    critical, case = simulation.critical_time_step, simulation.case
    key = "time_step" if case.time_step else "critical_time_step_multiplier"
    if stable == 0 and step > critical:  # of a scheme and shape that are warned of in any case
        yield f"{key}: {step:.4g} s exceeds the critical {critical:.4g} s; the run may diverge"
    elif 0 < stable < step:
        best = f"{MARGIN * stable:.2g} s" if case.time_step else f"{MARGIN * stable / critical:.2g}"
        longer = ""
        if case.stress_scheme_update == "USL":
            longer = ', or "stress_scheme_update": "MUSL"'
        yield (
            f"{key}: {step:.4g} s exceeds {stable:.4g} s, up to which {method(simulation)} is "
            f"stable here; the run may diverge; try {best} or less{longer}"
        )


def _outside(position, mesh) -> Iterator[str]:
    outside = ~within(mesh.origin, mesh.upper, position, mesh.zero)
    if outside.any():
        first = int(outside.argmax())
        where = shown(position[first], mesh.zero)
        yield (
            f"{np.count_nonzero(outside)} of {len(position)} particles start outside the mesh and "
            f"take no part, the first of them row {first} at {where}"
        )


def _empty_bodies(case, body_of_particle) -> Iterator[str]:
    labels = [label for body in case.body if body.active for label in body.labels]
    counts = np.bincount(np.asarray(body_of_particle, dtype=np.int64), minlength=len(labels) + 1)
    for number, label in enumerate(labels, start=1):
        if counts[number] == 0:
            yield f"body {number} ({label}) holds no particle"


def _actions(case, position, body) -> Iterator[str]:
    cell = np.array(case.mesh.cells_dimension)
    for action in ACTIONS:
        for number, entry in enumerate(case.entries(action), start=1):
            name = entry.name if action.called else f"entry {number}"
            where = f"{action.key}, {name}" if action.is_several else action.key
            reason, (what, end) = entry.idle(position, body, cell), entry.ends()
            if reason is not None:
                yield f"{where}: {reason}"
            if end < case.time:
                yield f"{where}: the {what} ends at {end:g} s, the run at {case.time:g} s"


def _probes(case) -> Iterator[str]:
    for probe in case.results.probes:
        points = np.array(getattr(probe, "points", ()), float).reshape(-1, 3)
        inside = within(case.mesh.origin, case.mesh.upper, points, case.mesh.zero)
        for point in points[~inside]:
            where = f"results.probes, {probe.name}"
            yield f"{where}: the point {(point + case.mesh.zero).tolist()} is outside the mesh"


def _terrain(case) -> Iterator[str]:
    terrain = case.terrain_contact
    if terrain is None:
        return
    known, cell = terrain.resolution, min(case.mesh.cells_dimension)
    if known > COARSE * cell:
        yield (
            f"{terrain.stl_mesh}: the file holds its coordinates to {known:.2g} m only, cells are "
            f"{cell:g} m; move it towards (0, 0, 0), or write it as a text with all digits"
        )


def _record(case, time_step) -> Iterator[str]:
    if case.earthquake is None or not case.earthquake.active:
        return
    record = case.earthquake.record()
    frequency = significant_frequency(record)
    if frequency == 0:
        return
    shakes, period = f"earthquake: the record shakes with up to {frequency:.3g} Hz", 1 / frequency
    for step, what in (np.diff(record.time).max(), "values"), (time_step, "time steps"):
        if step * VALUES_PER_PERIOD > period:
            yield f"{shakes}, too fast for {what} {step:.4g} s apart"
    speed, largest = _slowest_wave(case), max(case.mesh.cells_dimension)
    if largest * CELLS_PER_WAVELENGTH > speed * period:
        yield (
            f"{shakes}; waves of that frequency are {speed * period:.3g} m long "
            f"and need cells of {speed * period / CELLS_PER_WAVELENGTH:.3g} m or less"
        )


def significant_frequency(record) -> float:
    """Return the frequency [Hz] below which a record has nearly all of its power."""
    time = np.linspace(record.time[0], record.time[-1], len(record.time))
    if time[-1] == time[0]:
        return 0.0
    series = [np.interp(time, record.time, a) for a in record.acceleration.T]
    power = sum(np.abs(np.fft.rfft(a - a.mean())) ** 2 for a in series).cumsum()
    index = int(np.searchsorted(power, SIGNIFICANT * power[-1])) if power[-1] > 0 else 0
    return float(np.fft.rfftfreq(len(time), time[1] - time[0])[index])


def _slowest_wave(case):
    """Return the lowest wave speed of the materials in use [m/s]."""
    used = {number for body in case.body if body.active for number in body.materials}
    return min(_wave_speed(law) for law in case.materials if law.id in used)


def _wave_speed(law):
    if not hasattr(law, "poisson"):
        return law.sound_speed()
    shear = law.young / (2 * (1 + law.poisson))
    return float(np.sqrt(shear / law.density))
