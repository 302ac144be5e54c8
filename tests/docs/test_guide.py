"""The guide works as written: its commands, its module, its Command, its cog."""

from __future__ import annotations

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import urllib.request
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.docs.flying import LIMIT_S, copy_of_the_tree, files_of, flying, lines_of
from tests.support.tools import need_browser
from tests.support.virtual_environment import REPOSITORY, VirtualEnvironment
from tests.support.waiting import HANG_S, until
from up_flightlog.read.flight_log import FlightLog

PAGE = "guide.md"
FILES = files_of(PAGE)
TEXT = (REPOSITORY / "docs" / PAGE).read_text(encoding="utf-8")
PROXY = "run/demo/proxy.pid"
ADDRESS = r"http://127\.0\.0\.1:\d+/"
FBW, OUTPUT = (
    "board: FBW: the sticks ask for attitude, within limits",
    "board: OUTPUT: the Raspberry Pi sets the servo positions",
)
ENDED = "aircraft ended unexpectedly with signal 9; the end of its log "


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    """The virtual aircraft in the air, with the guide's files in place."""
    with flying(tmp_path_factory.mktemp("guide"), FILES) as flight:
        yield flight


def test_the_steps_in_the_page(flight):
    node = need_browser()
    # Of all proxies on this machine only this flight's.
    proxy = _child(flight.process.pid, "up_proxy.main")
    assert lines_of(PAGE, "cut") == [f"kill -STOP $(cat {PROXY})"]
    assert lines_of(PAGE, "mend") == [f"kill -CONT $(cat {PROXY})"]
    assert (flight.tree / PROXY).read_text() == f"{proxy}\n"
    address = re.search(ADDRESS, flight.said.read_text())[0]
    steps = [node, Path(__file__).with_name("guide_page.mjs"), address, str(proxy)]
    done = subprocess.run(
        steps, env={**os.environ, "UP_PYTHON": sys.executable}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    written = re.search(r"Write `([^`]+)` under \*Mark in the flight log\*", TEXT)[1]
    # The mark that the cut link held back was refused.
    flight.wait_for(lambda: _marks(flight) == [written])


def _marks(flight):
    """Return the marks of the newest flight, that one that is still recorded."""
    parts = sorted((flight.tree / "run" / "demo" / "flights").glob("*.mcap"))
    return [each.data["text"] for each in FlightLog.read(parts).messages("black_box.mark")]


@pytest.mark.parametrize("line", [line for line in lines_of(PAGE, "flying") if line[:2] == "up"])
def test_a_command_of_the_flying_part(flight, line):
    done = flight.run(line)
    assert done.returncode == 0, done.stdout + done.stderr
    if "send" in line:
        assert "ack after" in done.stdout


def test_the_module_is_shorter_than_15_lines_and_its_value_is_in_telemetry(flight):
    assert len(FILES["modules/bank_module.py"].splitlines()) < 15
    done = flight.run(re.search(r"up-ground watch --json .*bank.*", TEXT)[0])
    assert json.loads(done.stdout.removeprefix('"bank": '))["steepest"] > 0, done.stderr


def test_the_remark_is_in_the_log(flight):
    (line,) = lines_of(PAGE, "remark")
    done = flight.run(line)
    assert (done.returncode, "ack after" in done.stdout) == (0, True), done.stdout + done.stderr
    log = flight.tree / "run" / "demo" / "raspilot.log"
    flight.wait_for(lambda: "remark: lovely" in log.read_text())


def test_a_remark_that_is_too_long_is_refused_in_words(flight):
    done = flight.run(f"up-ground send --force raspilot.remark text={'x' * 81}")
    assert done.returncode == 1
    assert "text" in done.stdout + done.stderr and "80" in done.stdout + done.stderr


def test_a_dead_part_ends_the_run_and_by_hand_the_others_survive_it(tmp_path):
    make_run = "make run CONTROLLER=raspberry"
    assert all(f"`{words}`" in TEXT for words in (make_run, FBW, OUTPUT))
    with flying(tmp_path / "flight", {}, make_run) as flight:
        aircraft = flight.tree / re.search(r"`kill -9 \$\(cat (\S+aircraft.pid)\)`", TEXT)[1]
        os.kill(int(aircraft.read_text()), signal.SIGKILL)
        assert flight.process.wait(LIMIT_S) == 1
        assert not list(aircraft.parent.glob("*.pid"))
        said = flight.said.read_text()
        assert ENDED in TEXT and ENDED in said
        _look_at_the_flight(flight, said)
        proxy, simulator, daemon, _watch = lines_of(PAGE, "by hand")
        general, orientation = re.findall(
            r"port: (\d+)", (flight.tree / "run/demo/config/android.yml").read_text()
        )
        simulator += f" --general-port {general} --orientation-port {orientation}"
        with ExitStack() as stack:

            def start(line: str, log: str) -> tuple[subprocess.Popen[bytes], Path]:
                return _started(stack, line, flight.tree, flight.environ, tmp_path / log)

            start(proxy, "proxy")
            board, _said = start(simulator, "board 1")
            aircraft, log = start(daemon, "aircraft 1")
            until(lambda: "FlightModeManager: flies" in log.read_text(), log.read_text)
            board.send_signal(signal.SIGINT)
            until(lambda: "does not fly" in log.read_text(), log.read_text)
            until(lambda: "provisionally in Black Box Mode" in log.read_text(), log.read_text)
            assert not (flight.tree / "run/demo/board").is_symlink()
            log.write_text("")
            board, board_said = start(simulator, "board 2")
            until(lambda: "FlightModeManager: flies" in log.read_text(), log.read_text)
            until(lambda: OUTPUT in board_said.read_text(), board_said.read_text)
            board_said.write_text("")
            aircraft.kill()
            until(lambda: FBW in board_said.read_text(), board_said.read_text)
            start(daemon, "aircraft 2")
            until(lambda: OUTPUT in board_said.read_text(), board_said.read_text)


def _look_at_the_flight(flight, said):
    """Run the guide's commands for a flight that has ended."""
    for line in lines_of(PAGE, "after"):
        done = flight.run(line)
        assert done.returncode == 0, done.stdout + done.stderr
        assert "default" in done.stdout or "report.html" in done.stdout
    assert (flight.tree / "my_flight" / "report.html").is_file()
    (line,) = lines_of(PAGE, "replay")
    # The last lines of make run agree about this flight.
    assert line in said and lines_of(PAGE, "after")[-1].partition(" -o")[0] in said
    with ExitStack() as stack:
        words = flight.tree / "replay said"
        _started(stack, f"{line} --listen 127.0.0.1:0", flight.tree, flight.environ, words)
        until(lambda: "Ctrl-C ends it" in words.read_text(), words.read_text)
        with urllib.request.urlopen(re.search(ADDRESS, words.read_text())[0]) as page:
            assert b"<title>Up ground station</title>" in page.read()


def _child(parent: int, name: str) -> int:
    """Return the process number of a program's child."""
    for child in Path(f"/proc/{parent}/task/{parent}/children").read_text().split():
        if name in Path(f"/proc/{child}/cmdline").read_text().split("\0"):
            return int(child)
    raise LookupError(name)


def _started(
    stack: ExitStack, line: str, folder: Path, environ: dict[str, str], log: Path
) -> tuple[subprocess.Popen[bytes], Path]:
    """Start a line of the page until the end of the stack; its words go to a file's end."""
    with log.open("ab") as stream:
        process = subprocess.Popen(
            shlex.split(line),
            cwd=folder,
            env={**environ, "PYTHONUNBUFFERED": "1"},
            stdout=stream,
            stderr=subprocess.STDOUT,
        )
    stack.callback(process.wait)
    stack.callback(process.kill)
    return process, log


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
        timeout=HANG_S,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "lidar_cog.modules.lidar_module.LidarModule" in done.stdout
    assert (tmp_path / "lidar_cog" / "README.md").is_file()
    assert (tree / "config" / "lidar.yml").is_file()
