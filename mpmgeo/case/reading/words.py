"""Words that people use, and the words of a case that they stand for.

The nearest spelling does not find these. A word counts only where one of those that it may stand
for is known, so one table serves all places.
"""

import re

from mpmgeo.case.report import nearest

MEANINGS = {
    # the top level
    "time": ("duration", "endtime", "totaltime", "finaltime", "simulationtime", "tend", "tmax"),
    "time_step": ("dt", "deltat", "timeincrement", "stepsize", "increment"),
    "critical_time_step_multiplier": ("cfl", "courant", "courantnumber", "safetyfactor"),
    "density_scaling": ("massscaling", "inertiascaling", "scalemass"),
    "until": ("stop", "equilibrium", "convergence", "tolerance", "rest"),
    "unbalanced_force": ("ratio", "forceratio", "unbalanced", "outofbalance"),
    "gravity": ("g", "gravityvector", "bodyforce"),
    "mesh": ("grid", "domain", "background"),
    "body": ("geometry", "geometries", "objects", "particles", "parts"),
    "materials": ("laws", "constitutive", "soils"),
    "stress_scheme_update": ("scheme", "usl", "musl", "stressupdate", "algorithm"),
    "shape_function": ("shape", "interpolation", "basis", "kernel"),
    "transfer": ("transfers", "pic", "picflip", "velocityupdate"),
    "n_phases": ("phases", "phase"),
    "n_threads": ("threads", "cores", "processors", "nproc"),
    "results": ("output", "outputs"),
    "earthquake": ("baseacceleration", "seismic", "groundmotion"),
    "terrain_contact": ("terrain", "contact", "stl", "ground"),
    "nodal_point_load": ("pointload", "forces", "loads"),
    # the mesh
    "cells_number": ("n", "ncells", "cells", "divisions", "nelements"),
    "cells_dimension": ("h", "dx", "cellsize", "spacing", "elementsize", "resolution"),
    "origin": ("lower", "min", "corner"),
    "boundary_conditions": ("boundaries", "boundary", "bc", "bcs"),
    # materials
    "density": ("rho", "ρ", "massdensity"),
    "young": ("e", "youngs", "youngmodulus", "youngsmodulus", "elasticmodulus", "modulus"),
    "poisson": ("nu", "ν", "v", "poissonratio", "poissonsratio"),
    "friction": ("phi", "φ", "frictionangle", "angle", "mu", "μ"),
    "cohesion": ("c", "coh"),
    "dilation": ("psi", "ψ", "dilatancy", "dilationangle", "dilatancyangle"),
    "tensile": ("tension", "tensilestrength", "tensioncutoff", "cutoff"),
    "bulk": ("k", "bulkmodulus"),
    "viscosity": ("mu", "μ", "eta", "η", "dynamicviscosity"),
    "porosity": ("n",),
    "hydraulic_conductivity": ("k", "permeability"),
    "bulk_fluid": ("kf", "kw", "bulkwater"),
    "density_fluid": ("rhof", "rhow", "densitywater"),
    # bodies
    "point_p1": ("p1", "min", "lower", "lo", "corner1", "start", "from"),
    "point_p2": ("p2", "max", "upper", "hi", "corner2", "end", "to"),
    "center": ("centre", "middle"),
    "diameter": ("radius", "r", "d"),
    "material_id": ("material", "mat", "matid", "law"),
    "initial_velocity": ("velocity", "v0", "v"),
    "particles_per_direction": ("ppc", "particlespercell", "np"),
    "mesh_file": ("file", "filename"),
    # loads
    "point": ("node", "at", "place", "location"),
    "value": ("vector", "acceleration"),
    "factor": ("factors", "multiplier", "amplitude", "values"),
    "factor_file": ("file", "filename", "table"),
    "sine": ("sin", "cosine", "smooth"),
    # results
    "material_point_results": ("particleresults", "particlefields", "variables"),
    "grid_nodal_results": ("gridresults", "gridfields", "noderesults"),
    "print": ("frames", "numberofoutputs", "noutputs"),
    # what follows "type", and other words
    "cuboid": ("box", "cube", "block", "brick", "rectangle", "hexahedron"),
    "sphere": ("ball", "circle", "disc"),
    "polygon_2d": ("prism", "extrusion", "polyline"),
    "gmsh": ("mesh", "msh"),
    "elastic": ("linear", "hooke", "linearelastic", "isotropic"),
    "mohr-coulomb": ("mc", "soil", "sand", "plastic", "elastoplastic", "druckerprager"),
    "newtonian": ("fluid", "water", "liquid", "viscous"),
    "local": ("cundall", "nonviscous", "flac"),
    "mass": ("rayleigh", "viscous", "proportional", "global"),
    "flip": ("pic", "picflip", "flippic", "ratio", "blend"),
    "apic": ("affine", "affinepic"),
    "tpic": ("taylor", "taylorpic"),
    "sliding": ("roller", "slip", "symmetry", "smooth"),
    "fixed": ("clamped", "noslip", "stick", "rough", "encastre"),
    "free": ("open", "none", "outflow"),
    "linear": ("standard", "hat", "tent"),
    "GIMP": ("ugimp", "cpgimp", "generalized"),
    "quadratic-bspline": ("quadratic", "bspline", "spline", "quadraticspline"),
    "cubic-bspline": ("cubic", "cubicspline"),
    "LME": ("maxent", "localmaxent", "maximumentropy", "localmaximumentropy"),
}
"""Word of a case → other words for it, in small letters without separators."""


def meant(word, known) -> str | None:
    """Return the known word that a given one stands for or is most like, if there is one."""
    plain = re.sub(r"[\W_]", "", word).casefold() if isinstance(word, str) else None
    for candidate in known:
        if plain in MEANINGS.get(candidate, ()):
            return candidate
    return nearest(word, known)
