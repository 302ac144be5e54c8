"""Leases: at most one node holds a key, each holder has a higher fencing number than all before.

`LeaseStore.acquire` calls `decide` with the present record; it returns the new data, or raises an
exception of its own to leave the key to its holder. The first call is with None, as if the key were
free, and there are more if others write at the same time: it must have no effects. The store renews
a lease until it is released. Act for a lease only while `lease.is_proven(now_s)`: the proof is a
write that the majority of the NATS servers took less than `ttl_s` ago. A reader's copy proves
nothing.
"""

import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import field
from enum import Enum
from typing import Any, NamedTuple
from zlib import crc32

from twisted.internet.defer import Deferred, DeferredLock

from up.log import UpLogger
from up.quick_dataclass import dataclass
from up.system.clock import Clock, Timer, cancel
from up_cluster.errors import RefusedError, UnavailableError, WrongRevisionError
from up_cluster.key_value import Entry, KeyValueBucket

TTL_S = 15
"""Longer than an election of the bucket's leader, 5 to 7 s."""
RENEWALS = 3
"""Renewals in a time to live."""
RETRY_S = 0.5
MAX_TRIES = 4
"""Attempts of one acquisition: each needs a fresh revision."""
_log = UpLogger.get_logger("cluster")


class LeaseState(Enum):
    """What a holder knows of its lease."""

    HELD = "held"
    UNPROVEN = "unproven"
    """No write succeeded within the time to live: another node may hold it by now."""
    LOST = "lost"
    """Another node holds it, or it was released."""


class LeaseLostError(Exception):
    """The lease is another node's."""


class Record(NamedTuple):
    """What a key's entry states: its holder, its fencing number, the holder's data."""

    node: str
    fence: int
    data: dict[str, Any]


@dataclass(slots=True, eq=False)
class Lease:
    """A lease of this node. `fence` rises when it expired and was acquired again."""

    key: str
    data: dict[str, Any]
    fence: int
    revision: int
    proven_until_s: float
    on_change: Callable[["Lease"], object]
    state: LeaseState = LeaseState.HELD
    lock: DeferredLock = field(default_factory=DeferredLock)
    timer: Timer | None = None

    @property
    def is_lost(self) -> bool:
        return self.state is LeaseState.LOST

    def is_proven(self, now_s: float) -> bool:
        """Return whether no other node can hold it now; monotonic time."""
        return self.state is LeaseState.HELD and now_s < self.proven_until_s


def phase_of(name: str) -> float:
    """Return a number from 0 to 1 for a name: what all do in one period is spread over it."""
    return crc32(name.encode()) / 2**32


