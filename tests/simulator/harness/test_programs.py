"""Real programs: started, killed in mid-frame, started again, ended whatever happens."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from up_rig.pty_line import PtyLine
from up_simulator.firmware.wire import checked_frame
from up_simulator.harness.child import Child
from up_simulator.harness.participants import CrewError
from up_simulator.harness.real_raspilot import RealRaspilot
from up_simulator.harness.real_servers import RealProxy, RealRunner

DEADLINE_S = 60.0


def wait(condition, what):
    deadline_s = time.monotonic() + DEADLINE_S
    while not (value := condition()):
        assert time.monotonic() < deadline_s, f"never: {what}"
        time.sleep(0.02)
    return value


def child(tmp_path, code):
    return Child("part", [sys.executable, "-c", code], tmp_path)


def test_its_lines_are_those_of_this_life_and_new_ones_come_once(tmp_path):
    (tmp_path / "part.log").write_text("of another life\n")
    made = child(tmp_path, "print('one'); print('two'); print('half', end='')")
    assert made.wait() == 0
    assert made.lines() == ["one", "two", "half"]
    assert made.new_lines() == ["one", "two"]
    assert made.new_lines() == []
    assert "of another life" in made.log.read_text()


def test_one_that_dies_before_it_is_ready_says_why(tmp_path):
    made = child(tmp_path, "import sys; print('no port is free'); sys.exit(3)")
    with pytest.raises(CrewError) as caught:
        made.wait_for_line("listens", DEADLINE_S)
    said = str(caught.value)
    assert said.startswith("part ended by itself with status 3; its log ")
    assert said.endswith("ends:\n  no port is free")


def test_one_that_dies_without_a_word_is_one_line(tmp_path):
    made = child(tmp_path, "import sys; sys.exit(3)")
    assert made.last_words(made.wait()) == "part ended by itself with status 3 and said nothing"


def test_one_that_never_gets_ready_is_given_up(tmp_path):
    made = child(tmp_path, "import time; print('starting'); time.sleep(600)")
    wait(made.lines, "its first words")
    with pytest.raises(CrewError, match="no 'listens' within 0 s\n  starting"):
        made.wait_for_line("listens", 0.1)
    assert made.end() == -signal.SIGTERM


def test_one_that_does_not_want_to_end_is_forced(tmp_path):
    code = "import signal, time; signal.signal(15, signal.SIG_IGN); print('here'); time.sleep(600)"
    made = child(tmp_path, code)
    made.wait_for_line("here", DEADLINE_S)
    made.terminate()
    assert made.wait(0.2) == -signal.SIGKILL


def test_when_we_are_killed_it_is_told_to_end(tmp_path):
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
    wait(lambda: not is_running(pid), "its end")


def is_running(pid):
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"


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


def test_the_daemon_is_killed_in_mid_frame_and_comes_back(raspilot, line):
    raspilot.start()
    with pytest.raises(CrewError, match="runs already"):
        raspilot.start()
    raspilot.wait_for_line("modules run")
    assert raspilot.is_running
    whole = checked_frame(0, "x", bytes(20))
    line.write(whole[: len(whole) // 2])
    raspilot.kill()
    assert not raspilot.is_running
    with pytest.raises(CrewError, match="raspilot ended by itself with signal 9; its log "):
        raspilot.check()
    raspilot.start()
    raspilot.wait_for_line("opened")
    raspilot.check()
    log = (line_ for line_ in Path(raspilot._folder / "raspilot.log").read_text().splitlines())
    assert sum("modules run" in each for each in log) >= 1, "both lives are in one log"
    raspilot.stop()
    assert not raspilot.is_running


def test_a_frozen_daemon_stays_and_ends_when_it_is_asked_to(raspilot):
    raspilot.start()
    raspilot.wait_for_line("modules run")
    raspilot.freeze()
    stat = Path(f"/proc/{raspilot.pid}/stat")
    wait(lambda: stat.read_text().rsplit(")", 1)[1].split()[0] == "T", "it stands still")
    assert raspilot.is_running
    raspilot.stop()
    assert not raspilot.is_running


def test_a_daemon_with_a_wrong_configuration_says_so(raspilot, tmp_path):
    (tmp_path / "config" / "config.yml").write_text("log levle: info\n")
    raspilot.start()
    with pytest.raises(CrewError) as caught:
        raspilot.wait_for_line("modules run")
    assert "ended by itself with status 2" in str(caught.value)
    assert "did you mean" in str(caught.value)
    assert raspilot.log


def test_a_proxy_and_a_runner_tell_their_ports(tmp_path, short_path):
    (tmp_path / "proxy.yml").write_text("airborne port: 0\nground port: 0\nmetrics: false\n")
    (tmp_path / "runner.yml").write_text(
        f"port: 0\nrun folder: {short_path}\nstop instances on exit: true\ni_accept_root: true\n"
    )
    for server in (RealProxy(tmp_path, tmp_path), RealRunner(tmp_path, tmp_path)):
        server.start()
        pid = server.pid
        ports = (
            (server.airborne_port, server.ground_port)
            if isinstance(server, RealProxy)
            else (server.port,)
        )
        assert all(1024 <= port <= 65535 for port in ports)
        server.check()
        server.stop()
        assert server.pid is None and not is_running(pid)


def test_a_proxy_that_is_killed_is_noticed(tmp_path):
    (tmp_path / "proxy.yml").write_text("airborne port: 0\nground port: 0\nmetrics: false\n")
    proxy = RealProxy(tmp_path, tmp_path)
    proxy.start()
    os.kill(proxy.pid, signal.SIGKILL)
    wait(lambda: proxy.pid is None, "its end")
    with pytest.raises(CrewError, match="proxy ended by itself with signal 9"):
        proxy.check()
    proxy.stop()
