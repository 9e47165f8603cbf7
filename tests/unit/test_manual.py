"""The manual and the README: their code runs as it stands, their links lead somewhere."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("manual/*.md"), *ROOT.glob("inputs/*/*.md")])
BLOCK = re.compile(
    r"<!-- (file: |end of: |same as: |run)(.*?) -->\n```python\n(.*?)```\n", re.DOTALL
)
LINK = re.compile(r"\]\(([^)\s]+)\)")


def blocks(page):
    """Return (what to do, file name, code) for every block that a remark before it marks."""
    return BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))


def run(script, folder, **environment):
    return subprocess.run(
        [sys.executable, "-W", "error::RuntimeWarning", "-c", script],
        cwd=folder,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_new_models_work_as_the_manual_says(tmp_path):
    """The files of the page on architecture, put into a copy of the package, make a case run."""
    shutil.copytree(
        ROOT / "mpmgeo", tmp_path / "mpmgeo", ignore=shutil.ignore_patterns("__pycache__")
    )
    scripts = []
    for action, name, code in blocks("manual/architecture.md"):
        if action == "run":
            scripts.append(code)
            continue
        if action == "same as: ":
            assert (tmp_path / name).read_text(encoding="utf-8") == code
            continue
        assert (tmp_path / name).exists() == (action == "end of: ")
        with (tmp_path / name).open("a", encoding="utf-8") as file:
            file.write(code if action == "file: " else "\n" + code)
    assert len(scripts) == 3
    place = {"PYTHONPATH": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path)}
    result = run("\n".join(scripts), tmp_path, **place)
    assert result.returncode == 0, result.stderr


def test_laboratory_works_as_the_page_says():
    """The soil fails where theory says."""
    [(_, _, code)] = blocks("manual/materials.md")
    result = run(code, ROOT, PYTHONPATH=str(ROOT))
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("page", ["README.md", "manual/output.md", "manual/python.md"])
def test_library_works_as_the_page_says(page):
    """The code prints the deflection of a cantilever at its end."""
    code = "\n".join(code for _, _, code in blocks(page))
    result = run(code, ROOT, PYTHONPATH=str(ROOT))
    assert result.returncode == 0, result.stderr
    assert float(result.stdout.split()[-1]) < 0


def anchors(page):
    """Return the anchors of a page's headings as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading).lower().replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for link in LINK.findall(page.read_text(encoding="utf-8")):
        if link.startswith(("http://", "https://")):
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        assert target.exists(), link
        assert target.is_relative_to(ROOT), link
        assert not anchor or anchor in anchors(target), link


def test_manual_lists_all_its_pages():
    index = (ROOT / "manual" / "index.md").read_text(encoding="utf-8")
    for page in (ROOT / "manual").glob("*.md"):
        assert page.name == "index.md" or f"({page.name})" in index


def test_results_of_the_first_command_are_no_part_of_the_repository():
    assert "--output results\n" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert "results/" in (ROOT / ".gitignore").read_text(encoding="utf-8").split()


def test_pictures_are_small():
    for picture in (ROOT / "manual" / "pictures").glob("*.png"):
        assert picture.stat().st_size < 150_000, picture.name
