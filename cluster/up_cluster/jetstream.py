"""Requests to JetStream: its API, acknowledged writes, stored messages.

https://docs.nats.io/reference/reference-protocols/nats_api_reference
"""

import json
from base64 import b64decode
from collections.abc import Mapping
from typing import Any, NamedTuple

from up_cluster import nats_protocol as nats
from up_cluster.errors import RefusedError, WrongRevisionError
from up_cluster.nats_client import REQUEST_LIMIT_S, NatsClient

STREAM_NAME_EXISTS = 10058
STREAM_NOT_FOUND, NOT_ENABLED = 10059, (10039, 10076)
"""Without the stream; without JetStream for the account, or at the server."""
NANOSECONDS = 1_000_000_000
EXPECTED = "Nats-Expected-Last-Subject-Sequence"
"""Header of a write: the sequence of the subject's last message, 0: none."""
_WRONG_LAST_SEQUENCE = 10071
_NO_MESSAGE = 10037


class Stored(NamedTuple):
    """A message of a stream."""

    subject: str
    sequence: int
    headers: dict[str, str]
    data: bytes


async def api(
    client: NatsClient, what: str, body: Mapping[str, Any], limit_s: float = REQUEST_LIMIT_S
) -> dict[str, Any]:
    """Return the answer of the API. Raises UnavailableError, RefusedError."""
    answer = await client.request(f"$JS.API.{what}", json.dumps(body).encode(), limit_s=limit_s)
    return _checked(answer.payload)


async def create_stream(client: NatsClient, config: Mapping[str, Any]) -> bool:
    """Make a stream; False: one of this name exists, which is unchanged. Raises as `api`."""
    try:
        await api(client, f"STREAM.CREATE.{config['name']}", config)
    except RefusedError as error:
        if error.code != STREAM_NAME_EXISTS:
            raise
        return False
    return True


async def write(
    client: NatsClient, subject: str, payload: bytes, headers: Mapping[str, str] | None = None
) -> int:
    """Write a message and return its sequence.

    Raises WrongRevisionError, RefusedError, UnavailableError: whether it was written is
    unknown then.
    """
    answer = await client.request(subject, payload, headers=headers)
    return int(_checked(answer.payload)["seq"])


async def stored(client: NatsClient, stream: str, query: Mapping[str, Any]) -> Stored | None:
    """Return the message that a query selects, `last_by_subj` or `seq` with `next_by_subj`.

    None without such a message. A leader that a partition has cut off answers with old ones for
    some seconds. Raises UnavailableError, RefusedError.
    """
    try:
        found = await api(client, f"STREAM.MSG.GET.{stream}", query)
    except RefusedError as error:
        if error.code == _NO_MESSAGE:
            return None
        raise
    message = found["message"]
    _, headers = nats.parse_headers(b64decode(message.get("hdrs", "")))
    data = b64decode(message.get("data", ""))
    return Stored(str(message["subject"]), int(message["seq"]), headers, data)


def _checked(payload: bytes) -> dict[str, Any]:
    """Return JetStream's answer. Raises RefusedError."""
    try:
        answer = json.loads(payload)
    except ValueError:
        raise RefusedError(0, f"not JSON: {payload[:60]!r}") from None
    error = answer.get("error")
    if error:
        code, text = int(error.get("err_code", 0)), str(error.get("description", ""))
        raise (WrongRevisionError if code == _WRONG_LAST_SEQUENCE else RefusedError)(code, text)
    return dict(answer)
