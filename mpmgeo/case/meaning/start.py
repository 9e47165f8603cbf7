"""What the stresses of overburden at the start need, and what does not go with them."""

from mpmgeo.materials.hyperelastic import is_hyperelastic
from mpmgeo.values import shown

KEY = "initial_stress"
COUPLING = "hydro_mechanical_coupling"
OF_MATERIALS = ("k0", "density_saturated")


def check_start(draft, report):
    """Report initial stresses that cannot be made, and keys that have no effect without them."""
    case = draft.whole
    parts = draft.of(KEY)
    if not parts:
        for part in draft.of("materials"):
            for key in OF_MATERIALS:
                if key in part.given:
                    report.note(part.at(key), f"has no effect without {KEY}")
        return
    start, two = parts[0], case.values.get("n_phases") == 2
    if case.values.get("compatibility") is not None:
        report.error((KEY,), "MPM-Geomechanics knows no stresses of overburden; leave one out")
    if case.values.get("load_state"):
        report.error((KEY,), "load_state has the stresses at the start; leave one of them out")
    _check_materials(draft, report)
    if start.values.get("water_table") is None:
        for part in draft.of("materials"):
            if "density_saturated" in part.given:
                report.note(
                    part.at("density_saturated"), f"has no effect without {KEY}.water_table"
                )
        return
    if any(coupling.enabled for coupling in draft.made(COUPLING)):
        message = f"the pore pressures are those of {COUPLING}; leave one of them out"
        report.error(start.at("water_table"), message)
    if two:
        _check_fluids(draft, start, report)


def _check_materials(draft, report):
    for part in draft.of("materials"):
        law = part.made
        if law is None:
            continue
        if is_hyperelastic(law.symbols):
            name = shown(law.type)
            report.error((KEY,), f"the stress of {name} follows from its deformation; leave it out")
        if law.is_fluid and law.k0 not in (None, 1.0):
            report.error(
                part.at("k0"),
                f"{law.k0:g}: a fluid at rest has the same pressure in all directions; accepted: 1",
            )
        if "density_saturated" in part.given and draft.whole.values.get("n_phases") == 2:
            message = "with two phases grains and fluid make the density; leave it out"
            report.error(part.at("density_saturated"), message)


def _check_fluids(draft, start, report):
    """Report more than one fluid under a table."""
    densities = {law.density_fluid for law in draft.made("materials")} - {None}
    if len(densities) > 1:
        found = ", ".join(f"{density:g}" for density in sorted(densities))
        message = f"needs one density_fluid for all materials; here there are {found}"
        report.error(start.at("water_table"), message)
    if "density_water" in start.given:
        message = "has no effect with two phases: density_fluid counts"
        report.note(start.at("density_water"), message)
