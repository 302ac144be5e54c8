"""An object store of NATS: named byte sequences in chunks, with a digest.

The layout of ADR-20 (https://github.com/nats-io/nats-architecture-and-design), which the command
`nats object` and other clients read: stream `OBJ_<bucket>`, chunks at `$O.<bucket>.C.<id>`, what
describes an object at `$O.<bucket>.M.<name in base64>`.
"""

import hashlib
import json
import secrets
from base64 import urlsafe_b64encode
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from twisted.internet.defer import maybeDeferred
from twisted.internet.threads import deferToThread

from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.jetstream import EXPECTED, api, create_stream, stored, write
from up_cluster.nats_client import NatsClient

CHUNK_BYTES = 128 * 1024
ReadChunk = Callable[[int], Any]
"""Returns the next bytes, at most as many as given, or their Deferred; empty at the end."""


class ObjectDamagedError(Exception):
    """A stored object differs from the written one.

    `code` is `chunk_missing`, `digest`, `checksum`, `info`, `content` or `too_large`.

    `revision` is that of the object, for the write that replaces it.
    """

    def __init__(self, name: str, code: str, revision: int | str) -> None:
        super().__init__(f"the stored object {name} is damaged ({code})")
        self.code = code
        self.revision = revision


class ObjectInfo(NamedTuple):
    """Describes an object; `revision` changes with each write of it."""

    name: str
    nuid: str
    size: int
    chunks: int
    digest: str
    revision: int


class ObjectStore:
    """One bucket of objects.

    The methods raise UnavailableError without an answer, RefusedError for a refusal.
    """

    def __init__(self, client: NatsClient, name: str) -> None:
        self._client = client
        self._name = name
        self._stream = f"OBJ_{name}"
        self._abandoned: set[str] = set()
        """Chunks of writes that NATS did not take to their end; not those of an earlier process."""

    async def create(self, replicas: int) -> None:
        config = {
            "name": self._stream,
            "subjects": [f"$O.{self._name}.C.>", f"$O.{self._name}.M.>"],
            "num_replicas": replicas,
            "storage": "file",
            "discard": "new",
            "allow_rollup_hdrs": True,
            "allow_direct": True,
        }
        await create_stream(self._client, config)

    async def info(self, name: str) -> ObjectInfo | None:
        """Return what describes an object; None without it. Raises ObjectDamagedError."""
        found = await stored(self._client, self._stream, {"last_by_subj": self._meta(name)})
        if found is None:
            return None
        try:
            fields = json.loads(found.data)
            if fields.get("deleted"):
                return None
            return ObjectInfo(
                str(fields["name"]), str(fields["nuid"]), int(fields["size"]),
                int(fields["chunks"]), str(fields["digest"]), found.sequence,
            )  # fmt: skip
        except (ValueError, KeyError, TypeError, AttributeError):
            raise ObjectDamagedError(name, "info", found.sequence) from None

    async def put_file(self, name: str, path: Path) -> None:
        """Write an object from a file. Raises OSError, too."""
        with await deferToThread(path.open, "rb") as file:
            await self.put(name, lambda size: deferToThread(file.read, size))

    async def put(self, name: str, read: ReadChunk, expected: int | None = None) -> ObjectInfo:
        """Write an object, and remove the chunks that it replaces.

        With `expected` only if its revision is this one, 0: no object. Raises WrongRevisionError;
        nothing is replaced then.
        """
        for abandoned in list(self._abandoned):
            await self._remove_chunks(abandoned)
        nuid, old, is_whole = secrets.token_hex(11), None, False
        with suppress(ObjectDamagedError):
            old = await self.info(name)
        digest, size, chunks = hashlib.sha256(), 0, 0
        try:
            while data := await maybeDeferred(read, CHUNK_BYTES):
                await write(self._client, self._chunks(nuid), data)
                digest.update(data)
                size, chunks = size + len(data), chunks + 1
            info = ObjectInfo(name, nuid, size, chunks, _text(digest), 0)
            headers = {"Nats-Rollup": "sub"}
            if expected is not None:
                headers[EXPECTED] = str(expected)
            is_whole = True
            revision = await write(self._client, self._meta(name), self._encode(info), headers)
        except UnavailableError:
            # A whole object may have been written.
            if not is_whole:
                self._abandoned.add(nuid)
            raise
        except (RefusedError, OSError):
            await self._remove_chunks(nuid)
            raise
        if old is not None:
            await self._remove_chunks(old.nuid)
        return info._replace(revision=revision)

    async def put_bytes(self, name: str, data: bytes, expected: int | None = None) -> ObjectInfo:
        """Write an object of a few bytes, as `put`."""
        parts = iter([data[at : at + CHUNK_BYTES] for at in range(0, len(data), CHUNK_BYTES)])
        return await self.put(name, lambda _: next(parts, b""), expected)

    async def get_bytes(self, info: ObjectInfo) -> bytes:
        """Return an object whose size is known to be small. Raises ObjectDamagedError."""
        data, sequence = b"", 1
        for _ in range(info.chunks):
            query = {"seq": sequence, "next_by_subj": self._chunks(info.nuid)}
            found = await stored(self._client, self._stream, query)
            if found is None:
                raise ObjectDamagedError(info.name, "chunk_missing", info.revision)
            data, sequence = data + found.data, found.sequence + 1
        if len(data) != info.size or _text(hashlib.sha256(data)) != info.digest:
            raise ObjectDamagedError(info.name, "digest", info.revision)
        return data

    def _encode(self, info: ObjectInfo) -> bytes:
        fields: dict[str, Any] = {
            "name": info.name,
            "bucket": self._name,
            "nuid": info.nuid,
            "size": info.size,
            "chunks": info.chunks,
            "mtime": datetime.now(UTC).isoformat().replace("+00:00", "Z"),
            "digest": info.digest,
            "options": {"max_chunk_size": CHUNK_BYTES},
        }
        return json.dumps(fields).encode()

    async def _remove_chunks(self, nuid: str) -> None:
        """Free the space; chunks that stay are never read."""
        try:
            filter_ = {"filter": self._chunks(nuid)}
            await api(self._client, f"STREAM.PURGE.{self._stream}", filter_)
            self._abandoned.discard(nuid)
        except (UnavailableError, RefusedError):
            pass

    def _chunks(self, nuid: str) -> str:
        return f"$O.{self._name}.C.{nuid}"

    def _meta(self, name: str) -> str:
        return f"$O.{self._name}.M.{urlsafe_b64encode(name.encode()).decode()}"


def _text(digest: Any) -> str:
    """Return a digest as ADR-20 writes it."""
    return f"SHA-256={urlsafe_b64encode(digest.digest()).decode()}"
