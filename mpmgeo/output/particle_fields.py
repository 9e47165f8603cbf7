"""What the fields of the particles hold, and under which names files hold them."""

import numpy as np

from mpmgeo.output.fields import PARTICLE_FIELDS

AXES = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")
_FILE_ORDER = (0, 1, 2, 3, 5, 4)  # files list xz before yz
_NAMES = {
    "id": "Particle Id",
    "material": "Material Id",
    "active": "Particle Active",
    "pressure": "Pressure",
    "pore_pressure": "Pore Pressure",
    "plastic_strain": "Effective Plastic Strain",
    "external_force": "External Force",
    "displacement": "Displacement",
    "distance_levelset": "Distance-levelset",
    "velocity": "Velocity",
    "body": "Body Id",
    "deviatoric_strain": "Deviatoric Strain",
    "mean_stress": "Mean Stress",
    "von_mises_stress": "Von Mises Stress",
    "density": "Density",
    "volume": "Volume",
    "velocity_fluid": "Velocity Fluid",
    "porosity": "Porosity",
}
_ARRAYS = {"velocity": "v", "stress": "stress"}
TENSORS = {"stress": "Stress", "strain": "Strain"}
_VECTORS = ("position", "velocity", "displacement", "external_force", "velocity_fluid")
DEFORMATION = "deformation_gradient"
"""Field of the particles whose law keeps it; zero for others."""
WITH_STRAIN = ("strain", "deviatoric_strain")
"""Fields for which the particles' strains must be kept."""


def particle_field(solver, key):
    """Return a field of all particles in row order: one of `particle_field_names`.

    Shape (n,), (n, 3), or (n, 6) for stress and strain (xx yy zz xy yz xz); SI units. Raises
    KeyError for an unknown key, for a strain that is not kept, for a fluid that is not there.
    """
    parts = [field_of(solver, s, key) for s in solver.sets]
    if not parts:
        return np.empty((0, *_shape(key)))
    field = np.zeros((len(solver.population.position), *_shape(key)), parts[0].dtype)
    for s, part in zip(solver.sets, parts, strict=True):
        field[s.row] = part
    return field


def particle_field_names(solver):
    """Return the names of all fields: keys of a case, some that only scripts use, and variables of
    the laws in use, which are zero for other laws."""
    names = [*PARTICLE_FIELDS, *_ARRAYS, *_VALUES, *_OF_THE_FLUID]
    if any(s.F is not None for s in solver.sets):
        names.append(DEFORMATION)
    return list(dict.fromkeys([*names, *(name for s in solver.sets for name in s.law.STATE)]))


def field_of(solver, s, key, at=slice(None)):
    """Return a field of the particles `at` (indices or a slice) of a set, as `particle_field`."""
    if key in _ARRAYS:
        return getattr(s, _ARRAYS[key])[at]
    if key in _VALUES:
        return _VALUES[key](solver, s, at)
    if key in _OF_THE_FLUID:
        if s.fluid is None:
            raise KeyError(f"{key}: exists with two phases only")
        return _OF_THE_FLUID[key](s, at)
    if key == DEFORMATION and s.F is not None:
        return s.F[at].reshape(-1, 3, 3)
    if key in s.law.STATE:
        return s.state[at, s.law.STATE.index(key)]
    if key in particle_field_names(solver):
        return np.zeros((len(s.row[at]), *_shape(key)))
    raise KeyError(key)


def _shape(key):
    """Return the shape of a field's value at one particle."""
    if key in TENSORS:
        return (6,)
    if key == DEFORMATION:
        return (3, 3)
    return (3,) if key in _VECTORS or key.startswith("particle_contact_force") else ()


def particle_arrays(solver, keys):
    """Return the arrays of a particle file for some keys of a case, by their names."""
    arrays = {}
    for key in keys:
        field = particle_field(solver, key)
        if key in TENSORS:
            for component in _FILE_ORDER:
                arrays[f"{TENSORS[key]}_{AXES[component]}"] = field[:, component]
        else:
            arrays[_NAMES.get(key, key)] = field
    return arrays


