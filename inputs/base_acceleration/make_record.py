"""Write base_acceleration.csv: the accelerations of a base that moves as a sine in x and in y."""

from math import pi
from pathlib import Path

from mpmgeo.verify.base_motion import SineMotion

BASE = SineMotion(amplitude=(0.3, 0.3, 0.0), frequency=(1.0, 0.5, 1.0), phase=pi)

if __name__ == "__main__":
    BASE.write_record(Path(__file__).with_name("base_acceleration.csv"), end=2.0, interval=1e-3)
