"""kill -9 of the daemon and of the proxy in mid-line: the Java sides come back, nothing crosses."""

import itertools
import signal
import threading
import time

import pytest

from tests.android.console_program import ConsoleProgram, number_in
from tests.android.numbered_motion import numbers_of
from tests.android.phone_program import PhoneProgram
from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.android.slow_relay import SlowRelay
from tests.proxy.program import Client, Program
from tests.support.waiting import until
from up_simulator.harness.ports import choose_port_sets

OTHER = b'{"name": "up.telemetry.update", "data": {"orientation": {"roll": 1.25}}, "beacon": 1}\n'
MOVING = 20
BACK_S = 5.0
"""Proxy restarts: both ends come back within 5 s, not counting how long a program starts."""


class Stranger(threading.Thread):
    """Another aircraft of the proxy, whose telemetry must never be seen; it reconnects, too."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.port = port
        self.connections = 0
        self.is_over = False
        self.start()

    def run(self):
        while not self.is_over:
            try:
                with Client(self.port, "UP1 aircraft=other\n") as client:
                    self.connections += client.line().startswith("UP1 ok")
                    while not self.is_over:
                        client.say(OTHER)
                        time.sleep(0.02)
            except OSError:
                time.sleep(0.05)


class System:
    """Daemon, proxy, phone and ground; the daemon's way to the proxy can be cut in a line."""

    def __init__(self, folder):
        (ports,) = choose_port_sets(1)
        self.folder = folder
        self.ports = (ports.airborne, ports.ground, ports.metrics)
        self.start_proxy()
        self.relay = SlowRelay(ports.airborne).__enter__()
        uplink = f"remote_server: {{url: 127.0.0.1, port: {self.relay.port}}}\n"
        self.daemon = RealDaemon(folder / "daemon", mission=uplink)
        self.daemon.start()
        self.stranger = Stranger(ports.airborne)
        self.phone = PhoneProgram(*self.daemon.place, "--orientation", "tcp")
        proxy = ("--proxy", f"127.0.0.1:{ports.ground}", "--aircraft", AIRCRAFT)
        self.console = ConsoleProgram(*proxy, values=("android.connected",))
        self.console.holds()
        self.console.until(lambda: self.console.number(), "an attitude")
        assert self.console.ask("up.telemetry.frequency", frequency=20)["outcome"] == "ACK"

    def start_proxy(self):
        self.proxy = Program(self.folder / "proxy", ports=self.ports)
        self.proxy.__enter__()

    def end(self):
        self.stranger.is_over = True
        for each in (self.phone, self.console, self.daemon, self.proxy):
            each.end()
        self.relay.__exit__()
        self.stranger.join()

    def flows(self, what):
        """Wait until attitudes of from now on flow to the ground; return when the first came, s."""
        since_s, said = time.monotonic(), self.phone.number

        def fresh():
            return [
                at for at, event in list(self.console.events)
                if event["event"] == "telemetry" and at > since_s
                and (number_in(event) or 0) > said
            ]  # fmt: skip

        return self.console.until(lambda: len(fresh()) >= MOVING and fresh(), what)[0] - since_s


@pytest.fixture
def system(tmp_path):
    made = System(tmp_path)
    yield made
    made.end()


def test_both_come_back_and_nothing_is_crossed(system):
    console, phone, daemon = system.console, system.phone, system.daemon
    system.flows("telemetry")
    # The daemon dies while a line of telemetry is half at the proxy.
    system.relay.cut(700)
    until(lambda: system.relay.cuts == 1, "half a line")
    assert daemon.end(signal.SIGKILL) == -signal.SIGKILL
    console.until(lambda: console.status["online"] is False, "that the aircraft is missed")
    phone.until(lambda: phone.all("lost"), "that the phone misses it")
    lost = console.ask("up.disarm")
    assert (lost["outcome"], lost["code"]) == ("REFUSED", "no_aircraft")
    daemon.start()
    daemon_s = system.flows("telemetry of the new daemon")
    assert len(phone.connections) == 2
    console.holds()
    assert console.ask("android.speak", text="back")["outcome"] == "ACK"
    # The proxy dies while lines are on their way.
    system.proxy.end(signal.SIGKILL)
    console.until(lambda: console.status["link"] != "OPEN", "that the proxy is missed")
    met = system.stranger.connections
    system.start_proxy()
    proxy_s = system.flows("telemetry through the new proxy")
    until(lambda: system.stranger.connections > met, "the other aircraft")
    console.holds()
    assert console.ask("android.speak", text="again")["outcome"] == "ACK"
    system.flows("telemetry beside the other aircraft's")
    assert phone.said == ["back", "again"]
    assert len(phone.connections) == 2, "the phone did not notice the proxy"
    assert proxy_s < BACK_S and daemon_s < BACK_S
    # Every frame is one that the phone sent, and none overtook another.
    numbers = [number_in(frame) for frame in console.frames]
    known = [number for number in numbers if number is not None]
    assert known == sorted(known)
    assert not console.all("notice")
    daemon.end()
    recorded = numbers_of(daemon.log_of("up.orientation.update"))
    assert all(b - a >= 0 for a, b in itertools.pairwise(recorded))
    print(f"back: daemon {daemon_s:.2f} s, proxy {proxy_s:.2f} s after they listened;"
          f" {len(known)} frames, all right")  # fmt: skip
