"""The program: start, stop, ports, configuration."""

import signal
import socket
import subprocess
import sys

import pytest

from tests.proxy.program import UP_PROXY, Client, Program, accepted, until
from tests.proxy.virtual import HandReactor
from up.version import VERSION
from up_proxy.config import ProxyConfig
from up_proxy.listener import StartError
from up_proxy.main import main
from up_proxy.proxy import Proxy

PORTS = ["--airborne-port=0", "--ground-port=0", "--metrics-port=0"]
# A shell without job control starts background programs with SIGINT ignored.
IN_BACKGROUND = ("sh", "-c", 'trap "" INT; exec "$@"', "sh")


def relays(proxy):
    air, _ = accepted(proxy.airborne_port, "UP1 aircraft=glider-1\n")
    ground, _ = accepted(proxy.ground_port, "UP1 aircraft=glider-1 seat=command\n")
    with air, ground:
        air.say('{"name": "telemetry"}\n')
        ground.expect('{"name": "telemetry"}')
        ground.say('{"name": "command"}\n')
        air.expect('{"name": "command"}')
    return True


@pytest.mark.parametrize(
    ("how", "prefix"),
    [
        (signal.SIGTERM, ()),
        (signal.SIGINT, ()),
        (signal.SIGHUP, ()),
        (signal.SIGINT, IN_BACKGROUND),
    ],
)
def test_it_relays_until_a_signal_without_waiting_for_its_clients(tmp_path, how, prefix):
    with Program(tmp_path, prefix=prefix) as proxy:
        assert relays(proxy)
        clients = [Client(proxy.ground_port, "{}\n") for _ in range(20)]
        clients += [Client(proxy.airborne_port, "UP1 aircraft=a\n")]
        clients[-1].line()
        assert proxy.end(how) == 0
        for client in clients:
            while client.line():
                pass
            client.close()
    assert proxy.codes()[-1] == "stopped"
    assert "Traceback" not in proxy.log


def test_a_signal_as_soon_as_its_ports_are_open_ends_it_in_order(tmp_path):
    (tmp_path / "proxy.yml").write_text("")
    program = (
        "import os, sys; from up_proxy import main, proxy; start = proxy.Proxy.start\n"
        "proxy.Proxy.start = lambda self: (start(self), os.kill(os.getpid(), 15))\n"
        f"sys.exit(main.main({['--config', str(tmp_path), *PORTS]}))"
    )
    done = subprocess.run([sys.executable, "-c", program], stderr=subprocess.PIPE, timeout=60)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("signals", [[signal.SIGUSR1, signal.SIGUSR2], [signal.SIGHUP]])
def test_other_signals_do_not_end_it(tmp_path, signals):
    # 'nohup' starts it with an ignored SIGHUP.
    with Program(tmp_path, prefix=("nohup",) if signal.SIGHUP in signals else ()) as proxy:
        for number in signals:
            proxy.process.send_signal(number)
        assert relays(proxy)
        assert proxy.end() == 0


def test_its_pid_file_names_it_and_keeps_a_second_one_out(tmp_path):
    pid = tmp_path / "proxy.pid"
    environ = {"UP_PID_FILE": str(pid)}
    with Program(tmp_path, environ=environ) as proxy:
        assert pid.read_text() == f"{proxy.pid}\n"
        second = Program(tmp_path, environ=environ)
        assert second.wait() == 1
        assert str(pid) in second.log
        assert len(second.log.splitlines()) == 1
        assert proxy.end() == 0
    assert not pid.exists()


def test_it_listens_on_ipv4_and_ipv6(tmp_path):
    with Program(tmp_path) as proxy:
        hosts = ["127.0.0.1"] + (["::1"] if socket.has_dualstack_ipv6() else [])
        for host in hosts:
            with Client(proxy.ground_port, "UP1 aircraft=a seat=listen\n", host) as client:
                assert client.line().startswith("UP1 ok")


@pytest.mark.parametrize("which", ["airborne port", "ground port", "metrics port"])
def test_a_port_in_use_is_one_sentence_and_exit_1(tmp_path, which):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        ports = [0, 0, 0]
        ports[["airborne port", "ground port", "metrics port"].index(which)] = port
        proxy = Program(tmp_path, ports=ports)
        assert proxy.wait() == 1
    assert proxy.events[-1]["code"] == "cannot_listen"
    assert f"{which} {port}" in proxy.log.splitlines()[-1]
    assert "Traceback" not in proxy.log


