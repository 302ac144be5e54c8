import os
import socket

import pytest
from twisted.internet.task import Clock

from up.system.notify import Notifier, WatchdogPinger, watchdog_period_s


@pytest.fixture
def supervisor(tmp_path):
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as heard:
        heard.bind(str(tmp_path / "notify"))
        heard.settimeout(10)
        yield heard


def hear_all(supervisor):
    supervisor.setblocking(False)
    found = []
    while True:
        try:
            found.append(supervisor.recv(4096))
        except BlockingIOError:
            return found


def test_each_message(supervisor):
    notifier = Notifier.from_environment({"NOTIFY_SOCKET": supervisor.getsockname()})
    assert notifier.ready("two\nlines")
    assert supervisor.recv(4096) == b"READY=1\nSTATUS=two lines"
    assert notifier.status("flying")
    assert supervisor.recv(4096) == b"STATUS=flying"
    assert notifier.watchdog()
    assert supervisor.recv(4096) == b"WATCHDOG=1"
    assert notifier.stopping()
    assert supervisor.recv(4096) == b"STOPPING=1"


def test_an_abstract_socket():
    name = f"up-notify-{os.getpid()}"
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as heard:
        heard.bind("\0" + name)
        heard.settimeout(10)
        assert Notifier("@" + name).ready()
        assert heard.recv(4096) == b"READY=1"


@pytest.mark.parametrize("address", [None, "", "/nowhere/notify", "@nobody-hears", "x" * 500])
def test_nobody_hears_and_nothing_breaks(address):
    assert not Notifier(address).ready("status")


def test_a_supervisor_that_does_not_read_blocks_nobody(supervisor):
    notifier = Notifier(supervisor.getsockname())
    said = [notifier.watchdog() for _ in range(100_000)]
    assert said[0]
    assert not said[-1]


@pytest.mark.parametrize(
    ("environ", "period_s"),
    [
        ({}, None),
        ({"WATCHDOG_USEC": "2000000"}, 2.0),
        ({"WATCHDOG_USEC": "0"}, None),
        ({"WATCHDOG_USEC": "soon"}, None),
        ({"WATCHDOG_USEC": "-1"}, None),
        ({"WATCHDOG_USEC": "\u0663"}, None),
        ({"WATCHDOG_USEC": "2000000", "WATCHDOG_PID": str(os.getpid())}, 2.0),
        ({"WATCHDOG_USEC": "2000000", "WATCHDOG_PID": "1"}, None),
    ],
)
def test_the_period_that_the_supervisor_asks_for(environ, period_s):
    assert watchdog_period_s(environ) == period_s


def test_pings_come_twice_a_period_while_healthy_and_only_then(supervisor):
    clock, healthy = Clock(), [True]
    notifier = Notifier(supervisor.getsockname())
    environ = {"WATCHDOG_USEC": "2000000"}
    pinger = WatchdogPinger(clock, lambda: healthy[0], notifier, environ)
    pinger.start()
    pinger.start()
    assert hear_all(supervisor) == [b"WATCHDOG=1"]
    clock.pump([1.0] * 3)
    assert hear_all(supervisor) == [b"WATCHDOG=1"] * 3
    healthy[0] = False
    clock.pump([1.0] * 3)
    assert hear_all(supervisor) == []
    healthy[0] = True
    clock.advance(1.0)
    assert hear_all(supervisor) == [b"WATCHDOG=1"]
    pinger.stop()
    pinger.stop()
    clock.advance(10.0)
    assert hear_all(supervisor) == []
    assert clock.getDelayedCalls() == []


def test_nobody_watches_nothing_is_scheduled():
    clock = Clock()
    WatchdogPinger(clock, lambda: True, environ={}).start()
    assert clock.getDelayedCalls() == []