def _id(solver, s, at):
    numbers, rows = solver.population.id, s.row[at]
    return rows.astype(np.uint64) if numbers is None else numbers[rows]


def _active(solver, s, at):
    return (np.arange(len(s.row))[at] < s.active).astype(np.uint8)


def _pressure(solver, s, at):
    pressure = s.pressure if s.fluid is None else s.pf
    return np.zeros(len(s.row[at])) if pressure is None else pressure[at]


def _mass(solver, s, at):
    """Return the masses of both phases."""
    return s.m[at] if s.fluid is None else s.m[at] + s.mf[at]


def _undrained_strength(solver, s, at):
    return getattr(s.law, "su", 0.0) * np.maximum(-s.stress[at, 2], 0.0)


def _external_force(solver, s, at):
    weight = _mass(solver, s, at)[:, None] * np.asarray(solver.gravity)
    return weight if s.force is None else weight + s.force[at]


def _distance(solver, s, at):
    if solver.ground is None:
        return np.zeros(len(s.row[at]))
    return solver.ground.level(s, at)


def _contact(first):
    """Return the field of a contact force whose columns begin at `first`."""

    def force(solver, s, at):
        if s.contact is None:
            return np.zeros((len(s.row[at]), 3))
        return s.contact[at, first : first + 3]

    return force


_NORMAL_FORCE, _TANGENTIAL_FORCE = _contact(0), _contact(3)


def _contact_flag(solver, s, at):
    if s.due is None:
        return np.zeros(len(s.row[at]), np.uint8)
    return (s.due[at] == -1).astype(np.uint8)


def _strain(solver, s, at):
    if s.strain is None:
        raise KeyError("strain: kept only if the results or a probe of the case ask for it")
    return s.strain[at]


def _mean(tensor):
    return tensor[:, :3].mean(axis=1)


def _size_of_deviator(tensor):
    """Return √(d:d) for the deviators d of tensors (n, 6)."""
    normal = tensor[:, :3] - _mean(tensor)[:, None]
    return np.sqrt((normal**2).sum(axis=1) + 2 * (tensor[:, 3:] ** 2).sum(axis=1))


_VALUES = {
    "position": lambda solver, s, at: s.x[at] + solver.population.zero,
    "id": _id,
    "material": lambda solver, s, at: solver.population.material[s.row[at]].astype(np.uint32),
    "body": lambda solver, s, at: solver.population.body[s.row[at]],
    "active": _active,
    "Su": _undrained_strength,
    "pressure": _pressure,
    "pore_pressure": _pressure,
    "external_force": _external_force,
    "displacement": lambda solver, s, at: s.x[at] - solver.population.position[s.row[at]],
    "distance_levelset": _distance,
    "particle_contact_force": lambda *of: _NORMAL_FORCE(*of) + _TANGENTIAL_FORCE(*of),
    "particle_contact_force_tangential": _TANGENTIAL_FORCE,
    "particle_contact_force_normal": _NORMAL_FORCE,
    "particle_contact_flag": _contact_flag,
    "strain": _strain,
    "deviatoric_strain": lambda *of: np.sqrt(2 / 3) * _size_of_deviator(_strain(*of)),
    "mean_stress": lambda solver, s, at: _mean(s.stress[at]),
    "von_mises_stress": lambda solver, s, at: np.sqrt(1.5) * _size_of_deviator(s.stress[at]),
    "mass": _mass,
    "volume": lambda solver, s, at: s.volume(at),
    "density": lambda solver, s, at: _mass(solver, s, at) / s.volume(at),
}
_OF_THE_FLUID = {
    "mass_fluid": lambda s, at: s.mf[at],
    "velocity_fluid": lambda s, at: s.vf[at],
    "porosity": lambda s, at: 1 - s.m[at] / (s.fluid.ρs * s.V[at]),
}
