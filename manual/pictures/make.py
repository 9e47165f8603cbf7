"""Draw the pictures of the manual from runs of the cases that ship.

    python manual/pictures/make.py
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pyvista

import mpmgeo

HERE = Path(__file__).parent
INPUTS = HERE.parents[1] / "inputs"
WIDTH = 1200  # pixels
COLOURS = 255  # of a picture file: what keeps it small
BAR = {"color": "black", "fmt": "%.3g", "title_font_size": 24, "label_font_size": 20, "n_labels": 5, "height": 0.16}
SURFACE = {"ambient": 0.35, "diffuse": 0.75, "show_edges": True, "edge_opacity": 0.25}


def run(name, folder):
    """Run a case that ships, with files into `folder`; returns the simulation."""
    return mpmgeo.Simulation(mpmgeo.load_case(INPUTS / name / "case.json"), output=folder).run()


def frames(folder):
    """Return the particle files of a run in `folder` in order of time, with their times."""
    reader = pyvista.PVDReader(folder / "particles" / "particleTimeSerie.pvd")
    for time in reader.time_values:
        reader.set_active_time_value(time)
        yield time, reader.read()[0]


def boxes(points, size):
    """Return every particle as a box of its size (3,) [m]."""
    box = pyvista.Cube(x_length=size[0], y_length=size[1], z_length=size[2])
    return points.glyph(geom=box, scale=False, orient=False)


def plotter(height, shape=(1, 1)):
    """Return an empty white scene of the pictures' width."""
    scene = pyvista.Plotter(off_screen=True, window_size=(WIDTH, height), shape=shape, border=False)
    scene.set_background("white")
    scene.enable_anti_aliasing("ssaa")
    return scene


def save(scene, name):
    """Write a scene with few colours, which halves the file and does not show."""
    from PIL import Image

    pixels = Image.fromarray(scene.screenshot(return_img=True))
    few = pixels.quantize(COLOURS, dither=Image.Dither.NONE)
    few.save(HERE / f"{name}.png", optimize=True)
    scene.close()


def cantilever(folder):
    """Bending stress in the cantilever, deflection enlarged, with the shape before."""
    simulation = run("cantilever", folder)
    *_, (_, particles) = frames(folder)
    particles["Stress xx [kPa]"] = particles["Stress_XX"] / 1e3
    particles.points += 4 * particles["Displacement"]
    scene = plotter(420)
    scene.add_mesh(
        boxes(particles, simulation.solver.population.size[0]),
        scalars="Stress xx [kPa]",
        cmap="coolwarm",
        clim=(-500, 500),
        **SURFACE,
        scalar_bar_args=BAR | {"width": 0.4, "position_x": 0.3, "position_y": 0.02},
    )
    scene.add_mesh(pyvista.Box((0, 2, 0, 0.1, 0, 0.4)), style="wireframe", color="grey")
    scene.add_mesh(pyvista.Box((-0.06, 0, -0.1, 0.2, -0.15, 0.55)), color="lightgrey", ambient=0.4)
    scene.enable_parallel_projection()
    scene.camera_position = [(1.9, -5, 1.6), (0.97, 0, 0.14), (0, 0, 1)]
    scene.camera.parallel_scale = 0.44
    save(scene, "cantilever")


if __name__ == "__main__":
    for picture in (cantilever,):
        with TemporaryDirectory() as folder:
            picture(Path(folder))
