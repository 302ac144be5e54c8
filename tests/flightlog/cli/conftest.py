"""``up log`` in this process, away from the user's own flights and cache."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

import pytest

from up.cli.main import main


@dataclass
class Outcome:
    status: int
    out: str
    err: str


@pytest.fixture
def log(capsys, monkeypatch, tmp_path):
    """Return a function that carries out ``up log ...`` in ``tmp_path``."""
    monkeypatch.delenv("STATE_DIRECTORY", raising=False)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("TZ", "UTC")
    time.tzset()

    def log(*arguments: object, cwd: Path = tmp_path) -> Outcome:
        monkeypatch.chdir(cwd)
        try:
            status = main(["log", *map(str, arguments)])
        except SystemExit as end:
            status = int(end.code or 0)
        said = capsys.readouterr()
        assert "Traceback" not in said.err
        return Outcome(status, said.out, said.err)

    yield log
    monkeypatch.undo()
    time.tzset()


@pytest.fixture
def flights(tmp_path):
    """The folder in which the black box keeps flights without any configuration."""
    folder = tmp_path / "state" / "raspilot" / "flights"
    folder.mkdir(parents=True)
    return folder
