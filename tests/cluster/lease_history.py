"""Seeded clients that compete for a lease, what they believed, and what may not be true of it."""

import random
from dataclasses import dataclass

from twisted.internet.defer import Deferred, gatherResults

from tests.support.reactor import reactor, sleep, until
from up_cluster.errors import RefusedError, UnavailableError, WrongRevisionError
from up_cluster.key_value import KeyValueBucket
from up_cluster.lease import LeaseLostError, LeaseStore
from up_cluster.nats_client import NatsClient

TTL_S = 2


@dataclass
class Held:
    """A node's belief: it asked at `asked_s`, and held the lease from `from_s` to `until_s`."""

    node: str
    fence: int
    asked_s: float
    from_s: float
    until_s: float


def violations(history):
    """Return what contradicts one holder at a time with rising numbers; all times of one clock."""
    found = []
    for one in history:
        for other in history:
            if one is other:
                continue
            if one.fence == other.fence:
                found.append(("one number twice", one, other))
            if one.from_s < other.asked_s and one.fence >= other.fence:
                found.append(("number not higher", one, other))
            if one.from_s <= other.from_s < one.until_s:
                found.append(("two holders", one, other))
    return found


class BlindBucket(KeyValueBucket):
    """The planted bug: a write without comparing the revision."""

    async def put(self, key, value, *, expected, ttl_s):
        try:
            return await super().put(key, value, expected=expected, ttl_s=ttl_s)
        except WrongRevisionError:
            entry = await self.get(key)
            return await super().put(key, value, expected=entry.revision, ttl_s=ttl_s)


class TakenError(Exception):
    """The key is another node's."""


def free_for(name):
    """Return what decides to take a free key; one of this node is of a write without an answer."""

    def decide(record):
        if record is not None and record.node != name:
            raise TakenError
        return {}

    return decide


async def compete(name, client, make, key, seed, end_s, history, is_enough):
    """Acquire, hold, renew, hang or release at random until `end_s`, or until it is enough."""
    draw = random.Random(f"{name}{seed}")
    leases = LeaseStore(make(client, "up-leases"), reactor, name, TTL_S)
    while (asked_s := reactor.seconds()) < end_s and not is_enough(history):
        try:
            lease = await leases.acquire(key, free_for(name))
        except (TakenError, UnavailableError, RefusedError):
            await sleep(draw.uniform(0.01, 0.2))
            continue
        from_s, fence = reactor.seconds(), lease.fence
        held_s = draw.uniform(0.05, TTL_S * 1.2)
        if hangs := draw.random() < 0.3:
            lease.timer.cancel()
        free_s = min(from_s + held_s, end_s)
        until_s = lease.proven_until_s
        while reactor.seconds() < free_s and lease.fence == fence:
            await sleep(0.02)
            if lease.fence == fence:
                until_s = lease.proven_until_s
            try:
                if not hangs and draw.random() < 0.1:
                    await leases.update(lease, {"draw": draw.random()})
            except (LeaseLostError, UnavailableError, RefusedError):
                break
        history.append(Held(name, fence, asked_s, from_s, min(until_s, reactor.seconds())))
        await leases.release(lease)


async def create_bucket(client):
    """Create the bucket as soon as the servers have a leader."""
    bucket = KeyValueBucket(client, "up-leases")
    while True:
        try:
            await bucket.create(3)
            return bucket
        except (UnavailableError, RefusedError):
            await sleep(0.2)


async def run(
    servers, key, seed, seconds, make=KeyValueBucket, faults=(), is_enough=lambda history: False
):
    """Return the history of three nodes, one at each server; `faults`: (second, what to do)."""
    urls = servers.addresses()
    clients = [NatsClient(reactor, [*urls[n:], *urls[:n]], name=f"n{n}") for n in range(len(urls))]
    for client in clients:
        client.start()
    await until(lambda: all(client.is_connected for client in clients))
    await create_bucket(clients[0])
    history = []
    timers = [reactor.callLater(at_s, what) for at_s, what in faults]
    end_s = reactor.seconds() + seconds
    await gatherResults(
        [
            Deferred.fromCoroutine(
                compete(f"n{n}", client, make, key, seed, end_s, history, is_enough)
            )
            for n, client in enumerate(clients)
        ]
    )
    for timer in timers:
        if timer.active():
            timer.cancel()
    for client in clients:
        await client.stop()
    return history
