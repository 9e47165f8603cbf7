"""What scripts are shown: warnings of one category, once, about the line that asked for them."""

import json
import os
import subprocess
import sys
import warnings

import pytest
from assembly import two_blocks

import mpmgeo
from mpmgeo import cli

ODD = {"odd": 1}  # load_case warns of it
LONG = {"time_step": 1.0, "time": 2.0}  # Simulation warns of it


def caught(action):
    """Return the texts of the warnings that an action shows, all of our category and about here."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        action()
    assert all(w.category is mpmgeo.CaseWarning and w.filename == __file__ for w in seen)
    return [str(w.message) for w in seen]


def test_reading_a_case_warns():
    assert caught(lambda: mpmgeo.load_case(two_blocks(**ODD))) == ["odd: unknown key, ignored"]


def test_building_a_simulation_warns_of_what_only_it_knows():
    case = mpmgeo.load_case(two_blocks(**LONG))
    made = []
    (text,) = caught(lambda: made.append(mpmgeo.Simulation(case)))
    assert text.startswith("time_step: 1 s exceeds ")
    assert made[0].warnings == [text]


def test_each_warning_comes_once():
    """A simulation does not repeat what was said of its case, nor one that goes on."""
    texts = caught(lambda: mpmgeo.Simulation(mpmgeo.load_case(two_blocks(**ODD, **LONG))))
    assert len(texts) == 2 and texts[0].startswith("odd") and texts[1].startswith("time_step")
    assert caught(lambda: mpmgeo.Simulation(two_blocks(**ODD, **LONG))) == texts


def test_a_simulation_that_goes_on_is_not_looked_at_as_a_new_one(tmp_path):
    case = two_blocks(**LONG)
    mpmgeo.Simulation(case).save(tmp_path / "s.npz")
    assert caught(lambda: mpmgeo.Simulation.resume(tmp_path / "s.npz")) == []


def test_a_sound_case_is_silent():
    assert caught(lambda: mpmgeo.Simulation(two_blocks())) == []


def test_they_can_be_silenced_and_made_errors():
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("ignore", mpmgeo.CaseWarning)
        mpmgeo.load_case(two_blocks(**ODD))
    assert not seen
    with warnings.catch_warnings(), pytest.raises(mpmgeo.CaseWarning, match="odd"):
        warnings.simplefilter("error", mpmgeo.CaseWarning)
        mpmgeo.load_case(two_blocks(**ODD))


def test_a_script_sees_its_own_line(tmp_path):
    (tmp_path / "case.json").write_text(json.dumps(two_blocks(**ODD)))
    script = tmp_path / "script.py"
    script.write_text("import mpmgeo\n\nfor _ in range(3):\n    mpmgeo.load_case('case.json')\n")
    done = subprocess.run(
        [sys.executable, script], cwd=tmp_path, env=os.environ, capture_output=True, text=True
    )
    assert done.returncode == 0
    assert done.stderr.count("odd: unknown key, ignored") == 1
    assert "script.py:4: CaseWarning" in done.stderr


def test_the_command_shows_them_once_and_in_its_own_form(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.json").write_text(json.dumps(two_blocks(**ODD, **LONG)))
    before = list(warnings.filters)
    assert caught(lambda: cli.main(["case.json", "--check"])) == []
    shown = capsys.readouterr().err
    assert shown.count("odd: unknown key, ignored") == 1
    assert shown.count("USL with GIMP is stable here") == 1
    assert shown.count("warning:") == 2 and "CaseWarning" not in shown
    assert warnings.filters == before


# What a case may be


@pytest.mark.parametrize("kind", ["path", "text", "dict", "case"])
def test_a_simulation_takes_all_that_describes_a_case(tmp_path, kind):
    path = tmp_path / "case.json"
    path.write_text(json.dumps(two_blocks()))
    case = {"path": path, "text": str(path), "dict": two_blocks()}.get(kind)
    simulation = mpmgeo.Simulation(mpmgeo.load_case(path) if case is None else case)
    assert simulation.step().steps == 1


@pytest.mark.parametrize("make", [mpmgeo.load_case, mpmgeo.Simulation])
@pytest.mark.parametrize("wrong", [None, 3, [1], b"case.json"])
def test_what_is_needed_is_said(make, wrong):
    kind = type(wrong).__name__
    with pytest.raises(TypeError, match=rf"the path of its file, or a dict .*, no {kind}"):
        make(wrong)


def test_a_path_that_leads_nowhere():
    with pytest.raises(mpmgeo.CaseError, match="there is no file"):
        mpmgeo.Simulation("nowhere.json")
