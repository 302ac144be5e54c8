"""``up-ground send``: one Command to the aircraft, and its answer."""

from __future__ import annotations

import json
import secrets
from typing import Any

from up.commands.telemetry_commands import SLOWEST_MS
from up.protocols.general_message import GeneralMessage, encode
from up_ground.ground_link import GroundLink
from up_ground.link_status import ASK_INTERVAL_S, KEPT_S, ControlStatus, LinkState, control_status
from up_ground.one_shot_task import EXIT_DONE, EXIT_NO_ANSWER, EXIT_REFUSED, Echo, OneShotTask
from up_ground.sanitize_text import sanitize_text
from up_ground.settings import Settings
from up_ground.telemetry import NAME as TELEMETRY
from up_ground.telemetry import Telemetry
from up_ground.token_store import TokenStore

CONNECT_LIMIT_S = 8.0
TELEMETRY_LIMIT_S = SLOWEST_MS / 1000 + 1.0
OFFLINE_LIMIT_S = 5.0
ANSWER_LIMIT_S = 3.0
CONTENT_LIMIT_S = 2.0
_CONTENT_OF = {
    "arduino.pids.tunings": "arduino.pids.values",
    "arduino.profile.request": "arduino.profile.values",
}
"""Data besides the ack, for a Command that requests something."""
_MAY_SET = ("arduino.pids.tunings",)
"""Requests something only with ``request=true``."""
_QUIET = (TELEMETRY, "up.system.state")


class Send(OneShotTask):
    """Waits for the seat and for one telemetry frame, sends, waits for the answer.

    Nothing is sent twice, and nothing without the beacon of a frame; an aircraft whose frames have
    none, such as the thesis's, gets only Commands that need none (``needs_beacon``).
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
        echo: Echo,
        print_error: Echo,
    ) -> None:
        super().__init__(echo, print_error)
        self.link = GroundLink(reactor, settings, self, tokens)
        self._reactor = reactor
        self._settings = settings
        self._name = name
        self._data = data
        self._needs_beacon = needs_beacon
        self._telemetry = Telemetry()
        self._id = secrets.token_hex(8)
        self._sent_s: float | None = None
        is_asking = name not in _MAY_SET or data.get("request") is True
        self._awaited = _CONTENT_OF.get(name, "") if is_asking else ""
        self._is_acked = False

    def start(self) -> None:
        """Begin."""
        self.after(self._reactor, "connect", CONNECT_LIMIT_S, self._on_no_seat)
        self.link.start()

    def on_message(self, message: GeneralMessage) -> None:
        """Take telemetry for its beacon, and the answers to us."""
        if self.is_finished:
            return
        if self._telemetry.update(message, self._reactor.seconds()):
            self._try_to_send()
        elif self._sent_s is not None:
            self._on_answer(message, self._sent_s)

    def on_link(self) -> None:
        """Continue as far as the link permits."""
        if self.is_finished:
            return
        status = self.link.status
        if status.state is LinkState.WAITING:
            self._fail(status.reason, EXIT_REFUSED if status.rejection else EXIT_NO_ANSWER)
            return
        seat = control_status(status, self._settings.direct)
        if seat is ControlStatus.HELD:
            self._fail(
                f"ground {status.holder} commands this aircraft; 'up-ground seat request' asks it"
                " for the seat",
                EXIT_REFUSED,
            )
        elif seat is ControlStatus.FREE:
            # Reserved for a token for a moment; then the first request gets it.
            self.after(self._reactor, "connect", KEPT_S, self._on_no_seat)
            self._ask()
        elif seat is ControlStatus.OURS:
            self.cancel_timer("connect")
            self.cancel_timer("ask")
            if self._sent_s is None and not self._telemetry.frames:
                is_offline = status.is_aircraft_online is False
                limit_s = OFFLINE_LIMIT_S if is_offline else TELEMETRY_LIMIT_S
                self.after(self._reactor, "telemetry", limit_s, self._on_no_telemetry)
            self._try_to_send()

    def _ask(self) -> None:
        self.link.request_seat()
        self.after(self._reactor, "ask", ASK_INTERVAL_S, self._ask)

    def _try_to_send(self) -> None:
        if self._sent_s is not None or not self._telemetry.frames:
            return
        if control_status(self.link.status, self._settings.direct) is not ControlStatus.OURS:
            return
        self.cancel_timer("telemetry")
        if self._needs_beacon and self._telemetry.beacon is None:
            self._fail(
                f"{self._name} is only taken with a beacon, and this aircraft's telemetry has none",
                EXIT_REFUSED,
            )
            return
        self.link.send(encode(self._name, self._data, self._id, self._telemetry.beacon))
        self._sent_s = self._reactor.seconds()
        self.after(self._reactor, "answer", ANSWER_LIMIT_S, self._on_no_answer)

    def _on_answer(self, message: GeneralMessage, sent_s: float) -> None:
        data = message.data
        if message.name == "up.ack" and data.get("id") == self._id:
            self.echo(f"ack after {(self._reactor.seconds() - sent_s) * 1000:.0f} ms")
            self._is_acked = True
            self.cancel_timer("answer")
            if not self._awaited:
                self.finish(EXIT_DONE)
                return
            self.after(self._reactor, "content", CONTENT_LIMIT_S, self._on_no_content)
        elif message.name == "up.nack" and data.get("id") == self._id:
            reason = sanitize_text(data.get("reason") or "no reason given", 500)
            self._fail(f"refused: {reason} ({sanitize_text(data.get('code'), 32)})", EXIT_REFUSED)
        elif message.name not in (*_QUIET, "up.ack", "up.nack"):
            self.echo(f"{sanitize_text(message.name, 128)} {_shown(data)}")
            if message.name == self._awaited:
                self._awaited = ""
                if self._is_acked:
                    self.finish(EXIT_DONE)

    def _on_no_seat(self) -> None:
        self._fail("no seat: another ground has just left it or takes it", EXIT_NO_ANSWER)

    def _on_no_telemetry(self) -> None:
        if self.link.status.is_aircraft_online is False:
            self._fail(
                f"the aircraft {self._settings.aircraft} is not connected to the proxy",
                EXIT_NO_ANSWER,
            )
        else:
            self._fail(
                f"no telemetry within {TELEMETRY_LIMIT_S:g} s, and {self._name} is only sent with"
                " its beacon",
                EXIT_NO_ANSWER,
            )

    def _on_no_answer(self) -> None:
        self._fail(
            f"no answer within {ANSWER_LIMIT_S:g} s; it is not known whether {self._name} was"
            " carried out",
            EXIT_NO_ANSWER,
        )

    def _on_no_content(self) -> None:
        self._fail(f"no {self._awaited} within {CONTENT_LIMIT_S:g} s", EXIT_NO_ANSWER)

    def _fail(self, sentence: str, status: int) -> None:
        self.print_error(sanitize_text(sentence, 600))
        self.finish(status)


def _shown(data: dict[str, Any]) -> str:
    return json.dumps(data).replace("\x7f", "\\u007f")
