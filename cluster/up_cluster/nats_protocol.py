"""The client protocol of NATS as bytes: parser and encoders, without any state of a connection.

https://docs.nats.io/reference/reference-protocols/nats-protocol
"""

import json
import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

MAX_LINE_BYTES = 65536
"""A longer control line ends the connection; INFO with many servers is the longest one."""
MAX_MESSAGE_BYTES = 8 * 2**20
"""Headers and payload of a message; the default of a server is 1 MiB."""
PING, PONG = b"PING\r\n", b"PONG\r\n"
PUB = b"PUB %b %d\r\n%b\r\n"
"""A message: its subject (and where to answer), the length of the payload, the payload."""

_SUBJECT = re.compile(r"[!-~]+", re.ASCII)
_STATUS = re.compile(r"NATS/1\.0(?: ([0-9]{3})(?: (.*))?)?", re.ASCII)
_NUMBER = re.compile(rb"[0-9]{1,10}")
_SIZE_DIGITS = len(str(MAX_MESSAGE_BYTES))


class NatsProtocolError(ValueError):
    """The server's bytes are not NATS; `code` is `nats_malformed` or `nats_too_long`."""

    def __init__(self, code: str, reason: str) -> None:
        super().__init__(reason)
        self.code = code


class Message(NamedTuple):
    """MSG or HMSG; `header` has the bytes of all headers, empty for MSG."""

    subject: str
    sid: int
    reply: str
    header: bytes
    payload: bytes


class Info(NamedTuple):
    """INFO: what the server is and requires."""

    fields: dict[str, Any]


class Failed(NamedTuple):
    """-ERR, with the server's text."""

    text: str


class Ping(NamedTuple):
    """PING: to be answered."""


class Pong(NamedTuple):
    """PONG: the answer to PING; all that was sent before it has been processed."""


Event = Message | Info | Failed | Ping | Pong


class NatsParser:
    """Splits a server's bytes into events; keeps at most one incomplete message.

    `payloads`: what takes the payload of a MSG without a reply, by the bytes of its sid. Such a
    message is no event.
    """

    def __init__(
        self,
        on_event: Callable[[Event], object],
        payloads: Mapping[bytes, Callable[[bytes], object]] | None = None,
    ) -> None:
        self._on_event = on_event
        self._payloads = {} if payloads is None else payloads
        self._buffer = b""

    def feed(self, data: bytes) -> None:
        """Pass on the events that `data` completes.

        Raises NatsProtocolError; then it is useless.
        """
        payloads = self._payloads
        buffer = self._buffer + data if self._buffer else data
        at = 0
        try:
            while True:
                if (end := buffer.find(b"\r\n", at)) < 0:
                    break
                line = buffer[at:end]
                if len(line) > MAX_LINE_BYTES:
                    break
                at_payload = end + 2
                if line[:4] == b"MSG ":
                    # The path of every relayed line: avoid every unnecessary call.
                    words = line.split(b" ")
                    if len(words) == 4 and (take := payloads.get(words[2])) is not None:
                        size = words[3]
                        if len(size) <= _SIZE_DIGITS and size.isdigit():
                            stop = at_payload + int(size)
                            if buffer[stop : stop + 2] == b"\r\n":
                                at = stop + 2
                                take(buffer[at_payload:stop])
                                continue
                    words = line.split()
                    sizes = words[-1:]
                elif line[:5] == b"HMSG ":
                    words = line.split()
                    sizes = words[-2:]
                else:
                    at = at_payload
                    if (event := _control(line)) is not None:
                        self._on_event(event)
                    continue
                message, length = _message(words, sizes, buffer, at_payload)
                if message is None:
                    return
                at = at_payload + length
                self._on_event(message)
            if len(buffer) - at > MAX_LINE_BYTES:
                raise NatsProtocolError("nats_too_long", f"a line over {MAX_LINE_BYTES} bytes")
        finally:
            self._buffer = buffer[at:]


