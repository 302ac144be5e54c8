"""Sent Commands, their outcomes, and the outcomes as event texts."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from up.commands.event_rules import Report
from up.commands.telemetry_schema import OUTCOMES
from up.flight_log.gain_changes import changes_text
from up.protocols.general_message import GeneralMessage
from up.sanitize_text import sanitize_text
from up.system.clock import Clock, Timer, cancel
from up_ground.catalogue import GAINS, requested_content

ANSWER_LIMIT_S = 5.0


@dataclass(frozen=True, slots=True)
class Answer:
    """Outcome of a Command.

    ``outcome``: ack, nack, timeout (sent, result unknown), unsent, refused (here). ``detail`` is
    the code of the aircraft's handler that refused it.
    """

    outcome: str
    code: str = ""
    reason: str = ""
    round_trip_ms: float | None = None
    data: dict[str, Any] | None = None
    detail: str = ""

    def message(self, ask: int) -> dict[str, Any]:
        """Return the message for the page that sent the Command as its number ``ask``."""
        return {"type": "answer", "ask": ask, **asdict(self)}


Notify = Callable[[Answer], object]


@dataclass(slots=True)
class _Sent:
    notify: Notify
    sent_s: float
    timer: Timer
    awaited: str
    data: dict[str, Any] | None = None
    acked_ms: float | None = None


class Answers:
    """Matches answers by their id; each Command ends once, despite duplicate or late answers."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._sent: dict[str, _Sent] = {}

    def __len__(self) -> int:
        return len(self._sent)

    def expect(self, name: str, data: dict[str, Any], notify: Notify) -> str:
        """Return the id with which to send a Command; ``notify`` gets its outcome."""
        id_ = secrets.token_hex(8)
        awaited = requested_content(name, data)
        timer = self._clock.callLater(ANSWER_LIMIT_S, self._on_time_over, id_)
        self._sent[id_] = _Sent(notify, self._clock.seconds(), timer, awaited)
        return id_

    def on_message(self, message: GeneralMessage) -> None:
        if message.name in ("up.ack", "up.nack"):
            id_ = message.data.get("id")
            sent = self._sent.get(id_) if isinstance(id_, str) else None
            if sent is not None and isinstance(id_, str):
                self._on_answer(id_, sent, message)
            return
        for id_, sent in list(self._sent.items()):
            if sent.awaited == message.name:
                sent.awaited, sent.data = "", message.data
                if sent.acked_ms is not None:
                    self.end(id_, Answer("ack", round_trip_ms=sent.acked_ms, data=sent.data))

    def on_link_lost(self) -> None:
        """Handle the loss of the link: Commands in flight may or may not have arrived."""
        for id_, sent in list(self._sent.items()):
            self.end(id_, _timed_out(sent, "link_lost", "the link was lost before the answer"))

    def stop(self) -> None:
        for sent in self._sent.values():
            sent.timer.cancel()
        self._sent.clear()

    def _on_answer(self, id_: str, sent: _Sent, message: GeneralMessage) -> None:
        took_ms = round((self._clock.seconds() - sent.sent_s) * 1000, 1)
        if message.name == "up.nack":
            code, reason, detail = (
                _text(message.data, key) for key in ("code", "reason", "detail")
            )
            self.end(id_, Answer("nack", code, reason, took_ms, detail=detail))
        elif sent.awaited:
            sent.acked_ms = took_ms
        else:
            self.end(id_, Answer("ack", round_trip_ms=took_ms, data=sent.data))

    def _on_time_over(self, id_: str) -> None:
        sent = self._sent[id_]
        self.end(id_, _timed_out(sent, "no_answer", f"no answer within {ANSWER_LIMIT_S:g} s"))

    def end(self, id_: str, answer: Answer) -> None:
        sent = self._sent.pop(id_)
        cancel(sent.timer)
        sent.notify(answer)


def _timed_out(sent: _Sent, code: str, why: str) -> Answer:
    if sent.acked_ms is not None:
        reason = "carried out, but the requested data did not arrive"
        return Answer("ack", "no_content", reason, sent.acked_ms)
    return Answer("timeout", code, why)


def _text(data: dict[str, Any], key: str) -> str:
    found = data.get(key)
    return found[:500] if isinstance(found, str) else ""


MARK = "black_box.mark"
_SHOWN = 4


def outcome_event(
    who: str, what: str, name: str, data: Mapping[str, Any], before: Any, answer: Answer
) -> tuple[str, Report]:
    """Return kind and report of a Command that is called ``what``.

    ``before`` are the gains that flew before, None: not known.
    """
    level, outcome = OUTCOMES[answer.outcome]
    kind, done = "command", f": {what} {outcome}"
    if name == GAINS and data.get("request") is not True:
        changes = changes_text(before, data.get("pids"), _SHOWN) or "nothing differs"
        kind, what, done = "gains", f"gains ({changes})", f" changed gains: {changes}"
    elif name == MARK:
        kind, what, done = "mark", f"mark {data.get('text')}", f" marks: {data.get('text')}"
    if answer.outcome != "ack":
        reason = answer.reason.rstrip(". ") or answer.code
        done = f": {what} {outcome}" + (f": {reason}" if reason else "")
    fields = {"name": name, "outcome": answer.outcome, "code": answer.code, "by": who}
    return kind, Report(level, f"{kind}_{answer.outcome}", sanitize_text(who + done, 400), fields)
