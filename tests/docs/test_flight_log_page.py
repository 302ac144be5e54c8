"""The flight log page's examples work on a log of the black box's own writer."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from tests.flightlog.logbook import quiet, write_flight
from tests.support.virtual_environment import REPOSITORY
from tests.support.waiting import HANG_S
from up_flightlog.cli.parser import add

PAGE = (REPOSITORY / "docs" / "flight-log.md").read_text(encoding="utf-8")
EXAMPLES = dict(re.findall(r"<!-- file: (\S+) -->\n```python\n(.*?)```", PAGE, re.DOTALL))


@pytest.fixture
def run(tmp_path):
    """Return a function that runs an example of the page on a file."""

    def run(name, path):
        program = tmp_path / name
        program.write_text(EXAMPLES[name])
        return subprocess.run(
            [sys.executable, program, path],
            env={**os.environ, "PYTHONPATH": str(REPOSITORY)},
            capture_output=True,
            text=True,
            timeout=HANG_S,
            check=False,
        )

    return run


def test_ten_lines_with_the_official_package(run, tmp_path):
    done = run("attitude.py", write_flight(tmp_path, 1))
    lines = done.stdout.splitlines()
    assert done.returncode == 0, done.stderr
    assert len(lines) == 200 and lines[3] == "1777000000.300 1.00 arduino (board)"
    assert len(EXAMPLES["attitude.py"].splitlines()) <= 10


@pytest.mark.parametrize("is_finished", [True, False])
def test_ours_reads_what_was_cut_off_too(run, tmp_path, is_finished):
    done = run("rolls.py", write_flight(tmp_path, 1, is_finished=is_finished))
    assert re.findall(r"[\d.]+", done.stdout) == ["200", "19.9", "1.0"], done.stderr


def test_the_official_package_refuses_what_was_cut_off(run, tmp_path):
    assert run("attitude.py", write_flight(tmp_path, 1, is_finished=False)).returncode != 0


def test_every_verb_is_on_the_page():
    import argparse

    verbs = argparse.ArgumentParser().add_subparsers()
    add(verbs)
    below = next(
        action for action in verbs.choices["log"]._actions if isinstance(action.choices, dict)
    )
    for verb in ("list", "info", "export", "plot", "report", "view"):
        assert verb in below.choices and f"\n    up log {verb} " in f"{PAGE} ".replace(
            "log list\n", "log list \n"
        )


def test_the_topics_that_it_names_are_recorded(tmp_path):
    from up_flightlog.read.flight_log import FlightLog

    log = FlightLog.read([write_flight(tmp_path, 1, quiet)])
    for topic in ("up.orientation.update", "up.rx.update", "up.flight.state", "arduino.status"):
        assert f"`{topic}." in PAGE and topic in log.topics
