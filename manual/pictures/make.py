"""Draw the pictures of the manual, most of them from runs of the cases that ship."""

import runpy
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.collections import PatchCollection

import mpmgeo

matplotlib.use("agg")

HERE = Path(__file__).parent
INPUTS = HERE.parents[1] / "inputs"
EXAMPLES = HERE.parents[1] / "examples"
BAR = {"color": "black", "fmt": "%.3g", "title_font_size": 24, "label_font_size": 20}
SURFACE = {"ambient": 0.35, "diffuse": 0.75, "show_edges": True, "edge_opacity": 0.25}


def run(name, folder):
    """Run a case that ships, with files into `folder`; returns the simulation."""
    return mpmgeo.Simulation(mpmgeo.load_case(INPUTS / name / "case.json"), output=folder).run()


def frames(folder):
    """Return the particle files of a run in `folder` in order of time, with their times [s]."""
    reader = pyvista.PVDReader(folder / "particles" / "particleTimeSerie.pvd")
    for time in reader.time_values:
        reader.set_active_time_value(time)
        yield time, reader.read()[0]


def boxes(points, size):
    """Return every particle as a box of its size (3,) [m]."""
    box = pyvista.Cube(x_length=size[0], y_length=size[1], z_length=size[2])
    return points.glyph(geom=box, scale=False, orient=False)


def plotter(width, height):
    """Return an empty white scene of so many pixels, in parallel projection."""
    scene = pyvista.Plotter(off_screen=True, window_size=(width, height))
    scene.set_background("white")
    scene.enable_anti_aliasing("ssaa")
    scene.enable_parallel_projection()
    return scene


def look(scene, direction, centre, height):
    """Look along `direction` at `centre`; the picture shows `height` [m] from bottom to top."""
    centre = np.array(centre)
    scene.camera_position = [centre - np.array(direction), centre, (0, 0, 1)]
    scene.camera.parallel_scale = height / 2
    scene.reset_camera_clipping_range()


def save(scene, name):
    """Write a scene as small as png can without a visible loss."""
    from PIL import Image

    picture = Image.fromarray(scene.screenshot(return_img=True))
    picture.save(HERE / f"{name}.png", optimize=True)
    scene.close()


def cantilever(folder):
    """Bending stress in the cantilever, its deflection five times as large as it is."""
    simulation = run("cantilever", folder)
    *_, (_, particles) = frames(folder)
    particles["Stress xx [kPa]"] = particles["Stress_XX"] / 1e3
    particles.points += 4 * particles["Displacement"]
    scene = plotter(1200, 440)
    scene.add_mesh(
        boxes(particles, simulation.solver.population.size[0]),
        scalars="Stress xx [kPa]",
        cmap="coolwarm",
        clim=(-500, 500),
        **SURFACE,
        scalar_bar_args=BAR | {"width": 0.4, "height": 0.16, "position_x": 0.3, "position_y": 0.02},
    )
    scene.add_mesh(pyvista.Box((0, 2, 0, 0.1, 0, 0.4)), style="wireframe", color="grey")
    scene.add_mesh(pyvista.Box((-0.06, 0, -0.1, 0.2, -0.15, 0.5)), color="lightgrey", ambient=0.4)
    look(scene, direction=(-0.93, 5, -1.46), centre=(0.97, 0, 0.14), height=0.96)
    save(scene, "cantilever")


def boussinesq(folder):
    """Settlement below the point force: half of the cube, by decades."""
    simulation = run("boussinesq", folder)
    *_, (_, particles) = frames(folder)
    particles["Settlement [m]"] = -particles["Displacement"][:, 2]
    behind = particles.extract_points(particles.points[:, 1] > 0.5, adjacent_cells=False)
    scene = plotter(840, 600)
    scene.add_mesh(
        boxes(behind, simulation.solver.population.size[0]),
        scalars="Settlement [m]",
        cmap="viridis",
        clim=(4e-10, 4e-8),
        log_scale=True,
        **SURFACE,
        scalar_bar_args=BAR
        | {"vertical": True, "height": 0.7, "width": 0.1, "position_x": 0.76, "position_y": 0.14}
        | {"n_labels": 3},
    )
    force = pyvista.Arrow(start=(0.5, 0.5, 1.3), direction=(0, 0, -1), scale=0.29, tip_length=0.35)
    scene.add_mesh(force, color="firebrick", ambient=0.3)
    look(scene, direction=(-1.6, 5, -2.4), centre=(0.66, 0.75, 0.6), height=1.5)
    save(scene, "boussinesq")


def moving_base(folder):
    """Velocity of the base and of particles above it, over time."""
    run("base_acceleration", folder)
    heights = (0.025, 0.425, 0.775)
    times, velocities = [], []
    for time, particles in frames(folder):
        if not times:
            rows = [particles.find_closest_point((0.525, 0.525, z)) for z in heights]
        times.append(time)
        velocities.append(particles["Velocity"][rows, 0])
    figure, axes = plt.subplots(figsize=(9, 3.6), layout="constrained")
    t = np.linspace(0, 2, 400)
    axes.plot(t, -0.3 * np.sin(2 * np.pi * t), color="black", label="base: the sine of the record")
    for z, series, mark in zip(heights, np.transpose(velocities), "os^", strict=True):
        axes.plot(times, series, mark, markersize=5, label=f"particle at z = {z} m")
    axes.set(xlabel="time [s]", ylabel="velocity in x [m/s]", xlim=(0, 2))
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    figure.savefig(HERE / "moving_base.png", dpi=130)


