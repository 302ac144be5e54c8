import socket
import subprocess
import urllib.request

from tests.ground.aircraft import UP_GROUND, coded, environment
from tests.support.sandbox import under, verify
from tests.support.tools import need_tool


def test_systemd_finds_no_fault(tmp_path):
    need_tool("systemd-analyze", "systemd")
    verify("ground/up-ground.service", UP_GROUND, tmp_path)


def test_it_runs_under_the_units_filter_and_notifies(tmp_path, proxy):
    need_tool("systemd-analyze", "systemd")
    command = [*under("ground/up-ground.service"), UP_GROUND, "serve", "--listen", "127.0.0.1:0"]
    environ = environment(tmp_path, proxy.ground_port) | {
        "NOTIFY_SOCKET": str(tmp_path / "notify"),
        "WATCHDOG_USEC": "100000",
    }
    supervisor = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    supervisor.bind(environ["NOTIFY_SOCKET"])
    supervisor.settimeout(60)
    with (
        supervisor,
        subprocess.Popen(command, env=environ, stdout=subprocess.PIPE, text=True) as server,
    ):
        address = next(coded(line)[0]["url"] for line in server.stdout if "page_open" in line)
        with urllib.request.urlopen(address) as page:
            assert page.status == 200
        words = [supervisor.recv(4096).decode().split("\n")[0] for _ in range(4)]
        assert words == ["READY=1", "WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1"]
        server.terminate()
        assert server.wait() == 0
