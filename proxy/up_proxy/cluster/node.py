"""This proxy as a node of a cluster: its NATS client, its leases, its heartbeat."""

import socket
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import psutil
from twisted.internet.defer import Deferred, DeferredList

from up.log import Limited, UpLogger
from up.protocols.proxy_lines import Side
from up.system.clock import Timer, cancel
from up_cluster.config import ClusterConfig
from up_cluster.lease import Lease
from up_cluster.membership import Membership, usage_of, word
from up_proxy.cluster.handshake import ClusterHandshake
from up_proxy.cluster.node_messages import (
    ENVELOPE,
    Envelope,
    MalformedError,
    encode_usage,
    parse_batch,
    parse_usage,
    unpack,
)
from up_proxy.cluster.poller_reactor import PollerReactor
from up_proxy.cluster.sender_ages import SenderAges
from up_proxy.cluster.session import ClusterSession
from up_proxy.cluster.state_batches import StateBatches
from up_proxy.metrics import Metric, Row, Samples, named, one
from up_proxy.poller import Poller
from up_proxy.registry import AircraftRegistry
from up_proxy.tenant_quota import TenantQuota

MAX_AGE_S = 2.0
"""Older messages of other nodes are dropped."""
HEARTBEAT_S = 1.0
STOP_LIMIT_S = 1.0
"""How long the end waits for NATS to take the released leases."""
_log = UpLogger.get_logger("proxy")


