"""mpmgeo: explicit 3D material point method for geomechanics, driven by JSON cases.

case = mpmgeo.load_case("case.json")
simulation = mpmgeo.Simulation(case).run()
displacement = simulation.field("displacement")
"""

from importlib import import_module

_HOMES = {
    "CaseError": "mpmgeo.case.report",
    "CaseWarning": "mpmgeo.case.report",
    "Simulation": "mpmgeo.simulation",
    "StopRun": "mpmgeo.run.watch",
    "Watcher": "mpmgeo.run.watch",
    "load_case": "mpmgeo.case.load",
}
__all__ = list(_HOMES)


def __getattr__(name):
    """Import the public names when they are used: most of the start-up time is theirs."""
    if name not in _HOMES:
        raise AttributeError(f"module 'mpmgeo' has no attribute {name!r}")
    found = getattr(import_module(_HOMES[name]), name)
    globals()[name] = found
    return found
