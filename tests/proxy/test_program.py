"""The program: start, stop, ports, configuration."""

import signal
import socket
import subprocess
import sys
import time

import pytest

from tests.proxy.program import UP_PROXY, Client, Program, accepted, until
from up.version import VERSION
from up_proxy.connection import IDLE_S


def test_it_relays_and_says_its_ports(tmp_path):
    with Program(tmp_path) as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=glider-1\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=glider-1 seat=command\n")
        with air, ground:
            air.say('{"name": "telemetry"}\n')
            ground.expect('{"name": "telemetry"}')
            ground.say('{"name": "command"}\n')
            air.expect('{"name": "command"}')
        assert proxy.end() == 0
    assert "Traceback" not in proxy.log


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_it_stops_without_waiting_for_whoever_is_connected(tmp_path, how):
    with Program(tmp_path) as proxy:
        clients = [Client(proxy.ground_port, "{}\n") for _ in range(20)]
        clients += [Client(proxy.airborne_port, "UP1 aircraft=a\n")]
        clients[-1].line()
        begin_s = time.monotonic()
        assert proxy.end(how) == 0
        assert time.monotonic() - begin_s < IDLE_S
        for client in clients:
            while client.line():
                pass
            client.close()
    assert "stopped" in proxy.log


def test_an_interrupt_ends_it_in_the_background_of_a_script_too(tmp_path):
    # A shell without job control starts background programs with SIGINT ignored.
    shell = ("sh", "-c", 'trap "" INT; exec "$@"', "sh")
    with Program(tmp_path, prefix=shell) as proxy:
        assert proxy.end(signal.SIGINT) == 0
    assert "stopped" in proxy.log


@pytest.mark.parametrize("signals", [[signal.SIGUSR1, signal.SIGUSR2], [signal.SIGHUP]])
def test_what_is_no_request_to_end_ends_nothing(tmp_path, signals):
    # 'nohup' starts it with an ignored SIGHUP.
    with Program(tmp_path, prefix=("nohup",) if signal.SIGHUP in signals else ()) as proxy:
        for number in signals:
            proxy.process.send_signal(number)
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=a\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=a seat=listen\n")
        with air, ground:
            air.say("telemetry\n")
            ground.expect("telemetry")
        assert proxy.end() == 0


def test_its_pid_file_names_it_and_keeps_a_second_one_out(tmp_path):
    pid = tmp_path / "proxy.pid"
    environ = {"UP_PID_FILE": str(pid)}
    with Program(tmp_path, environ=environ) as proxy:
        assert pid.read_text() == f"{proxy.pid}\n"
        second = Program(tmp_path, environ=environ)
        assert second.wait() == 1
        assert second.log == f"process {proxy.pid} runs already (pid file {pid})\n"
        assert proxy.end() == 0
    assert not pid.exists()


def test_it_hears_ipv4_and_ipv6(tmp_path):
    with Program(tmp_path) as proxy:
        hosts = ["127.0.0.1"] + (["::1"] if socket.has_dualstack_ipv6() else [])
        for host in hosts:
            with Client(proxy.ground_port, "UP1 aircraft=a seat=listen\n", host) as client:
                assert client.line().startswith("UP1 ok")


@pytest.mark.parametrize("which", ["airborne port", "ground port", "metrics port"])
def test_a_port_in_use_is_one_sentence_and_exit_1(tmp_path, which):
    with socket.create_server(("127.0.0.1", 0)) as holder:
        port = holder.getsockname()[1]
        ports = [0, 0, 0]
        ports[["airborne port", "ground port", "metrics port"].index(which)] = port
        proxy = Program(tmp_path, ports=ports)
        assert proxy.wait() == 1
    assert proxy.log.splitlines()[-1] == (
        f"up-proxy: cannot listen on {which} {port}: address already in use"
    )
    assert "Traceback" not in proxy.log


def test_it_is_a_module_that_runs():
    shown = subprocess.run([sys.executable, "-m", "up_proxy", "--version"], capture_output=True)
    assert shown.stdout.decode() == f"up-proxy {VERSION}\n"


def test_version_and_help_need_no_configuration():
    shown = subprocess.run([UP_PROXY, "--version"], capture_output=True, text=True, check=True)
    assert shown.stdout == f"up-proxy {VERSION}\n"
    shown = subprocess.run([UP_PROXY, "--help"], capture_output=True, text=True, check=True)
    assert "--airborne-port" in shown.stdout


@pytest.mark.parametrize("port", ["-1", "65536", "x", "٣"])
def test_a_wrong_port_is_one_sentence_and_exit_2(port):
    shown = subprocess.run([UP_PROXY, f"--ground-port={port}"], capture_output=True, text=True)
    assert shown.returncode == 2
    assert "a port is a number from 0 to 65535" in shown.stderr


def test_a_configuration_folder_that_is_not_there_is_one_sentence_and_exit_2(tmp_path):
    folder = tmp_path / "nowhere"
    ports = ("--airborne-port=0", "--ground-port=0", "--metrics-port=0")
    shown = subprocess.run(
        [UP_PROXY, "--config", folder, *ports], capture_output=True, text=True, timeout=60
    )
    assert (shown.returncode, shown.stderr) == (2, f"--config {folder}: no such folder\n")


