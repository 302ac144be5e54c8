"""Flights with real processes and sockets, each by the program as a user starts it."""

import json
import subprocess
import sys
from pathlib import Path

from tests.support.firmware import build_firmware
from up_flightlog.read.flight_log import FlightLog
from up_simulator.scenario.log import read_log

LIMIT_S = 240.0
HEAD = "title: Real\nsticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]\n"


def fly(folder, text):
    build_firmware()
    (folder / "real.yml").write_text(text)
    command = [sys.executable, "-m", "up_simulator.cli", "fly", "real.yml", "--no-picture"]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=LIMIT_S, check=False
    )
    assert "Traceback" not in done.stderr
    return done


def black_boxes(folder):
    """The daemon's recordings, one log for each of its lives."""
    found = sorted((folder / "run/flights/real/black-box").glob("*.mcap"))
    return [FlightLog.read([path]) for path in found]


def test_a_killed_daemon_returns_in_real_time(tmp_path):
    done = fly(
        tmp_path,
        HEAD
        + "duration_s: 13\nraspilot: {runs: real}\nphone: {}\nground: {period_ms: 50}\n"
        + "link: {up: {delay_ms: 20}, down: {delay_ms: 20}}\n"
        + "events:\n"
        + "  - {at_s: 0.5, command: {name: up.telemetry.frequency, data: {frequency: 200},"
        + " answer: ack, within_s: 5}}\n"
        + "  - {at_s: 1, name: killed, raspilot: killed}\n"
        + "  - {at_s: 2.5, name: started, raspilot: started}\n"
        + "expect:\n"
        + "  - {name: a, signal: board.armed, is: true}\n"
        + "  - {name: b, signal: board.pi_heard, after: killed, becomes: false, within_s: 1.5}\n"
        + "  - {name: c, signal: board.pi_heard, after: started, becomes: true, within_s: 10}\n"
        + "  - {name: d, signal: raspilot.running, after: killed, becomes: false, within_s: 0.1}\n"
        + "  - {name: e, signal: servo.stale_ms, below: 40}\n"
        + "  - {name: f, signal: ground.latency_s, below: 2}\n",
    )
    assert done.returncode == 0, done.stdout + done.stderr
    log = read_log(tmp_path / "run" / "flights" / "real" / "log.csv")
    assert max(log.numbers("ground.frames")) > 3
    first, second = black_boxes(tmp_path)
    for each in (first, second):
        assert each.topics["up.orientation.update"] > 20
    assert not first.is_complete, "it was killed"
    assert "up.telemetry.frequency" in first.topics or "up.telemetry.frequency" in second.topics


def test_a_daemon_that_fails_is_reported_with_its_newest_log_lines(tmp_path):
    done = fly(
        tmp_path,
        HEAD
        + "duration_s: 3\n"
        + "raspilot:\n  runs: real\n  config:\n    disabled_modules.yml:\n"
        + "      disabled modules: [serial_cog.modules.serial_provider.SerialProvider]\n"
        + "expect: [{name: a, signal: time_s, above: 0}]\n",
    )
    assert done.returncode == 1
    assert "SerialProvider" in done.stdout
    summary = json.loads(Path(tmp_path, "run/flights/real/summary.json").read_text())
    assert summary["held"] is False and summary["failure_code"] == "participant_failed"


def test_a_black_box_through_runner_and_proxy_leaves_no_process(tmp_path):
    done = fly(
        tmp_path,
        HEAD.replace(", mode: FBW, arm: true", "")
        + "duration_s: 4\nboard: direct\nraspilot: {runs: real}\nphone: {orientation: tcp}\n"
        + "ground: {through: runner}\n"
        + "expect:\n"
        + "  - {name: a, signal: ground.mode, is: black box}\n"
        + "  - {name: b, signal: ground.source.orientation, becomes: android, within_s: 4}\n",
    )
    assert done.returncode == 0, done.stdout + done.stderr
    (recorded,) = black_boxes(tmp_path)
    assert recorded.topics["up.orientation.update"] > 20
    for commands in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = commands.read_bytes()
        except OSError:
            continue
        assert b"up-sim-" not in words or str(tmp_path).encode() not in words
