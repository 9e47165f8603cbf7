"""mpmgeo: explicit 3D material point method for geomechanics, driven by JSON cases.

case = mpmgeo.load_case("case.json")
simulation = mpmgeo.Simulation(case).run()
displacement = simulation.field("displacement")
"""

__all__ = ["CaseError", "Simulation", "load_case"]


def __getattr__(name):
    """Import the public names when they are used: most of the start-up time is theirs."""
    if name == "Simulation":
        from mpmgeo.simulation import Simulation as found
    elif name in ("CaseError", "load_case"):
        from mpmgeo.case import load

        found = getattr(load, name)
    else:
        raise AttributeError(f"module 'mpmgeo' has no attribute {name!r}")
    globals()[name] = found
    return found
