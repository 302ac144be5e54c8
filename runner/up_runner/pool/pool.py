"""A runner as a member of a pool: it carries requests out here or lets another runner do it."""

from __future__ import annotations

import secrets
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from twisted.internet.task import deferLater

from up.config.atomic_writer import write_atomically
from up.log import Limited, UpLogger
from up.system.clock import Timer, cancel
from up.system.figures import Figure
from up_cluster.config import ClusterError, read_secret
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.membership import LOG_INTERVAL_S, Membership, run
from up_cluster.object_store import ObjectStore
from up_runner.config import RunnerConfig
from up_runner.instance_host import InstanceHost
from up_runner.instances import Instances
from up_runner.policy import ASLEEP
from up_runner.pool.directory import PoolDirectory
from up_runner.pool.fleet_actions import drain, kick, report
from up_runner.pool.hosted import UNAVAILABLE, HostedInstances, TakenError
from up_runner.pool.orphans import Orphans
from up_runner.pool.placement import HEARTBEAT_S, RunnerInfo, ranking
from up_runner.pool.state_files import Store
from up_runner.request import MalformedRequest, Request, decode_request, encode_request
from up_runner.response import (
    NO_ANSWER,
    Response,
    decode_response,
    encode_response,
    failed,
)

STORE = "up-state"
RENEWALS = 5
SWEEP_S = 0.25
MAX_HOPS, HOP_S = 4, 0.3
"""How often a request follows an instance that moves, and the pause before."""
ANSWER_S = 2.0
"""For the answer of another runner, beyond the time limit of a start."""
ID = ".pool-id"
CLUSTER, DRAINING, INSTANCE_LIMIT = "cluster", "draining", "instance_limit"
QUOTA, ELSEWHERE = "quota", "elsewhere"
_log = UpLogger.get_logger("runner.pool")


