"""A key-value bucket of JetStream: the last message of each subject of a stream.

https://docs.nats.io/nats-concepts/jetstream/key-value-store; a time to live of each key needs
server 2.11.
"""

import secrets
from collections.abc import Callable
from typing import Any, NamedTuple

from twisted.internet.defer import Deferred

from up.log import UpLogger
from up.system.clock import Clock, Timer, cancel
from up_cluster import nats_protocol as nats
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.jetstream import (
    EXPECTED,
    NANOSECONDS,
    STREAM_NAME_EXISTS,
    api,
    create_stream,
    stored,
    write,
)
from up_cluster.nats_client import NatsClient

MARKER_TTL_S = 60
"""How long the marker of an expired or purged key stays: watchers that were away see it."""
HEARTBEAT_S = 2.0
"""A watch that gets neither entries nor heartbeats for twice as long begins again."""
WATCH_RETRY_S = 1.0
CONSUMER_LIMIT_S = 1.0
"""For the server that NATS chooses to send the entries: for a minute it may choose a dead one."""
_log = UpLogger.get_logger("cluster")


class Entry(NamedTuple):
    """The newest entry of a key; `revision` rises over the whole bucket.

    One that `is_deleted` marks a key that was purged or has expired.
    """

    key: str
    value: bytes
    revision: int
    is_deleted: bool


class KeyValueBucket:
    """One bucket. Keys are words of `A-Z a-z 0-9 - _ =` with dots between them.

    The methods raise UnavailableError without an answer (whether a write was done is unknown
    then), RefusedError for a refusal.
    """

    def __init__(self, client: NatsClient, name: str) -> None:
        self._client = client
        self.name = name
        self._stream = f"KV_{name}"

    async def create(self, replicas: int) -> None:
        """Make the bucket if it does not exist; an existing one keeps its number of replicas."""
        config = {
            "name": self._stream,
            "subjects": [self._subject(">")],
            "num_replicas": replicas,
            "storage": "file",
            "discard": "new",
            "max_msgs_per_subject": 1,
            "allow_rollup_hdrs": True,
            "deny_delete": True,
            "allow_msg_ttl": True,
            "subject_delete_marker_ttl": MARKER_TTL_S * NANOSECONDS,
        }
        if not await create_stream(self._client, config):
            found = await self.check()
            if not found["config"].get("allow_msg_ttl"):
                text = f"{self._stream} exists without a TTL"
                raise RefusedError(STREAM_NAME_EXISTS, text)

    async def check(self) -> dict[str, Any]:
        """Return what describes the bucket, or raise the error of one that does not exist."""
        return await api(self._client, f"STREAM.INFO.{self._stream}", {})

    async def get(self, key: str) -> Entry | None:
        """Return the newest entry that the bucket's leader knows; None for an unknown key.

        A leader that a partition has cut off answers with old values for some seconds.
        """
        found = await stored(self._client, self._stream, {"last_by_subj": self._subject(key)})
        if found is None:
            return None
        return Entry(key, found.data, found.sequence, _is_deleted(found.headers))

    async def put(self, key: str, value: bytes, *, expected: int, ttl_s: int) -> int:
        """Write if the key's revision is `expected`, 0: no entry; return the new revision.

        The entry expires after `ttl_s`, 0: never. Raises WrongRevisionError.
        """
        headers = {EXPECTED: str(expected)}
        if ttl_s:
            headers["Nats-TTL"] = f"{ttl_s}s"
        return await write(self._client, self._subject(key), value, headers)

    async def purge(self, key: str, *, expected: int) -> int:
        """Delete the key if its revision is `expected`. Raises WrongRevisionError."""
        headers = {
            "KV-Operation": "PURGE",
            "Nats-Rollup": "sub",
            EXPECTED: str(expected),
            "Nats-TTL": f"{MARKER_TTL_S}s",
        }
        return await write(self._client, self._subject(key), b"", headers)

    def watch(
        self,
        pattern: str,
        on_entry: Callable[[Entry], object],
        on_current: Callable[[bool], object],
        clock: Clock,
    ) -> "Watch":
        """Call `on_entry` for each present and each later entry of the keys, until `stop`.

        `pattern` may have the wild cards `*` (one word) and a last `>`. `on_current(True)`: all
        present entries were delivered; `on_current(False)`: entries may be missing, and all present
        ones will be delivered again; a key that was deleted long ago is not among them.
        """
        watch = Watch(self, self._client, clock, self._subject(pattern), on_entry, on_current)
        watch.start()
        return watch

    def key_of(self, subject: str) -> str:
        return subject[len(self._subject("")) :]

    async def consume(self, config: dict[str, Any]) -> dict[str, Any]:
        body = {"stream_name": self._stream, "config": config}
        what = f"CONSUMER.CREATE.{self._stream}"
        return await api(self._client, what, body, CONSUMER_LIMIT_S)

    def _subject(self, key: str) -> str:
        return f"$KV.{self.name}.{key}"


