"""``up-ground send``: one Command to the aircraft, and its answer."""

from __future__ import annotations

import json
import secrets
from collections.abc import Container, Iterable
from typing import Any, NoReturn

from up.cli.cli_error import UsageError
from up.cli.option_parser import EXIT_FAILED, EXIT_OK
from up.protocols.general_message import GeneralMessage, encode
from up.sanitize_text import sanitize_text
from up_ground.catalogue import requested_content
from up_ground.command_task import CommandTask
from up_ground.one_shot_task import EXIT_NO_ANSWER
from up_ground.settings import Settings
from up_ground.telemetry import NAME as TELEMETRY
from up_ground.token_store import TokenStore

ANSWER_LIMIT_S = 3.0
CONTENT_LIMIT_S = 2.0
_QUIET = (TELEMETRY, "up.system.state")


class Send(CommandTask):
    """Waits for control and for one telemetry frame, sends, waits for the answer.

    Nothing is sent twice, and nothing without the beacon of a frame; an aircraft whose frames have
    no beacon, such as the thesis's, gets only Commands that need none (``needs_beacon``).
    """

    def __init__(
        self,
        reactor: Any,
        settings: Settings,
        tokens: TokenStore,
        name: str,
        data: dict[str, Any],
        *,
        needs_beacon: bool,
    ) -> None:
        super().__init__(reactor, settings, tokens)
        self._needs_beacon = needs_beacon
        self._use(name, data)

    def _use(self, name: str, data: dict[str, Any]) -> None:
        self.what = self._name = name
        self._data = data
        self._id = secrets.token_hex(8)
        self._sent_s: float | None = None
        self._awaited = requested_content(name, data)
        self._is_acked = False

    def on_ready(self) -> None:
        if self._needs_beacon and self.telemetry.beacon is None:
            text = f"{self._name} needs a beacon, and this aircraft's telemetry has none"
            self.fail(text, "no_beacon", EXIT_FAILED)
            return
        self.link.send(encode(self._name, self._data, self._id, self.telemetry.beacon))
        self._sent_s = self._reactor.seconds()
        self.after(self._reactor, "answer", ANSWER_LIMIT_S, self._on_no_answer)

    def on_acked(self) -> None:
        """Take that the Command was carried out, and its content has arrived."""
        self.finish(EXIT_OK)

    def on_answer(self, message: GeneralMessage) -> None:
        if self._sent_s is None:
            return
        data = message.data
        if message.name == "up.ack" and data.get("id") == self._id:
            took_ms = round((self._reactor.seconds() - self._sent_s) * 1000)
            aircraft, address = self._settings.aircraft, self._settings.address
            text = f"ack after {took_ms} ms from {aircraft} by {address}"
            self.echo(text, "ack", took_ms=took_ms, aircraft=aircraft, address=address)
            self._is_acked = True
            self.cancel_timer("answer")
            if not self._awaited:
                self.on_acked()
                return
            self.after(self._reactor, "content", CONTENT_LIMIT_S, self._on_no_content)
        elif message.name == "up.nack" and data.get("id") == self._id:
            reason = sanitize_text(data.get("reason") or "no reason given", 500)
            code = sanitize_text(data.get("code"), 32)
            detail = sanitize_text(data.get("detail") or "", 32)
            self.fail(f"refused: {reason} ({code})", code, EXIT_FAILED, detail=detail)
        elif message.name not in (*_QUIET, "up.ack", "up.nack"):
            shown = json.dumps(data).replace("\x7f", "\\u007f")
            name = sanitize_text(message.name, 128)
            self.echo(f"{name} {shown}", "message", name=name, data=data)
            if message.name == self._awaited:
                self._awaited = ""
                if self._is_acked:
                    self.on_acked()

    def _on_no_answer(self) -> None:
        text = f"no answer within {ANSWER_LIMIT_S:g} s; the outcome of {self._name} is unknown"
        self.fail(text, "no_answer", EXIT_NO_ANSWER)

    def _on_no_content(self) -> None:
        text = f"no {self._awaited} within {CONTENT_LIMIT_S:g} s"
        self.fail(text, "no_content", EXIT_NO_ANSWER)


def parse_fields(words: Iterable[str], texts: Container[str] = ()) -> dict[str, Any]:
    """Return the data of a Command; a dot in a key opens an object.

    A value is taken as JSON where it is JSON (``2``, ``true``, ``null``, ``"2"``, ``{...}``) and
    as text otherwise; numbers and flags of the keys in ``texts`` stay as typed. Raises UsageError.
    """
    data: dict[str, Any] = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not equals or not key:
            raise UsageError(f"{word!r} is not a field: write key=value", "invalid_field")
        value = _value(text)
        is_typed = key in texts and isinstance(value, int | float)
        _put(data, key, text if is_typed else value)
    return data


def _value(text: str) -> Any:
    try:
        return json.loads(text, parse_constant=_refuse)
    except (ValueError, RecursionError):
        return text


def _refuse(text: str) -> NoReturn:
    raise ValueError(text)


def _put(data: dict[str, Any], key: str, value: Any) -> None:
    *path, last = key.split(".")
    place = data
    for name in path:
        inner = place.setdefault(name, {})
        if not isinstance(inner, dict):
            raise UsageError(
                f"{key}: {name} already has a value and can hold no fields", "invalid_field"
            )
        place = inner
    if not last or not all(path):
        raise UsageError(f"{key!r} is not a key: a part between its dots is empty", "invalid_field")
    if last in place:
        raise UsageError(f"{key} is given twice", "invalid_field")
    place[last] = value
