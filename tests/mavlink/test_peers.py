"""MAVSDK and MAVProxy fly an aircraft: the firmware, the daemon, real sockets."""

import contextlib
import json
import os
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path
from random import Random

import pytest
from pymavlink import mavutil

from tests.ground.aircraft import Ground
from tests.mavlink.flying import Flying
from tests.proxy.program import Program
from tests.support.waiting import until

HERE = Path(__file__).parent
LIMIT_S = 120.0
PILOT = {
    "low": {"throttle": 1000},
    "high": {"throttle": 1600},
    "stick": {"aux1": 1500},
    "auto": {"aux1": 2000},
}


@pytest.fixture(scope="module")
def proxy(tmp_path_factory):
    with Program(tmp_path_factory.mktemp("proxy")) as running:
        yield running


@pytest.fixture(scope="module")
def flying(proxy, tmp_path_factory):
    folder = tmp_path_factory.mktemp("peers")
    (folder / "config").mkdir()
    (folder / "config" / "key.txt").write_text("passphrase\n")
    (folder / "config" / "key.txt").chmod(0o600)
    found = Flying(
        folder,
        {"url": "udpin:127.0.0.1:0", "role": "pilot"},
        {"url": "tcpin:127.0.0.1:0", "role": "pilot", "signing": "require", "key_file": "key.txt"},
        proxy=proxy,
        **{"failsafe.yml": {"uplink_lost": {"delay_s": 2.0}}},
    )
    yield found
    found.stop()


@contextlib.contextmanager
def bridge(proxy, folder, kind):
    """Run `up-ground mavlink`; the address of its endpoint."""
    with Ground(folder, proxy.ground_port, "mavlink", f"{kind}:127.0.0.1:0") as running:
        running.expect("mavlink_open")
        yield f"127.0.0.1:{running.event('mavlink_open')['port']}"


class Lossy:
    """A UDP path to the aircraft that loses 3 % of the datagrams, each way."""

    def __init__(self, port):
        self._ends = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
        self._ends[0].bind(("127.0.0.1", 0))
        self._ends[1].connect(("127.0.0.1", port))
        self.port = self._ends[0].getsockname()[1]
        self._peer = None
        self.lost = 0
        self._random = Random(1)
        self._is_over = False
        for place in range(2):
            threading.Thread(target=self._pass, args=(place,), daemon=True).start()

    def _pass(self, place):
        while not self._is_over:
            try:
                data, sender = self._ends[place].recvfrom(2048)
                if place == 0:
                    self._peer = sender
                if self._random.random() < 0.03:
                    self.lost += 1
                elif place == 0:
                    self._ends[1].send(data)
                elif self._peer is not None:
                    self._ends[0].sendto(data, self._peer)
            except OSError:
                return

    def close(self):
        self._is_over = True
        for each in self._ends:
            each.close()


def run_mavsdk(flying, url):
    """Return what the script reports, by the names of its steps; it begins with open throttle."""
    flying.pilot.move(throttle=1600)
    reader, writer = os.pipe()
    command = [sys.executable, HERE / "mavsdk_script.py", url, writer]
    told = {}
    with subprocess.Popen(
        list(map(str, command)), text=True, pass_fds=[writer], stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    ) as script:  # fmt: skip
        os.close(writer)
        watchdog = threading.Timer(LIMIT_S, script.kill)
        watchdog.start()
        with os.fdopen(reader) as lines:
            for line in lines:
                step, outcome = json.loads(line).values()
                told[step] = outcome
                if step == "pilot":
                    flying.pilot.move(**PILOT[outcome])
                    script.stdin.write("\n")
                    script.stdin.flush()
        errors = script.stderr.read()
        watchdog.cancel()
    assert script.returncode == 0, errors[-2000:]
    return told


def test_a_mavsdk_program_uses_all_of_the_aircraft_over_a_bad_link(flying):
    path = Lossy(flying.ports[0])
    told = run_mavsdk(flying, f"udpout://127.0.0.1:{path.port}")
    path.close()
    check_mavsdk(told)
    assert path.lost > 5


def test_a_mavsdk_program_uses_it_through_the_ground_bridge_by_tcp(proxy, flying, tmp_path):
    with bridge(proxy, tmp_path, "tcpin") as address:
        check_mavsdk(run_mavsdk(flying, f"tcpout://{address}"))


def check_mavsdk(told):
    times_ms = {name: told.pop(name) for name in list(told) if name.endswith(" ms")}
    texts = told.pop("texts")
    assert told.pop("parameters") > 60
    assert told == {
        **dict.fromkeys(
            ("global position", "home", "battery", "in air", "fix", "airspeed", "receiver",
             "unix time", "is holding", "equal", "is in mission", "is at item", "is paused",
             "is guided", "is returning", "disarm", "is disarmed", "is not armable",
             "is armable", "is armed"),
            True,
        ),
        **dict.fromkeys(
            ("hold", "set", "upload", "start", "item", "pause", "fence", "fence clear", "goto",
             "return", "clear", "arm"),
            "SUCCESS",
        ),
        "read": 3.25, "after": 3.25, "unknown": "DOES_NOT_EXIST",
        "read only": "READ_ONLY", "out of range": "VALUE_OUT_OF_RANGE", "download": "done",
        "speeds": [12.0] * 3,
        "total": 20, "fence back": "done", "borders": [4, 50.0], "too far": "COMMAND_DENIED",
        "pilot": "low", "arm refused": "COMMAND_DENIED", "kill": "COMMAND_DENIED",
        "not at AUTO": "COMMAND_DENIED", "by sticks": True,
    }, texts  # fmt: skip
    assert times_ms["connect ms"] < 5000


