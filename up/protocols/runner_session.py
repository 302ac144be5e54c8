"""A protected request to a runner: JSON lines that carry the bodies of a session in hex."""

import json
import secrets
from collections.abc import Callable, Mapping
from typing import Any

from up.protocols.binary_line import HANDSHAKE
from up.protocols.envelope import EnvelopeError
from up.protocols.ground_session import GroundSession
from up.protocols.handshake import Answer, Refusal
from up.protocols.pairing import Pairing

RUNNER = "runner:"
"""The name of every runner, in the place of an aircraft's; no aircraft can have it."""
PROTECTED = "protected"


def to_line(body: bytes) -> bytes:
    """Return the line that carries a body, the same in both directions."""
    return json.dumps({"action": PROTECTED, "body": body.hex()}).encode("ascii") + b"\n"


def body_of(found: Mapping[str, Any]) -> bytes:
    """Return the body in a parsed line; raises ValueError."""
    digits = found.get("body")
    body = bytes.fromhex(digits) if isinstance(digits, str) else b""
    if not body:
        raise ValueError("body must be a text of hexadecimal digits")
    return body


class RunnerSession:
    """The client's end of one request: a hello, then the request.

    `request` and `result` take the line of the runner's answer before, and raise EnvelopeError with
    its code when it is a refusal or proves nothing.
    """

    def __init__(
        self, pairing: Pairing, random: Callable[[int], bytes] = secrets.token_bytes
    ) -> None:
        key_id, secret = bytes.fromhex(pairing.key_id), bytes.fromhex(pairing.secret)
        self._session = GroundSession(RUNNER, key_id, secret, random)

    def hello(self) -> bytes:
        return to_line(self._session.hello())

    def request(self, answer: bytes, request: bytes) -> bytes:
        """Return the line with a request, JSON without its LF."""
        if not isinstance(self._handshake(_body(answer)), Answer):
            raise EnvelopeError("malformed")
        return to_line(self._session.seal(request))

    def result(self, answer: bytes) -> bytes:
        """Return the runner's answer, JSON without its LF."""
        body = _body(answer)
        opened = None if self._handshake(body) else self._session.open(body)
        if opened is None:
            raise EnvelopeError("malformed")
        return opened

    def _handshake(self, body: bytes) -> Answer | None:
        """Return the answer to the hello; None for another body."""
        if body[0] != HANDSHAKE:
            return None
        said = self._session.on_handshake(body)
        if isinstance(said, Refusal):
            raise EnvelopeError(said.code)
        return said


def _body(line: bytes) -> bytes:
    """Return the body in the runner's answer; raises EnvelopeError with the code of a plain one."""
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        raise EnvelopeError("malformed") from None
    if not isinstance(found, dict):
        raise EnvelopeError("malformed")
    if isinstance(found.get("code"), str):
        raise EnvelopeError(found["code"])
    try:
        return body_of(found)
    except ValueError:
        raise EnvelopeError("unprotected") from None