def test_every_error_of_the_configuration_is_shown_with_its_place(tmp_path):
    text = "airborn port: 1\nground port: x\nlimits:\n  aircraft: 0\n"
    proxy = Program(tmp_path, text, ports=(None, None, None))
    assert proxy.wait() == 2
    lines = proxy.log.splitlines()
    assert len(lines) == 3
    assert lines[0].startswith(f"{tmp_path}/proxy.yml:1:1: ")
    assert "did you mean 'airborne port'?" in lines[0]
    assert ":2:" in lines[1]
    assert ":4:" in lines[2]


@pytest.mark.parametrize(("address", "status"), [("203.0.113.7", 2), ("nonsense", 1)])
def test_an_address_that_will_not_do_is_one_sentence(tmp_path, address, status):
    proxy = Program(tmp_path, f"address: {address}\n")
    assert proxy.wait() == status
    assert len(proxy.log.splitlines()) == 1
    assert address in proxy.log
    assert ("i_accept_plain: true" in proxy.log) == (status == 2)


def test_after_kill_9_both_ends_come_back_and_nothing_is_misdelivered(tmp_path):
    with Program(tmp_path) as proxy:
        ports = (proxy.airborne_port, proxy.ground_port, 0)
        old = [
            (*accepted(proxy.airborne_port, f"UP1 aircraft={name}\n"), name)
            for name in ("one", "two")
        ]
        old_grounds = [
            (*accepted(proxy.ground_port, f"UP1 aircraft={name} seat=command\n"), name)
            for name in ("one", "two")
        ]
        for air, _, name in old:
            air.say(f"half of {name}")
        proxy.end(signal.SIGKILL)
    for client, *_ in old + old_grounds:
        while client.line():
            pass
        client.close()
    with Program(tmp_path, ports=ports) as proxy:
        pairs = []
        for (_, air_token, name), (_, token, _) in zip(old, reversed(old_grounds), strict=True):
            air, _ = accepted(ports[0], f"UP1 aircraft={name} token={air_token}\n")
            ground, _ = accepted(ports[1], f"UP1 aircraft={name} seat=command token={token}\n")
            pairs.append((air, ground, name))
        for air, _, name in pairs:
            air.say(f"telemetry of {name}\n")
        for air, ground, name in pairs:
            assert ground.expect("telemetry") == f"telemetry of {name}\n"
            ground.say(f"command for {name}\n")
            assert air.expect("command") == f"command for {name}\n"
            air.close()
            ground.close()


def test_the_supervisor_is_told(tmp_path):
    path = tmp_path / "notify"
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as supervisor:
        supervisor.bind(str(path))
        supervisor.settimeout(30)
        environ = {"NOTIFY_SOCKET": str(path), "WATCHDOG_USEC": "200000"}
        with Program(tmp_path, environ=environ) as proxy:
            said = supervisor.recv(4096).decode("ascii")
            assert said == (
                f"READY=1\nSTATUS=relaying, airborne {proxy.airborne_port}, "
                f"ground {proxy.ground_port}"
            )
            for _ in range(3):
                assert supervisor.recv(4096) == b"WATCHDOG=1"
            proxy.end()
            heard = []
            until(lambda: heard.append(supervisor.recv(4096)) or heard[-1] == b"STOPPING=1", "stop")


def test_the_log_goes_to_a_file_when_asked(tmp_path):
    with Program(tmp_path, f"log file: {tmp_path}/proxy.jsonl\n") as proxy:
        proxy.end()
    assert "listens on port" in (tmp_path / "proxy.jsonl").read_text(encoding="utf-8")


JUMP = """
import os, sys, time
real = time.time
flag = {flag!r}
time.time = lambda: real() - (86400.0 if os.path.exists(flag) else 0.0)
from twisted.python import runtime
runtime.seconds = time.time
from twisted.internet import base
base.ReactorBase.seconds = staticmethod(lambda: time.time())
from up_proxy.main import main
sys.exit(main(sys.argv[1:]))
"""


def test_a_wall_clock_that_jumps_a_day_changes_nothing(tmp_path):
    flag = tmp_path / "jumped"
    program = tmp_path / "jumping.py"
    program.write_text(JUMP.format(flag=str(flag)), encoding="utf-8")
    with Program(tmp_path, command=(sys.executable, str(program))) as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=a\n")
        ground, _ = accepted(proxy.ground_port, "UP1 aircraft=a seat=command\n")
        flag.touch()
        # The tick still comes: it takes the silent for thesis clients and notices the silent.
        with Client(proxy.ground_port):
            ground.expect("UP1 aircraft offline")
        air.say("telemetry\n")
        ground.expect("telemetry")
        air.close()
        ground.close()
        assert proxy.end() == 0


def test_the_log_tells_of_aircraft_and_seats_and_is_not_flooded(tmp_path):
    with Program(tmp_path) as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=g\n")
        for _ in range(50):
            ground, _ = accepted(proxy.ground_port, "UP1 aircraft=g seat=command\n")
            ground.say("UP1 seat release\n")
            ground.expect("holder=none")
            ground.close()
        air.close()
        proxy.end()
    assert "aircraft g is online from 127.0.0.1\n" in proxy.log
    assert "ground 1 from 127.0.0.1 commands g\n" in proxy.log
    assert len(proxy.log.splitlines()) < 20
