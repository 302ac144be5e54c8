"""Peers that vanish without a word: a network that swallows every packet."""

import subprocess
import time

import pytest

from tests.proxy.namespace import THERE, blackhole, figure, light, network
from tests.proxy.program import Program, accepted, until


@pytest.fixture
def proxy(tmp_path):
    with network() as inside, Program(tmp_path, prefix=inside) as proxy:
        proxy.inside = inside
        yield proxy


def test_a_vanished_aircraft_and_owner_are_detected_and_replaced(proxy):
    begin_s = time.monotonic()
    air, token = accepted(proxy.airborne_port, "UP1 aircraft=a\n", THERE)
    ground, _ = accepted(proxy.ground_port, "UP1 aircraft=a seat=command\n", THERE)
    assert figure(proxy.inside, proxy, 'up_proxy_aircraft_online{aircraft="a"}') == 1
    blackhole(proxy.inside)
    until(
        lambda: figure(proxy.inside, proxy, 'up_proxy_aircraft_online{aircraft="a"}') == 0,
        "offline",
    )
    until(
        lambda: figure(proxy.inside, proxy, 'up_proxy_aircraft_commanded{aircraft="a"}') == 0,
        "no owner",
    )
    assert time.monotonic() - begin_s > 2
    light(proxy.inside)
    # Half-open: neither old connection has ended, the new ones take their places.
    successor, _ = accepted(proxy.ground_port, "UP1 aircraft=a seat=command\n", THERE)
    again, same = accepted(proxy.airborne_port, f"UP1 aircraft=a token={token}\n", THERE)
    assert same == token
    again.say("telemetry\n")
    successor.expect("telemetry")
    successor.say("command\n")
    assert again.expect("command") == "command\n"
    for client in (air, ground, again, successor):
        client.close()


def test_data_to_a_vanished_peer_end_its_connection(proxy):
    listener, _ = accepted(proxy.ground_port, "UP1 aircraft=local seat=listen\n", THERE)
    connections = 'up_proxy_connections{side="ground"}'
    assert figure(proxy.inside, proxy, connections) == 1
    feeder = subprocess.Popen(
        [
            *proxy.inside, "python3", "-c",
            "import socket, time\n"
            f"air = socket.create_connection(('127.0.0.1', {proxy.airborne_port}))\n"
            "air.sendall(b'UP1 aircraft=local\\n')\n"
            "while True:\n"
            "    air.sendall(b'telemetry\\n')\n"
            "    time.sleep(0.05)\n",
        ]
    )  # fmt: skip
    try:
        listener.expect("telemetry")
        blackhole(proxy.inside)
        until(
            lambda: figure(proxy.inside, proxy, connections) == 0,
            "the end of the listener",
        )
        assert figure(proxy.inside, proxy, 'up_proxy_idle_closed_total{side="ground"}') == 0
    finally:
        feeder.kill()
        feeder.wait()
        listener.close()