def _message(
    words: list[bytes], sizes: list[bytes], buffer: bytes, at: int
) -> tuple[Message | None, int]:
    """Return the message whose payload begins at `at`, None while it is incomplete, and its length.

    `sizes`: that of everything, before it that of the headers.
    """
    if len(words) - len(sizes) not in (3, 4) or not all(map(_NUMBER.fullmatch, sizes)):
        raise _malformed(b" ".join(words))
    total = int(sizes[-1])
    header = int(sizes[0]) if len(sizes) == 2 else 0
    if total > MAX_MESSAGE_BYTES:
        raise NatsProtocolError("nats_too_long", f"a message of {total} bytes")
    if header > total or not _NUMBER.fullmatch(words[2]):
        raise _malformed(b" ".join(words))
    end = at + total
    if len(buffer) < end + 2:
        return None, 0
    if buffer[end : end + 2] != b"\r\n":
        raise _malformed(b"no CRLF behind the payload")
    reply = words[3].decode("ascii", "replace") if len(words) - len(sizes) == 4 else ""
    subject = words[1].decode("utf-8", "replace")
    split = at + header
    return Message(subject, int(words[2]), reply, buffer[at:split], buffer[split:end]), total + 2


def _control(line: bytes) -> Event | None:
    """Return the event of a line without a payload; None for +OK."""
    word = line[:5].upper()
    if word == b"PING":
        return Ping()
    if word == b"PONG":
        return Pong()
    if word == b"INFO ":
        try:
            fields = json.loads(line[5:])
        except (ValueError, RecursionError):
            raise _malformed(line) from None
        if not isinstance(fields, dict):
            raise _malformed(line)
        return Info(fields)
    if word == b"-ERR ":
        return Failed(line[5:].decode("utf-8", "replace").strip("' "))
    if line.upper() == b"+OK":
        return None
    raise _malformed(line)


def _malformed(what: bytes) -> NatsProtocolError:
    return NatsProtocolError("nats_malformed", f"malformed: {what[:60]!r}")


def parse_headers(header: bytes) -> tuple[int, dict[str, str]]:
    """Return the status of a header block, 0 without one, and its values.

    Raises NatsProtocolError. Of a key that occurs twice the first value counts.
    """
    if not header:
        return 0, {}
    first, *lines = header.decode("utf-8", "replace").split("\r\n")
    status = _STATUS.fullmatch(first.rstrip())
    if status is None or lines[-2:] != ["", ""]:
        raise _malformed(header)
    values: dict[str, str] = {}
    for line in lines[:-2]:
        key, colon, value = line.partition(":")
        if not colon:
            raise _malformed(line.encode())
        values.setdefault(key.strip(), value.strip())
    return int(status[1] or 0), values


def connect(options: Mapping[str, object]) -> bytes:
    """Return CONNECT, the first line of a client."""
    return b"CONNECT %s\r\n" % json.dumps(options, separators=(",", ":")).encode()


def subscribe(subject: str, sid: int) -> bytes:
    """Return SUB; `sid` is in each message of it. Raises ValueError for an invalid subject."""
    return b"SUB %b %d\r\n" % (checked(subject), sid)


def unsubscribe(sid: int) -> bytes:
    """Return UNSUB."""
    return f"UNSUB {sid}\r\n".encode("ascii")


def publish(
    subject: str, payload: bytes, reply: str = "", headers: Mapping[str, str] | None = None
) -> bytes:
    """Return PUB, or HPUB if there are headers. Raises ValueError for an invalid subject."""
    to = b" ".join(map(checked, (subject, reply) if reply else (subject,)))
    if not headers:
        return PUB % (to, len(payload), payload)
    lines = "".join(f"{key}: {_line(value)}\r\n" for key, value in headers.items())
    block = f"NATS/1.0\r\n{lines}\r\n".encode()
    sizes = len(block), len(block) + len(payload)
    return b"HPUB %s %d %d\r\n%b%b\r\n" % (to, *sizes, block, payload)


def checked(subject: str) -> bytes:
    """Return a subject as bytes. Raises ValueError."""
    if not _SUBJECT.fullmatch(subject):
        raise ValueError(f"not a subject: {subject[:60]!r}")
    return subject.encode("ascii")


def _line(value: str) -> str:
    if "\r" in value or "\n" in value:
        raise ValueError("a header's value is one line")
    return value
