"""Endpoints on real sockets and a real terminal."""

import contextlib
import os
import pty
import socket

import pytest
from pymavlink.dialects.v20 import common as m
from twisted.internet.error import CannotListenError

from tests.mavlink.test_codec import FRAME
from tests.support.reactor import reactor, run_in_reactor, until
from up_mavlink.address import read_address
from up_mavlink.endpoint import Endpoint, Settings
from up_mavlink.personas import BY_NAME


class Port:
    problem = ""

    def send(self, message):
        """Leave it unanswered."""


def endpoint_of(url):
    return Endpoint(reactor, Settings(read_address(url), BY_NAME["ardupilot"]), Port())


def serving(url, body):
    async def run():
        endpoint = endpoint_of(url)
        endpoint.start()
        try:
            await body(endpoint)
        finally:
            await endpoint.stop()

    run_in_reactor(run)


def packet():
    message = m.MAVLink_command_long_message(1, 1, 512, 0, 148, 0, 0, 0, 0, 0, 0)
    return bytes(message.pack(m.MAVLink(None, srcSystem=255)))


def kinds(data):
    parser = m.MAVLink(None)
    parser.robust_parsing = True
    return [each.get_type() for each in parser.parse_buffer(data) or ()]


def udp():
    found = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    found.setblocking(False)
    found.bind(("127.0.0.1", 0))
    return found


def received(end):
    def read():
        try:
            return end.recv(65536)
        except BlockingIOError:
            return b""

    return read


def test_a_serial_radio_is_served():
    ours, theirs = pty.openpty()
    path = os.ttyname(theirs)

    async def body(endpoint):
        os.write(ours, packet())
        await until(lambda: endpoint.counters["sent"] >= 1)
        endpoint.on_frame(FRAME, 1)
        os.set_blocking(ours, False)
        data = bytearray()

        def are_there():
            with contextlib.suppress(BlockingIOError):
                data.extend(os.read(ours, 65536))
            return {"AUTOPILOT_VERSION", "HEARTBEAT", "ATTITUDE"} <= set(kinds(data))

        await until(are_there)

    serving(f"serial:{path}:57600", body)
    os.close(ours)
    os.close(theirs)


def test_a_udp_client_begins_and_hears_its_peer_only():
    with udp() as ground, udp() as stranger:

        async def body(endpoint):
            endpoint.on_frame(FRAME, 1)
            data = []
            await until(lambda: data.append(received(ground)()) or data[-1])
            assert kinds(data[-1]) == ["HEARTBEAT"]
            here = ("127.0.0.1", endpoint._transport.getHost().port)
            stranger.sendto(packet(), here)
            await until(lambda: endpoint.counters["foreign"] == 1)
            sent = endpoint.counters["sent"]
            ground.sendto(packet(), here)
            await until(lambda: endpoint.counters["sent"] == sent + 2)

        serving(f"udpout:127.0.0.1:{ground.getsockname()[1]}", body)


def test_noise_makes_no_udp_client_and_silence_ends_one(monkeypatch):
    with udp() as ground:

        async def body(endpoint):
            here = ("127.0.0.1", endpoint.number)
            ground.sendto(b"\xfd" * 300, here)
            await until(lambda: endpoint.counters["malformed"] or endpoint.counters["unknown"])
            assert not endpoint.sessions
            ground.sendto(packet(), here)
            await until(lambda: endpoint.sessions)
            (session,) = endpoint.sessions.values()
            session.received_s -= 31.0
            endpoint._on_moment()
            assert not endpoint.sessions

        serving("udpin:127.0.0.1:0", body)


def test_a_tcp_client_that_does_not_read_loses_packets():
    async def body(endpoint):
        with socket.create_connection(("127.0.0.1", endpoint.number)) as client:
            await until(lambda: endpoint.sessions)
            for _ in range(200_000):
                if endpoint.counters["unsent"]:
                    break
                endpoint.on_frame(FRAME, 1)
                for session in endpoint.sessions.values():
                    session._streams._sent_s.clear()
                await until(lambda: True)
            assert endpoint.counters["unsent"]
            client.close()
            await until(lambda: not endpoint.sessions)

    serving("tcpin:127.0.0.1:0", body)


def test_a_port_in_use_is_an_error():
    with udp() as taken:
        endpoint = endpoint_of(f"udpin:127.0.0.1:{taken.getsockname()[1]}")
        with pytest.raises(CannotListenError):
            endpoint.start()
