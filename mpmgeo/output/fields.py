"""The fields a case may ask for, in the order in which files hold them."""

PARTICLE_FIELDS = {
    "id": "particle number, in order of creation from 0",
    "material": "material id",
    "Su": "undrained shear strength [Pa]",
    "active": "1 while the particle takes part, 0 after it left the mesh",
    "pressure": "pore or fluid pressure [Pa]",
    "pore_pressure": "pore pressure of the one-way coupling [Pa]",
    "plastic_strain": "effective plastic strain [-]",
    "external_force": "gravity and box loads [N]",
    "displacement": "current minus initial position [m]",
    "distance_levelset": "signed distance to the terrain [m]",
    "particle_contact_force": "contact force [N]",
    "particle_contact_force_tangential": "tangential contact force [N]",
    "particle_contact_force_normal": "normal contact force [N]",
    "particle_contact_flag": "1 while in contact with the terrain",
    "velocity": "velocity [m/s]",
    "stress": "effective stress, six components [Pa]",
    "body": "body number, from 1",
}
"""Fields of the particles, all of them what the word "all" stands for."""

FURTHER_FIELDS = {
    "strain": "sum of the strain increments, six components [-]",
    "deviatoric_strain": "√(2/3 e:e), e the deviator of that strain [-]",
    "mean_stress": "mean of the effective normal stresses [Pa]",
    "von_mises_stress": "√(3/2 s:s), s the deviator of the stress [Pa]",
    "density": "mass over volume [kg/m³]",
    "volume": "volume with what tension has opened [m³]",
}
"""Fields of the particles that a case asks for by name."""

FLUID_FIELDS = {
    "velocity_fluid": "velocity of the pore fluid [m/s]; with two phases only",
    "porosity": "share of the pores [-]; with two phases only",
}
"""Fields of the particles that exist with two phases."""

GRID_FIELDS = {
    "id": "node number, x fastest, with two ghost layers",
    "active": "1 where the node carries mass",
    "mass": "nodal mass [kg]",
    "velocity": "nodal velocity [m/s], zero on inactive nodes",
    "distance_levelset": "signed distance to the terrain [m]",
    "density_levelset": "share of the nodal volume that particles fill [-]",
    "volume": "nodal volume [m³]",
}

TERRAIN_FIELDS = {
    "stl_density_levelset": "density level set at the triangle's centre [-]",
    "stl_normal": "unit normal of the triangle",
}
