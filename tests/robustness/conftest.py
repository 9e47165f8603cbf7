import json
from pathlib import Path

import pytest

SOUND = Path(__file__).with_name("sound.json")
RECORD = "t,ax,ay,az\n" + "".join(f"{n / 100},{n % 7 / 10},0,0\n" for n in range(101))


@pytest.fixture
def case():
    """A valid case that uses nearly everything, new for every test."""
    return json.loads(SOUND.read_text())


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The working directory, which holds the record that the case names."""
    (tmp_path / "record.csv").write_text(RECORD)
    monkeypatch.chdir(tmp_path)
    return tmp_path
