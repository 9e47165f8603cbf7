import json
from pathlib import Path

import pytest

SOUND = Path(__file__).with_name("sound.json")
PRESSURES = [{"position": [0.5, 0.5, 0.5], "pressure": 1000.0}]
RECORD = "t,ax,ay,az\n" + "".join(f"{n / 100},{n % 7 / 10},0,0\n" for n in range(101))


@pytest.fixture
def case():
    """A valid case that uses nearly everything, new for every test."""
    return json.loads(SOUND.read_text())


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working directory, which holds the files that the case names."""
    (tmp_path / "record.csv").write_text(RECORD)
    (tmp_path / "velocity.csv").write_text("0,0,,1\n1,1,,0\n")
    (tmp_path / "pressures.json").write_text(json.dumps(PRESSURES))
    monkeypatch.chdir(tmp_path)
    return tmp_path
