"""The virtual phone as a program: its options, its lines, its end."""

import json
import subprocess

import pytest

from tests.support.java import CONSOLE, java_program
from up_simulator.phone.java_program import MAIN

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


@pytest.mark.parametrize("main", [MAIN, CONSOLE])
def test_help_teaches(program, main):
    done = run(program, "--help", main=main)
    assert done.returncode == 0 and done.stderr == ""
    assert done.stdout.startswith("usage: ") and "try: (" in done.stdout
    assert all(len(line) < 100 for line in done.stdout.splitlines())


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--fly"], "--fly: no such option, or its value is missing; --help tells them"),
        (["--fly", "high"], "--fly: no such option; --help tells them"),
        (["--raspberry", "pi"], "--raspberry 'pi' is not HOST:GENERAL:ORIENTATION"),
        (["--raspberry", "pi:0:1"], "--raspberry: a port is 1 to 65535, not '0'"),
        (["--runner", "x:y"], "--runner: a port is 1 to 65535, not 'y'"),
        (
            ["--runner", "x:1", "--discover", "y:2"],
            "--runner and --discover are two ways of finding the same: choose one",
        ),
        (["--orientation", "ip"], "--orientation 'ip' is not off, tcp or udp"),
        (["--seed", "-1"], "--seed is 0 to 2147483647, not '-1'"),
        (["--mounting", "1 2 3"], "--mounting: the mounting is four numbers, not '1 2 3'"),
    ],
)
def test_a_wrong_option_is_one_sentence(program, options, sentence):
    done = run(program, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"virtual phone: {sentence}\n"


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--proxy", "x"], "--proxy 'x' is not HOST:PORT"),
        (["--seat", "air"], "--seat 'air' is not command or listen"),
        (["--aircraft", "a b"], "the aircraft's name must be 1 to 32 letters"),
    ],
)
def test_a_wrong_option_of_the_console_is_one_sentence(program, options, sentence):
    done = run(program, *options, main=CONSOLE)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"ground console: {sentence}")
    assert done.stderr.count("\n") == 1


def test_it_ends_with_its_input_and_says_what_it_counted(program):
    done = run(program, *PLACE)
    assert (done.returncode, done.stderr) == (0, "")
    last = json.loads(done.stdout.splitlines()[-1])
    assert last["event"] == "counters" and last["connections"] == 0
