"""What is out of proportion in a built case: speeds, stiffness, gravity, the time step."""

from collections.abc import Iterator

import numpy as np

from mpmgeo.naming import PLANES

SHAKES = 50.0
"""Acceleration [m/s²] that no earthquake reaches."""

FAST = 0.5
"""Share of the wave speed from which on an impact crushes a body."""

CROSSINGS = 10
"""Times that a body in free flight may pass through the mesh during a run."""


def out_of_proportion(case, position, body, time_step) -> Iterator[str]:
    """Yield warnings, one sentence each; all in coordinates of the mesh.

    position (n, 3) [m] and number of the body (n,) of all particles at the start.
    """
    numbered = [made for made in case.body if made.active for _ in made.labels]
    places = [position[body == number] for number in range(1, len(numbered) + 1)]
    laws = {law.id: law for law in reversed(case.materials)}
    yield from _step(case, time_step)
    yield from _gravity(case, position)
    for number, (made, x) in enumerate(zip(numbered, places, strict=True), 1):
        used = [laws[id] for id in made.materials if id in laws]
        if len(x):
            yield from _weight(case, number, x, used)
            yield from _speed(case, number, made, used)
    yield from _tools(case)
    yield from _record(case)


def _step(case, time_step):
    if not case.time_step and time_step >= case.time:
        yield (
            f"time: the time step chosen from the critical one, {time_step:.3g} s, is longer than "
            f"the run, {case.time:g} s; is a stiffness or density in other units?"
        )


def _gravity(case, position):
    gravity = np.array(case.largest_gravity)
    laws = {law.type for law in case.materials} - {"elastic", "neo-hookean"}
    if not gravity.any():
        if laws and not _moves(case):
            kinds = ", ".join(sorted(laws))
            yield f"gravity: absent, and nothing else acts on the bodies ({kinds})"
        elif any(getattr(law, "su_vertical_stress", 0) for law in case.materials):
            yield "gravity: absent, while su_vertical_stress needs a vertical stress"
        return
    axis = int(np.abs(gravity).argmax())
    if gravity[2] < 0 or case.terrain_contact is not None or not len(position):
        return
    cell, upper = np.array(case.mesh.cells_dimension), np.array(case.mesh.upper)
    stands = [*(position.min(axis=0) < cell), *(position.max(axis=0) > upper - cell)]
    below = axis + 3 * bool(gravity[axis] > 0)
    if gravity[2] > 0 and axis == 2:
        yield f"gravity: {gravity[2]:g} m/s² along z points up"
    elif stands[2] and not stands[below]:
        yield f"gravity: points to the plane {PLANES[below]}, while the bodies stand on Z0"


def _moves(case):
    """Tell whether anything but gravity sets the bodies in motion."""
    quake = case.earthquake is not None and case.earthquake.active
    loads = (*case.nodal_point_load, *case.load_distributed_box, *case.prescribed_velocity)
    fluid = (*case.initial_pressure_box, *case.prescribed_pressure_box, *case.pressure_force_box)
    others = (case.hydro_mechanical_coupling, case.terrain_contact, case.load_state or None)
    flying = any(any(body.initial_velocity) for body in case.body if body.active)
    return quake or flying or loads or fluid or any(other is not None for other in others)


def _weight(case, number, x, laws):
    gravity = np.array(case.largest_gravity)
    size = float(np.linalg.norm(gravity))
    if size == 0:
        return
    height = float(np.ptp(x @ gravity) / size)
    for law in laws:
        key = "young" if hasattr(law, "young") else "bulk"
        stiffness, weight = getattr(law, key, None), law.density * size * height
        if stiffness is not None and weight > stiffness:
            yield (
                f"body {number}: its own weight, {weight:.3g} Pa at the bottom, exceeds the "
                f"stiffness of material {law.id}, {key} {stiffness:g} Pa; is that in kPa or MPa?"
            )


def _speed(case, number, made, laws):
    speed = float(np.linalg.norm(made.initial_velocity))
    wave = min((law.sound_speed() for law in laws), default=np.inf)
    reach = float(np.linalg.norm(np.subtract(case.mesh.upper, case.mesh.origin)))
    if speed > FAST * wave:
        yield (
            f"body {number}: {speed:g} m/s at the start is not small beside the speed of waves in "
            f"its material, {wave:.3g} m/s"
        )
    elif speed * case.time > CROSSINGS * reach:
        yield (
            f"body {number}: {speed:g} m/s at the start lead {speed * case.time:.3g} m far during "
            f"the run, in a mesh {reach:.3g} m across"
        )


def _tools(case):
    reach = float(np.linalg.norm(np.subtract(case.mesh.upper, case.mesh.origin)))
    for entry in case.prescribed_velocity:
        way = float(np.linalg.norm(np.nan_to_num(entry.motion.displacement(case.time))))
        if entry.plane is None and way > reach:
            yield (
                f"prescribed_velocity, {entry.name}: leads {way:.3g} m far during the run, in a "
                f"mesh {reach:.3g} m across"
            )


def _record(case):
    if case.earthquake is not None and case.earthquake.active:
        peak = float(np.abs(case.earthquake.record().acceleration).max())
        if peak > SHAKES:
            yield (
                f"earthquake: the record reaches {peak:.3g} m/s², {peak / 9.81:.2g} times gravity; "
                "is it in cm/s²?"
            )