RETURN, LOITER = 11, 12
"""Numbers of ArduPlane's modes."""


def test_the_aircraft_returns_after_the_last_heartbeat_of_its_only_ground(flying):
    flying.pilot.move(**PILOT["auto"], throttle=1600)
    link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{flying.ports[0]}", source_system=255)

    def mode(wanted, is_there):
        if is_there:
            link.mav.heartbeat_send(6, 8, 0, 0, 4)
            link.mav.set_mode_send(1, 1, wanted)
        beat = link.recv_match(type="HEARTBEAT", blocking=True, timeout=1.0)
        return beat is not None and beat.custom_mode == wanted

    until(lambda: mode(LOITER, True), "LOITER")
    until(lambda: mode(RETURN, False), "RETURN")
    link.close()


class MAVProxy:
    """mavproxy.py on a pipe: commands in, lines out."""

    MODULES = "link,signing,param,mode,arm,wp,fence,misc,cmdlong"

    def __init__(self, master, folder):
        program = Path(sys.executable).with_name("mavproxy.py")
        options = ["--master", master, "--state-basedir", str(folder), "--streamrate", "4"]
        options += ["--default-modules", self.MODULES]
        self.lines = []
        self._process = subprocess.Popen(
            [sys.executable, str(program), *options], text=True, bufsize=1, cwd=folder,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip
        self._reader = threading.Thread(target=lambda: self.lines.extend(self._process.stdout))
        self._reader.start()

    def enter(self, command, *expected):
        """Enter a command, and wait for lines that contain these texts."""
        begun = len(self.lines)
        if command:
            self._process.stdin.write(f"{command}\n")
            self._process.stdin.flush()
        for text in expected:
            until(
                lambda text=text: any(text in line for line in self.lines[begun:]),
                lambda text=text: f"{text} after {command}:\n{''.join(self.lines[-30:])}",
                20.0,
            )

    def asks(self, command, text):
        """Enter a command; return whether the text has come, now or after an earlier one."""
        self.enter(command)
        time.sleep(0.1)
        return any(text in line for line in self.lines)

    def stop(self):
        self._process.kill()
        self._process.wait()
        self._reader.join()
        self._process.stdin.close()
        self._process.stdout.close()


WAYPOINTS = """QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t50.0\t14.5\t368\t1
1\t0\t3\t16\t0\t0\t0\t0\t50.002\t14.502\t60\t1
2\t0\t3\t16\t0\t0\t0\t0\t50.004\t14.502\t70\t1
3\t0\t3\t17\t0\t0\t60\t0\t50.004\t14.499\t60\t1
"""


def test_mavproxy_uses_the_aircraft_by_tcp_with_signatures(flying, tmp_path):
    flying.pilot.move(throttle=1600)
    (tmp_path / "field.txt").write_text(WAYPOINTS)
    proxy = MAVProxy(f"tcp:127.0.0.1:{flying.ports[1]}", tmp_path)
    try:
        proxy.enter("", "Detected vehicle 1:1")
        # Unsigned, nothing is carried out.
        proxy.enter("mode LOITER")
        proxy.enter("signing key passphrase")
        proxy.enter("param fetch", "Saved ")
        assert not any("DO_SET_MODE" in line for line in proxy.lines)
        proxy.enter("mode LOITER", "DO_SET_MODE: ACCEPTED", "LOITER>")
        proxy.enter("param set RATE_RLL_P 1.5")
        until(lambda: proxy.asks("param show RATE_RLL_P", "RATE_RLL_P       1.5"), "the gain")
        proxy.enter("param set SYSID_THISMAV 3", "SYSID_THISMAV can only be read")
        proxy.enter("param set LOITER_RADIUS_M 60", "no parameter is set while")
        proxy.enter("wp load field.txt", "TYPE_MISSION: ACCEPTED")
        proxy.enter("wp list", "17 3 50.0040000000 14.4990000000 60.000000 p1=0.0 p2=0.0 p3=60.0")
        proxy.enter("wp set 2", "DO_SET_MISSION_CURRENT: ACCEPTED", "waypoint 2")
        proxy.enter("mode AUTO", "DO_SET_MODE: ACCEPTED", "Mode AUTO")
        proxy.enter("guided 50.003 14.501 80", "DO_REPOSITION: ACCEPTED", "Mode GUIDED")
        proxy.enter("mode RTL", "DO_SET_MODE: ACCEPTED", "Mode RTL")
        proxy.enter("disarm", "ARM_DISARM: DENIED", "the throttle is not low")
        proxy.enter("wp clear", "TYPE_MISSION: ACCEPTED")
    finally:
        proxy.stop()


def test_mavproxy_uses_the_aircraft_through_the_ground_bridge_by_udp(proxy, flying, tmp_path):
    flying.pilot.move(throttle=1600)
    (tmp_path / "field.txt").write_text(WAYPOINTS)
    with bridge(proxy, tmp_path, "udpin") as address:
        station = MAVProxy(f"udpout:{address}", tmp_path)
        try:
            station.enter("", "Detected vehicle 1:1")
            station.enter("param fetch", "Saved ")
            until(lambda: station.asks("mode LOITER", "DO_SET_MODE: ACCEPTED"), "control")
            station.enter("", "LOITER>")
            station.enter("wp load field.txt", "TYPE_MISSION: ACCEPTED")
            station.enter("wp list", "p1=0.0 p2=0.0 p3=60.0")
            station.enter("disarm", "ARM_DISARM: DENIED", "the throttle is not low")
            station.enter("mode RTL", "DO_SET_MODE: ACCEPTED", "Mode RTL")
            station.enter("wp clear", "TYPE_MISSION: ACCEPTED")
        finally:
            station.stop()