def column_collapse(folder):
    """The heap of bars at rest, what moved in it, and the lines of the experiment."""
    simulation = run("column_collapse", folder)
    position = simulation.field("position")
    moved = np.linalg.norm(simulation.field("displacement"), axis=1) > 0.001
    figure, axes = plt.subplots(figsize=(9, 2.5), layout="constrained")
    for chosen, colour, label in (
        (moved, "#e8b04a", "moved by more than 1 mm"),
        (~moved, "#5b7aa8", "moved by less"),
    ):
        axes.plot(*position[chosen][:, [0, 2]].T, ".", markersize=1.6, color=colour, label=label)
    for name, style in (("free_surface", "o-"), ("failure_line", "^-")):
        line = np.loadtxt(INPUTS / "column_collapse" / f"{name}.csv", delimiter=",", skiprows=1).T
        label = f"experiment: {name.replace('_', ' ')}"
        axes.plot(*line, style, color="black", markersize=4, linewidth=1, label=label)
    axes.add_patch(plt.Rectangle((0, 0), 0.2, 0.1, fill=False, linestyle=":"))
    axes.set(aspect="equal", xlim=(0, 0.55), ylim=(0, 0.11), xlabel="x [m]", ylabel="z [m]")
    axes.legend(loc="upper right", frameon=False, markerscale=1.5, fontsize=9)
    figure.savefig(HERE / "column_collapse.png", dpi=130)


def dam_break():
    """Water of the dam break at four instants, and its front and height beside the experiment."""
    example = runpy.run_path(EXAMPLES / "06_dam_break.py")
    simulation = mpmgeo.Simulation(mpmgeo.load_case(INPUTS / "dam_break" / "case.json"))
    figure = example["plot"](example["found"])
    figure.savefig(HERE / "dam_break.png", dpi=110)
    size = simulation.solver.population.size[0] * 1e3
    figure, axes = plt.subplots(1, 4, figsize=(9, 2.1), layout="constrained", sharey=True)
    for T, axis in zip((0, 1, 2, 3), axes, strict=True):
        simulation.run(until=T * np.sqrt(0.05715 / (2 * 9.81)))
        x, _, z = 1e3 * simulation.field("position").T
        speed = np.linalg.norm(simulation.field("velocity"), axis=1)
        corners = np.column_stack([x - size[0] / 2, z - size[2] / 2])
        squares = [plt.Rectangle(corner, size[0], size[2]) for corner in corners]
        water = PatchCollection(squares, array=speed, cmap="viridis", clim=(0, 2))
        axis.add_collection(water)
        axis.set(title=f"T = {T}", xlim=(0, 240), ylim=(0, 120), aspect="equal", xlabel="x [mm]")
    figure.colorbar(water, ax=axes, label="speed [m/s]")
    figure.savefig(HERE / "dam_break_water.png", dpi=110)


def tile():
    """Blocks of nodes, the tile of one of them, and the nodes of one particle (GIMP)."""
    figure, axes = plt.subplots(figsize=(7.6, 4.2), layout="constrained")
    for corner in np.ndindex(2, 2):
        axes.add_patch(_square(np.multiply(4, corner) - 0.5, 4, fill=False, edgecolor="silver"))
    axes.add_patch(_square((-0.5, -0.5), 4, facecolor="#cfe0f3", edgecolor="tab:blue"))
    axes.add_patch(_square((-0.5, -0.5), 6, fill=False, edgecolor="tab:blue", linewidth=2.5))
    nodes = np.array(list(np.ndindex(8, 8)))
    axes.plot(*nodes.T, ".", color="grey", markersize=5)
    particle = np.array([3.8, 2.3])
    reached = nodes[(np.abs(nodes - np.round(particle)) < 1.5).all(axis=1)]
    axes.plot(*reached.T, "o", color="tab:red", markersize=9, fillstyle="none", markeredgewidth=2)
    axes.add_patch(_square(particle - 0.25, 0.5, facecolor="tab:red", alpha=0.6))
    for text, tip, height, colour in (
        ("tile: block and halo,\n6 × 6 × 6 records for GIMP", (5.5, 5.1), 5.9, "tab:blue"),
        ("particle and its 3 × 3 × 3 nodes", (4.05, 2.3), 3.2, "tab:red"),
        (
            "block: 4 × 4 × 4 nodes, and all\nparticles whose first node\nis one of them",
            (3.5, 0.3),
            0.5,
            "tab:blue",
        ),
    ):
        style = {"arrowstyle": "-", "color": colour}
        at = (8.1, height)
        axes.annotate(text, tip, at, color=colour, fontsize=11, va="center", arrowprops=style)
    axes.set(aspect="equal", xlim=(-0.6, 15), ylim=(-0.6, 7.6))
    axes.axis("off")
    figure.savefig(HERE / "tile.png", dpi=110)


def _square(corner, side, **style):
    return plt.Rectangle(corner, side, side, **style)


if __name__ == "__main__":
    tile()
    dam_break()
    for picture in (cantilever, boussinesq, moving_base, column_collapse):
        with TemporaryDirectory() as folder:
            picture(Path(folder))
