"""The phone in Python as a process against real sockets: connecting, finding, stalling."""

import json
import socket
import struct
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulator.program import DEADLINE_S, Program
from up_simulator.phone.address import (
    NotFoundError,
    RaspberryPi,
    read_discovery_answer,
    read_spawn_answer,
)

# The Java phone has its own tests: tests/android/test_interop_*.py.


@pytest.fixture
def server():
    with socket.create_server(("127.0.0.1", 0)) as made:
        made.settimeout(DEADLINE_S)
        yield made


def port_of(made):
    return made.getsockname()[1]


class Peer:
    def __init__(self, server):
        self.connection, self.address = server.accept()
        self.connection.settimeout(DEADLINE_S)
        self.file = self.connection.makefile("rb")

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def close(self):
        self.file.close()
        self.connection.close()

    def send(self, data):
        self.connection.sendall(data)

    def wait_for(self, name):
        deadline = time.monotonic() + DEADLINE_S
        while time.monotonic() < deadline:
            line = self.file.readline()
            assert line.endswith(b"\n"), "the phone hung up"
            message = json.loads(line)
            if message["name"] == name:
                return message
        raise AssertionError(f"no {name}")


def phone(general, *arguments):
    return Program("--no-board", "--general-port", port_of(general), *arguments)


def test_it_sends_its_measurements_and_answers(server):
    with phone(server) as program, Peer(server) as peer:
        place = peer.wait_for("up.location.update")["data"]
        assert (place["latitude"], place["longitude"]) == pytest.approx((50.0, 14.5), abs=0.01)
        assert set(place) >= {"altitude", "accuracy", "speed", "bearing", "satellites"}
        for name in ("up.altitude.change", "up.heading.change"):
            peer.wait_for(name)
        peer.send(b'{"name": "android.speak", "data": {"text": "Hello"}, "id": "42"}\n')
        assert peer.wait_for("up.ack")["data"] == {"id": "42"}
        program.wait_for("phone_speech", speech="Hello")
        status, _, error = program.end()
    assert (status, error) == (0, "")


def test_it_comes_back_after_a_lost_link_and_half_a_line_dies_with_it(server):
    with phone(server) as program:
        for _ in range(2):
            with Peer(server) as peer:
                peer.wait_for("android.battery")
                peer.send(b'{"name": "android.sp')
        with Peer(server) as peer:
            peer.send(b'{"name": "android.speak", "data": {"text": "again"}, "id": "9"}\n')
            assert peer.wait_for("up.ack")["data"] == {"id": "9"}
        assert program.end()[0] == 0


def test_garbage_and_endless_lines_end_no_phone(server):
    with phone(server) as program:
        with Peer(server) as peer:
            peer.send(b"\xff\xfe{[\n" * 100)
            peer.wait_for("up.location.update")
            program.wait_for("phone_malformed_line")
            try:
                for _ in range(100):
                    peer.send(b"x" * 4096)
            except OSError:
                pass  # a line longer than 16 KiB ends the connection
        with Peer(server) as peer:
            peer.wait_for("up.location.update")
        assert program.end()[0] == 0


def test_orientation_over_tcp(server):
    with socket.create_server(("127.0.0.1", 0)) as orientation:
        orientation.settimeout(DEADLINE_S)
        arguments = ("--orientation", "tcp", "--orientation-port", port_of(orientation))
        with phone(server, *arguments) as program, Peer(server), Peer(orientation) as peer:
            frames = [peer.file.read(24) for _ in range(50)]
            for frame in frames:
                values = struct.unpack(">6f", frame)
                assert all(abs(angle) <= 360 for angle in values[:3])
                assert all(abs(rate) <= 4000 for rate in values[3:])
            assert len(set(frames)) > 30
            assert program.end()[0] == 0


def test_orientation_over_udp(server):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as orientation:
        orientation.bind(("127.0.0.1", 0))
        orientation.settimeout(DEADLINE_S)
        arguments = ("--orientation", "udp", "--orientation-port", port_of(orientation))
        with phone(server, *arguments) as program, Peer(server):
            assert {len(orientation.recv(2048)) for _ in range(50)} == {24}
            assert program.end()[0] == 0


