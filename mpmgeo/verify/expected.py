"""The numbers a case expects: read from its `expected` key and compared with a run.

    "expected": {
        "tip deflection": {
            "field": "displacement", "component": "z", "at": [1.95, 0.05, 0.2],
            "value": -0.0278, "tolerance": 0.0006, "source": "beam theory"
        }
    }

The value measured is the mean over the particles that were nearest to `at` initially; `time` [s]
says when, the end of the case if absent. `tolerance` has the unit of the value. A field of single
numbers, such as the pressure, needs no component.
"""

from dataclasses import dataclass

import numpy as np

COMPONENTS = {
    "displacement": ("x", "y", "z"),
    "velocity": ("x", "y", "z"),
    "stress": ("xx", "yy", "zz", "xy", "yz", "xz"),
    "velocity_fluid": ("x", "y", "z"),
    "pressure": ("",),
}


@dataclass(frozen=True)
class Expectation:
    """One number that a run should reproduce: value ± tolerance of a component of a field."""

    name: str
    field: str
    at: tuple[float, float, float]
    value: float
    tolerance: float
    time: float
    source: str
    component: str = ""

    def measure(self, simulation) -> float:
        """Return the number as the simulation has it at its present time."""
        column = COMPONENTS[self.field].index(self.component)
        initial = simulation.field("position") - simulation.field("displacement")
        distance = np.linalg.norm(initial - np.array(self.at), axis=1)
        nearest = distance < distance.min() * (1 + 1e-6) + 1e-12
        field = simulation.field(self.field).reshape(len(nearest), -1)
        return float(field[nearest, column].mean())


@dataclass(frozen=True)
class Comparison:
    """An expectation beside the number that the run gave."""

    expectation: Expectation
    measured: float

    @property
    def agrees(self) -> bool:
        """Return whether the number lies within the tolerance."""
        return abs(self.measured - self.expectation.value) <= self.expectation.tolerance

    def __str__(self) -> str:
        e = self.expectation
        wanted = f"{e.value:.6g} ± {e.tolerance:.2g} ({e.source})"
        return f"{e.name}: {self.measured:.6g}, expected {wanted}"


def expectations(case) -> list[Expectation]:
    """Return what the case expects, earliest first; TypeError for missing or unknown keys."""
    found = [
        Expectation(name=name, **{"time": case.time} | entry)
        for name, entry in (case.expected or {}).items()
    ]
    return sorted(found, key=lambda expectation: expectation.time)


def compare(simulation, case) -> list[Comparison]:
    """Run the simulation of the case and return every expectation with the measured number."""
    found = []
    for expectation in expectations(case):
        simulation.run(until=expectation.time)
        found.append(Comparison(expectation, expectation.measure(simulation)))
    return found
