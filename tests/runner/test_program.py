"""The program `up-runner` as people and service managers meet it."""

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from twisted.internet.task import Clock

from tests.runner.runners import APPLICATION, wait_until
from tests.support.tools import need_root
from up.version import VERSION
from up_runner.config import RunnerConfig
from up_runner.main import main
from up_runner.run_folder import CannotStart
from up_runner.runner import Runner

PROGRAM = Path(sys.executable).with_name("up-runner")


def test_version_and_help():
    for command in ([PROGRAM], [sys.executable, "-m", "up_runner"]):
        shown = subprocess.run([*command, "--version"], capture_output=True, text=True)
        assert shown.stdout == f"up-runner {VERSION}\n"
    shown = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True).stdout
    assert "--config DIR" in shown and "--port N" in shown


def test_other_signals_do_not_end_it(runner):
    for number in (signal.SIGUSR1, signal.SIGUSR2):
        runner.process.send_signal(number)
    assert runner.status()["running"] is False
    assert (runner.run_folder / ".runner.pid").read_text() == f"{runner.process.pid}\n"


def test_an_instance_has_its_pid_file(runner):
    pid = runner.run_folder / runner.name / "pid"
    response = runner.spawn()
    named, port = response["pid"], response["ports"]["general"]
    assert runner.talk(port).order("environ UP_PID_FILE") == str(pid)
    # A killed program leaves its file behind; the runner removes it with the instance.
    pid.write_text(f"{named}\n")
    os.kill(named, signal.SIGTERM)
    wait_until(lambda: not pid.exists(), "the pid file is removed")


def status(arguments):
    with pytest.raises(SystemExit) as exit_:
        main(arguments)
    return exit_.value.code


@pytest.mark.parametrize("port", ["x", "-1", "65536", "1" * 5000])
def test_a_wrong_port_is_exit_2(port, capsys):
    assert status(["--port", port]) == 2
    assert "--port" in capsys.readouterr().err


def test_a_missing_configuration_folder_is_exit_2(tmp_path, capsys):
    assert status(["--config", str(tmp_path / "nowhere")]) == 2
    assert f"--config {tmp_path / 'nowhere'}" in capsys.readouterr().err


def test_all_errors_of_the_configuration_have_their_place(tmp_path, capsys):
    (tmp_path / "runner.yml").write_text("prot: 1\nport: x\nexit delay: -1\n")
    assert status(["--config", str(tmp_path)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 3
    for number, line in enumerate(lines, 1):
        assert line.startswith(f"{tmp_path / 'runner.yml'}:{number}:")


@pytest.mark.parametrize(
    ("config", "code"),
    [
        ({"script_path": "/nowhere/main.py"}, "no_script"),
        ({"address": "203.0.113.9"}, "bad_address"),
        ({"address": "nonsense"}, "bad_address"),
        ({"run_folder": "/proc/nothing"}, "run_folder_unusable"),
        ({"run_folder": "/tmp/" + "x" * 100}, "path_too_long"),
        ({"i_accept_root": False}, "root"),
    ],
)
def test_a_start_that_fails_has_its_code(tmp_path, config, code):
    if code == "root":
        need_root()
    config = {"i_accept_root": True, "run_folder": str(tmp_path / "run"), **config}
    with pytest.raises(CannotStart) as error:
        Runner(Clock(), RunnerConfig(**config), tmp_path).start()
    assert error.value.code == code


def test_a_port_in_use_is_one_sentence_and_exit_1(runners):
    with socket.create_server(("0.0.0.0", 0)) as taken:
        port = taken.getsockname()[1]
        runner = runners(port=port).launch()
        assert runner.wait() == 1
    assert runner.events()[-1]["code"] == "cannot_listen"
    assert f"port {port}" in runner.printed.splitlines()[-1]
    assert "Traceback" not in runner.printed
    # It released the run folder.
    runner.settings["port"] = 0
    runner.start()


def test_the_command_line_names_another_port(runners):
    runner = runners(port=1).start("--port", "0")
    assert runner.port > 1 and runner.ask(action="status")["error"] is None


def test_a_signal_at_any_moment_of_its_start_prints_no_traceback(runners):
    runner = runners()
    for delay_s in (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5):
        runner.launch()
        time.sleep(delay_s)  # no wait for luck: any moment must do
        assert runner.terminate() in (0, -signal.SIGTERM)
        assert "Traceback" not in runner.printed


def test_ctrl_c_stops_it_with_its_instances(runners):
    runner = runners().start(under_systemd=False)
    runner.spawn()
    runner.process.send_signal(signal.SIGINT)
    assert runner.wait() == 0
    assert "Traceback" not in runner.printed and runner.instances() == []


def test_it_notifies_its_service_manager(runners, short_path):
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


def test_a_configuration_without_a_base_is_logged_and_works(runners):
    runner = runners()
    (runner.config_folder / "blackbox").rmdir()
    runner.start()
    runner.logs("no_base")
    assert runner.spawn()["spawned"] is True


def test_relative_programs_are_found_from_the_application_root(runners, short_path):
    root = short_path / "app"
    root.mkdir()
    (root / "fly.py").write_text(APPLICATION.read_text())
    runner = runners(**{"application root": str(root), "script path": "fly.py"}).start()
    answer = runner.spawn()
    told = runner.talk(answer["ports"]["general"]).order("session")
    assert told.split()[2] == str(root)
    assert os.getsid(answer["pid"]) == answer["pid"]