@pytest.mark.parametrize("address", ["203.0.113.7", "nonsense"])
def test_an_address_it_cannot_use(address):
    with pytest.raises(StartError) as error:
        Proxy(HandReactor(), ProxyConfig(address=address)).start()
    assert (error.value.code, error.value.status) == ("bad_address", 2)
    assert address in str(error.value)


def test_version_and_help_need_no_configuration():
    for command in ([UP_PROXY], [sys.executable, "-m", "up_proxy"]):
        shown = subprocess.run([*command, "--version"], capture_output=True, text=True, check=True)
        assert shown.stdout == f"up-proxy {VERSION}\n"
    shown = subprocess.run([UP_PROXY, "--help"], capture_output=True, text=True, check=True)
    assert "--airborne-port" in shown.stdout


def status(arguments):
    with pytest.raises(SystemExit) as exit_:
        main(arguments)
    return exit_.value.code


@pytest.mark.parametrize("port", ["-1", "65536", "x", "٣"])
def test_a_wrong_port_is_exit_2(port, capsys):
    assert status([f"--ground-port={port}"]) == 2
    assert "--ground-port" in capsys.readouterr().err


@pytest.mark.parametrize("exists", [False, True], ids=["missing", "empty"])
def test_a_mistyped_configuration_folder_is_one_sentence_and_exit_2(exists, tmp_path, capsys):
    folder = tmp_path / "nowhere"
    if exists:
        folder.mkdir()
    assert status(["--config", str(folder)]) == 2
    error = capsys.readouterr().err
    assert str(folder) in error
    assert len(error.splitlines()) == 1


def test_every_error_of_the_configuration_has_its_place(tmp_path, capsys):
    text = "airborn port: 1\nground port: x\nlimits:\n  aircraft: 0\n"
    (tmp_path / "proxy.yml").write_text(text)
    assert status(["--config", str(tmp_path)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 3
    for line, number in zip(lines, (1, 2, 4), strict=True):
        assert line.startswith(f"{tmp_path}/proxy.yml:{number}:")


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


def test_it_notifies_its_supervisor(tmp_path):
    path = tmp_path / "notify"
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as supervisor:
        supervisor.bind(str(path))
        supervisor.settimeout(30)
        environ = {"NOTIFY_SOCKET": str(path), "WATCHDOG_USEC": "200000"}
        with Program(tmp_path, environ=environ) as proxy:
            ready = supervisor.recv(4096).decode("ascii")
            assert ready.startswith("READY=1\nSTATUS=")
            assert str(proxy.airborne_port) in ready
            assert str(proxy.ground_port) in ready
            for _ in range(3):
                assert supervisor.recv(4096) == b"WATCHDOG=1"
            proxy.end()
            received = []

            def stopping():
                received.append(supervisor.recv(4096))
                return received[-1] == b"STOPPING=1"

            until(stopping, "stop")


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
        # The tick still accepts silent clients as legacy clients and detects silent aircraft.
        with Client(proxy.ground_port):
            ground.expect("UP1 aircraft offline")
        air.say("telemetry\n")
        ground.expect("telemetry")
        air.close()
        ground.close()
        assert proxy.end() == 0


def test_the_log_and_its_file_report_aircraft_and_control_at_a_limited_rate(tmp_path):
    with Program(tmp_path, f"log file: {tmp_path}/proxy.jsonl\n") as proxy:
        air, _ = accepted(proxy.airborne_port, "UP1 aircraft=g\n")
        for _ in range(50):
            ground, _ = accepted(proxy.ground_port, "UP1 aircraft=g seat=command\n")
            ground.say("UP1 seat release\n")
            ground.expect("holder=none")
            ground.close()
        air.close()
        proxy.end()
    reports = [fields for fields in proxy.events if "aircraft" in fields]
    assert reports[0] == {"code": "aircraft_online", "aircraft": "g", "host": "127.0.0.1"}
    assert reports[1] == {
        "code": "control_granted", "aircraft": "g", "number": 1, "host": "127.0.0.1"
    }  # fmt: skip
    assert len(proxy.events) < 20
    assert (tmp_path / "proxy.jsonl").read_text(encoding="utf-8").count("port_open") == 3
