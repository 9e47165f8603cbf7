"""Nothing is asked of a solver but what a formulation offers, and the solver offers all of it."""

import ast
from pathlib import Path

import pytest
from assembly import assemble

import mpmgeo
from mpmgeo.formulation import Formulation, Terrain

PACKAGE = Path(mpmgeo.__file__).parent
ASKING = sorted(
    [PACKAGE / "simulation.py", PACKAGE / "cli.py", PACKAGE / "case" / "building" / "lint.py"]
    + [*(PACKAGE / "output").rglob("*.py"), *(PACKAGE / "run").rglob("*.py")]
    + [PACKAGE / "mpm" / "persistence.py"]
)


def members(protocol):
    """Return the names that a protocol declares."""
    methods = {name for name in vars(protocol) if not name.startswith("_")}
    return methods | set(protocol.__annotations__)


def asked(tree, of):
    """Yield the attributes that code reads of anything named `of`, or of an attribute so named."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            owner = node.value
            name = getattr(owner, "id", getattr(owner, "attr", None))
            if name == of:
                yield node.attr


@pytest.mark.parametrize("path", ASKING, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_only_what_a_formulation_offers_is_asked_for(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert set(asked(tree, "solver")) <= members(Formulation)
    assert set(asked(tree, "ground")) <= members(Terrain)


def test_something_is_asked():
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in ASKING]
    found = {name for tree in trees for name in asked(tree, "solver")}
    assert found >= {
        "step",
        "check",
        "keep",
        "restore",
        "owners",
        "sets",
        "population",
        "reactions",
    }


def test_the_material_point_method_is_one():
    solver = assemble([[5.0, 5.0, 5.0]])
    assert all(hasattr(solver, name) for name in members(Formulation))


def test_its_terrain_is_one():
    from mpmgeo.mpm.terrain.contact import Contact

    assert all(callable(getattr(Contact, name)) for name in members(Terrain))
