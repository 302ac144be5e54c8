"""What every program does before its own code runs."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.waiting import HANG_S

ROOT = Path(__file__).parents[3]
HOOKED = """\
import os, runpy, signal, sys
_, module, name = sys.argv
def hook(event, details):
    if event == "import" and details[0] == module:
        os.kill(os.getpid(), signal.SIGINT)
sys.addaudithook(hook)
sys.argv = ["program"]
(runpy.run_path if name.endswith(".py") else runpy.run_module)(name, run_name="__main__")
"""
PROGRAMS = {
    "up.cli": "up.cli.parser",
    "up_ground": "up_ground.arguments",
    "up_cluster.fleet": "up_cluster.fleet.tables",
    "up_proxy": "twisted",
    "up_runner": "twisted",
    "up_simulator": "up_simulator.verbs.catalogue",
    "up_simulator.demo": "up_simulator.demo.flight",
    str(ROOT / "main.py"): "up.program",
}
"""Each with one of the first modules that it imports."""


def interrupted_at(module, program, **options):
    return subprocess.run(
        [sys.executable, "-c", HOOKED, module, program],
        capture_output=True,
        text=True,
        timeout=60,
        **options,
    )


@pytest.mark.parametrize("program", PROGRAMS)
def test_an_interrupted_import_ends_the_program_quietly(program, tmp_path):
    process = interrupted_at(PROGRAMS[program], program, cwd=tmp_path)
    assert (process.returncode, process.stderr) == (-signal.SIGINT, "")


def test_an_interrupt_that_the_program_does_not_handle_ends_it_quietly(tmp_path):
    # After the program's own modules, before its first handler.
    process = interrupted_at("twisted.internet.reactor", "up_runner", cwd=tmp_path)
    assert (process.returncode, process.stderr) == (128 + signal.SIGINT, "")


def test_a_background_job_ignores_the_interrupt_of_its_shell(tmp_path):
    def ignore():
        signal.signal(signal.SIGINT, signal.SIG_IGN)

    process = interrupted_at("up.cli.parser", "up.cli", cwd=tmp_path, preexec_fn=ignore)
    assert process.returncode == 2 and "usage: up" in process.stdout


@pytest.mark.parametrize("program", PROGRAMS)
def test_an_unknown_format_of_the_log_is_wrong_use(program, tmp_path):
    process = subprocess.run(
        [sys.executable, *([program] if program.endswith(".py") else ["-m", program])],
        capture_output=True,
        text=True,
        timeout=60,
        cwd=tmp_path,
        env={**os.environ, "UP_LOG_FORMAT": "JSON"},
    )
    assert process.returncode == 2 and process.stdout == ""
    assert process.stderr.count("\n") == 1 and "UP_LOG_FORMAT='JSON'" in process.stderr


@pytest.mark.parametrize(
    ("words", "output", "codes"),
    [
        (("modules",), "/dev/full", ["system_error"]),
        (("modules",), "a closed pipe", []),
        (("schemas", "UpFile/here"), os.devnull, ["system_error"]),
    ],
)
def test_what_cannot_be_written_is_one_sentence_and_a_closed_pipe_none(
    tmp_path, words, output, codes
):
    (tmp_path / "UpFile").write_text("")
    read, write = os.pipe()
    os.close(read)
    if output.startswith("/"):
        os.close(write)
        write = os.open(output, os.O_WRONLY)
    done = subprocess.run(
        [sys.executable, "-m", "up.cli", *words],
        cwd=tmp_path,
        env=os.environ | {"UP_LOG_FORMAT": "json"},
        stdout=write,
        stderr=subprocess.PIPE,
        timeout=HANG_S,
    )
    os.close(write)
    said = [json.loads(line)["fields"]["code"] for line in done.stderr.splitlines()]
    assert (done.returncode, said) == (1, codes)
