"""Cases that ship are complete, and everything a case may choose is shown by one of them."""

import ast
import json
from pathlib import Path

import pytest

from mpmgeo.bodies import BODIES
from mpmgeo.case.load import load_case
from mpmgeo.damping import DAMPINGS
from mpmgeo.materials import LAWS
from mpmgeo.mpm.schemes import SCHEMES
from mpmgeo.verify.expected import COMPONENTS, expectations

ROOT = Path(__file__).parents[2]
FOLDERS = sorted(path for path in (ROOT / "inputs").iterdir() if path.is_dir())
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
WORDS = [choice.type for choice in (*LAWS, *BODIES, *DAMPINGS)] + list(SCHEMES)

by_folder = pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
by_example = pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)


@by_folder
def test_folder_explains_itself(folder):
    """Its README names the command that runs the case."""
    readme = (folder / "README.md").read_text(encoding="utf-8")
    assert f"mpmgeo --input inputs/{folder.name}/case.json" in readme


@by_folder
def test_case_says_what_it_is_and_what_to_expect(folder):
    case = load_case(folder / "case.json", strict=True)
    assert case.title
    assert case.reference
    found = expectations(case)
    assert found
    for expectation in found:
        assert expectation.component in COMPONENTS[expectation.field]
        assert expectation.tolerance > 0
        assert expectation.source
        assert 0 < expectation.time <= case.time


@by_folder
def test_case_is_free_of_notes(folder):
    """A case that ships is written in canonical keys, and small enough to read."""
    case = load_case(folder / "case.json")
    assert not case.notes
    assert not case.warnings
    assert all(path.stat().st_size < 200_000 for path in folder.iterdir() if path.is_file())


@by_example
def test_example_is_told_in_words(path):
    """It starts with a docstring, and loads what draws only when it is drawn."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert ast.get_docstring(tree)
    imported = {
        name
        for node in tree.body
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in [getattr(node, "module", None), *(alias.name for alias in node.names)]
        if name
    }
    assert not any(name.startswith("matplotlib") for name in imported)


@pytest.mark.parametrize("word", WORDS)
def test_every_choice_is_shown(word):
    """A law, body, damping or scheme that can be chosen is chosen by a case or an example."""
    texts = [path.read_text(encoding="utf-8") for path in EXAMPLES]
    cases = [json.loads((folder / "case.json").read_text()) for folder in FOLDERS]
    chosen = [json.dumps(case) for case in cases]
    assert word in ("none", "USL") or any(f'"{word}"' in text for text in texts + chosen)
