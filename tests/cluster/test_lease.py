"""Leases on three real NATS servers: one holder at a time, whatever happens to the servers."""

import random

import pytest
from twisted.internet.defer import Deferred
from twisted.internet.task import Clock

from tests.cluster.connected import connected
from tests.cluster.lease_history import BlindBucket, Held, create_bucket, run, violations
from tests.support.nats_servers import NatsServers
from tests.support.reactor import reactor, run_in_reactor, sleep, until
from up_cluster.errors import UnavailableError, WrongRevisionError
from up_cluster.key_value import KeyValueBucket
from up_cluster.lease import LeaseLostError, LeaseState, LeaseStore

SEED = 18


@pytest.fixture(scope="module")
def servers(tmp_path_factory):
    with NatsServers(tmp_path_factory.mktemp("nats")) as running:
        yield running


def test_the_checker_finds_a_write_that_does_not_compare(servers):
    def is_found(history):
        return "two holders" in {what for what, *_ in violations(history)}

    history = run_in_reactor(run, servers, "blind", SEED, 45.0, BlindBucket, (), is_found)
    assert is_found(history)


@pytest.mark.parametrize(
    ("second", "what"),
    [
        (Held("b", 2, 0.5, 1.5, 3.0), "two holders"),
        (Held("b", 1, 2.5, 3.0, 4.0), "one number twice"),
        (Held("b", 0, 2.5, 3.0, 4.0), "number not higher"),
    ],
)
def test_the_checker(second, what):
    first = Held("a", 1, 0.0, 1.0, 2.0)
    assert what in {each[0] for each in violations([first, second])}
    assert violations([first, Held("b", 2, 1.5, 2.0, 3.0)]) == []


async def test_the_life_of_a_lease(servers):
    client = await connected(servers)
    bucket = await create_bucket(client)
    seen, current = [], []
    watch = bucket.watch("life.*", seen.append, current.append, reactor)
    await until(lambda: current == [True])
    a, b = (LeaseStore(bucket, reactor, node, ttl_s=2) for node in "ab")
    first = await a.acquire("life.x", lambda record: {"of": "a"})
    assert first.fence == first.revision and first.is_proven(reactor.seconds())

    changes = []
    first.on_change = lambda lease: changes.append(lease.state)
    second = await b.acquire("life.x", lambda record: record and {"from": record.data["of"]})
    assert second.data == {"from": "a"} and second.fence > first.fence
    with pytest.raises(LeaseLostError):
        await a.update(first, {})
    assert changes == [LeaseState.LOST]

    await b.update(second, {"of": "b"})
    assert second.revision > second.fence
    await until(lambda: second.revision > second.fence + 1, what="a renewal")
    # A holder that hangs: the entry expires, and the holder gets a new number.
    second.timer.cancel()
    old, second.on_change = second.fence, lambda lease: changes.append(lease.fence)
    await until(lambda: seen and seen[-1].is_deleted, what="the expiry at the watch")
    assert not second.is_proven(reactor.seconds())
    await b.update(second, second.data)
    assert second.fence > old and changes[-1] == second.fence
    assert second.is_proven(reactor.seconds())

    await b.release(second, {"left": True})
    third = await a.acquire("life.x", lambda record: record and record.data)
    assert third.data == {"left": True}
    await a.release(third)
    entry = await bucket.get("life.x")
    assert entry.is_deleted
    with pytest.raises(WrongRevisionError):
        await bucket.put("life.x", b"", expected=entry.revision - 1, ttl_s=0)
    assert [each.revision for each in seen] == sorted(each.revision for each in seen)
    watch.stop()
    await sleep(0)
    await client.stop()


def test_one_holder_while_servers_hang_and_die(servers):
    draw = random.Random(SEED)
    victim, other = draw.sample(range(3), 2)
    faults = [
        (1.0, lambda: servers.pause(victim)),
        (4.0, lambda: servers.resume(victim)),
        (6.0, lambda: servers.kill(other)),
        (6.5, lambda: servers.start(other)),
    ]
    end_s = reactor.seconds() + 10.0

    def is_over(history):
        return reactor.seconds() > end_s and len(history) >= 3

    history = run_in_reactor(run, servers, "faults", SEED, 45.0, KeyValueBucket, faults, is_over)
    assert len(history) >= 3
    assert violations(history) == []


class SlowBucket:
    """Answers when the test does: whatever the servers do while an answer is due."""

    def __init__(self):
        self.answers = []

    def put(self, key, value, *, expected, ttl_s):
        self.answers.append(Deferred())
        return self.answers[-1]

    async def purge(self, key, *, expected):
        raise UnavailableError("timeout")


def test_a_lease_that_is_released_during_a_failed_renewal_stays_lost():
    clock, bucket = Clock(), SlowBucket()
    store = LeaseStore(bucket, clock, "a", ttl_s=15)
    acquired = Deferred.fromCoroutine(store.acquire("x", lambda _: {}))
    bucket.answers[0].callback(7)
    lease = acquired.result
    clock.advance(5)
    released = Deferred.fromCoroutine(store.release(lease))
    clock.advance(15)
    bucket.answers[1].errback(UnavailableError("timeout"))
    assert released.called and lease.state is LeaseState.LOST
    assert clock.getDelayedCalls() == []
