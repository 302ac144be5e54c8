"""Protected sessions of the ground's devices, on all links of this aircraft."""

from __future__ import annotations

from collections import Counter, OrderedDict
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from twisted.logger import Logger

from up.commands.command_link import Answers, CommandLink
from up.commands.origin import Origin
from up.commands.refusal import Code
from up.commands.roles import Role
from up.log.limits import Limited
from up.protocols.aircraft_sessions import AircraftSessions, Key, Session
from up.protocols.binary_line import HANDSHAKE, to_body, to_line
from up.protocols.envelope import EnvelopeError
from up.protocols.general_message import MalformedMessage, decode
from up.quick_dataclass import dataclass
from up.system.token_bucket import TokenBucket

if TYPE_CHECKING:
    from up.up import Up

REPLIES_HZ, REPLIES_BURST = 20.0, 40
STRANGERS_HZ, STRANGERS_BURST = 1.0, 5
"""Replies to hellos of unknown keys, which anybody can send."""
_LOG_INTERVAL_S = 10.0
SESSION = "session"
"""The name under which the begin, end and refusal of sessions are reported."""
KEY_ROLE = "keys.yml: role"
Send = Callable[[bytes], object]


@dataclass(frozen=True, slots=True)
class _Device:
    """The owner of a session: how it is reached, and its Commands' link."""

    send: Send
    commands: CommandLink


class Protection:
    """Opens sessions, carries out protected Commands with the role of their key, seals the rest.

    ``counters`` counts refused bodies by their code. With ``secrecy`` all sessions are encrypted.
    """

    log = Logger()

    def __init__(
        self,
        up: Up,
        aircraft: str,
        policy: Callable[[Any], str | None],
        *,
        secrecy: bool = False,
    ) -> None:
        reactor = up.context.reactor
        self.sessions = AircraftSessions(
            aircraft, lambda: round(reactor.seconds() * 1000), secrecy=secrecy
        )
        self.counters: Counter[str] = Counter()
        self._up = up
        self._policy = policy
        self._replies = TokenBucket(reactor, REPLIES_HZ, REPLIES_BURST)
        self._strangers = TokenBucket(reactor, STRANGERS_HZ, STRANGERS_BURST)
        self._limited = Limited(reactor, _LOG_INTERVAL_S)
        self._answers: dict[bytes, Answers] = {}

    def stop(self) -> None:
        self._limited.stop()

    def on_keys(self, keys: Mapping[bytes, Key]) -> None:
        """Use these keys from now on, and notify the devices whose sessions end."""
        self._answers = {key_id: self._answers.get(key_id, OrderedDict()) for key_id in keys}
        ended: dict[bytes, tuple[Origin, str]] = {}
        for session, refusal in self.sessions.replace_keys(keys):
            session.owner.send(to_line(refusal[1]))
            ended[session.key.id] = (session.owner.commands.origin, refusal[0].code)
        for each in ended.values():
            self._report(*each)

    def receive(self, line: bytes, link: str, send: Send, refusal: str = "") -> None:
        """Take a binary line of a link; ``send`` sends a line back on it.

        ``refusal`` is why the peer may send no Commands now; hellos are always answered.
        """
        try:
            body = to_body(line)
            if body[0] == HANDSHAKE:
                self._on_hello(body, link, send)
            else:
                self._on_message(body, refusal)
        except EnvelopeError as error:
            self._refused(link, error.code)
        except ValueError:
            self._refused(link, "malformed")

    def frame_lines(self, body: bytes, *, is_required: bool) -> bytes:
        """Return what a link sends of a frame of telemetry: protected, and plain where it may.

        It is empty where protection is required and no session is open.
        """
        self.sessions.end_idle()
        return self._lines(self.sessions.seal_frame, body, is_required)

    def message_lines(self, body: bytes, *, is_required: bool) -> bytes:
        """Return what a link sends of another message to all grounds."""
        return self._lines(self.sessions.seal_message, body, is_required)

    def _lines(self, seal: Callable[[bytes], bytes], body: bytes, is_required: bool) -> bytes:
        sealed = to_line(seal(body)) if len(self.sessions) else b""
        return sealed if is_required else to_line(body) + sealed

    def _on_hello(self, body: bytes, link: str, send: Send) -> None:
        said, reply = self.sessions.answer(body)
        if isinstance(said, Session):
            said.owner = _Device(send, self._open_link(link, said, send))
            origin, code = said.owner.commands.origin, ""
        else:
            origin, code = Origin(link, Role.OBSERVER, key=self.sessions.name_of(said)), said.code
            self.counters[code] += 1
        if not (self._strangers if code == "unknown_key" else self._replies).take():
            return
        send(to_line(reply))
        self._report(origin, code)

    def _open_link(self, link: str, session: Session, send: Send) -> CommandLink:
        key = session.key
        return self._up.open_link(
            link,
            Role(key.role),
            lambda message: send(to_line(session.answers.seal(message.removesuffix(b"\n")))),
            role_key=KEY_ROLE,
            policy=self._policy,
            key=key.name,
            answers=self._answers[key.id],
        )

    def _on_message(self, body: bytes, refusal: str) -> None:
        session, payload = self.sessions.open(body)
        link, receiver = session.owner.commands, self._up.command_receiver
        try:
            message = decode(payload)
        except MalformedMessage as fault:
            receiver.receive_malformed(fault, link)
            return
        if refusal:
            receiver.refuse(link, message, Code.FORBIDDEN, refusal)
        else:
            receiver.receive(message, link)

    def _refused(self, link: str, code: str) -> None:
        self.counters[code] += 1
        self._report(Origin(link, Role.OBSERVER), code)

    def _report(self, origin: Origin, code: str) -> None:
        """Report that a session has begun, or why a body or a session was refused."""
        text = "refused: {code}" if code else "a session begins"
        self._limited.log(
            self.log.warn if code else self.log.info,
            "{link}: protected messages, key {device!r}: " + text,
            key=(origin.link, origin.key, code),
            link=origin.link,
            device=origin.key,
            code=code or "session_opened",
        )
        reason = "the body or its session is refused" if code else ""
        self._up.command_receiver.outcomes.report(origin, SESSION, None, code, reason)
