"""Write the stresses at the end of a run, as MPM-Geomechanics does."""

from mpmgeo.output.whole_file import whole_file
from mpmgeo.state.stress_file import NAME, write_stress


class FinalStress:
    """Watches a run and writes its stress file when it has come to the end of the case."""

    def __init__(self, folder):
        self.path = folder / NAME

    def begin(self, simulation):
        """Do nothing: an older file may be the one that the run began with."""

    def after_step(self, simulation):
        """Do nothing."""

    def end(self, simulation, error):
        """Write the file unless the run was cut short."""
        if error is None and simulation.time >= simulation.case.time:
            with whole_file(self.path) as file:
                write_stress(file, simulation.field("stress"))
