"""The program `up-runner` as people and service managers meet it."""

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.runner.runners import APPLICATION, wait_until
from tests.support.tools import need_root
from up.version import VERSION

PROGRAM = Path(sys.executable).with_name("up-runner")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)


def test_it_says_its_version_and_how_it_is_used():
    assert run("--version").stdout == f"up-runner {VERSION}\n"
    shown = run("--help").stdout
    assert "--config DIR" in shown and "--port N" in shown


def test_it_is_a_module_that_runs():
    shown = subprocess.run([sys.executable, "-m", "up_runner", "--version"], capture_output=True)
    assert shown.stdout.decode() == f"up-runner {VERSION}\n"


def test_what_is_no_request_to_end_ends_nothing(runners):
    runner = runners().start()
    for number in (signal.SIGUSR1, signal.SIGUSR2):
        runner.process.send_signal(number)
    assert runner.status()["running"] is False
    assert (runner.run_folder / ".runner.pid").read_text() == f"{runner.process.pid}\n"


def test_root_is_refused_unless_it_is_accepted(runners):
    need_root()
    runner = runners(i_accept_root=False).launch()
    assert runner.wait() == 1
    assert "i_accept_root" in runner.said and len(runner.said.splitlines()) == 1


def test_an_instance_has_its_pid_file(runners):
    runner = runners().start()
    pid = runner.run_folder / "glider-1" / "pid"
    answer = runner.spawn()
    named, port = answer["pid"], answer["ports"]["general"]
    assert runner.talk(port).order("environ UP_PID_FILE") == str(pid)
    # A killed program leaves its file behind; the runner removes it with the instance.
    pid.write_text(f"{named}\n")
    os.kill(named, signal.SIGTERM)
    wait_until(lambda: not pid.exists(), "the pid file is removed")


def test_wrong_arguments_are_told():
    for port in ("x", "-1", "65536", "1" * 5000):
        told = run("--port", port)
        assert told.returncode == 2 and "a port is a number from 0 to 65535" in told.stderr


def test_a_configuration_folder_that_is_not_there_is_told(tmp_path):
    told = run("--config", str(tmp_path / "nowhere"))
    assert told.returncode == 2
    assert told.stderr == f"--config {tmp_path / 'nowhere'}: no such folder\n"


def test_all_mistakes_of_the_configuration_are_told_at_once(tmp_path):
    (tmp_path / "runner.yml").write_text("prot: 1\nport: x\nexit delay: -1\n")
    told = run("--config", str(tmp_path))
    assert told.returncode == 2 and "Traceback" not in told.stderr
    lines = told.stderr.splitlines()
    assert len(lines) == 3
    for number, line in enumerate(lines, 1):
        assert line.startswith(f"{tmp_path / 'runner.yml'}:{number}:")


@pytest.mark.parametrize(
    ("config", "sentence"),
    [
        ({"script path": "/nowhere/main.py"}, "there is no script /nowhere/main.py; "),
        ({"address": "203.0.113.9"}, "203.0.113.9 is a public address"),
        ({"address": "nonsense"}, "address in runner.yml is no address: 'nonsense'"),
        ({"address": "192.0.2.7", "i_accept_plain": True}, "cannot be listened on"),
        ({"run folder": "/proc/nothing"}, "the run folder /proc/nothing cannot be used"),
        ({"run folder": "/tmp/" + "x" * 100}, "too long for the sockets in it"),
    ],
)
def test_what_keeps_it_from_starting_is_one_sentence(runners, config, sentence):
    runner = runners(**config).launch()
    assert runner.wait() == 1
    last = runner.said.splitlines()[-1]
    assert last.startswith("up-runner: ") and sentence in last
    assert "Traceback" not in runner.said


def test_a_port_in_use_is_one_sentence(runners):
    with socket.create_server(("0.0.0.0", 0)) as taken:
        port = taken.getsockname()[1]
        runner = runners(port=port).launch()
        assert runner.wait() == 1
    last = runner.said.splitlines()[-1]
    assert last.startswith(f"up-runner: port {port} cannot be listened on") and "--port" in last
    # It gave the run folder back.
    runner.settings["port"] = 0
    runner.start()


def test_the_command_line_names_another_port(runners):
    runner = runners(port=1).start("--port", "0")
    assert runner.port > 1 and runner.ask(action="status")["error"] is None


def test_an_idle_one_stops_at_once(runners):
    runner = runners().start()
    assert runner.terminate() == 0
    assert "Traceback" not in runner.said


def test_a_signal_at_any_moment_of_its_start_is_no_traceback(runners):
    runner = runners()
    for delay_s in (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5):
        runner.launch()
        time.sleep(delay_s)  # no wait for luck: any moment must do
        assert runner.terminate() in (0, -signal.SIGTERM)
        assert "Traceback" not in runner.said


def test_ctrl_c_stops_it_with_its_instances(runners):
    runner = runners().start(under_systemd=False)
    runner.spawn()
    runner.process.send_signal(signal.SIGINT)
    assert runner.wait() == 0
    assert "Traceback" not in runner.said and runner.instances() == []


def test_it_keeps_its_service_manager_informed(runners, short_path):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.bind(str(short_path / "manager"))
        manager.settimeout(30)
        runner = runners(**{"exit delay": 0})
        runner.environ = {
            "NOTIFY_SOCKET": str(short_path / "manager"),
            "WATCHDOG_USEC": "200000",
        }
        runner.start()
        heard = []

        def hears(text):
            while not any(text in words for words in heard):
                heard.append(manager.recv(4096).decode())

        hears("READY=1\nSTATUS=0 of 8 instances")
        runner.spawn()
        hears("STATUS=1 of 8 instances: glider-1 running (")
        hears("STATUS=0 of 8 instances")
        del heard[:]
        for _ in range(3):
            hears("WATCHDOG=1")
            heard.remove("WATCHDOG=1")
        runner.terminate()
        hears("STOPPING=1")


def test_no_descriptor_stays_behind(runners):
    runner = runners(**{"exit delay": 0}).start()
    folder = Path(f"/proc/{runner.process.pid}/fd")
    before = None
    for _ in range(6):
        runner.spawn()
        wait_until(lambda: runner.status()["error"] is None, "it ended")
        wait_until(lambda: not runner.status()["running"], "it ended")
        if before is None:
            before = len(list(folder.iterdir()))
    wait_until(lambda: len(list(folder.iterdir())) <= before, "no descriptor is left")


def test_a_configuration_without_a_base_is_said_and_works(runners):
    runner = runners()
    (runner.config_folder / "blackbox").rmdir()
    runner.start()
    runner.says("instances start with their defaults")
    assert runner.spawn()["spawned"] is True


def test_logs_that_cannot_be_opened_are_told_to_the_asker(runners):
    runner = runners(**{"logs folder": "/proc/nothing"}).start()
    answer = runner.ask(aircraft="glider-1")
    assert answer["running"] is False and "Raspilot cannot be started" in answer["error"]


def test_relative_programs_are_found_from_the_application_root(runners, short_path):
    root = short_path / "app"
    root.mkdir()
    (root / "fly.py").write_text(APPLICATION.read_text())
    runner = runners(**{"application root": str(root), "script path": "fly.py"}).start()
    answer = runner.spawn()
    told = runner.talk(answer["ports"]["general"]).order("session")
    assert told.split()[2] == str(root)
    assert os.getsid(answer["pid"]) == answer["pid"]
