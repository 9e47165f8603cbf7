"""Particles, lists and meshes that cannot be used: a clear message, exit code 2, no files."""

import json

import meshes
import numpy as np
import pytest
from refusal import refusal_of

CUBE = ("hexahedron", *meshes.box("hexahedron"))
GROUPS = {"type": "gmsh", "mesh_file": "m.msh", "physical_to_material": {"soil": 1}}
LIST = {"type": "particles_list", "file": "list.json"}
ENTRY = {"position": [1, 1, 1], "volume": 1.0, "material_id": 1}
COLUMNS = {"position": [[1, 1, 1], [2, 1, 1]], "volume": [1, 1], "material_id": [1, 1]}


def refused(case, body, capsys):
    """Return what the program says about a case with a body that it refuses to run."""
    case["body"] = {"b": body}
    return refusal_of(case, capsys)


@pytest.fixture(autouse=True)
def nothing_is_written(folder):
    yield
    assert not (folder / "out").exists()


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"volume": [1]}, "body.b.particles.volume: has 1 entries for 2 particles"),
        ({"material_id": [1]}, "body.b.particles.material_id: has 1 entries for 2 particles"),
        ({"id": [1, 2, 3]}, "body.b.particles.position: has 2 entries for 3 particles"),
        ({"volume": [1, -1]}, "body.b.particles.volume[1]: -1 is not accepted"),
        ({"volume": [1, 0]}, "body.b.particles.volume[1]: 0 is not accepted"),
        ({"volume": [1, "1"]}, 'body.b.particles.volume[1]: "1" is not accepted'),
        ({"volume": [1, float("nan")]}, "body.b.particles.volume[1]: NaN is no finite number"),
        ({"volume": 1}, "body.b.particles.volume: 1 is not accepted; accepted: a list of numbers"),
        ({"position": [[1, 1, 1], [2, 1]]}, "body.b.particles.position[1]: [2, 1] is not accepted"),
        ({"position": {}}, "body.b.particles.position: {} is not accepted"),
        ({"material_id": [1, 9]}, "body.b.particles.material_id[1]: 9 is no id of a material"),
        ({"material_id": ["soil", 1]}, 'body.b.particles.material_id[0]: "soil" is not accepted'),
        ({"volume": None}, "body.b.particles.volume: missing"),
        ({"material_id": None}, "body.b.particles: material_id is missing"),
    ],
    ids=str,
)
def test_particles(case, keys, message, capsys):
    body = {"type": "particles", "particles": COLUMNS | keys}
    assert message in refused(case, body, capsys)


FILES = {
    "missing": (None, "body.b.file: there is no file"),
    "empty": ("", "not JSON: line 1, column 1"),
    "no JSON": ("x,y,z\n1,2,3\n", "not JSON: line 1, column 1"),
    "binary": (b"\x89PNG\r\n\xff\xfe\x00", "list.json: not JSON"),
    "deep": ("[" * 100_000, "list.json: not JSON"),
    "an object": ('{"particles": []}', 'needs a list of objects with "position" and "volume"'),
    "a number": ("3", 'needs a list of objects with "position" and "volume"'),
    "a list of numbers": ("[1, 2]", "list.json, entry 1: needs an object"),
    "no position": ([{"volume": 1}], 'entry 1: "position" is missing'),
    "no volume": ([ENTRY, {"position": [1, 1, 1]}], 'entry 2: "volume" is missing'),
    "no material": ([{"position": [1, 1, 1], "volume": 1}], 'entry 1: "material_id" is missing'),
    "short position": ([ENTRY | {"position": [1, 1]}], 'entry 1: "position" needs three finite'),
    "text position": ([ENTRY | {"position": "1 1 1"}], 'entry 1: "position" needs three finite'),
    "NaN position": ([ENTRY | {"position": [1, float("nan"), 1]}], '"position" needs three finite'),
    "NaN volume": ([ENTRY, ENTRY | {"volume": float("nan")}], 'entry 2: "volume" needs a finite'),
    "infinite": ([ENTRY | {"volume": float("inf")}], 'entry 1: "volume" needs a finite'),
    "huge": ([ENTRY | {"volume": 10**400}], 'entry 1: "volume" needs a finite number above 0'),
    "negative": ([ENTRY | {"volume": -0.5}], '"volume" needs a finite number above 0, has -0.5'),
    "zero": ([ENTRY | {"volume": 0}], '"volume" needs a finite number above 0, has 0'),
    "text volume": ([ENTRY | {"volume": "1"}], '"volume" needs a finite number above 0, has "1"'),
    "true": ([ENTRY | {"volume": True}], '"volume" needs a finite number above 0, has true'),
    "material word": ([ENTRY | {"material_id": "soil"}], '"material_id" needs a whole number'),
    "material 1.5": ([ENTRY | {"material_id": 1.5}], '"material_id" needs a whole number, has 1.5'),
    "unknown material": ([ENTRY | {"material_id": 9}], "body.b.file: 9 is no id of a material"),
}


@pytest.mark.parametrize("name", FILES)
def test_particle_file(folder, case, name, capsys):
    content, message = FILES[name]
    if isinstance(content, list):
        content = json.dumps(content)
    if content is not None:
        content = content if isinstance(content, bytes) else content.encode()
        (folder / "list.json").write_bytes(content)
    assert message in refused(case, LIST, capsys)