class LeaseStore:
    """The leases of one node, whose id no other process ever has.

    Raises UnavailableError when the majority of the servers does not answer in time. Whether
    the write was done is unknown then; if it was, the entry expires, or this node takes it over.
    """

    def __init__(
        self,
        bucket: KeyValueBucket,
        clock: Clock,
        node: str,
        ttl_s: int = TTL_S,
        renewals: int = RENEWALS,
    ) -> None:
        self._bucket = bucket
        self._clock = clock
        self._node = node
        self._ttl_s = ttl_s
        self._pause_s = ttl_s / renewals
        self._held: dict[str, Lease] = {}

    def __len__(self) -> int:
        return len(self._held)

    async def acquire(
        self,
        key: str,
        decide: Callable[[Record | None], dict[str, Any]],
        on_change: Callable[[Lease], object] = lambda _: None,
    ) -> Lease:
        """Acquire a key; see the module. `on_change` is called when the state or fence changes.

        A record with this node's id but without its lease comes from a write that got no answer:
        the key is free.
        """
        expected, record = 0, None
        for _ in range(MAX_TRIES):
            data = decide(record)
            began_s = self._clock.seconds()
            try:
                revision = await self._put(key, data, 0, expected)
            except WrongRevisionError:
                entry = await self._bucket.get(key)
                expected = 0 if entry is None else entry.revision
                record = None if entry is None else parse_record(entry)
                continue
            lease = Lease(key, data, revision, revision, began_s + self._ttl_s, on_change)
            stale = self._held.get(key)
            self._held[key] = lease
            if stale is not None:
                self._set_state(stale, LeaseState.LOST)
            # Of many keys that were acquired together not all are renewed at the same time.
            self._schedule(lease, self._pause_s * (1.0 - 0.8 * phase_of(key)))
            return lease
        raise UnavailableError("contended")

    async def read(self, key: str) -> Record | None:
        """Return a key's record, which may be old; None without one."""
        entry = await self._bucket.get(key)
        return None if entry is None else parse_record(entry)

    async def update(self, lease: Lease, data: dict[str, Any]) -> None:
        """Replace the data of a held lease, and renew it.

        Raises LeaseLostError if it is another node's.
        """
        async with lease.lock:
            await self._renew(lease, data)

    async def release(self, lease: Lease, data: dict[str, Any] | None = None) -> None:
        """Give a lease up; without an answer from NATS it expires.

        With `data` the record stays until it expires: the next holder reads them.
        """
        async with lease.lock:
            if lease.is_lost:
                return
            self._set_state(lease, LeaseState.LOST)
            with suppress(UnavailableError, RefusedError):
                if data is None:
                    await self._bucket.purge(lease.key, expected=lease.revision)
                else:
                    await self._put(lease.key, data, lease.fence, lease.revision)

    def leave(self, lease: Lease) -> None:
        """Renew a lease no longer, and keep its entry until it expires."""
        self._set_state(lease, LeaseState.LOST)

    async def _renew(self, lease: Lease, data: dict[str, Any]) -> None:
        if lease.is_lost:
            raise LeaseLostError(lease.key)
        for _ in range(MAX_TRIES):
            began_s = self._clock.seconds()
            try:
                lease.revision = await self._put(lease.key, data, lease.fence, lease.revision)
            except WrongRevisionError:
                entry = await self._bucket.get(lease.key)
                record = None if entry is None else parse_record(entry)
                if entry is None or entry.is_deleted:
                    # It expired. The next holder, this node, gets a new number.
                    lease.fence, lease.revision = 0, 0 if entry is None else entry.revision
                elif record is not None and record.node != self._node:
                    self._set_state(lease, LeaseState.LOST)
                    raise LeaseLostError(lease.key) from None
                else:
                    lease.revision = entry.revision  # an earlier write without an answer
                continue
            is_new = lease.fence == 0
            if is_new:
                lease.fence = lease.revision
            lease.data, lease.proven_until_s = data, began_s + self._ttl_s
            self._set_state(lease, LeaseState.HELD, is_news=is_new)
            return
        raise UnavailableError("contended")

    async def _renew_in_time(self, lease: Lease) -> None:
        pause_s = self._pause_s
        try:
            await self.update(lease, lease.data)
        except LeaseLostError:
            return
        except (UnavailableError, RefusedError):
            pause_s = RETRY_S
            if self._clock.seconds() >= lease.proven_until_s:
                self._set_state(lease, LeaseState.UNPROVEN)
        self._schedule(lease, pause_s)

    def _schedule(self, lease: Lease, pause_s: float) -> None:
        if not lease.is_lost:
            lease.timer = self._clock.callLater(pause_s, self._on_due, lease)

    def _on_due(self, lease: Lease) -> None:
        Deferred.fromCoroutine(self._renew_in_time(lease)).addErrback(
            lambda failure: _log.failure("a lease failed on a bug", failure, code="cluster_bug")
        )

    def _set_state(self, lease: Lease, state: LeaseState, *, is_news: bool = False) -> None:
        if lease.is_lost:
            return  # released, or another node's, while an answer was awaited
        if state is LeaseState.LOST:
            cancel(lease.timer)
            if self._held.get(lease.key) is lease:
                del self._held[lease.key]
        if state is not lease.state or is_news:
            lease.state = state
            lease.on_change(lease)

    async def _put(self, key: str, data: dict[str, Any], fence: int, expected: int) -> int:
        value = json.dumps({"node": self._node, "fence": fence, "data": data})
        return await self._bucket.put(key, value.encode(), expected=expected, ttl_s=self._ttl_s)


def parse_record(entry: Entry) -> Record | None:
    """Return what an entry states; None if it is deleted or malformed: then anyone may have it."""
    if entry.is_deleted:
        return None
    try:
        fields = json.loads(entry.value)
        fence = int(fields["fence"]) or entry.revision
        return Record(str(fields["node"]), fence, dict(fields["data"]))
    except (ValueError, KeyError, TypeError):
        return None
