"""The virtual phone as a program: its options, its lines, its end."""

import json
import subprocess

import pytest

from tests.support.java import CONSOLE, MAIN, java_program

LIMIT_S = 60.0
PLACE = ["--raspberry", "127.0.0.1:50001:50000"]


@pytest.fixture(scope="module")
def program():
    return java_program()


def run(program, *options, main=MAIN, text=""):
    return subprocess.run(
        program.command(*options, main=main),
        input=text,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )


@pytest.mark.parametrize(
    "options",
    [
        ["--fly"],
        ["--raspberry", "pi:0:1"],
        ["--runner", "x:1", "--discover", "y:2"],
        ["--orientation-hz", "-1"],
    ],
)
def test_a_wrong_option_is_refused_in_one_line_that_names_it(program, options):
    done = run(program, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert options[0] in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("options", [["--proxy", "x"], ["--seat", "air"]])
def test_a_wrong_option_of_the_console_is_refused_in_one_line(program, options):
    done = run(program, *options, main=CONSOLE)
    assert (done.returncode, done.stdout) == (2, "")
    assert options[0].lstrip("-") in done.stderr and done.stderr.count("\n") == 1


def test_it_ends_with_its_input_and_reports_its_counters(program):
    done = run(program, *PLACE)
    assert (done.returncode, done.stderr) == (0, "")
    last = json.loads(done.stdout.splitlines()[-1])
    assert last["event"] == "counters" and last["connections"] == 0
