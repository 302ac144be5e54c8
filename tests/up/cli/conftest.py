"""The command line in this process, and in a separate one."""

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from tests.support.program_output import fields_of
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import HANG_S
from up.cli.main import main


@dataclass
class Outcome:
    status: int
    out: str
    err: str

    @property
    def codes(self) -> list[str]:
        return [each["code"] for each in fields_of(self.err + self.out)]

    @property
    def problem(self) -> dict[str, Any]:
        """Return the fields of the one error or warning."""
        (only,) = fields_of(self.err)
        return only


@pytest.fixture
def up(capsys, monkeypatch, tmp_path):
    """Return a function that carries out a command in this process, in ``tmp_path``."""
    monkeypatch.delenv("UP_MODE", raising=False)

    def up(*arguments: str, cwd: Path = tmp_path, as_json: bool = False) -> Outcome:
        monkeypatch.chdir(cwd)
        monkeypatch.setenv("UP_LOG_FORMAT", "json" if as_json else "")
        try:
            status = main([str(each) for each in arguments])
        except SystemExit as end:
            status = int(end.code or 0)
        said = capsys.readouterr()
        assert "Traceback" not in said.err
        return Outcome(status, said.out, said.err)

    return up


@pytest.fixture
def own_process():
    """Return a function that runs a Python module from the repository in another process."""

    def run(*arguments: str, cwd: Path, **more: str) -> subprocess.CompletedProcess[str]:
        path = os.pathsep.join([str(REPOSITORY), *more.pop("paths", "").split(os.pathsep)])
        environ = {**os.environ, "PYTHONPATH": path, "MYPYPATH": str(REPOSITORY), **more}
        return subprocess.run(
            [sys.executable, "-m", *map(str, arguments)],
            cwd=cwd,
            env=environ,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=HANG_S,
            check=False,
        )

    return run
