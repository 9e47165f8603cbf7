"""Runs that diverge: exit code, message, and files that show the last sound state."""

import json
import re
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from assembly import SIDES, simulate, two_blocks

from mpmgeo import cli
from mpmgeo.run.watch import Diverged

SHOWN = {
    "print": 10,
    "material_point_results": ["id", "displacement", "velocity", "stress"],
    "grid_nodal_results": ["id", "mass", "velocity"],
}
MESSAGE = re.compile(
    r"the run diverged in step (\d+) \(time (\S+) s\): particle (\d+) of material (\d+) "
    r"at \((.*?)\) m has a speed of (\S+) m/s, its last stress was \((.*?)\) Pa; (.*); "
    r"the files show the last sound state"
)


def unstable(factor=20.0, **keys):
    """Return a case whose time step is some times the critical one; the lower block is squeezed."""
    case = two_blocks(results=SHOWN, gravity=[0, 0, -9.81], **keys)
    case["mesh"]["boundary_conditions"] = dict.fromkeys(SIDES, "fixed")
    case["body"][1]["initial_velocity"] = [0.3, 0.1, -8.0]
    case["time_step"] = factor * simulate(case).critical_time_step
    case["time"] = 1000 * case["time_step"]
    return case


def files_of(folder):
    """Return the times and files of both collections."""
    found = []
    for name in ("particles/particleTimeSerie.pvd", "grid/gridTimeSerie.pvd"):
        entries = list(ElementTree.parse(folder / name).iter("DataSet"))
        paths = [(folder / name).parent / entry.get("file") for entry in entries]
        found.append(([float(entry.get("timestep")) for entry in entries], paths))
    return found


@pytest.fixture(scope="module")
def failed(tmp_path_factory):
    """Exit code, messages and folder of a run on the command line with an absurd time step."""
    folder = tmp_path_factory.mktemp("diverged")
    (folder / "case.json").write_text(json.dumps(unstable()))
    with pytest.MonkeyPatch.context() as patch:
        lines = []
        patch.setattr(cli, "_say", lambda kind, text: lines.append((kind, text)))
        code = cli.main(["--input", str(folder / "case.json"), "--output", str(folder), "--quiet"])
    return code, lines, folder


def test_exit_code(failed):
    assert failed[0] == cli.DIVERGED == 3


def test_unstable_time_step_is_warned_of_before(failed):
    _, lines, _ = failed
    kinds = [kind for kind, _ in lines]
    first = next(text for kind, text in lines if kind == "warning" and "stable" in text)
    assert "time step" in first or "time_step" in first
    assert kinds.index("warning") < kinds.index("error")


def test_message(failed):
    _, lines, _ = failed
    (text,) = [text for kind, text in lines if kind == "error"]
    match = MESSAGE.fullmatch(text)
    assert match, text
    step, time, particle, material, place, speed, stress, cause = match.groups()
    assert int(step) > 0 and float(time) > 0
    assert 0 <= int(particle) < 96
    assert int(material) == (9 if int(particle) < 64 else 4)
    assert len(place.split(", ")) == 3 and len(stress.split(", ")) == 6
    assert np.isfinite([float(x) for x in stress.split(", ")]).all()
    assert not float(speed) <= 0.5 / unstable()["time_step"] or "nan" in place
    assert re.search(r"exceeds \S+ s, up to which USL with GIMP is stable", cause)


def test_files_are_valid_and_sound(failed):
    _, _, folder = failed
    for times, paths in files_of(folder):
        assert len(times) >= 1 and times == sorted(times)
        for path in paths:
            mesh = meshio.read(path)
            assert np.isfinite(mesh.points).all()
            for name, values in mesh.point_data.items():
                assert np.isfinite(values).all(), (path.name, name)
    assert not list(folder.rglob("*.part"))


def test_energies_are_finite(failed):
    rows = (failed[2] / "time-energy.csv").read_text().splitlines()[1:]
    values = np.array([[float(x) for x in row.split(",")] for row in rows])
    assert np.isfinite(values).all()
    assert values[:, 0].tolist() == files_of(failed[2])[0][0]


def test_last_file_is_the_last_sound_state(failed):
    """It is the state of that time, as a run that stops there has it."""
    (times, paths), _ = files_of(failed[2])
    twin = simulate(unstable()).run(until=times[-1] - 1e-9)
    mesh = meshio.read(paths[-1])
    assert twin.time == times[-1]
    assert (mesh.points == twin.field("position")).all()
    assert (mesh.point_data["Velocity"] == twin.field("velocity")).all()


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
@pytest.mark.parametrize("factor", [3.0, 20.0, 1e4, 1e9])
def test_every_absurd_time_step_is_noticed(scheme, factor):
    """Whether particles fly out of the mesh, oscillate or become NaN at once."""
    simulation = simulate(unstable(factor, stress_scheme_update=scheme))
    with pytest.raises(Diverged, match=f"exceeds .* {scheme} with GIMP is stable"):
        simulation.run()
    for key in ("position", "velocity", "stress"):
        assert np.isfinite(simulation.field(key)).all()
    assert np.isfinite(simulation.kinetic_energy())


def test_absurd_load_with_a_sound_time_step():
    load = {"point_p1": [1, 1, 3], "point_p2": [2, 2, 4], "load": [1e12, 0, 0]}
    simulation = simulate(two_blocks(load_distributed_box=[load]))
    with pytest.raises(Diverged) as caught:
        simulation.run()
    assert "below" in str(caught.value) and "USL with GIMP is stable" in str(caught.value)
    assert MESSAGE.fullmatch(str(caught.value))


def test_single_steps_raise_too():
    simulation = simulate(unstable(1e9))
    with pytest.raises(Diverged, match="diverged in step"):
        simulation.step(200)


def test_steps_of_a_user_can_be_checked():
    simulation = simulate(two_blocks()).step(3)
    simulation.check()
    velocity = simulation.field("velocity")
    velocity[40] = np.nan
    simulation.assign("velocity", velocity)
    with pytest.raises(Diverged, match="particle 40 of material 9"):
        simulation.check()