def test_particle_file_is_a_folder(folder, case, capsys):
    (folder / "list.json").mkdir()
    assert "body.b.file: there is no file" in refused(case, LIST, capsys)


def mesh(names=None, part=CUBE, lift=None):
    return meshes.mesh_of({"soil": [part]}, names, lift)


MESHES = {
    "unknown group": (
        mesh({"soil": (1, 3)}),
        {"soi1": 1},
        'body.b.physical_to_material.soi1: no physical group of the mesh, which has "soil"; '
        'did you mean "soil"?',
    ),
    "quite another name": (mesh(), {"water": 1}, "physical_to_material.water: no physical group"),
    "group of surfaces": (
        meshes.mesh_of({"soil": [CUBE], "top": [CUBE]}, {"soil": (1, 3), "top": (2, 2)}),
        {"top": 1},
        'physical_to_material.top: a group of the mesh, but not of volumes; those are "soil"',
    ),
    "only surfaces": (
        mesh({"soil": (1, 2)}),
        {"soil": 1},
        "m.msh has no physical group of volumes",
    ),
    "no groups": (mesh({"soil": (0, 9)}), {"soil": 1}, "m.msh has no physical group of volumes"),
    "empty group": (
        meshes.mesh_of({"soil": [CUBE]}, {"soil": (1, 3), "rock": (2, 3)}),
        {"rock": 1},
        "body.b.mesh_file: ",
    ),
    "unknown material": (
        mesh(),
        {"soil": 9},
        "physical_to_material.soil: 9 is no id of a material",
    ),
    "no material": (mesh(), {"soil": 0}, "physical_to_material: names no group with a material"),
    "no map": (mesh(), {}, "physical_to_material: names no group with a material above 0"),
    "list": (
        mesh(),
        ["soil"],
        'physical_to_material: ["soil"] is not accepted; accepted: an object',
    ),
    "material word": (mesh(), {"soil": "1"}, 'physical_to_material.soil: "1" is not accepted'),
    "flat": (
        mesh(lift=lambda x: x * [1, 1, 0]),
        {"soil": 1},
        "8 hexahedron without volume or folded",
    ),
    "folded": (
        mesh(part=(CUBE[0], CUBE[1], CUBE[2][:, [0, 2, 1, 3, 4, 5, 6, 7]])),
        {"soil": 1},
        "8 hexahedron without volume or folded, one at (0.25, 0.25, 0.25) m",
    ),
    "NaN": (
        mesh(lift=lambda x: x * np.nan),
        {"soil": 1},
        "has nodes whose coordinates are not finite",
    ),
    "wedges": (
        mesh(part=("wedge", np.random.default_rng(1).random((6, 3)), np.arange(6)[None])),
        {"soil": 1},
        'the group "soil" holds elements of type wedge; supported: tetra, tetra10, hexahedron',
    ),
}


@pytest.mark.parametrize("version", ["2.2", "4.1"])
@pytest.mark.parametrize("name", MESHES)
def test_mesh(folder, case, name, version, capsys):
    content, groups, message = MESHES[name]
    meshes.write(folder / "m.msh", content, version)
    assert message in refused(case, GROUPS | {"physical_to_material": groups}, capsys)


BROKEN = {
    "empty": b"",
    "text": b"this is no mesh\n",
    "binary": bytes(range(256)) * 4,
    "heading only": b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
    "version 1": b"$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n0\n$ENDELM\n",
    "unknown version": b"$MeshFormat\n9.9 0 8\n$EndMeshFormat\n",
    "STL": b"solid part\n facet normal 0 0 1\n  outer loop\n",
    "no elements": b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n0 0 0 0\n$EndNodes\n",
}


@pytest.mark.parametrize("name", BROKEN)
def test_file_that_is_no_mesh(folder, case, name, capsys):
    (folder / "m.msh").write_bytes(BROKEN[name])
    shown = refused(case, GROUPS, capsys)
    assert "body.b.mesh_file: " in shown
    assert "m.msh" in shown


def test_missing_mesh(case, capsys):
    assert "body.b.mesh_file: there is no file" in refused(case, GROUPS, capsys)


@pytest.mark.parametrize(("version", "is_binary"), meshes.FORMATS)
@pytest.mark.parametrize("share", [0.2, 0.5, 0.8, 0.97])
def test_mesh_that_was_cut_short(folder, case, version, is_binary, share, capsys):
    path = meshes.write(folder / "m.msh", mesh(), version, is_binary)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])
    assert "body.b." in refused(case, GROUPS, capsys)


def test_node_that_is_not_there(folder, case, capsys):
    path = meshes.write(folder / "m.msh", mesh())
    lines = path.read_text().split("\n")
    start = lines.index("$Elements") + 2
    lines[start] = " ".join([*lines[start].split()[:-1], "9999"])
    path.write_text("\n".join(lines))
    assert "body.b.mesh_file: " in refused(case, GROUPS, capsys)


def test_distribution_word(folder, case, capsys):
    meshes.write(folder / "m.msh", mesh())
    body = GROUPS | {"particle_distribution": "gausian"}
    assert 'did you mean "gaussian"?' in refused(case, body, capsys)


def test_too_many_particles(folder, case, capsys):
    meshes.write(folder / "m.msh", mesh())
    body = GROUPS | {"particle_distribution": "per_cell", "particles_per_direction": 3 * [10**6]}
    assert "more than the 1e+09 that fit" in refused(case, body, capsys)
