"""What keeps real programs from flying is one sentence and status 1."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from up_simulator.cli import main

LIMIT_S = 120.0
REAL = """\
title: Real
duration_s: 3
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]
raspilot: {runs: real}
ground: {}
events:
  - {at_s: 0.2, name: out, serial: unplugged}
  - {at_s: 0.4, name: in, serial: back}
expect: [{name: a, signal: time_s, above: -1}]
"""
TAKEN_PORT = """
import socket
from up_simulator.scenario.real_reactor import RealReactor
link = RealReactor.link
def taken(reactor, port, *models, **more):
    global held
    held = socket.socket()
    held.bind(("127.0.0.1", port))
    held.listen()
    link(reactor, port, *models, **more)
RealReactor.link = taken
"""
TAKEN_NAME = """
from up_simulator.scenario.real_participants import RealCompanions
plug = RealCompanions.plug_serial
def taken(companions, is_in):
    if is_in:
        (companions._folder / "board").write_text("of somebody else")
    plug(companions, is_in)
RealCompanions.plug_serial = taken
"""
FLY = """
import sys
from up_simulator.cli import main
sys.exit(main(["fly", "real.yml", "--no-picture", "--output", "out"]))
"""


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("real.yml").write_text(REAL)
    build_firmware()


def fly(trouble):
    return subprocess.run(
        [sys.executable, "-c", trouble + FLY],
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
        check=False,
    )


def test_a_port_that_the_link_cannot_have_is_told_before_the_flight():
    done = fly(TAKEN_PORT)
    assert done.stderr.startswith("up-sim: real: the link cannot listen on 127.0.0.1:")
    assert done.stderr.count("\n") == 1
    assert done.returncode == 1


def test_a_pty_that_cannot_come_back_ends_the_flight_with_a_report():
    done = fly(TAKEN_NAME)
    assert "Traceback" not in done.stderr, done.stderr
    assert done.returncode == 1
    assert "exists and is no symbolic link: left alone" in done.stdout
    failure = json.loads(Path("out/real/summary.json").read_text())["failure"]
    assert "board exists and is no symbolic link" in failure


def test_datagrams_to_a_black_box_are_a_mistake_of_the_file(capsys):
    lines = REAL.replace("ground: {}", "ground: {through: runner}\nphone: {orientation: udp}")
    Path("real.yml").write_text(lines)
    assert main(["check", "real.yml"]) == 2
    told = capsys.readouterr().err
    assert told.startswith("real.yml:6:") and "a Black Box on a server takes no datagrams" in told