def test_it_finds_the_raspberry_pi_by_discovery(server):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as discovery:
        discovery.bind(("127.0.0.1", 0))
        discovery.settimeout(DEADLINE_S)
        arguments = ("--discover", f"127.0.0.1:{port_of(discovery)}", "--phone-host", "192.0.2.1")
        with phone(server, *arguments) as program:
            # The first request is not answered: it is repeated.
            discovery.recvfrom(512)
            program.wait_for("phone_not_found")
            question, asker = discovery.recvfrom(512)
            assert len(question) <= 512
            discovery.sendto(b"127.0.0.1", asker)
            with Peer(server) as peer:
                peer.wait_for("up.location.update")
            assert program.end()[0] == 0


def test_it_asks_a_runner_and_goes_where_the_answer_says(server):
    with socket.create_server(("127.0.0.1", 0)) as runner:
        runner.settimeout(DEADLINE_S)
        place = f"127.0.0.1:{port_of(runner)}"
        with Program("--no-board", "--runner", place, "--aircraft-name", "glider-1") as program:
            with Peer(runner) as peer:
                assert json.loads(peer.file.readline()) == {"aircraft": "glider-1"}
                peer.send(b'{"running": false, "error": "unknown-aircraft", "ports": null}\n')
                refused = program.wait_for("phone_not_found")
                assert "unknown-aircraft" in refused.fields["reason"]
            with Peer(runner) as peer:
                peer.file.readline()
                ports = {"general": port_of(server), "orientation": 50000}
                answer = {"message": "Raspilot spawned", "running": True, "ports": ports}
                peer.send(json.dumps(answer).encode() + b"\n")
                with Peer(server) as pi:
                    pi.wait_for("up.location.update")
            assert program.end()[0] == 0


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"[]",
        b"null",
        b"{",
        b'{"running": true}',
        b'{"running": true, "ports": null}',
        b'{"running": true, "ports": {"general": "1", "orientation": 2}}',
        b'{"running": true, "ports": {"general": 0, "orientation": 2}}',
        b'{"running": true, "ports": {"general": true, "orientation": 2}}',
        b'{"running": "yes", "ports": {"general": 1, "orientation": 2}}',
        b"[" * 100_000,
    ],
)
def test_an_invalid_answer_of_a_runner_is_refused(line):
    with pytest.raises(NotFoundError):
        read_spawn_answer(line, "127.0.0.1")


def test_a_runners_right_answer_is_a_place():
    line = b'{"running": true, "ports": {"general": 5, "orientation": 6}}'
    assert read_spawn_answer(line, "192.0.2.7") == RaspberryPi("192.0.2.7", 5, 6)


@pytest.mark.parametrize(
    ("answer", "host"),
    [(b"10.0.0.1", "10.0.0.1"), (b"10.0.0.1\n", "10.0.0.1"), (b"", "10.0.0.1"),
     (b"10.0.0.2", None), (b"203.0.113.9", None), (b"\xff", None), (b"010.0.0.1", None)],
)  # fmt: skip
def test_discoverys_answer_is_the_senders_address(answer, host):
    assert read_discovery_answer(answer, "10.0.0.1") == host


def test_a_public_address_is_no_answer():
    assert read_discovery_answer(b"203.0.113.9", "203.0.113.9") is None
    assert read_discovery_answer(b"", "203.0.113.9") is None


@given(st.binary(max_size=100))
def test_any_answer_is_an_address_or_refused(answer):
    assert read_discovery_answer(answer, "10.0.0.1") in ("10.0.0.1", None)
    with pytest.raises(NotFoundError):
        read_spawn_answer(answer, "127.0.0.1")


@pytest.mark.parametrize("option", ["--discover", "--runner"])
def test_it_ends_at_once_while_it_waits_for_an_answer(option):
    with (
        socket.create_server(("127.0.0.1", 0)) as runner,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as discovery,
    ):
        discovery.bind(("127.0.0.1", 0))
        asked = discovery if option == "--discover" else runner
        asked.settimeout(DEADLINE_S)
        with Program("--no-board", option, f"127.0.0.1:{port_of(asked)}") as program:
            question = asked.recv(512) if asked is discovery else asked.accept()[0]
            status, took_s, error = program.end()
            if asked is runner:
                question.close()
    assert (status, error) == (0, "")
    assert took_s < 5.0
