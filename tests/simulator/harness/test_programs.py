"""Real programs: started, killed within a frame, restarted, ended in every case."""

import signal
import subprocess
import sys

import pytest

from tests.support.waiting import DEADLINE_S, is_running, until
from up_rig.pty_line import PtyLine
from up_simulator.firmware.wire import checked_frame
from up_simulator.harness.child import Child
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.programs import RealRaspilot


def child(tmp_path, code):
    return Child("part", [sys.executable, "-c", code], tmp_path)


def test_its_lines_are_those_of_this_process_and_new_ones_come_once(tmp_path):
    (tmp_path / "part.log").write_text("earlier\n")
    made = child(tmp_path, "print('one'); print('two'); print('half', end='')")
    assert made.wait() == 0
    assert [line.text for line in made.lines()] == ["one", "two", "half"]
    assert [line.text for line in made.new_lines()] == ["one", "two"]
    assert made.new_lines() == []
    assert made.log.read_text().startswith("earlier\n")


READY = (
    "from up_simulator.harness.user_log import print_line; print_line('on 7', code='on', port=7)"
)


def test_a_line_is_awaited_by_its_code_and_fields(tmp_path):
    made = child(tmp_path, f"print('half'); {READY}; print('after')")
    passed = []
    line = made.wait_for("on", DEADLINE_S, on_line=passed.append, port=7)
    assert (line.text, line.fields["port"]) == ("on 7", 7)
    assert [each.text for each in passed][:2] == ["half", "on 7"]
    assert made.wait() == 0


def test_one_that_ends_before_it_is_ready_is_reported_with_its_log(tmp_path):
    made = child(tmp_path, "import sys; print('why'); sys.exit(3)")
    with pytest.raises(ParticipantError) as caught:
        made.wait_for("on", DEADLINE_S)
    report = str(caught.value).splitlines()
    assert "status 3" in report[0] and report[1:] == ["  why"]


def test_one_that_does_not_get_ready_times_out(tmp_path):
    made = child(tmp_path, f"import time; {READY}; time.sleep(600)")
    until(made.lines, "its first line")
    with pytest.raises(ParticipantError, match="port=8"):
        made.wait_for("on", 0.1, port=8)
    assert made.end() == -signal.SIGTERM


def test_one_that_ignores_the_signal_is_killed(tmp_path, monkeypatch):
    monkeypatch.setattr("up_simulator.harness.child.STOP_LIMIT_S", 0.2)
    code = f"import signal, time; signal.signal(15, signal.SIG_IGN); {READY}; time.sleep(600)"
    made = child(tmp_path, code)
    made.wait_for("on", DEADLINE_S)
    made.terminate()
    assert made.wait() == -signal.SIGKILL


def test_it_ends_when_we_are_killed(tmp_path):
    code = (
        "from up_simulator.harness.child import Child; import sys, time, pathlib;"
        f"made = Child('part', [sys.executable, '-c', 'import time; time.sleep(600)'],"
        f" pathlib.Path({str(tmp_path)!r})); print(made.pid, flush=True); time.sleep(600)"
    )
    us = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    pid = int(us.stdout.readline())
    us.kill()
    us.wait()
    us.stdout.close()
    until(lambda: not is_running(pid), "its end")


@pytest.fixture
def line(tmp_path):
    made = PtyLine(tmp_path / "board")
    yield made
    made.close()


@pytest.fixture
def raspilot(tmp_path, line):
    config = tmp_path / "config"
    config.mkdir()
    for name, text in {
        "arduino": f"port: {tmp_path / 'board'}\n",
        "android": "general port: 0\norientation port: 0\n",
        "discovery": "port: 0\n",
        "mission_control": "listener: {port: 0, address: 127.0.0.1}\n",
    }.items():
        (config / f"{name}.yml").write_text(text)
    made = RealRaspilot(config, tmp_path)
    yield made
    made.stop()


def test_the_daemon_is_killed_within_a_frame_and_restarted(raspilot, line, tmp_path):
    raspilot.start()
    with pytest.raises(ParticipantError, match="already"):
        raspilot.start()
    raspilot.wait_for("started")
    assert raspilot.is_running
    whole = checked_frame(0, "x", bytes(20))
    line.write(whole[: len(whole) // 2])
    raspilot.kill()
    assert not raspilot.is_running
    with pytest.raises(ParticipantError, match="signal 9"):
        raspilot.check()
    raspilot.start()
    raspilot.wait_for("started")
    raspilot.check()
    log = (tmp_path / "raspilot.log").read_text()
    assert log.count('"code": "started"') == 2, "both runs are in one log"
    raspilot.stop()
    assert not raspilot.is_running
