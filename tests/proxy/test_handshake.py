"""From the first byte to a seat or a refusal."""

import socket

import pytest


@pytest.mark.parametrize(
    "line",
    ["GET / HTTP/1.1\r\n\r\n", "UP1 aircraft=a/b\n", "\n", "UP2 aircraft=a\n", "UP1" + "x" * 600],
)
def test_a_malformed_hello_is_answered_and_closed(bench, line):
    for peer in (bench.air(line), bench.ground(line)):
        assert peer.refusal() == "malformed"
    air, ground = (door.refused["malformed"] for door in bench.proxy._acceptors)
    assert air == ground == 1


def test_why_is_readable_even_when_more_was_sent_than_is_read(bench):
    peer = bench.ground("garbage\n" + "x" * 300_000)
    assert peer.refusal() == "malformed"
    bench.pass_time(3)
    assert len(bench.proxy._acceptors[1].connections) == 0


def test_a_hello_may_come_byte_by_byte_within_five_seconds(bench):
    peer = bench.ground("UP1")
    bench.pass_time(2)
    for character in " aircraft=a seat=listen":
        peer.say(character)
    bench.pass_time(2)
    peer.say("\n")
    assert peer.line().startswith("UP1 ok aircraft=a seat=listen token=")


def test_a_hello_that_takes_longer_is_refused(bench):
    peer = bench.ground("UP1 aircraft=")
    bench.pass_time(4.5)
    assert peer.heard == b""
    bench.pass_time(1)
    assert peer.refusal() == "malformed"


def test_lines_behind_the_hello_are_relayed(bench):
    ground, _ = bench.hello_ground()
    air = bench.air("UP1 aircraft=a\none\ntw")
    ground.expect("UP1 aircraft online\none\n")
    air.say("o\n")
    assert ground.line() == "two\n"


def test_a_peer_that_closes_immediately(bench):
    for _ in range(50):
        peer = bench.ground()
        peer.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
        peer.close()
    bench.hello_ground()
    bench.pass_time(1)
    assert len(bench.proxy._acceptors[1].connections) == 1


def test_idle_means_no_byte_in_either_direction(bench):
    air, _ = bench.hello_air()
    listener, _ = bench.hello_ground(asks="listen")
    lonely, _ = bench.hello_ground("b", asks="listen")
    for _ in range(20):
        air.say("telemetry\n")
        bench.pass_time(1)
    assert not listener.closed
    lonely.expect_closed()
    assert bench.proxy._acceptors[1].idle_closed == 1
