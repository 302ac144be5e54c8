"""The guide does what it says: its commands, its module, its Command, its cog."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.support.virtual_environment import REPOSITORY, VirtualEnvironment

GUIDE = (REPOSITORY / "docs" / "guide.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"<!-- file: (\S+) -->\n```\w+\n(.*?)```", GUIDE, re.DOTALL))
BLOCKS = re.findall(r"<!-- run: (\w+) -->\n```\n(.*?)```", GUIDE, re.DOTALL)
LIMIT_S = 120.0


def lines_of(name):
    return [line for kind, block in BLOCKS if kind == name for line in block.splitlines()]


def copy_of_the_tree(folder):
    """A clone of what the guide touches, as it is after ``make run`` has installed everything."""
    ignored = shutil.ignore_patterns("__pycache__")
    for name in ("raspilot", "simulator", "cogs"):
        shutil.copytree(REPOSITORY / name, folder / name, ignore=ignored)
    shutil.copy(REPOSITORY / "main.py", folder)
    (folder / "config").mkdir()
    return folder


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    """The virtual aircraft in the air, with the guide's files in place."""
    folder = tmp_path_factory.mktemp("guide")
    tree = copy_of_the_tree(folder / "tree")
    for name, text in FILES.items():
        (tree / "raspilot" / name).write_text(text, encoding="utf-8")
    said = folder / "said"
    with said.open("wb") as stream:
        process = subprocess.Popen(
            [sys.executable, "-m", "up_simulator.showcase", "--any-ports", "--no-watch"],
            cwd=tree,
            env={**os.environ, "PYTHONPATH": str(tree / "simulator")},
            stdout=stream,
            stderr=subprocess.STDOUT,
        )
    try:
        wait_for(lambda: "Ctrl-C stops everything" in said.read_text(), process, said)
        port = re.search(r"ground on port (\d+)", said.read_text())[1]
        environ = {
            **os.environ,
            "UP_GROUND_PORT": port,
            "XDG_STATE_HOME": str(folder / "state"),
            "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
        }
        yield tree, environ, process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(LIMIT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def wait_for(condition, process, said):
    deadline_s = time.monotonic() + LIMIT_S
    while not condition():
        assert process.poll() is None, said.read_text()
        assert time.monotonic() < deadline_s, said.read_text()
        time.sleep(0.05)


def run(line, environ):
    return subprocess.run(
        ["bash", "-c", line], env=environ, capture_output=True, text=True, timeout=LIMIT_S
    )


@pytest.mark.parametrize("line", [line for line in lines_of("flying") if line[:2] == "up"])
def test_a_command_of_the_flying_part(flight, line):
    done = run(line, flight[1])
    assert done.returncode == 0, done.stdout + done.stderr
    if "send" in line:
        assert "ack after" in done.stdout


def test_the_module_is_shorter_than_15_lines_and_its_value_is_in_telemetry(flight):
    assert len(FILES["modules/bank_module.py"].splitlines()) < 15
    shown = re.search(r"up-ground watch --json .*", GUIDE)[0]
    done = run(shown, flight[1])
    assert json.loads(done.stdout.removeprefix('"bank": '))["steepest"] > 0, done.stderr


def test_the_remark_is_in_the_log(flight):
    tree, environ, process = flight
    (line,) = lines_of("remark")
    done = run(line, environ)
    assert (done.returncode, "ack after" in done.stdout) == (0, True), done.stdout + done.stderr
    log = tree / "run" / "showcase" / "raspilot.log"
    wait_for(lambda: "remark: lovely" in log.read_text(), process, log)


def test_a_remark_that_is_too_long_is_refused_in_words(flight):
    done = run(f"up-ground send --force raspilot.remark text={'x' * 81}", flight[1])
    assert done.returncode == 1
    assert "text" in done.stdout + done.stderr and "80" in done.stdout + done.stderr


def test_the_cog_from_outside_is_gathered_and_listed(tmp_path):
    tree = copy_of_the_tree(tmp_path / "tree")
    (tree / "raspilot" / "external_modules.yml").unlink(missing_ok=True)
    (tree / "raspilot" / "Cogfile.yml").write_text("# The guide's cog alone.\n")
    environment = VirtualEnvironment(tmp_path / "environment")
    script = f'set -e\nup() {{ {environment.python} -m up.cli "$@"; }}\n'
    done = subprocess.run(
        ["bash", "-c", script + "\n".join(lines_of("cog"))],
        cwd=tree,
        env=environment.environ(),
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "lidar_cog.modules.lidar_module.LidarModule" in done.stdout
    assert (tmp_path / "lidar_cog" / "README.md").is_file()
    assert (tree / "config" / "lidar.yml").is_file()
