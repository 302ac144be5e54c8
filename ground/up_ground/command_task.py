"""Tasks that send Commands: they wait for control and for a telemetry frame with its beacon."""

from __future__ import annotations

from typing import Any

from up.cli.option_parser import EXIT_FAILED
from up.commands.telemetry_commands import MAX_PERIOD_MS
from up.protocols.general_message import GeneralMessage
from up_ground.link_status import KEPT_S, ControlStatus, control_status
from up_ground.one_shot_task import EXIT_NO_ANSWER, LinkTask
from up_ground.settings import Settings
from up_ground.telemetry import Telemetry
from up_ground.token_store import TokenStore

CONNECT_LIMIT_S = 8.0
TELEMETRY_LIMIT_S = MAX_PERIOD_MS / 1000 + 1.0
OFFLINE_LIMIT_S = 5.0


class CommandTask(LinkTask):
    """Calls ``on_ready`` once; ``what`` is what needs the beacon, for the messages.

    With ``NEEDS_CONTROL`` false it waits for the telemetry frame only.
    """

    NEEDS_CONTROL = True
    what = "this"

    def __init__(self, reactor: Any, settings: Settings, tokens: TokenStore) -> None:
        super().__init__(reactor, settings, tokens)
        self.telemetry = Telemetry()
        self._is_ready = False

    def start(self) -> None:
        self.after(self._reactor, "connect", CONNECT_LIMIT_S, self._on_no_control)
        self.link.start()

    def on_ready(self) -> None: ...

    def on_answer(self, message: GeneralMessage) -> None:
        """Take a message of the aircraft that is not telemetry."""

    def on_message(self, message: GeneralMessage) -> None:
        if self.is_finished:
            return
        if self.telemetry.update(message, self._reactor.seconds()):
            self._check_ready()
        else:
            self.on_answer(message)

    def on_control(self, control: ControlStatus) -> None:
        status = self.link.status
        if self._is_ours(control):
            self.cancel_timer("connect")
            self.cancel_timer("request")
            if not self._is_ready and not self.telemetry.frames:
                is_offline = status.is_aircraft_online is False
                limit_s = OFFLINE_LIMIT_S if is_offline else TELEMETRY_LIMIT_S
                self.after(self._reactor, "telemetry", limit_s, self._on_no_telemetry)
            self._check_ready()
        elif control is ControlStatus.HELD:
            text = f"ground {status.holder} has control; 'up-ground control request' requests it"
            self.fail(text, "control_held", EXIT_FAILED, owner=status.holder)
        elif control is ControlStatus.FREE:
            # Reserved for a token for a moment; then the first request gets it.
            self.after(self._reactor, "connect", KEPT_S, self._on_no_control)
            self.request_control()

    def _is_ours(self, control: ControlStatus) -> bool:
        return control is ControlStatus.OURS or not self.NEEDS_CONTROL

    def _check_ready(self) -> None:
        if self._is_ready or not self.telemetry.frames:
            return
        if self._is_ours(control_status(self.link.status, self._settings.direct)):
            self._is_ready = True
            self.cancel_timer("telemetry")
            self.on_ready()

    def _on_no_control(self) -> None:
        text = "no control: another ground has just released it or is taking it"
        self.fail(text, "no_control", EXIT_NO_ANSWER)

    def _on_no_telemetry(self) -> None:
        if self.link.status.is_aircraft_online is False:
            text = f"the aircraft {self._settings.aircraft} is not connected to the proxy"
            self.fail(text, "aircraft_offline", EXIT_NO_ANSWER)
        elif fault := self.link.status.key_fault:
            self.fail(*fault, EXIT_NO_ANSWER)
        else:
            text = f"no telemetry within {TELEMETRY_LIMIT_S:g} s, and {self.what} needs its beacon"
            self.fail(text, "no_telemetry", EXIT_NO_ANSWER)
