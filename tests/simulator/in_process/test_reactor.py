"""Time, threads and descriptors of the simulated reactor."""

import os
import socket
import threading

import pytest
from twisted.internet.main import CONNECTION_LOST
from twisted.logger import capturedLogs

from up.system.disk_thread import DiskThread
from up_simulator.in_process.reactor import SimulatedReactor


@pytest.fixture
def reactor():
    return SimulatedReactor()


def test_time_moves_in_steps_and_does_not_drift(reactor):
    seen_s = []
    host = reactor.host()

    def sample():
        seen_s.append(reactor.seconds())
        host.callLater(0.002, sample)

    sample()
    for _ in range(20_000):
        reactor.advance(0.002)
    assert reactor.seconds() == 40.0
    assert seen_s == [n / 500 for n in range(20_001)]


def test_calls_made_in_a_step_run_in_the_next_one(reactor):
    made_s = []

    def again():
        made_s.append(reactor.seconds())
        reactor.callLater(1e-18, again)

    reactor.callLater(0, again)
    reactor.advance(0.01)
    assert made_s == [0.002, 0.004, 0.006, 0.008, 0.01]


def test_a_slow_disk_does_not_delay_a_flight(reactor):
    host, done = reactor.host(), []
    held = threading.Event()
    threading.Timer(0.2, held.set).start()
    DiskThread(host).run(held.wait).addCallback(done.append)
    reactor.advance(0.002)
    assert done == [True]


def test_a_due_call_may_be_cancelled_and_moved_by_one_before_it(reactor):
    order = []

    def first():
        order.append("first")
        second.cancel()
        third.reset(0.1)

    reactor.callLater(0.01, first)
    second = reactor.callLater(0.01, order.append, "second")
    third = reactor.callLater(0.01, order.append, "third")
    reactor.advance(0.05)
    assert order == ["first"]
    reactor.advance(0.1)
    assert order == ["first", "third"]


def test_a_call_that_raises_is_logged(reactor):
    done = []
    reactor.callLater(0.01, lambda: 1 / 0)
    reactor.callLater(0.01, done.append, 1)
    with capturedLogs() as events:
        reactor.advance(0.02)
    assert done == [1]
    assert [event["log_failure"].type for event in events if "log_failure" in event] == [
        ZeroDivisionError
    ]


def test_calls_from_threads_run_in_the_next_step(reactor):
    host, made_in = reactor.host(), []
    thread = threading.Thread(
        target=host.callFromThread, args=(lambda: made_in.append(threading.get_ident()),)
    )
    thread.start()
    thread.join()
    assert made_in == []
    reactor.advance(0.002)
    assert made_in == [threading.get_ident()]


class Descriptor:
    def __init__(self, number):
        self.number, self.read, self.lost, self.writes = number, b"", [], 0
        self.answer = None

    def fileno(self):
        return self.number

    def logPrefix(self):  # noqa: N802
        return "test"

    def doRead(self):  # noqa: N802
        data = os.read(self.number, 100)
        self.read += data
        return self.answer or (None if data else CONNECTION_LOST)

    def doWrite(self):  # noqa: N802
        self.writes += 1

    def connectionLost(self, reason):  # noqa: N802
        self.lost.append(reason.type.__name__)


def test_a_descriptor_is_read_in_the_step_after_its_bytes(reactor):
    host = reactor.host()
    own, other = socket.socketpair()
    with own, other:
        descriptor = Descriptor(own.fileno())
        host.addReader(descriptor)
        reactor.advance(0.01)
        assert descriptor.read == b""
        other.send(b"abc")
        reactor.advance(0.002)
        assert descriptor.read == b"abc"
        host.addWriter(descriptor)
        reactor.advance(0.004)
        host.removeWriter(descriptor)
        reactor.advance(0.004)
        assert descriptor.writes == 2
        other.close()
        reactor.advance(0.002)
        assert descriptor.lost == ["ConnectionLost"]
        reactor.advance(0.1)
        assert descriptor.lost == ["ConnectionLost"], "reported once"


def test_a_descriptor_that_raises_is_removed(reactor):
    host = reactor.host()
    own, other = socket.socketpair()
    with own, other:
        descriptor = Descriptor(own.fileno())
        descriptor.doRead = lambda: 1 / 0
        host.addReader(descriptor)
        other.send(b"abc")
        with capturedLogs():
            reactor.advance(0.01)
        assert descriptor.lost == ["ZeroDivisionError"]


def test_a_killed_program_is_never_called_again(reactor):
    host, other, called = reactor.host(), reactor.host(), []
    for each in (host, other):
        each.callLater(0.01, called.append, each)
        each.callFromThread(called.append, each)
    own, theirs = socket.socketpair()
    with own, theirs:
        descriptor = Descriptor(own.fileno())
        host.addReader(descriptor)
        theirs.send(b"x")
        host.cut_off()
        reactor.advance(0.1)
        assert called == [other, other]
        assert descriptor.read == b""
