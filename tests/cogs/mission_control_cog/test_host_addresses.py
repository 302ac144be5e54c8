"""Names are looked up beside the reactor."""

import threading

import pytest
from mission_control_cog.host_addresses import HostAddresses, HostNotFoundError
from twisted.internet.defer import Deferred

from tests.support.reactor import reactor, until


class Names:
    """A resolver that answers when it is let."""

    def __init__(self, *answers):
        self.answers = list(answers)
        self.asked = 0
        self.gate = threading.Event()
        self.gate.set()

    def __call__(self, host, port):
        self.asked += 1
        assert self.gate.wait(30)
        answer = self.answers[min(self.asked, len(self.answers)) - 1]
        if isinstance(answer, Exception):
            raise answer
        return answer


@pytest.mark.parametrize("literal", ["127.0.0.1", "::1", "fe80::1%eth0"])
async def test_a_literal_address_needs_no_resolver(literal):
    names = Names([])
    assert await HostAddresses(reactor, literal, 1, names).next() == literal
    assert names.asked == 0


async def test_a_name_stands_for_its_addresses_in_turn():
    addresses = HostAddresses(reactor, "proxy.example", 1, Names(["10.0.0.1", "10.0.0.2"]))
    assert await addresses.next() == "10.0.0.1"
    assert await addresses.next() == "10.0.0.1"
    addresses.failed("10.0.0.1")
    assert await addresses.next() == "10.0.0.2"
    await until(lambda: not addresses._is_looking)


async def test_a_resolver_that_hangs_delays_nothing_once_an_address_is_known():
    names = Names(["10.0.0.1"], ["10.0.0.9"])
    addresses = HostAddresses(reactor, "proxy.example", 1, names)
    await addresses.next()
    names.gate.clear()
    assert await addresses.next() == "10.0.0.1"
    assert await addresses.next() == "10.0.0.1"
    names.gate.set()
    # A proxy that moved is found by the look-up that ran beside.
    await until(lambda: addresses._known == ["10.0.0.9"])
    assert names.asked == 2


async def test_a_failed_look_up_keeps_what_is_known():
    names = Names(["10.0.0.1"], OSError(-3, "Temporary failure in name resolution"))
    addresses = HostAddresses(reactor, "proxy.example", 1, names)
    await addresses.next()
    await addresses.next()
    await until(lambda: addresses._problem)
    assert await addresses.next() == "10.0.0.1"
    await until(lambda: not addresses._is_looking)


async def test_an_unknown_name_is_a_sentence():
    addresses = HostAddresses(reactor, "x.invalid", 1, Names(OSError(-2, "Name not known")))
    with pytest.raises(HostNotFoundError):
        await addresses.next()


async def test_waiting_for_a_first_address_can_be_given_up():
    names = Names(["10.0.0.1"])
    names.gate.clear()
    addresses = HostAddresses(reactor, "proxy.example", 1, names)
    waiting = Deferred.fromCoroutine(addresses.next())
    ended = []
    waiting.addErrback(lambda failure: ended.append(failure.type.__name__))
    waiting.cancel()
    assert ended == ["CancelledError"]
    names.gate.set()
    await until(lambda: not addresses._is_looking)
