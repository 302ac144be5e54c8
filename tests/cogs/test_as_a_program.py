"""The three cogs registered and run as a user does: `up start`, SIGTERM."""

import json
import re
import signal
import socket
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from android_cog.registrar import Registrant as Android
from discovery_cog.registrar import Registrant as Discovery
from mission_control_cog.registrar import Registrant as MissionControl

from tests.proxy.program import Client, Program, until
from up.loading.application import Application

UP = Path(sys.executable).with_name("up")
DEADLINE_S = 30.0


class Daemon:
    """A running application; `log` grows while it runs."""

    def __init__(self, root):
        self.log = ""
        self.process = subprocess.Popen(
            [str(UP), "start"],
            cwd=root,
            stderr=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            text=True,
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.log += line

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(DEADLINE_S)
        self._reader.join(DEADLINE_S)
        self.process.stderr.close()

    def port(self, name):
        def found():
            assert self.process.poll() is None, self.log
            return re.search(rf"{name} listens on port (\d+)", self.log)

        return int(until(found, f"the port {name}; log {self.log}")[1])


def application(folder, **files):
    """An application with only the modules of the three cogs."""
    (folder / "config").mkdir(parents=True)
    (folder / "UpFile").write_text("package: flying\n", encoding="utf-8")
    for name, text in files.items():
        (folder / "config" / f"{name}.yml").write_text(text, encoding="utf-8")
    for registrant in (Android, Discovery, MissionControl):
        registrant().register(Application.at(folder))
    return folder


PORTS = "general port: 0\norientation port: 0\naddress: 127.0.0.1\n"


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1"])
def test_registered_started_flown_and_stopped(tmp_path, host):
    with Program(tmp_path / "proxy") as proxy:
        root = application(
            tmp_path / "app",
            android=PORTS,
            discovery="port: 0\n",
            mission_control=(
                f"remote_server: {{url: {host}, port: {proxy.airborne_port}}}\n"
                "listener: {port: 0, address: 127.0.0.1}\n"
            ),
        )
        with Daemon(root) as daemon:
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asker:
                asker.settimeout(DEADLINE_S)
                asker.sendto(b"where?", ("127.0.0.1", daemon.port("discovery")))
                assert asker.recv(100) == b"127.0.0.1"
            phone = Client(daemon.port("general"))
            phone.say('{"name": "android.battery", "data": {"level": 63}}\n')
            ground = Client(proxy.ground_port, "UP1 aircraft=default seat=command\n")
            ground.expect('"batteryLevel": 63')
            near = Client(daemon.port("ground"))
            near.expect('"batteryLevel": 63')
            ground.say('{"name": "android.speak", "data": {"text": "hi"}, "id": "s"}\n')
            asked = json.loads(phone.expect("android.speak"))
            phone.say(json.dumps({"name": "up.ack", "data": {"id": asked["id"]}}) + "\n")
            assert json.loads(ground.expect("up.ack"))["data"] == {"id": "s"}
            daemon.process.send_signal(signal.SIGTERM)
            # Another status where it takes too long and is forced.
            assert daemon.process.wait(DEADLINE_S) == 0, daemon.log
            assert "Traceback" not in daemon.log
            for client in (phone, ground, near):
                client.close()


def test_an_absent_proxy_with_an_unknown_name_neither_stops_nor_hangs_the_program(tmp_path):
    root = application(
        tmp_path / "app",
        android=PORTS,
        discovery="port: 0\n",
        mission_control="remote_server: {url: no-such-host.invalid}\n",
    )
    with Daemon(root) as daemon:
        until(lambda: "no-such-host.invalid:3003: no connection" in daemon.log, daemon.log)
        with Client(daemon.port("general")) as phone:
            phone.expect("up.telemetry.update")
        daemon.process.send_signal(signal.SIGTERM)
        assert daemon.process.wait(DEADLINE_S) == 0
        assert "Traceback" not in daemon.log
