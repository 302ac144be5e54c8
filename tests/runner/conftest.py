"""Fixtures of the runner's tests."""

import shutil
import tempfile
from pathlib import Path

import pytest

from tests.runner.runners import RunnerProcess


@pytest.fixture
def runners(short_path):
    """Make real runners, each with its own folder; all are stopped afterwards."""
    made = []

    def make(**config):
        runner = RunnerProcess(short_path / str(len(made)), **config)
        made.append(runner)
        return runner

    yield make
    for runner in made:
        runner.clean()


@pytest.fixture(scope="module")
def shared_runner():
    folder = Path(tempfile.mkdtemp(prefix="upr-"))
    runner = RunnerProcess(folder, restarts={"delay": 0.05, "limit": 3}).start()
    yield runner
    runner.clean()
    shutil.rmtree(folder)


@pytest.fixture
def runner(shared_runner):
    """One real runner for the tests of a module; each test finds it without instances."""
    yield shared_runner
    shared_runner.reset()
