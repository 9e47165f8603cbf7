"""The shape of the source itself: who imports whom and when, sizes, docstrings."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

import mpmgeo

PACKAGE = Path(mpmgeo.__file__).parent
FILES = sorted(PACKAGE.rglob("*.py"))
FILE = pytest.mark.parametrize("path", FILES, ids=[str(f.relative_to(PACKAGE)) for f in FILES])

# Each part of the package imports only from the rows above its own.
LEVELS = (
    {"parameters", "numerics", "naming", "values", "positions", "instants", "effect"},
    {"region", "listed", "action", "formulation"},
    {"state"},
    {"shapes", "materials", "bodies", "boundaries", "loads", "damping", "transfers", "output"},
    {"mpm"},
    {"run"},
    {"case"},
    {"simulation"},
    {"verify", "benchmark"},
    {"cli"},
    {"__init__", "__main__"},
)
LEVEL = {part: level for level, parts in enumerate(LEVELS) for part in parts}
# Stricter than their rows: output shows what others computed, the loop knows no physics.
ONLY = {
    "output": {"output", "naming", "numerics", "parameters", "positions", "region", "state"},
    "run": {"run", "instants", "numerics", "parameters", "positions", "state"},
}
HEAVY = {"vtk", "vtkmodules", "pyvista", "meshio", "scipy", "jsonschema", "rich", "matplotlib"}
MOST_LINES = 300
MOST_LINES_OF_A_FUNCTION = 60


def tree_of(path):
    return ast.parse(path.read_text(encoding="utf-8"), filename=str(path))


def part_of(path):
    """Return the part of the package that a file belongs to: its folder, or itself at the top."""
    first = path.relative_to(PACKAGE).parts[0]
    return first.removesuffix(".py")


def imported(nodes):
    """Return the full names of the modules that some syntax nodes import."""
    names = []
    for node in nodes:
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are absolute"
            names += [f"{node.module}.{alias.name}" for alias in node.names]
    return names


def parts_imported(path):
    """Return the parts of the package that a file imports, at its top or anywhere in it."""
    names = imported(ast.walk(tree_of(path)))
    return {name.split(".")[1] for name in names if name.startswith("mpmgeo.")}


def outside_functions(tree):
    """Yield the nodes that run when the module is imported."""
    for node in ast.iter_child_nodes(tree):
        if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)):
            yield node
            yield from outside_functions(node)


@FILE
def test_imports_go_one_way(path):
    part = part_of(path)
    assert part in LEVEL, f"{part} has no place in LEVELS"
    for other in parts_imported(path) - {part}:
        assert LEVEL[other] < LEVEL[part], f"{part} imports {other}"
        assert other in ONLY.get(part, {other}), f"{part} imports {other}"


def test_only_building_knows_every_package():
    """Of the reading of cases, nothing but building touches the solver or its kernels."""
    for path in (PACKAGE / "case").rglob("*.py"):
        if path.parent.name != "building":
            parts = parts_imported(path)
            assert not parts & {"state", "numerics", "run"}, path.name
            names = imported(ast.walk(tree_of(path)))
            solvers = [n for n in names if n.startswith("mpmgeo.mpm.") and ".schemes" not in n]
            assert not solvers, path.name


ROOMS = ("reading", "meaning", "building")


@pytest.mark.parametrize("room", ROOMS)
def test_rooms_of_a_case_do_not_know_each_other(room):
    """They share what a case may say and what there is to say about it, one folder above."""
    files = sorted((PACKAGE / "case" / room).glob("*.py"))
    assert len(files) > 3
    for path in files:
        names = [name.split(".") for name in imported(ast.walk(tree_of(path)))]
        visited = {name[2] for name in names if name[:2] == ["mpmgeo", "case"]}
        assert not visited & ({*ROOMS, "load", "resume", "tables"} - {room}), path.name


def test_models_do_not_know_the_cases():
    """A law, body or boundary is declared without knowing who reads the declaration."""
    for part in ("materials", "bodies", "boundaries", "loads", "shapes"):
        for path in (PACKAGE / part).glob("*.py"):
            assert "case" not in parts_imported(path)


@FILE
def test_heavy_libraries_are_imported_where_they_are_used(path):
    names = {name.split(".")[0] for name in imported(outside_functions(tree_of(path)))}
    assert not names & HEAVY


@FILE
def test_sizes(path):
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) < MOST_LINES
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno < MOST_LINES_OF_A_FUNCTION, node.name


def is_registered(node):
    """Tell whether a function implements an open one, whose stub documents it."""
    calls = [d.func for d in node.decorator_list if isinstance(d, ast.Call)]
    return any(ast.unparse(call).endswith(".register") for call in calls)


def public(body):
    """Yield the public functions, classes and methods of a module or class body."""
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
            yield node
            if isinstance(node, ast.ClassDef):
                yield from public(node.body)


@FILE
def test_docstrings(path):
    tree = tree_of(path)
    assert not tree.body or ast.get_docstring(tree), "a file says what it is for"
    for node in public(tree.body):
        if isinstance(node, ast.FunctionDef) and not is_registered(node):
            assert ast.get_docstring(node), f"{node.name} has no docstring"


@FILE
def test_text_is_for_the_reader_of_today(path):
    """No notes to oneself."""
    text = path.read_text(encoding="utf-8")
    for word in ("TODO", "FIXME", "XXX", "HACK"):
        assert word not in text


@pytest.mark.parametrize("arguments", [["-c", "import mpmgeo"], ["-m", "mpmgeo", "--version"]])
def test_start_imports_no_numbers(arguments):
    """What needs no simulation starts at once."""
    done = subprocess.run(
        [sys.executable, "-X", "importtime", *arguments],
        env=os.environ | {"PYTHONPATH": str(PACKAGE.parent)},
        capture_output=True,
        text=True,
        check=True,
    )
    modules = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines() if "|" in line}
    assert "mpmgeo" in modules
    assert not modules & (HEAVY | {"numba", "numpy", "llvmlite"})


def test_a_case_is_read_without_writers():
    """Bad input need not wait for what only a run needs."""
    script = "import sys, mpmgeo.case.load; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=os.environ | {"PYTHONPATH": str(PACKAGE.parent)},
        capture_output=True,
        text=True,
        check=True,
    )
    # numba itself imports scipy where there is one
    assert not set(done.stdout.split()) & (HEAVY - {"jsonschema", "scipy"})


LOOPS_OF_THE_METHOD = 6
MOST_ARGUMENTS = 14


def kernels(path):
    """Yield the functions of a file that are compiled with loops over chunks, or by themselves."""
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.FunctionDef):
            marks = {ast.unparse(mark) for mark in node.decorator_list}
            if marks & {"blockwise", "compiled"}:
                yield node, marks


def test_the_method_has_few_loops():
    """What is done to a particle or node is said once, how they are gone through once."""
    loops = [
        n.name for f in (PACKAGE / "mpm").rglob("*.py") for n, m in kernels(f) if "blockwise" in m
    ]
    assert {"over_particles", "over_nodes"} <= set(loops)
    assert len(loops) <= LOOPS_OF_THE_METHOD
    assert not any(
        "prange" in path.read_text(encoding="utf-8") for path in FILES if path.name != "chunks.py"
    )


@FILE
def test_kernels_take_few_arguments(path):
    for node, _ in kernels(path):
        assert len(node.args.args) <= MOST_ARGUMENTS, node.name


@pytest.mark.parametrize("name", ["schemes.py", "stages.py"])
def test_schemes_and_stages_know_no_effect(name):
    tree = tree_of(PACKAGE / "mpm" / name)
    words = {getattr(node, "id", getattr(node, "attr", "")).lower() for node in ast.walk(tree)}
    words |= {alias for path in imported(ast.walk(tree)) for alias in path.lower().split(".")}
    for effect in ("contact", "ground", "tools", "fluid", "base", "reactions", "terrain"):
        assert not any(effect in word for word in words), effect
