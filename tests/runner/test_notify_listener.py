"""Notifications of instances, invalid ones included, and the socket that receives them."""

import array
import os
import socket
import subprocess
import sys

from hypothesis import given
from hypothesis import strategies as st

from tests.support.reactor import reactor, until
from up.system.notify import Notifier
from up_runner.notify_listener import MAX_BYTES, Notification, NotifyListener, parse


def count_descriptors():
    return len(os.listdir("/proc/self/fd"))  # noqa: PTH208


def listening(folder):
    received = []
    listener = NotifyListener(reactor, folder / "notify", lambda *each: received.append(each))
    listener.open()
    return listener, received


async def test_it_knows_the_sender(short_path):
    listener, received = listening(short_path)
    Notifier(str(listener.path)).ready("runs")
    await until(lambda: received)
    assert received == [(os.getpid(), Notification(ready=True))]
    code = "from up.system.notify import Notifier; import sys; Notifier(sys.argv[1]).watchdog()"
    with subprocess.Popen([sys.executable, "-c", code, str(listener.path)]) as child:
        await until(lambda: len(received) == 2)
    assert received[1] == (child.pid, Notification(alive=True))
    listener.close(remove=True)
    assert not listener.path.exists()


async def test_the_next_runners_socket_takes_over_at_the_same_path(short_path):
    received = []
    first = NotifyListener(reactor, short_path / "notify", lambda *_: received.append(1))
    first.open()
    first.close(remove=False)
    assert first.path.exists()
    assert Notifier(str(first.path)).ready() is False
    second = NotifyListener(reactor, short_path / "notify", lambda *_: received.append(2))
    second.open()
    assert Notifier(str(second.path)).ready() is True
    await until(lambda: received)
    assert received == [2]
    second.close(remove=True)


async def test_drained_it_receives_immediately(short_path):
    listener, received = listening(short_path)
    notifier = Notifier(str(listener.path))
    for _ in range(5):
        notifier.watchdog()
    listener.drain()
    assert len(received) == 5
    listener.close(remove=True)
    listener.drain()


async def test_received_descriptors_are_closed(short_path):
    listener, received = listening(short_path)
    before = count_descriptors()
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as line:
        for _ in range(20):
            line.sendmsg(
                [b"WATCHDOG=1"],
                [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", [0, 1, 2]))],
                0,
                str(listener.path),
            )
            listener.drain()
    assert count_descriptors() == before
    assert len(received) == 20
    listener.close(remove=True)


async def test_a_datagram_that_is_too_long_is_dropped(short_path):
    listener, received = listening(short_path)
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as line:
        line.sendto(b"READY=1\n" + b"x" * 10_000, str(listener.path))
    listener.drain()
    assert received == []
    listener.close(remove=True)


def test_the_fields_of_sd_notify_and_the_additions():
    assert parse(b"READY=1\nSTATUS=12 modules run") == Notification(ready=True)
    assert parse(b"WATCHDOG=1\nX_UP_PHONE=1") == Notification(alive=True, phone=True)
    assert parse(b"STOPPING=1") == Notification(stopping=True)
    assert parse(b"X_UP_PHONE=0\n") == Notification(phone=False)
    assert parse(b"X_UP_ARMED=1\n") == Notification(armed=True)
    assert parse(b"X_UP_PORTS=general:50001 orientation:50000").ports == {
        "general": 50001,
        "orientation": 50000,
    }
    assert parse(b"X_UP_PORTS=").ports == {}


def test_malformed_fields_are_left_out():
    empty = Notification()
    for words in (
        b"",
        b"READY=0",
        b"READY",
        b"X_UP_PHONE=2",
        b"X_UP_ARMED=yes",
        b"X_UP_PORTS=general",
        b"X_UP_PORTS=general:0",
        b"X_UP_PORTS=general:65536",
        b"X_UP_PORTS=general:-1",
        b"X_UP_PORTS=" + b" ".join(b"p%d:1" % number for number in range(17)),
        b"MAINPID=1",
    ):
        assert parse(words) == empty, words


@given(st.binary(max_size=300) | st.builds(lambda data: b"X_UP_PORTS=" + data, st.binary()))
def test_no_bytes_break_it(data):
    notification = parse(data)
    for port in (notification.ports or {}).values():
        assert 1 <= port <= 65535


def test_it_reads_no_more_than_its_limit():
    assert parse(b"x" * MAX_BYTES + b"\nREADY=1") == Notification()
