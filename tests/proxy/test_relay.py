"""Whole lines, also with slow peers and peers that leave in the middle of one."""

import gc
import weakref

import pytest

from up.protocols.control_lease import ALIVE_S
from up_proxy.connection import HIGH_WATER_BYTES, LINE_MAX_BYTES
from up_proxy.listener import SEND_BUFFER_BYTES


def numbered(first, count, width=200):
    return b"".join(b"%08d" % n + b"." * (width - 9) + b"\n" for n in range(first, first + count))


def test_a_partial_line_waits_for_its_end(bench):
    air, _ = bench.hello_air()
    ground, _ = bench.hello_ground()
    air.say("half")
    bench.settle()
    assert ground.heard == b""
    air.say(" whole\nnext")
    assert ground.line() == "half whole\n"
    assert ground.heard == b""


def test_partial_lines_of_two_grounds_are_never_joined(bench):
    air, _ = bench.hello_air()
    old, token = bench.hello_ground()
    old.say('{"old": ')
    new, _ = bench.hello_ground(extra=f" token={token}")
    old.expect_closed()
    new.say('"new"}\n')
    assert air.line() == '"new"}\n'


def test_a_partial_line_of_a_broken_connection_is_never_relayed(bench):
    air, token = bench.hello_air()
    ground, _ = bench.hello_ground()
    air.say("torn")
    air.close()
    again, _ = bench.hello_air(extra=f" token={token}")
    again.say("whole\n")
    ground.expect("UP1 aircraft online\n")
    assert ground.line() == "whole\n"


def test_a_new_listener_begins_at_the_beginning_of_a_line(bench):
    air, _ = bench.hello_air()
    air.say("begun ")
    ground, _ = bench.hello_ground()
    air.say("ended\n")
    assert ground.line() == "begun ended\n"


def test_an_aircraft_cannot_speak_as_the_proxy(bench):
    air, _ = bench.hello_air()
    ground, _ = bench.hello_ground()
    air.say("UP1 seat listen\nreal UP1 \nUP1 ")
    air.say("seat holder=none\n{}\n")
    assert ground.line() == "real UP1 \n"
    assert ground.line() == "{}\n"


@pytest.mark.parametrize("side", ["air", "ground"])
def test_a_line_without_end_closes_its_connection(bench, side):
    air, _ = bench.hello_air()
    ground, _ = bench.hello_ground()
    sender = air if side == "air" else ground
    sender.say(b"x" * (LINE_MAX_BYTES - 1) + b"\n")
    bench.settle()
    assert not sender.closed
    sender.socket.setblocking(False)
    with pytest.raises((BlockingIOError, ConnectionError)):
        for _ in range(10_000):
            sender.socket.send(b"x" * 65536)
            bench.pump()
            if sender.closed:
                raise ConnectionResetError
    sender.expect_closed()


def test_a_stalled_listener_loses_old_lines_and_the_good_ones_lose_nothing(bench):
    air, _ = bench.hello_air()
    good, _ = bench.hello_ground()
    stalled, _ = bench.hello_ground(asks="listen")
    bench.peers.remove(stalled)
    expected = b""
    total = 4_000
    for first in range(0, total, 100):
        lines = numbered(first, 100)
        expected += lines
        air.say(lines)
        ground = next(g for g in bench.aircraft().grounds.connections if g.number == 2)
        assert ground.waiting_bytes <= 65536
    bench.until(lambda: good.heard == expected, "every line at the good ground")
    assert bench.aircraft().dropped_lines > 0
    bench.peers.append(stalled)
    bench.until(lambda: numbered(total - 1, 1) in stalled.heard, "the newest line")
    lines = stalled.heard.split(b"\n")[:-1]
    numbers = [int(line[:8]) for line in lines]
    assert all(line[8:] == b"." * 191 for line in lines)
    assert numbers == sorted(set(numbers))
    assert len(numbers) + bench.aircraft().dropped_lines == total


def test_control_lines_stand_between_relayed_lines_behind_a_stall(bench):
    air, _ = bench.hello_air()
    owner, _ = bench.hello_ground()
    asker, _ = bench.hello_ground(gets="listen")
    bench.peers.remove(owner)
    for first in range(0, 3_000, 100):
        air.say(numbered(first, 100))
    asker.say("UP1 seat request\n")
    air.say(numbered(3_000, 1))
    bench.peers.append(owner)
    bench.until(lambda: numbered(3_000, 1) in owner.heard, "the newest line")
    lines = owner.heard.split(b"\n")[:-1]
    assert lines.count(b"UP1 seat asked by=2") == 1
    assert all(len(line) == 199 for line in lines if not line.startswith(b"UP1 "))


def test_a_slow_aircraft_slows_the_ground_that_commands_and_loses_nothing(bench):
    air, _ = bench.hello_air()
    ground, _ = bench.hello_ground()
    bench.peers.remove(air)
    sent, total = b"", 0
    while True:
        lines = numbered(total, 100)
        try:
            count = ground.socket.send(lines)
        except BlockingIOError:
            break
        sent += lines[:count]
        total += 100
        bench.pump()
        if count < len(lines):
            break
        assert len(sent) < 50_000_000
    waiting = bench.aircraft().air_lease.owner.waiting_bytes
    assert HIGH_WATER_BYTES <= waiting <= 3 * HIGH_WATER_BYTES
    bench.pass_time(10)
    assert bench.aircraft().grounds.lease.live_owner(bench.reactor.seconds()) is not None
    bench.peers.append(air)
    whole = sent[: sent.rfind(b"\n") + 1]
    bench.until(lambda: len(air.heard) >= len(whole), "every line at the aircraft")
    assert air.heard == whole
    ground.say((sent[len(whole) :] and b"\n") or b"")
    assert len(sent) > SEND_BUFFER_BYTES


def test_a_listener_may_flood_without_being_relayed_or_kept(bench):
    air, _ = bench.hello_air()
    owner, _ = bench.hello_ground()
    flooder, _ = bench.hello_ground(gets="listen")
    for _ in range(50):
        flooder.say(b"x" * 60_000 + b"\n")
    owner.say("good\n")
    assert air.line() == "good\n"
    assert air.heard == b""
    assert bench.aircraft().rejected_lines == 50


def test_an_aircraft_that_left_is_freed_without_the_collector(bench):
    gc.disable()
    try:
        air, _ = bench.hello_air()
        ground, _ = bench.hello_ground()
        left = weakref.ref(bench.aircraft())
        air.close()
        ground.close()
        bench.pass_time(ALIVE_S + 1.0)
        assert not bench.proxy.registry.aircraft()
        assert left() is None
    finally:
        gc.enable()
