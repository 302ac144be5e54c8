"""Commands that are repeated until the aircraft answers each of them."""

import secrets
from collections.abc import Callable
from typing import Any

from up.commands.command import BaseCommand
from up.commands.refusal import Code
from up.protocols.general_message import GeneralMessage
from up.quick_dataclass import dataclass
from up.sanitize_text import sanitize_text
from up.system.clock import Clock, Timer, cancel

TRIES = 5
RETRY_S, RETRY_FACTOR = 2.0, 1.5
"""The first answer is awaited for this long, each further one longer: 26 s with all tries."""
NO_ANSWER = "no_answer"
_LATE = frozenset({Code.STALE.value, Code.UNKNOWN_BEACON.value})


@dataclass(frozen=True, slots=True)
class Reply:
    """The answer to a Command; ``code`` is empty if it was carried out."""

    code: str = ""
    reason: str = ""
    detail: str = ""


Notify = Callable[[Reply], object]
SendCommand = Callable[[BaseCommand, str], object]
"""Sends a Command with an id, and with the newest beacon if it needs one."""


@dataclass(slots=True)
class _Request:
    command: BaseCommand
    notify: Notify
    tries: int = 0
    timer: Timer | None = None


class ReliableRequests:
    """Works on a link that loses, repeats and reorders messages.

    A repeated Command keeps its id, so the aircraft carries it out once and repeats its answer; one
    that arrived with an old beacon gets a new id.
    """

    def __init__(self, clock: Clock, send: SendCommand, tries: int = TRIES) -> None:
        self._clock = clock
        self._send = send
        self._tries = tries
        self._waiting: dict[str, _Request] = {}

    def __len__(self) -> int:
        return len(self._waiting)

    def ask(self, command: BaseCommand, notify: Notify) -> None:
        """Send a Command; ``notify`` gets its reply, or NO_ANSWER after the last try."""
        self._try(secrets.token_hex(8), _Request(command, notify))

    def on_message(self, message: GeneralMessage) -> None:
        id_ = message.data.get("id")
        if message.name not in ("up.ack", "up.nack") or not isinstance(id_, str):
            return
        request = self._waiting.pop(id_, None)
        if request is None:
            return
        cancel(request.timer)
        if message.name == "up.ack":
            request.notify(Reply())
            return
        data = message.data
        code, detail = (sanitize_text(data.get(key) or "", 32) for key in ("code", "detail"))
        if code in _LATE and request.tries < self._tries:
            self._try(secrets.token_hex(8), request)
            return
        reason = sanitize_text(data.get("reason") or "no reason given", 500)
        request.notify(Reply(code or Code.REFUSED.value, reason, detail))

    def stop(self) -> None:
        cancel(*(each.timer for each in self._waiting.values()))
        self._waiting.clear()

    def _try(self, id_: str, request: _Request) -> None:
        self._waiting[id_] = request
        delay_s = RETRY_S * RETRY_FACTOR**request.tries
        request.tries += 1
        request.timer = self._clock.callLater(delay_s, self._on_silence, id_)
        self._send(request.command, id_)

    def _on_silence(self, id_: str) -> None:
        request: Any = self._waiting.pop(id_)
        if request.tries < self._tries:
            self._try(id_, request)
        else:
            text = f"no answer to {request.command.NAME}, sent {request.tries} times"
            request.notify(Reply(NO_ANSWER, text))