class Pool:
    """Decides where a request is carried out. The constructor raises ClusterError, TLSError."""

    def __init__(
        self,
        reactor: Any,
        config: RunnerConfig,
        folder: Path,
        instances: Instances,
        host: InstanceHost,
    ) -> None:
        self._reactor = reactor
        self._config = config
        self._instances = instances
        self._counts: Counter[str] = Counter()
        self._member = Membership(
            reactor,
            config.pool,
            folder,
            program="up-runner",
            member_id=_own_id(host.run_folder.path / ID),
            ttl_s=config.pool.lease_s,
            renewals=RENEWALS,
            replicas=config.pool.replicas,
        )
        self.id = self._member.id
        store = self._new_store(folder)
        self._member.on_ready = self._on_ready
        self._member.on_connected = self._on_connected
        self._directory = PoolDirectory(reactor, self._member, self._counts)
        self.hosted = HostedInstances(
            reactor, config, self._member, store, instances, host, self._counts
        )
        take = partial(self._start_here, is_orphan=True)
        self._orphans = Orphans(self._directory, self.hosted, self._counts, take)
        self._member.actions.update(
            start=partial(self._on_peer, self._start_here),
            request=partial(self._on_peer, self._request_here),
            report=self._on_report,
            drain=self._on_drain,
            kick=partial(kick, instances),
        )
        self._is_draining = False
        self._starting: set[str] = set()
        """Aircraft without a lease yet, which count for the quota."""
        self._is_stopped = False
        self._limited = Limited(reactor, LOG_INTERVAL_S)
        self._sweep_timer: Timer | None = None
        self._beat_timer: Timer | None = None

    def _new_store(self, folder: Path) -> Store:
        pool, makers = self._config.pool, self._member.makers
        if not pool.s3_bucket:
            nats_store = ObjectStore(self._member.client, STORE)
            makers.append(nats_store.create)
            return nats_store
        try:
            from up_cluster.s3_store import S3Store, S3Threads
        except ImportError:
            reason = "s3_bucket needs the Python package boto3: pip install 'raspilot[s3]'"
            raise ClusterError(reason, "no_boto3") from None
        path = folder / pool.s3_credentials
        text = read_secret(path) if pool.s3_credentials else ""
        key, _, secret = text.partition(":")
        if text and not (key and secret):
            raise ClusterError(f"{path} must be KEY:SECRET", "cluster_credentials")
        try:
            store = S3Store(
                S3Threads(self._reactor),
                pool.s3_bucket,
                endpoint=pool.s3_endpoint,
                region=pool.s3_region,
                key=key,
                secret=secret,
            )
        except RefusedError as error:
            raise ClusterError(str(error), "s3_refused") from None
        makers.append(lambda _: store.create(pool.tenant))
        return store

    def start(self) -> None:
        self._directory.start()
        self._member.start()
        self._beat()
        self._sweep()

    async def stop(self) -> None:
        """Give up what has ended, and disconnect; instances that run on keep their leases."""
        self._is_stopped = True
        cancel(self._sweep_timer, self._beat_timer)
        self._limited.stop()
        self._directory.stop()
        await self.hosted.stop()
        await self._member.stop()

    async def handle(self, request: Request) -> Response:
        """Carry a phone's request out on the host of the aircraft, or on a new host for it."""
        name = request.aircraft
        for hop in range(MAX_HOPS):
            if hop:
                await deferLater(self._reactor, HOP_S)
                await self._directory.refresh(name)
            holder = self._directory.holders.get(name)
            if name in self.hosted:
                response = await self._request_here(request)
            elif not self._directory.is_current:
                return failed(name, CLUSTER, "the cluster does not answer")
            elif holder is not None and holder != self.id:
                response = await self._ask_holder(holder, request)
            elif request.action == "status":
                if name in self._directory.asleep:
                    return failed(name, ASLEEP, "the instance sleeps: a request starts it")
                return Response(name)
            else:
                response = await self._place(request)
            if response.error is None or response.error.code != ELSEWHERE:
                break
        return response

    def info(self) -> RunnerInfo:
        is_able = self._directory.is_current and not (self._is_draining or self._is_stopped)
        free = self._instances.free if is_able else 0
        labels = frozenset(self._config.pool.labels)
        return RunnerInfo(self.id, self._config.pool.address, free, labels)

    def unready_code(self) -> str:
        """Return why the pool starts nothing by this runner; empty: it does."""
        if self._is_draining:
            return DRAINING
        return "" if self._member.is_ready and self._directory.is_current else CLUSTER

    def figures(self) -> Iterator[Figure]:
        connected = int(self._member.client.is_connected)
        yield Figure("up_runner_pool_connected", "1 while NATS is connected.", connected)
        others = self._directory.others()
        yield Figure("up_runner_pool_runners", "Other runners heard within 3 s.", len(others))
        free = sum(each.free for each in (self.info(), *others))
        yield Figure("up_runner_pool_free", "Free places of all runners.", free)
        yield Figure("up_runner_pool_leases", "Instances of this runner.", len(self.hosted))
        text = "Wanted instances that no runner has."
        yield Figure("up_runner_pool_orphans", text, len(self._orphans))
        text = "Sleeping instances of the tenant."
        yield Figure("up_runner_pool_asleep", text, len(self._directory.asleep))
        for name, counts in self._shares().items():
            for kind, count in counts.items():
                text = "Usage of the tenant at all runners, and its quota if one is set."
                yield Figure(f"up_runner_pool_tenant_{name}", text, count, {"kind": kind})
        for event in ("taken_over", "lease_lost", "state_not_saved", "malformed", QUOTA):
            text = "Orphans taken over, lost leases, unsaved states, malformed messages, refusals."
            count, labels = self._counts[event], {"event": event}
            yield Figure("up_runner_pool_events", text, count, labels, "counter")

    def _names(self) -> set[str]:
        """Return the aircraft of the tenant whose instances run or are wanted."""
        directory = self._directory
        return {*directory.wanted, *directory.holders, *self.hosted.names(), *self._starting}

    def _shares(self) -> dict[str, dict[str, int]]:
        """Return the tenant's usage at all runners, and the quota if it is set."""
        limit = self._config.pool.quota_instances
        usage = {"instances": len(self._names())}
        return {"usage": usage, "quota": {"instances": limit} if limit else {}}

    def _is_over_quota(self, name: str) -> bool:
        limit = self._config.pool.quota_instances
        names = self._names()
        return name not in names and 0 < limit <= len(names)

    def _ranking(self, request: Request) -> list[str]:
        runners = [self.info(), *self._directory.others()]
        return ranking(request.aircraft, request.labels, runners)

    async def _place(self, request: Request) -> Response:
        """Let the first runner of the ranking that is able start the instance."""
        request = self._directory.woken(request)
        needed = ", ".join(request.labels)
        text = f"no runner{needed and f' with the labels {needed}'} has a free place"
        response = failed(request.aircraft, "no_runner", text)
        for runner in self._ranking(request):
            if runner == self.id:
                response = await self._start_here(request)
            else:
                response = await self._ask(runner, "start", request)
            if response.error is None or response.error.code not in (
                INSTANCE_LIMIT,
                DRAINING,
                NO_ANSWER,
            ):
                break
        return response

    async def _ask_holder(self, holder: str, request: Request) -> Response:
        """Let the runner of an instance answer; one that is silent is not waited for."""
        if all(each.id != holder for each in self._directory.others()):
            text = f"the runner {holder} of this aircraft is silent"
            return failed(request.aircraft, NO_ANSWER, text)
        return await self._ask(holder, "request", request)

    async def _ask(self, runner: str, action: str, request: Request) -> Response:
        limit_s = ANSWER_S
        if request.action != "status":
            limit_s += self._config.start_limit_s
        try:
            message = {"action": action, **encode_request(request)}
            answer = await self._member.ask(runner, message, limit_s)
        except UnavailableError as error:
            text = f"the runner {runner} of this aircraft does not answer ({error.code})"
            return failed(request.aircraft, NO_ANSWER, text)
        return decode_response(request.aircraft, answer)

    async def _request_here(self, request: Request) -> Response:
        """Answer for an instance whose lease is held here."""
        name = request.aircraft
        if request.action == "status":
            return self._named(self._instances.status(name))
        async with self.hosted.lock(name):
            if name in self.hosted:
                return self._named(await self._instances.spawn(request))
        return failed(name, ELSEWHERE, "the instance has ended here")

    async def _start_here(self, request: Request, *, is_orphan: bool = False) -> Response:
        """Start an instance here under a new lease, unless another runner has one."""
        name = request.aircraft
        async with self.hosted.lock(name):
            if name in self.hosted:
                return self._named(await self._instances.spawn(request))
            if self._is_draining or self._is_stopped:
                return failed(name, DRAINING, "this runner drains")
            if not is_orphan and self._is_over_quota(name):
                self._counts[QUOTA] += 1
                return failed(name, QUOTA, "the tenant has used its quota of instances")
            if not self._instances.free:
                return failed(name, INSTANCE_LIMIT, "no free place on this runner")
            self._starting.add(name)
            try:
                hosted = await self.hosted.acquire(request, is_orphan=is_orphan)
            except TakenError:
                return failed(name, ELSEWHERE, "another runner has this aircraft")
            except UNAVAILABLE:
                return failed(name, CLUSTER, "no lease: the cluster does not answer")
            finally:
                self._starting.discard(name)
            try:
                await self.hosted.prepare(hosted)
                response = self._named(await self._instances.spawn(request))
            except UNAVAILABLE as error:
                hosted.is_orphan = True
                response = failed(name, CLUSTER, f"its files cannot be read: {error}")
                text = "{name} is not started: {reason}"
                fields = {"code": "not_started", "name": name, "reason": str(error)}
                self._limited.log(_log.warn, text, key=name, **fields)
            except OSError as error:
                response = failed(name, "cannot_spawn", f"Raspilot cannot be started: {error}")
            except Exception:
                # A bug, which the caller logs: it may not keep the lease.
                self.hosted.end(hosted, "cannot_spawn")
                raise
            hosted.is_orphan &= not response.running
            if response.error is not None and self._instances.get(name) is None:
                self.hosted.end(hosted, response.error.code)
            return response

    def _named(self, response: Response) -> Response:
        return replace(response, host=self._config.pool.address)

    def _sweep(self) -> None:
        self._sweep_timer = self._reactor.callLater(SWEEP_S, self._sweep)
        self.hosted.sweep()
        self._orphans.sweep(self._reactor.seconds(), self.id, self._ranking)

    def _beat(self) -> None:
        cancel(self._beat_timer)
        self._beat_timer = self._reactor.callLater(HEARTBEAT_S, self._beat)
        self._directory.beat(self.info())

    def _on_connected(self, is_connected: bool) -> None:
        if not is_connected and not self._is_stopped:
            text = "NATS is lost: without it the instances end at their deadlines"
            _log.warn(text, code="pool_lost")

    def _on_ready(self) -> None:
        _log.info("the pool is available", code="pool_ready", node=self.id)
        self._directory.follow()
        run(self.hosted.save_old_flights(), "the flights of earlier instances")

    def _on_report(self, message: dict[str, Any]) -> dict[str, Any]:
        found = report(self.info(), self._instances)
        return {**found, "is_draining": self._is_draining, **self._shares()}

    def _on_drain(self, message: dict[str, Any]) -> dict[str, Any]:
        """Start nothing here again, and let the instances move."""
        self._is_draining = True
        self._beat()
        return drain(self._instances)

    async def _on_peer(self, carry_out: Any, message: dict[str, Any]) -> dict[str, Any]:
        try:
            request = decode_request(message)
        except MalformedRequest:
            self._counts["malformed"] += 1
            return {"code": "malformed_request"}
        return encode_response(await carry_out(request))


def _own_id(path: Path) -> str:
    """Return the id of the runner of this run folder, which only one process has at a time."""
    with suppress(OSError):
        if own := path.read_text("ascii").strip():
            return own
    own = secrets.token_hex(6)
    write_atomically(path, f"{own}\n".encode(), 0o600)
    return own
