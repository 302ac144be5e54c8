"""Waiting for many sockets in one call."""

import itertools
import socket

import pytest
from twisted.internet.testing import MemoryReactorClock
from twisted.logger import globalLogPublisher

from tests.proxy.virtual import Bench
from up_proxy.poller import BUSY_POLL_S, Poller


@pytest.fixture
def failures():
    found = []

    def observe(event):
        if "log_failure" in event:
            found.append(event["log_failure"])

    globalLogPublisher.addObserver(observe)
    yield found
    globalLogPublisher.removeObserver(observe)


def test_a_bug_ends_one_connection_and_is_logged(failures):
    class Broken:
        def on_lines(self, connection, lines):
            raise ZeroDivisionError

        def on_end(self, connection, reason):
            self.reason = reason

    with Bench() as bench:
        air, _ = bench.hello_air()
        ground, _ = bench.hello_ground()
        victim, _ = bench.hello_ground("b")
        owner = bench.aircraft("b").grounds.connections[0].owner = Broken()
        victim.say("trouble\n")
        victim.expect_closed()
        assert owner.reason == "internal error"
        air.say("continues\n")
        assert ground.line() == "continues\n"
    assert [failure.type for failure in failures] == [ZeroDivisionError]


class NoReactor:
    def addReader(self, reader):  # noqa: N802
        pass

    removeReader = addReader  # noqa: N815


class Deaf:
    """Does not read, so its socket is always ready; at last it does, so that the test ends."""

    def __init__(self, own):
        self.own = own
        self.calls = 0

    def on_ready(self, events):
        self.calls += 1
        if self.calls == 1000:
            self.own.recv(1)


def test_it_returns_to_the_reactor_under_unending_load():
    """A millisecond passes whenever it looks at the clock."""
    milliseconds = itertools.count()
    poller = Poller(NoReactor(), lambda: next(milliseconds) / 1000)
    here, there = socket.socketpair()
    with here, there:
        deaf = Deaf(there)
        poller.watch(there.fileno(), deaf)
        here.send(b"x")
        poller.doRead()
        assert 1 < deaf.calls < 2 * BUSY_POLL_S * 1000
        poller.discard(there.fileno())
        poller.discard(there.fileno())
        poller.doRead()
    poller.stop()


def test_a_step_outside_any_event_is_taken_too():
    clock, taken = MemoryReactorClock(), []
    poller = Poller(clock, clock.seconds)
    poller.busy_poll_s = 0.0
    poller.do_later(lambda: taken.append(1))
    poller.do_later(lambda: taken.append(2))
    assert taken == []
    while clock.getDelayedCalls():
        clock.advance(0)
    poller.stop()
    assert taken == [1, 2]