class ClusterNode:
    """What the sessions of this node share. The constructor raises ClusterError, TLSError."""

    def __init__(
        self,
        reactor: Any,
        poller: Poller,
        config: ClusterConfig,
        folder: Path,
        quota: TenantQuota,
    ) -> None:
        self._reactor = reactor
        self._poller = poller
        self.quota = quota
        self._sessions: dict[str, ClusterSession] = {}
        self.batches = StateBatches(reactor, self._send_batch)
        self._member = Membership(
            reactor,
            config,
            folder,
            program="up-proxy",
            client_reactor=PollerReactor(reactor, poller),
            replicas=config.replicas,
        )
        self._member.on_connected = self._on_connected
        self._member.on_ready = self._on_ready
        self.id = self._member.id
        self._id_bytes = self.id.encode("ascii")
        self._member.actions.update(
            report=self._report, drain=self._on_drain_request, kick=self._kick
        )
        self._is_draining = False
        self.on_drain: Callable[[], object] = lambda: None
        self.leases = self._member.leases
        self._client = self._member.client
        self._send_usage = self.sender(self._member.subject("nodes"))
        self._ages = SenderAges()
        self._releases: set[Deferred[None]] = set()
        self._timer: Timer | None = None
        self.refused: Counter[str] = Counter()
        self.stale = 0
        self.fenced = 0
        self._malformed = 0

    @property
    def is_ready(self) -> bool:
        return self._member.is_ready

    def start(self) -> None:
        self.subscribe(self._member.subject("nodes"), self._on_heartbeat)
        self.subscribe(self._batch_subject(self.id), self._take_batch)
        self._member.start()
        self._beat()

    def stop(self) -> "Deferred[None]":
        """Leave every aircraft to the other nodes, and disconnect."""
        cancel(self._timer)
        for session in list(self._sessions.values()):
            session.drain()
        waiting = DeferredList(list(self._releases)).addTimeout(STOP_LIMIT_S, self._reactor)
        done = waiting.addErrback(lambda _: None)
        return done.addCallback(lambda _: Deferred.fromCoroutine(self._member.stop()))

    def drain(self) -> None:
        """Leave every aircraft to the other nodes, and stay connected."""
        self.on_drain()
        _log.info("drains: the ports are closed, aircraft go to other nodes", code="draining")
        for session in list(self._sessions.values()):
            session.drain()

    # What `up-fleet` requests.

    def _homes(self) -> list[ClusterSession]:
        return [each for each in self._sessions.values() if each.is_home]

    def _report(self, message: dict[str, Any]) -> dict[str, Any]:
        sessions = self._sessions.values()
        guests = [each for each in sessions if not each.is_home and each.own_grounds]
        return {
            "kind": "proxy",
            "host": socket.gethostname(),
            "is_draining": self._is_draining,
            "aircraft": [_row(each) for each in self._homes()],
            "guests": [_row(each) for each in guests],
            "usage": self.quota.used()._asdict(),
            "quota": self.quota.limits,
            **usage_of(psutil.Process()),
        }

    def _on_drain_request(self, message: dict[str, Any]) -> dict[str, Any]:
        names = [each.name for each in self._homes()]
        if not self._is_draining:
            self._is_draining = True
            # Not in the callback of a connection that the poller is serving.
            self._reactor.callLater(0, self.drain)
        return {"leaving": names}

    def _kick(self, message: dict[str, Any]) -> dict[str, Any]:
        for each in self._homes():
            if each.name == message.get("aircraft"):
                self._reactor.callLater(0, each.kick)
                return {"stopping": each.name}
        return {"code": "unknown_aircraft"}

    # What the sessions use.

    def new_session(self, name: str, poller: Poller, limited: Limited) -> ClusterSession:
        session = self._sessions[name] = ClusterSession(self, name, poller, limited)
        return session

    def forget(self, session: ClusterSession) -> None:
        self.batches.discard(session)
        if self._sessions.get(session.name) is session:
            del self._sessions[session.name]

    def new_handshake(self, side: Side, registry: AircraftRegistry) -> ClusterHandshake:
        return ClusterHandshake(side, registry, self._poller, self.quota)

    def subject(self, aircraft: str) -> str:
        return self._member.subject(word(aircraft))

    def key(self, aircraft: str) -> str:
        return self._member.key("aircraft", aircraft)

    def sender(self, subject: str) -> Callable[[int, int, bytes], None]:
        """Return what sends messages: it takes the fencing number, the ground and the body."""
        publish, node = self._client.publisher(subject), self._id_bytes
        seconds = self._reactor.seconds

        def send(fence: int, ground: int, body: bytes) -> None:
            publish(ENVELOPE % (node, fence, int(seconds() * 1000), ground, body))

        return send

    def _send_batch(self, node: str, body: bytes) -> None:
        self.sender(self._batch_subject(node))(0, 0, body)

    def _batch_subject(self, node: str) -> str:
        return self._member.subject(f"nodes.{node}")

    def _take_batch(self, message: Envelope) -> None:
        for aircraft, fence, body in parse_batch(message.body):
            self._take_state(aircraft, message._replace(fence=fence, body=body))

    def _take_state(self, aircraft: str, message: Envelope) -> None:
        if (session := self._sessions.get(aircraft)) is not None:
            try:
                session.on_batched(message)
            except MalformedError:  # it costs no other aircraft
                self._malformed += 1

    def subscribe(
        self,
        subject: str,
        on_message: Callable[[Envelope], None],
        newest_s: dict[str, float] | None = None,
    ) -> int:
        """Pass on messages that are not malformed, older than MAX_AGE_S, or overtaken.

        A NATS server that hung delivers what its node has sent since then by another one.
        `newest_s`: the times of the senders' newest messages, if other messages count for it, too.
        """
        newest = {} if newest_s is None else newest_s
        # Not the poller's time: after a pause of this process, old messages are in its batch.
        seconds, is_older = self._reactor.seconds, self._ages.is_older

        def receive(payload: bytes) -> None:
            # The path of every relayed line: avoid every unnecessary call.
            try:
                envelope = unpack(payload)
                node, _, sent_s, _, _ = envelope
                is_overtaken = sent_s < newest.get(node, 0.0)
                if is_overtaken or is_older(MAX_AGE_S, node, sent_s, seconds()):
                    self.stale += 1
                else:
                    newest[node] = sent_s
                    on_message(envelope)
            except MalformedError:
                self._malformed += 1
            except Exception:  # noqa: BLE001 - a bug costs one message, not the connection
                _log.failure("a message failed on a bug", code="cluster_bug")

        return self._client.subscribe_payloads(subject, receive)

    def unsubscribe(self, sid: int) -> None:
        self._client.unsubscribe(sid)

    def release(self, lease: Lease, data: dict[str, Any] | None) -> None:
        """Release a lease; `data` stay readable for the next holder."""
        done = Deferred.fromCoroutine(self.leases.release(lease, data))
        self._releases.add(done)
        done.addBoth(lambda _: self._releases.discard(done))

    def metrics(self) -> Iterator[Metric]:
        refused: Samples = [({"code": code}, count) for code, count in self.refused.items()]
        counters: list[Row] = [
            ("stale", "Messages of other nodes dropped as old or overtaken.", one(self.stale)),
            ("fenced", "Messages of a former home or to another one.", one(self.fenced)),
            ("malformed", "Malformed messages of other nodes.", one(self._malformed)),
            ("dropped", "Messages to NATS that were dropped.", one(self._client.dropped)),
            ("refused", "Changes of control that were not granted, by code.", refused),
        ]
        gauges: list[Row] = [
            ("connected", "1 while NATS is connected.", one(int(self._client.is_connected))),
            ("nodes", "Other nodes heard within two minutes.", one(len(self._ages))),
            ("leases", "Aircraft whose home is this node.", one(len(self.leases))),
            ("draining", "1 after a drain.", one(int(self._is_draining))),
        ]
        return named("up_proxy_cluster", counters, gauges)

    def _on_heartbeat(self, message: Envelope) -> None:
        self._ages.age_s(message.node, message.sent_s, self._reactor.seconds())
        if message.body:
            self.quota.on_heartbeat(message.node, parse_usage(message.body))

    def _beat(self) -> None:
        self._timer = self._reactor.callLater(HEARTBEAT_S, self._beat)
        self._ages.forget(self._reactor.seconds())
        self._send_usage(0, 0, encode_usage(self.quota.own))

    def _on_connected(self, is_connected: bool) -> None:
        if not is_connected:
            _log.warn(
                "NATS is lost: pairs of this node go on, new leases are refused",
                code="cluster_lost",
            )

    def _on_ready(self) -> None:
        _log.info("leases are available", code="cluster_ready", node=self.id)


def _row(session: ClusterSession) -> dict[str, Any]:
    state = "online" if session.air_lease.owner is not None else "offline"
    return {
        "aircraft": session.name,
        "state": state if session.is_home else "guest",
        "grounds": session.own_grounds,
        "rx_bytes": session.air_bytes + session.ground_bytes,
    }
