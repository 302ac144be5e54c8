"""The guide does what it says: its commands, its module, its Command, its cog."""

from __future__ import annotations

import json
import re
import subprocess

import pytest

from tests.docs.flying import copy_of_the_tree, files_of, flying, lines_of
from tests.support.virtual_environment import REPOSITORY, VirtualEnvironment

PAGE = "guide.md"
FILES = files_of(PAGE)


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    """The virtual aircraft in the air, with the guide's files in place."""
    with flying(tmp_path_factory.mktemp("guide"), FILES) as flight:
        yield flight


@pytest.mark.parametrize("line", [line for line in lines_of(PAGE, "flying") if line[:2] == "up"])
def test_a_command_of_the_flying_part(flight, line):
    done = flight.run(line)
    assert done.returncode == 0, done.stdout + done.stderr
    if "send" in line:
        assert "ack after" in done.stdout


def test_the_module_is_shorter_than_15_lines_and_its_value_is_in_telemetry(flight):
    assert len(FILES["modules/bank_module.py"].splitlines()) < 15
    text = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
    done = flight.run(re.search(r"up-ground watch --json .*", text)[0])
    assert json.loads(done.stdout.removeprefix('"bank": '))["steepest"] > 0, done.stderr


def test_the_remark_is_in_the_log(flight):
    (line,) = lines_of(PAGE, "remark")
    done = flight.run(line)
    assert (done.returncode, "ack after" in done.stdout) == (0, True), done.stdout + done.stderr
    log = flight.tree / "run" / "showcase" / "raspilot.log"
    flight.wait_for(lambda: "remark: lovely" in log.read_text())


def test_a_remark_that_is_too_long_is_refused_in_words(flight):
    done = flight.run(f"up-ground send --force raspilot.remark text={'x' * 81}")
    assert done.returncode == 1
    assert "text" in done.stdout + done.stderr and "80" in done.stdout + done.stderr


def test_the_cog_from_outside_is_gathered_and_listed(tmp_path):
    tree = copy_of_the_tree(tmp_path / "tree")
    (tree / "raspilot" / "external_modules.yml").unlink(missing_ok=True)
    (tree / "raspilot" / "Cogfile.yml").write_text("# The guide's cog alone.\n")
    environment = VirtualEnvironment(tmp_path / "environment")
    script = f'set -e\nup() {{ {environment.python} -m up.cli "$@"; }}\n'
    done = subprocess.run(
        ["bash", "-c", script + "\n".join(lines_of(PAGE, "cog"))],
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
