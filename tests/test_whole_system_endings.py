"""How the whole system ends: by its user, by its terminal, by a part that dies."""

import os
import signal
from pathlib import Path

from tests.support.showcase import Showcase, child_with
from tests.support.waiting import until


def test_ctrl_c_stops_everything_and_leaves_nothing(tmp_path):
    (tmp_path / "tmp").mkdir()
    showcase = Showcase(tmp_path, TMPDIR=str(tmp_path / "tmp")).ready()
    page = child_with(showcase.process.pid, "serve")
    group = [page, showcase.daemon_pid(), child_with(showcase.process.pid, "up_proxy.main"),
             child_with(showcase.process.pid, "up_simulator")]  # fmt: skip
    assert (tmp_path / "radio").is_socket()
    assert showcase.stop(signal.SIGINT) == 0
    assert not any(Path(f"/proc/{pid}").exists() for pid in group)
    assert not (tmp_path / "board").is_symlink()
    assert not (tmp_path / "radio").exists()
    assert list((tmp_path / "tmp").iterdir()) == []
    assert "Traceback" not in showcase.said()


def test_a_terminal_that_closes_leaves_nothing(tmp_path):
    showcase = Showcase(tmp_path).ready()
    daemon = showcase.daemon_pid()
    assert showcase.stop(signal.SIGHUP) == 0
    assert not Path(f"/proc/{daemon}").exists()


def test_only_the_page_and_the_daemon_may_die_without_ending_the_flight(tmp_path):
    showcase = Showcase(tmp_path).ready()
    os.kill(child_with(showcase.process.pid, "serve"), signal.SIGKILL)
    until(lambda: showcase.said().count("signal 9") == 1, "its end")
    assert showcase.telemetry(1)[0]["armed"]
    daemon = showcase.daemon_pid()
    os.kill(daemon, signal.SIGKILL)
    until(lambda: showcase.said().count("signal 9") == 2, "its end")
    until(lambda: showcase.telemetry(1)[0]["system"]["uptime_s"] < 60, "another daemon")
    assert showcase.daemon_pid() != daemon
    os.kill(child_with(showcase.process.pid, "up_proxy.main"), signal.SIGKILL)
    assert showcase.process.wait(20) == 1
    assert showcase.said().count("signal 9") == 3
