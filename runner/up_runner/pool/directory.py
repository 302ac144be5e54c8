"""A runner's view of the pool: holders of instances, wanted instances, free places."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.key_value import Entry, Watch
from up_cluster.lease import Record, parse_record
from up_cluster.membership import Membership, aircraft_of, parse
from up_cluster.nats_protocol import Message
from up_runner.pool.placement import FRESH_S, RunnerInfo
from up_runner.request import Request, decode_request


class PoolDirectory:
    """Follows the keys of the pool and the heartbeats of its runners.

    `holders` are the runner ids by aircraft, `wanted` and `asleep` the requests. All may be late:
    only a lease decides who runs an instance. While not `is_current` they may lack entries.
    """

    def __init__(self, clock: Any, member: Membership, counts: Counter[str]) -> None:
        self._clock = clock
        self._member = member
        self._counts = counts
        self._watches: list[Watch] = []
        self._current: set[str] = set()
        self.holders: dict[str, str] = {}
        self.wanted: dict[str, Request] = {}
        self.asleep: dict[str, Request] = {}
        self._runners: dict[str, tuple[float, RunnerInfo]] = {}

    @property
    def is_current(self) -> bool:
        return len(self._current) == 3

    def start(self) -> None:
        self._member.client.subscribe(self._member.subject("runners"), self._on_heartbeat)

    def follow(self) -> None:
        """Begin to watch the keys, once the bucket exists."""
        if not self._watches:
            self._watch("instance", self._on_record, self.holders)
            for kind, table in (("wanted", self.wanted), ("asleep", self.asleep)):
                self._watch(kind, partial(self._on_kept, table), table)

    def stop(self) -> None:
        for watch in self._watches:
            watch.stop()

    def beat(self, own: RunnerInfo) -> None:
        data = json.dumps(own.as_json()).encode()
        self._member.client.publish(self._member.subject("runners"), data)

    def others(self) -> list[RunnerInfo]:
        """Return the other runners that have sent a heartbeat within FRESH_S."""
        now_s = self._clock.seconds()
        kept = {i: (at, info) for i, (at, info) in self._runners.items() if now_s - at <= FRESH_S}
        self._runners = kept
        return [info for _, info in kept.values()]

    def woken(self, request: Request) -> Request:
        """Return a request with what a sleeping instance had, unless it names its own."""
        kept = self.asleep.get(request.aircraft)
        if kept is None or request.wants_configuration:
            return request
        labels = request.labels or kept.labels
        return replace(
            request, profile=kept.profile, configuration=kept.configuration, labels=labels
        )

    async def refresh(self, name: str) -> None:
        """Read the holder of an aircraft: the watch may be later than a refusal."""
        try:
            entry = await self._member.bucket.get(self._member.key("instance", name))
        except (UnavailableError, RefusedError):
            return
        if entry is not None:
            self._on_record(entry)

    def _watch(self, kind: str, use: Callable[[Entry], None], table: dict[str, Any]) -> None:
        def set_current(is_current: bool) -> None:
            if is_current:
                self._current.add(kind)
            else:
                self._current.discard(kind)
                table.clear()

        pattern = self._member.key(kind, "*")
        self._watches.append(self._member.bucket.watch(pattern, use, set_current, self._clock))

    def _on_record(self, entry: Entry) -> None:
        record: Record | None = parse_record(entry)
        name = aircraft_of(entry.key)
        self.holders.pop(name, None)
        if record is not None:
            self.holders[name] = record.node

    def _on_kept(self, table: dict[str, Request], entry: Entry) -> None:
        name = aircraft_of(entry.key)
        table.pop(name, None)
        if not entry.is_deleted:
            try:
                table[name] = decode_request(parse(entry.value))
            except ValueError:
                self._counts["malformed"] += 1

    def _on_heartbeat(self, message: Message) -> None:
        try:
            info = RunnerInfo.parse(parse(message.payload))
        except (ValueError, KeyError, TypeError):
            self._counts["malformed"] += 1
        else:
            self._runners[info.id] = self._clock.seconds(), info
