"""Fixtures of the runner's tests."""

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
