"""An object store at Amazon S3, or at a service with its API, by boto3.

https://docs.aws.amazon.com/AmazonS3/latest/userguide/conditional-writes.html
"""

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from threading import Thread
from typing import Any, NamedTuple

import boto3
from boto3.exceptions import Boto3Error
from boto3.s3.transfer import TransferConfig
from botocore.config import Config
from botocore.exceptions import (
    BotoCoreError,
    ClientError,
    FlexibleChecksumError,
    HTTPClientError,
    SSLError,
)
from botocore.exceptions import ConnectionError as NoConnectionError
from twisted.internet.defer import Deferred
from twisted.internet.threads import deferToThreadPool
from twisted.python.threadpool import ThreadPool

from up_cluster.errors import RefusedError, UnavailableError, WrongRevisionError
from up_cluster.object_store import ObjectDamagedError

CONNECT_LIMIT_S, READ_LIMIT_S = 2.0, 5.0
ATTEMPTS = 2
MAX_THREADS = 8
UNCONDITIONAL = "unconditional"
"""Code of the refusal of a service that ignores the condition of a write."""
_PROBE = "conditional-write"
_DIGEST = "sha256"
_NO_REVISION = f'"{0:032x}"'
_NOT_FOUND = "404", "NoSuchKey"
_WRONG_REVISION = "412", "PreconditionFailed", "ConditionalRequestConflict"

InThread = Callable[..., Deferred[Any]]
"""Calls a function with arguments in a thread."""


class S3Object(NamedTuple):
    """Describes an object; `revision` is its ETag."""

    name: str
    size: int
    revision: str
    digest: str
    """SHA-256; empty for a file."""


class S3Threads:
    """The threads that wait for S3: few, and nobody waits for them at the end of the program.

    The reactor's own must stay free: it looks up names in them.
    """

    def __init__(self, reactor: Any) -> None:
        self._reactor = reactor
        self._pool = ThreadPool(0, MAX_THREADS, "s3")
        factory: Any = partial(Thread, daemon=True)
        self._pool.threadFactory = factory
        self._pool.start()

    def __call__(self, function: Callable[..., Any], *arguments: Any) -> Deferred[Any]:
        return deferToThreadPool(self._reactor, self._pool, function, *arguments)


class S3Store:
    """One bucket, with the methods of `ObjectStore` that the pool needs.

    They raise UnavailableError without an answer, RefusedError for a refusal, which the constructor
    raises for wrong settings. Each write is repeated once without an answer, so WrongRevisionError
    may mean an own write.
    """

    def __init__(
        self,
        in_thread: InThread,
        bucket: str,
        *,
        endpoint: str = "",
        region: str = "",
        key: str = "",
        secret: str = "",
    ) -> None:
        self._in_thread = in_thread
        self._bucket = bucket
        self._upload = TransferConfig(use_threads=False)
        limits = Config(
            connect_timeout=CONNECT_LIMIT_S,
            read_timeout=READ_LIMIT_S,
            retries={"total_max_attempts": ATTEMPTS, "mode": "standard"},
        )
        with _translated():
            self._client: Any = boto3.client(
                "s3",
                endpoint_url=endpoint or None,
                region_name=region or None,
                aws_access_key_id=key or None,
                aws_secret_access_key=secret or None,
                config=limits,
            )

    async def create(self, prefix: str) -> None:
        """Check the bucket, which must exist, with an object below `prefix`.

        Raises RefusedError with the code UNCONDITIONAL if the service ignores conditions: two hosts
        could then overwrite each other's state.
        """
        name = f"{prefix}/{_PROBE}"
        await self.put_bytes(name, b"")
        for revision in ("", _NO_REVISION):
            try:
                await self.put_bytes(name, b"", revision)
            except WrongRevisionError:
                continue
            raise RefusedError(UNCONDITIONAL, "it ignores the condition of a write", "S3")

    async def info(self, name: str) -> S3Object | None:
        """Return what describes an object; None without it."""
        try:
            found = await self._call("head_object", Key=name)
        except RefusedError as error:
            if error.code not in _NOT_FOUND:
                raise
            # The answer to HEAD has no code: is it the object or the bucket?
            await self._call("head_bucket")
            return None
        digest = found["Metadata"].get(_DIGEST, "")
        return S3Object(name, int(found["ContentLength"]), str(found["ETag"]), digest)

    async def put_bytes(self, name: str, data: bytes, expected: object = None) -> S3Object:
        """Write an object; with `expected` only if its revision is this one, '' or 0: no object.

        Raises WrongRevisionError; nothing is replaced then.
        """
        condition: dict[str, Any] = {}
        if expected is not None:
            condition = {"IfMatch": expected} if expected else {"IfNoneMatch": "*"}
        digest = hashlib.sha256(data).hexdigest()
        try:
            done = await self._call(
                "put_object", Key=name, Body=data, Metadata={_DIGEST: digest}, **condition
            )
        except RefusedError as error:
            if error.code in _WRONG_REVISION or (expected and error.code in _NOT_FOUND):
                raise WrongRevisionError(error.code, name, "S3") from None
            raise
        return S3Object(name, len(data), str(done["ETag"]), digest)

    async def put_file(self, name: str, path: Path) -> None:
        """Write an object from a file, in parts if it is large. Raises OSError, too."""

        def upload() -> None:
            with _translated():
                self._client.upload_file(str(path), self._bucket, name, Config=self._upload)

        await self._in_thread(upload)

    async def get_bytes(self, info: S3Object) -> bytes:
        """Return an object whose size is known to be small. Raises ObjectDamagedError."""

        def read() -> bytes:
            with _translated():
                found = self._client.get_object(
                    Bucket=self._bucket, Key=info.name, IfMatch=info.revision
                )
                try:
                    return bytes(found["Body"].read())
                except FlexibleChecksumError:
                    raise ObjectDamagedError(info.name, "checksum", info.revision) from None

        data: bytes = await self._in_thread(read)
        if info.digest and hashlib.sha256(data).hexdigest() != info.digest:
            raise ObjectDamagedError(info.name, "digest", info.revision)
        return data

    async def _call(self, method: str, **fields: Any) -> dict[str, Any]:
        def call() -> dict[str, Any]:
            with _translated():
                return dict(getattr(self._client, method)(Bucket=self._bucket, **fields))

        answer: dict[str, Any] = await self._in_thread(call)
        return answer


@contextmanager
def _translated() -> Iterator[None]:
    """Raise the errors of a store in place of those of boto3."""
    try:
        yield
    except ClientError as error:
        fields = error.response.get("Error", {})
        code, text = str(fields.get("Code", "")), str(fields.get("Message", ""))
        raise RefusedError(code, text, "S3") from None
    except SSLError as error:
        raise RefusedError("SSLError", str(error), "boto3") from None
    except (HTTPClientError, NoConnectionError) as error:
        raise UnavailableError(type(error).__name__, "S3") from None
    except (BotoCoreError, Boto3Error, ValueError) as error:
        raise RefusedError(type(error).__name__, str(error), "boto3") from None
