"""An elastic block on a shaken base: what its foot and its top feel.

The base moves as a sine of 1 Hz in x and 0.5 Hz in y (inputs/base_acceleration). The foot follows;
the top lags and swings at the block's own frequency, since the record starts with a jolt.
"""

from pathlib import Path

import numpy as np

import mpmgeo

CASE = Path(__file__).parents[1] / "inputs" / "base_acceleration" / "case.json"
DURATION = 0.5
EVERY = 20  # steps between samples

case = mpmgeo.load_case(CASE)
simulation = mpmgeo.Simulation(case)
height = simulation.field("position")[:, 2]
foot, top = height == height.min(), height == height.max()

rows = []
while simulation.time < DURATION:
    simulation.step(EVERY)
    velocity = simulation.field("velocity")
    # Velocities live half a step before the other fields.
    instant = simulation.time - simulation.time_step / 2
    rows.append((instant, velocity[foot, 0].mean(), velocity[top, 0].mean()))
time, foot_velocity, top_velocity = np.array(rows).T
base_velocity = 0.3 * np.sin(2 * np.pi * time + np.pi)


def plot():
    import matplotlib.pyplot as plt

    plt.plot(time, base_velocity, "k-", label="base")
    plt.plot(time, foot_velocity, "--", label="lowest particles")
    plt.plot(time, top_velocity, label="highest particles")
    plt.xlabel("time [s]")
    plt.ylabel("velocity in x [m/s]")
    plt.legend()
    plt.show()


if __name__ == "__main__":
    plot()
