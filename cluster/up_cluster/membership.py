"""One program of a cluster: its NATS client, its buckets, its leases, and what `up-fleet` asks."""

import json
import secrets
from collections.abc import Awaitable, Callable, Mapping
from pathlib import Path
from typing import Any

import psutil
from twisted.internet.defer import CancelledError, Deferred
from twisted.python.failure import Failure

from up.log import Limited, UpLogger
from up.system.clock import Timer, cancel
from up.tls.files import TLSFiles
from up_cluster import nats_protocol as nats
from up_cluster.config import FleetConfig
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.key_value import KeyValueBucket
from up_cluster.lease import RENEWALS, TTL_S, LeaseStore
from up_cluster.nats_client import NatsClient

LEASES = "up-leases"
BUCKET_RETRY_S = 1.0
LOG_INTERVAL_S = 60.0
_log = UpLogger.get_logger("cluster")

Action = Callable[[dict[str, Any]], "dict[str, Any] | Awaitable[dict[str, Any]]"]
"""Carries out a request; an answer with `code` reports that it was not."""


def word(name: str) -> str:
    """Return a name as one word of a subject or key."""
    return name.replace(".", "=")


def aircraft_of(key: str) -> str:
    """Return the aircraft of a key that `Membership.key` made."""
    return key.rpartition(".")[2].replace("=", ".")


class Membership:
    """Connects a program, makes the buckets, and passes requests to its actions.

    `actions` are by name; `up-fleet` sends `report` to all members together, and has no
    `replicas`: it makes no buckets. The constructor raises ClusterError, TLSError.
    """

    def __init__(
        self,
        reactor: Any,
        config: FleetConfig,
        folder: Path,
        *,
        program: str,
        client_reactor: Any = None,
        member_id: str = "",
        ttl_s: int = TTL_S,
        renewals: int = RENEWALS,
        replicas: int = 0,
    ) -> None:
        self._reactor = reactor
        self._config = config
        self.id = member_id or secrets.token_hex(6)
        tls = TLSFiles(folder / config.tls) if config.tls else None
        if tls is not None:
            tls.client()
        self.client = NatsClient(
            client_reactor or reactor,
            config.addresses(),
            name=f"{program} {self.id}",
            login=config.login(folder),
            tls=tls,
            on_connected=self._on_connected,
        )
        self.bucket = KeyValueBucket(self.client, LEASES)
        self.leases = LeaseStore(self.bucket, reactor, self.id, ttl_s, renewals)
        self.actions: dict[str, Action] = {}
        self.on_connected: Callable[[bool], object] = lambda _: None
        self._replicas = replicas
        self.makers: list[Callable[[int], Awaitable[None]]] = []
        """Make the buckets, with the number of replicas."""
        if replicas:
            self.makers.append(self.bucket.create)
        self.on_ready: Callable[[], object] = lambda: None
        self.is_ready = False
        """NATS is connected and has the buckets."""
        self._timer: Timer | None = None
        self._limited = Limited(reactor, LOG_INTERVAL_S)

    def start(self) -> None:
        self.client.subscribe(self.subject("members"), self._on_request)
        self.client.subscribe(self.subject(f"member.{self.id}"), self._on_request)
        self.client.start()

    async def stop(self) -> None:
        cancel(self._timer)
        self._limited.stop()
        await self.client.stop()

    def subject(self, rest: str) -> str:
        return f"up.{self._config.tenant}.{rest}"

    def key(self, kind: str, aircraft: str) -> str:
        """Return the key of an aircraft in the bucket of the leases."""
        return f"{kind}.{self._config.tenant}.{word(aircraft)}"

    async def ask(self, member: str, request: Mapping[str, Any], limit_s: float) -> dict[str, Any]:
        """Return the answer of a member. Raises UnavailableError; the request may be done."""
        return await ask(self.client, self.subject(f"member.{member}"), request, limit_s)

    def _on_connected(self, is_connected: bool) -> None:
        cancel(self._timer)
        self.is_ready = False
        self.on_connected(is_connected)
        if is_connected:
            self._make_buckets()

    def _make_buckets(self) -> None:
        run(self._make(), "the buckets")

    async def _make(self) -> None:
        try:
            for make in self.makers:
                await make(self._replicas)
        except (UnavailableError, RefusedError) as error:
            text = "no bucket yet: {reason}"
            self._limited.log(_log.warn, text, code="no_bucket", reason=str(error))
            cancel(self._timer)
            if self.client.is_connected:
                self._timer = self._reactor.callLater(BUCKET_RETRY_S, self._make_buckets)
        else:
            self.is_ready = self.client.is_connected
            self.on_ready()

    def _on_request(self, message: nats.Message) -> None:
        run(self._answer(message), "a request of another member")

    async def _answer(self, message: nats.Message) -> None:
        answer = await self._carry_out(message.payload)
        if message.reply:
            fields = {"id": self.id, **answer}
            self.client.publish(message.reply, json.dumps(fields).encode())

    async def _carry_out(self, payload: bytes) -> dict[str, Any]:
        try:
            request = parse(payload)
            action = self.actions.get(request["action"])
        except (ValueError, KeyError, TypeError):
            return {"code": "malformed_request"}
        if action is None:
            return {"code": "unknown_action"}
        done = action(request)
        return done if isinstance(done, dict) else await done


async def ask(
    client: NatsClient, subject: str, request: Mapping[str, Any], limit_s: float
) -> dict[str, Any]:
    """Return a member's answer. Raises UnavailableError, also for a malformed one."""
    answer = await client.request(subject, json.dumps(request).encode(), limit_s=limit_s)
    try:
        return parse(answer.payload)
    except ValueError:
        raise UnavailableError("malformed") from None


def parse(payload: bytes) -> dict[str, Any]:
    """Return the fields of a member's message. Raises ValueError."""
    try:
        fields = json.loads(payload)
    except RecursionError:
        raise ValueError("nested too deeply") from None
    if not isinstance(fields, dict):
        raise ValueError("no object")
    return fields


def usage_of(process: psutil.Process) -> dict[str, float]:
    """Return what a process has used. Raises psutil.Error."""
    times = process.cpu_times()
    return {"cpu_s": times.user + times.system, "rss_bytes": process.memory_info().rss}


def run(work: Any, what: str) -> "Deferred[Any]":
    """Run a coroutine; an exception that it raises is a bug, which is logged."""

    def on_failure(failure: Failure) -> None:
        if not failure.check(CancelledError):
            _log.failure("{what} failed on a bug", failure, code="cluster_bug", what=what)

    return Deferred.fromCoroutine(work).addErrback(on_failure)
