"""The instances of this runner: each has a lease, a deadline, and files in the object store."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from typing import Any
from weakref import WeakValueDictionary

from twisted.internet.defer import Deferred, DeferredList, DeferredLock

from up.log import Limited, UpLogger
from up.quick_dataclass import dataclass
from up.system.deadline_watch import VARIABLE, now_s, read_deadline, write_deadline
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.lease import Lease, Record
from up_cluster.membership import LOG_INTERVAL_S, Membership, run, word
from up_runner.config import RunnerConfig
from up_runner.instance import Instance
from up_runner.instance_config import ConfigurationRefused
from up_runner.instance_host import InstanceHost
from up_runner.instances import STOPPING, Instances
from up_runner.policy import ASLEEP
from up_runner.pool.state_files import STATE_HOME, StateFiles, Store
from up_runner.request import Request, encode_request
from up_runner.response import Problem

MARGIN_S = 0.5
"""An instance ends this much before its lease could expire."""
SAVE_S = 1.0
STOP_LIMIT_S = 10.0
ASLEEP_TTL_S = 90 * 24 * 3600
"""A sleeping instance is forgotten then; its files stay in the store."""
DEADLINE = "deadline"
LEASE_LOST = Problem("lease_lost", "its lease has expired or is another host's")
MOVING = Problem("moving", "it moves to another host")
_STAYS_WANTED = frozenset((LEASE_LOST.code, MOVING.code, STOPPING.code))
UNAVAILABLE = (UnavailableError, RefusedError)
FLIGHTS_S = 60.0
"""After which flights that could not be saved are tried again."""
_log = UpLogger.get_logger("runner.pool")


class TakenError(Exception):
    """Another runner holds the lease."""


@dataclass(slots=True, eq=False)
class Hosted:
    """An instance of this runner.

    `wanted` is the revision of its key, 0 before it is written; `written_s` the end of the lease
    that its deadline was computed from. `is_orphan`: it stays wanted if its start fails. `fence`
    is that of the lease: with another number it is another lease, after one that expired.
    """

    request: Request
    lease: Lease
    fence: int
    files: StateFiles
    is_orphan: bool = False
    wanted: int = 0
    written_s: float = 0.0
    saving: DeferredLock = field(default_factory=DeferredLock)


class HostedInstances:
    """Keeps the rule: a process runs only before the deadline of a lease of this runner."""

    def __init__(
        self,
        reactor: Any,
        config: RunnerConfig,
        member: Membership,
        store: Store,
        instances: Instances,
        host: InstanceHost,
        counts: Counter[str],
    ) -> None:
        self._reactor = reactor
        self._config = config
        self._member = member
        self._store = store
        self._instances = instances
        self._host = host
        self._counts = counts
        self._hosted: dict[str, Hosted] = {}
        self._locks: WeakValueDictionary[str, DeferredLock] = WeakValueDictionary()
        self._endings: set[Deferred[Any]] = set()
        self._saved_s = self._flights_s = 0.0
        self._flights = DeferredLock()
        self._limited = Limited(reactor, LOG_INTERVAL_S)
        host.permit = self._permit
        instances.on_end = self._on_end

    def __len__(self) -> int:
        return len(self._hosted)

    def __contains__(self, name: str) -> bool:
        return name in self._hosted

    def names(self) -> set[str]:
        return set(self._hosted)

    def lock(self, name: str) -> DeferredLock:
        """Return what orders the starts and ends of an aircraft's instance."""
        return self._locks.setdefault(name, DeferredLock())

    async def acquire(self, request: Request, *, is_orphan: bool = False) -> Hosted:
        """Acquire the lease. Raises TakenError, UnavailableError, RefusedError."""

        def decide(record: Record | None) -> dict[str, Any]:
            if record is not None and record.node != self._member.id:
                raise TakenError
            return {"host": self._config.pool.address}

        name = request.aircraft
        lease = await self._member.leases.acquire(self._member.key("instance", name), decide)
        return self.add(request, lease, is_orphan=is_orphan)

    def add(self, request: Request, lease: Lease, *, is_orphan: bool = False) -> Hosted:
        """Take an instance on, under a lease that this runner holds."""
        files = self.files(request.aircraft, self._config.persisted_files)
        hosted = Hosted(request, lease, lease.fence, files, is_orphan)
        self._hosted[request.aircraft] = hosted
        return hosted

    def files(self, name: str, learned: tuple[str, ...] = ()) -> StateFiles:
        prefix = f"{self._config.pool.tenant}/{word(name)}"
        return StateFiles(self._store, self._host, name, prefix, learned)

    async def prepare(self, hosted: Hosted) -> None:
        """Do what a start needs. Raises UnavailableError, RefusedError, OSError."""
        await hosted.files.restore()
        await self._want(hosted)
        self._write_deadline(hosted)

    def end(self, hosted: Hosted, code: str) -> None:
        """Give an instance up that has ended; `code` of the reason."""
        done = run(self._finish(hosted, code), "the end of an instance")
        self._endings.add(done)
        done.addBoth(lambda _: self._endings.discard(done))

    async def stop(self) -> None:
        """Wait for what has ended; leave the others their leases."""
        endings = DeferredList(list(self._endings)).addTimeout(STOP_LIMIT_S, self._reactor)
        await endings.addErrback(lambda _: None)
        for hosted in list(self._hosted.values()):
            self._member.leases.leave(hosted.lease)
        self._limited.stop()

    def sweep(self) -> None:
        """Kill instances without a valid lease; write deadlines and changed files."""
        is_save_due = self._reactor.seconds() - self._saved_s >= SAVE_S
        if is_save_due:
            self._saved_s = self._reactor.seconds()
        if self._saved_s - self._flights_s >= FLIGHTS_S and self._member.is_ready:
            self._flights_s = self._saved_s
            run(self.save_old_flights(), "the flights of earlier instances")
        for name in self._instances.states():
            instance, hosted = self._instances.get(name), self._hosted.get(name)
            if instance is None:
                continue
            if self._is_over(name, hosted):
                self._counts["lease_lost"] += 1
                instance.kill(LEASE_LOST)
            elif hosted is not None:
                self._write_deadline(hosted)
                if is_save_due:
                    run(self._save(hosted), "the state of an instance")
            if (hosted is None or not hosted.wanted) and not self.lock(name).locked:
                run(self._adopt(instance), "the lease of an earlier runner")

    async def save_old_flights(self) -> None:
        """Move the flights that this runner or an earlier one could not."""
        if self._flights.locked:
            return
        folders = await self._host.in_thread(
            lambda: list(self._host.folder.glob(f"*/{STATE_HOME}"))
        )
        for name in (each.parent.name for each in folders):
            # One that runs is not hosted before its lease is held, and still writes its flight.
            if name not in self._hosted and self._instances.get(name) is None:
                await self._save_flights(self.files(name))

    async def _save_flights(self, files: StateFiles) -> None:
        async with self._flights:
            await files.save_flights()

    def _permit(self, name: str) -> Mapping[str, str]:
        """Allow the start of a process only before the deadline of its lease."""
        hosted = self._hosted.get(name)
        if hosted is None or self._is_over(name, hosted):
            raise ConfigurationRefused(LEASE_LOST.code, LEASE_LOST.text)
        state = self._host.folder / name / STATE_HOME
        return {VARIABLE: str(self._deadline_path(name)), "XDG_STATE_HOME": str(state)}

    def _is_over(self, name: str, hosted: Hosted | None) -> bool:
        if hosted is None:  # of an earlier runner, whose deadline still counts
            return not now_s() < read_deadline(self._deadline_path(name))
        is_proven = hosted.lease.is_proven(self._reactor.seconds() + MARGIN_S)
        return not is_proven or hosted.lease.fence != hosted.fence

    def _deadline_path(self, name: str) -> Path:
        return self._host.run_folder.instance(name) / DEADLINE

    def _write_deadline(self, hosted: Hosted) -> None:
        """Write the deadline if the lease was renewed; without it the instance ends earlier."""
        until_s, path = hosted.lease.proven_until_s, self._deadline_path(hosted.request.aircraft)
        if until_s == hosted.written_s:
            return
        try:
            path.parent.mkdir(mode=0o700, exist_ok=True)
            write_deadline(path, now_s() + until_s - MARGIN_S - self._reactor.seconds())
            hosted.written_s = until_s
        except OSError as error:
            text = "cannot write {path}, so the instance will end: {reason}"
            _log.error(text, code="deadline_not_written", path=str(path), reason=str(error))

    async def _want(self, hosted: Hosted) -> None:
        """Write that the instance must run somewhere."""
        hosted.wanted = await self._write("wanted", hosted.request)
        key = self._member.key(ASLEEP, hosted.request.aircraft)
        entry = await self._member.bucket.get(key)
        if entry is not None and not entry.is_deleted:
            await self._member.bucket.purge(key, expected=entry.revision)

    async def _write(self, kind: str, request: Request, ttl_s: int = 0) -> int:
        """Write a request under a key of its aircraft; return the revision."""
        key = self._member.key(kind, request.aircraft)
        entry = await self._member.bucket.get(key)
        expected = 0 if entry is None else entry.revision
        value = json.dumps(encode_request(request)).encode()
        return await self._member.bucket.put(key, value, expected=expected, ttl_s=ttl_s)

    async def _adopt(self, instance: Instance) -> None:
        """Hold the lease of an instance that an earlier runner of this host started."""
        async with self.lock(instance.name):
            try:
                hosted = self._hosted.get(instance.name) or await self.acquire(instance.request)
                await hosted.files.follow()
                await self._want(hosted)
            except TakenError:
                instance.kill(LEASE_LOST)
            except UNAVAILABLE:
                pass  # The next sweep tries again, until the deadline ends the instance.

    def _on_end(self, instance: Instance) -> None:
        hosted = self._hosted.get(instance.name)
        if hosted is not None:
            self.end(hosted, instance.last_end.code if instance.last_end is not None else "")

    async def _finish(self, hosted: Hosted, code: str) -> None:
        name = hosted.request.aircraft
        async with self.lock(name):
            # Another request may have started it again; only an ended process frees the lease.
            if self._hosted.get(name) is not hosted or self._instances.get(name) is not None:
                return
            if code != LEASE_LOST.code and hosted.wanted:
                await self._save(hosted, is_last=True)
            if not (code in _STAYS_WANTED or hosted.is_orphan) and hosted.wanted:
                await self._unwant(hosted, is_asleep=code == ASLEEP)
            del self._hosted[name]
            self._deadline_path(name).unlink(missing_ok=True)
            await self._member.leases.release(hosted.lease)
        await self._save_flights(hosted.files)

    async def _unwant(self, hosted: Hosted, *, is_asleep: bool) -> None:
        key = self._member.key("wanted", hosted.request.aircraft)
        try:
            if is_asleep:
                await self._write(ASLEEP, hosted.request, ASLEEP_TTL_S)
            await self._member.bucket.purge(key, expected=hosted.wanted)
        except UNAVAILABLE as error:
            text = "{key} stays: {reason}"
            _log.warn(text, code="still_wanted", key=key, reason=str(error))

    async def _save(self, hosted: Hosted, *, is_last: bool = False) -> None:
        """Save what has changed; the last time after a save that is not done yet."""
        name = hosted.request.aircraft
        if hosted.saving.locked and not is_last:
            return
        async with hosted.saving:
            if self._is_over(name, hosted):
                return
            try:
                await hosted.files.save(lambda: not self._is_over(name, hosted))
            except (*UNAVAILABLE, OSError) as error:
                self._counts["state_not_saved"] += 1
                text = "the files of {name} are not saved: {reason}"
                fields = {"code": "state_not_saved", "name": name, "reason": str(error)}
                self._limited.log(_log.warn, text, key=name, **fields)
