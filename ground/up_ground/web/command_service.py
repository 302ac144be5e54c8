"""Commands of the pages: checked, sent once, answered."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from up.commands.event_rules import Report
from up.protocols.general_message import GeneralMessage, encode
from up.system.clock import Clock
from up_ground.catalogue import GAINS
from up_ground.ground_link import GroundLink
from up_ground.telemetry import Telemetry
from up_ground.web.answers import Answer, Answers, outcome_event
from up_ground.web.client_session import Ask, ClientSession
from up_ground.web.command_gate import CommandGate
from up_ground.web.control import Control
from up_ground.web.gains_history import GainsHistory
from up_ground.web.messages import PageFault, Reader

ASKS_KEPT = 256
_VALUES = "arduino.pids.values"
_PROFILE = "arduino.profile.values"


class CommandService:
    """Sends a Command now or refuses it with a reason; nothing is queued.

    ``notify_all`` sends a message to the pages that watch the aircraft; ``report`` receives every
    outcome: its kind and its report.
    """

    def __init__(
        self,
        clock: Clock,
        name: str,
        link: GroundLink,
        control: Control,
        telemetry: Telemetry,
        gate: CommandGate,
        notify_all: Callable[[dict[str, Any]], object],
        report: Callable[[str, Report], object],
    ) -> None:
        self.gains = GainsHistory()
        self.profile: dict[str, Any] | None = None
        self._clock = clock
        self._name = name
        self._link = link
        self._control = control
        self._telemetry = telemetry
        self._gate = gate
        self._notify_all = notify_all
        self._report = report
        self._answers = Answers(clock)
        self._are_gains_due = True
        self._gains_holder: ClientSession | None = None

    def stop(self) -> None:
        self._answers.stop()

    def on_command(self, page: ClientSession, message: Reader) -> None:
        """Answer a page's Command, immediately or after the aircraft's answer."""
        number = message.whole("ask")
        name = message.text("name", 128)
        data = message.object("data")
        beacon = message.optional_whole("beacon")
        is_forced = message.fields.get("force") is True
        content = json.dumps([self._name, name, data], sort_keys=True)
        known = page.asks.get(number)
        if known is not None:
            if known.content != content:
                raise PageFault(f"ask {number} was another Command", "ask_repeated")
            if known.answer is not None:
                page.send(known.answer)
            return
        ask = page.asks[number] = Ask(content)
        while len(page.asks) > ASKS_KEPT:
            del page.asks[next(iter(page.asks))]
        asks = page.asks

        def notify(answer: Answer) -> None:
            ask.answer = answer.message(number)
            # A page that was reloaded since then uses the same numbers for other Commands.
            if page.asks is asks:
                page.send(ask.answer)

        self._execute(page, name, data, beacon, is_forced, notify)

    def on_message(self, message: GeneralMessage) -> None:
        """Take a message of the aircraft that is not telemetry."""
        self._answers.on_message(message)
        if message.name == _VALUES:
            self.gains.on_values(message.data, self._clock.seconds())
            self._send_gains()
        elif message.name == _PROFILE:
            self.profile = message.data
            self._notify_all(self.profile_message())

    def on_lost(self) -> None:
        self._answers.on_link_lost()

    def want_gains(self) -> None:
        """Request the gains as soon as possible."""
        self._are_gains_due = True
        self.on_moment()

    def on_moment(self) -> None:
        """Take a frame; request the gains when they are due and a page here has control."""
        self._gate.beacons.poll()
        holder = self._control.holder
        if holder is not self._gains_holder:
            # Another ground may have changed them since.
            self._gains_holder = holder
            self._are_gains_due = self._are_gains_due or holder is not None
        if not self._are_gains_due or self._control.holder is None or self._gate.unsent():
            return
        if self._telemetry.is_silent(self._clock.seconds()):
            return
        self._are_gains_due = False
        self._send(GAINS, {"request": True}, self._telemetry.beacon, lambda answer: None)

    def gains_message(self) -> dict[str, Any]:
        return self.gains.message(self._name, self._clock.seconds())

    def profile_message(self) -> dict[str, Any]:
        return {"type": "profile", "aircraft": self._name, "profile": self.profile}

    def _execute(
        self,
        page: ClientSession,
        name: str,
        data: dict[str, Any],
        beacon: int | None,
        is_forced: bool,
        notify: Callable[[Answer], object],
    ) -> None:
        refused = self._gate.refusal(
            page, name, data, beacon, is_forced=is_forced, unanswered=len(self._answers)
        )
        if refused is not None:
            notify(refused)
            return
        before = self.gains.flying
        title = self._gate.title_of(name, data)

        def on_answer(answer: Answer) -> None:
            if name == GAINS and data.get("request") is not True:
                self._on_gains_answer(page, before, data.get("pids") or {}, answer)
            self._report(*outcome_event(page.name, title, name, data, before, answer))
            notify(answer)

        self._send(name, data, beacon, on_answer)

    def _send(
        self,
        name: str,
        data: dict[str, Any],
        beacon: int | None,
        notify: Callable[[Answer], object],
    ) -> None:
        id_ = self._answers.expect(name, data, notify)
        try:
            line = encode(name, data, id_, beacon)
        except ValueError as error:
            self._answers.end(id_, Answer("refused", "invalid", str(error)[:500]))
            return
        if not self._link.send(line):
            self._answers.end(id_, Answer("unsent", "no_link", "no link to the proxy"))

    def _on_gains_answer(
        self,
        page: ClientSession,
        before: dict[str, Any] | None,
        after: dict[str, Any],
        answer: Answer,
    ) -> None:
        now_s = self._clock.seconds()
        reason = answer.reason
        self.gains.record(page.name, before, after, answer.outcome, reason, now_s)
        self._send_gains()
        # After a timeout the active gains are unknown until the aircraft reports them.
        if answer.outcome in ("ack", "timeout"):
            self.want_gains()

    def _send_gains(self) -> None:
        self._notify_all(self.gains_message())
