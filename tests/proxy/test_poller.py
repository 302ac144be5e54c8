"""Waiting for many sockets at once."""

import socket
import time

import pytest
from twisted.logger import globalLogPublisher

from tests.proxy.virtual import Bench
from up_proxy.poller import Poller


@pytest.fixture
def failures():
    found = []

    def observe(event):
        if "log_failure" in event:
            found.append(event["log_failure"])

    globalLogPublisher.addObserver(observe)
    yield found
    globalLogPublisher.removeObserver(observe)


def test_a_bug_costs_one_connection_and_is_logged(failures):
    class Broken:
        def on_lines(self, connection, lines):
            raise ZeroDivisionError

        def on_end(self, connection, reason):
            self.reason = reason

    with Bench() as bench:
        air, _ = bench.hello_air()
        ground, _ = bench.hello_ground()
        victim, _ = bench.hello_ground("b")
        owner = bench.aircraft("b").grounds[0].owner = Broken()
        victim.say("trouble\n")
        victim.expect_closed()
        assert owner.reason == "internal error"
        air.say("going on\n")
        assert ground.line() == "going on\n"
    assert [failure.type for failure in failures] == [ZeroDivisionError]


class NoReactor:
    def addReader(self, reader):  # noqa: N802
        pass

    removeReader = addReader  # noqa: N815


class Deaf:
    """Never reads, so its socket is always ready."""

    def __init__(self):
        self.calls = 0

    def on_ready(self, events):
        self.calls += 1


def test_it_returns_to_the_reactor_under_unending_load():
    poller, deaf = Poller(NoReactor()), Deaf()
    here, there = socket.socketpair()
    with here, there:
        poller.watch(there.fileno(), deaf)
        here.send(b"x")
        begin_s = time.monotonic()
        poller.doRead()
        assert time.monotonic() - begin_s < 10
        assert deaf.calls > 1
        poller.forget(there.fileno())
        poller.forget(there.fileno())
        poller.doRead()
    poller.stop()