class Watch:
    """A watch; it begins again when entries may have been missed."""

    def __init__(
        self,
        bucket: KeyValueBucket,
        client: NatsClient,
        clock: Clock,
        subject: str,
        on_entry: Callable[[Entry], object],
        on_current: Callable[[bool], object],
    ) -> None:
        self._bucket = bucket
        self._client = client
        self._clock = clock
        self._subject = subject
        self._on_entry = on_entry
        self._on_current = on_current
        self._sid: int | None = None
        self._timer: Timer | None = None
        self._sequence = 0
        self._is_current = False

    def start(self) -> None:
        self.stop()
        Deferred.fromCoroutine(self._begin()).addErrback(
            lambda failure: _log.failure("a watch failed on a bug", failure, code="cluster_bug")
        )

    def stop(self) -> None:
        cancel(self._timer)
        if self._sid is not None:
            self._client.unsubscribe(self._sid)
            self._sid = None
        if self._is_current:
            self._is_current = False
            self._on_current(False)

    async def _begin(self) -> None:
        to = f"_INBOX.{secrets.token_hex(8)}"
        self._sequence = 0
        sid = self._sid = self._client.subscribe(to, self._on_message)
        self._timer = self._clock.callLater(2 * HEARTBEAT_S, self.start)
        try:
            made = await self._bucket.consume(
                {
                    "deliver_subject": to,
                    "deliver_policy": "last_per_subject",
                    "filter_subject": self._subject,
                    "ack_policy": "none",
                    "max_deliver": 1,
                    "flow_control": True,
                    "idle_heartbeat": int(HEARTBEAT_S * NANOSECONDS),
                    "mem_storage": True,
                    "num_replicas": 1,
                }
            )
        except (UnavailableError, RefusedError) as error:
            if sid == self._sid:
                cancel(self._timer)
                pause_s = 0.0 if error.code == "timeout" else WATCH_RETRY_S
                self._timer = self._clock.callLater(pause_s, self.start)
            return
        if sid == self._sid and self._sequence == 0 and not made.get("num_pending"):
            self._set_current()

    def _on_message(self, message: nats.Message) -> None:
        status, headers = nats.parse_headers(message.header)
        cancel(self._timer)
        self._timer = self._clock.callLater(2 * HEARTBEAT_S, self.start)
        if status == 100:
            if message.reply:
                self._client.publish(message.reply, b"")
            elif int(headers.get("Nats-Last-Consumer", self._sequence)) != self._sequence:
                self.start()
            return
        revision, sequence, pending = _metadata(message.reply)
        if sequence != self._sequence + 1:
            self.start()
            return
        self._sequence = sequence
        key = self._bucket.key_of(message.subject)
        self._on_entry(Entry(key, message.payload, revision, _is_deleted(headers)))
        if pending == 0:
            self._set_current()

    def _set_current(self) -> None:
        if not self._is_current:
            self._is_current = True
            self._on_current(True)


def _is_deleted(headers: dict[str, str]) -> bool:
    return "Nats-Marker-Reason" in headers or headers.get("KV-Operation") in ("DEL", "PURGE")


def _metadata(reply: str) -> tuple[int, int, int]:
    """Return stream sequence, consumer sequence and pending count of a delivered message."""
    words = reply.split(".")
    first = 5 if len(words) < 11 else 7  # behind a domain and an account
    return int(words[first]), int(words[first + 1]), int(words[first + 3])
