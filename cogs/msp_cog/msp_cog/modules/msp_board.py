"""A Betaflight board as a module: its readings on the bus, its state in telemetry."""

import struct
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from functools import partial
from typing import Any

from twisted.internet.task import LoopingCall

from msp_cog import messages
from msp_cog.codec import MspDecoder, encode
from msp_cog.config import MSP
from msp_cog.line_opener import open_line
from msp_cog.messages import BOX_ANGLE, BOX_ARM, BOX_OVERRIDE, Status
from msp_cog.poller import Poller
from msp_cog.stick_curve import StickCurve
from up.commands.flight_state_command import FlightStateCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.servo_command import ServoCommand
from up.flight_controller.base_board import BaseBoard
from up.protocols.serial_line import SerialLine

OVERRIDDEN_VALID = 0b110000
"""While set-points act the board reports them as the sticks: only the switches are the pilot's."""
FOLLOWED_S = 0.3
"""The board drops a set-point after this time (``rx/msp.c``)."""
ANSWER_S = 3.0
LOST_S = 0.1
"""After this silence missing answers are lost."""
SAME_FIX_S = 1.0
"""An equal answer before is the receiver's last fix, not a new one."""
_VETO = "msp board"


class MspBoard(BaseBoard):
    """Requests the board's readings at ``rate_hz`` and publishes them.

    The pilot's switch for the board's mode MSP OVERRIDE is AUTO: set-points act while it is on,
    ANGLE is on, and they come. ``send_sticks`` sends one. While the motor is disarmed, the vetoes
    of this program forbid the board to arm.
    """

    CONFIG = MSP
    FLIGHT_CONTROLLERS = frozenset({"msp"})
    DATA_SOURCE = True
    LINK = "msp"
    TITLE = "the Betaflight board"

    @property
    def connected(self) -> bool:
        return self._is_heard

    @property
    def is_source_open(self) -> bool:
        return self._line.is_open

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the state of the board beside that of the flight."""
        status = self.status
        counters = {
            **self.counters,
            **asdict(self._decoder.counters),
            **asdict(self._line.counters),
            "skipped": self._poller.skipped,
        }
        reasons = None if status is None else status.reasons
        return {
            **super().telemetry_content,
            "msp": {"connected": self._is_heard, "arming_disabled": reasons},
            "counters": {"msp": counters},
        }

    def on_init(self) -> None:
        super().on_init()
        self.status: Status | None = None
        self.curves: tuple[StickCurve, StickCurve] | None = None
        self.counters: Counter[str] = Counter()
        self._decoder = MspDecoder()
        self._poller = Poller()
        self._known: dict[int, bytes] = {}
        self._sequence = 0
        self._rates: tuple[float, float, float] | None = None
        self._is_heard = False
        self._receiver = Origin(self.LINK, Role.SENSOR)
        self._fix = b""
        self._fix_s = self._heard_s = self._sent_s = float("-inf")
        self._is_forbidden: bool | None = None
        self._unanswered_s: float | None = None
        self._handlers = {
            messages.ATTITUDE: self._on_attitude,
            messages.RAW_IMU: self._on_rates,
            messages.RC: self._on_channels,
            messages.STATUS: self._on_status,
            messages.MOTOR: self._on_motor,
            messages.ANALOG: self._on_analog,
            messages.RAW_GPS: self._on_gps,
        }
        config = self.config
        self._line = SerialLine(
            self.context.reactor,
            partial(open_line, config.port, config.baud_rate),
            on_bytes=self.on_bytes,
            on_opened=self._on_opened,
            on_lost=self._on_lost,
            on_open_failed=self._on_open_failed,
        )
        self._ticks = LoopingCall(self._tick)
        self._ticks.clock = self.context.reactor

    def on_start(self) -> bool:
        self._line.start()
        self._ticks.start(1 / self.config.rate_hz)
        return True

    async def on_stop(self) -> None:
        if self._ticks.running:
            self._ticks.stop()
        if self._is_forbidden:
            # Without this program the board's own checks decide.
            await self._line.end(encode(messages.SET_ARMING_DISABLED, b"\x00"))
        self._line.stop()

    def send_sticks(self, payload: bytes) -> None:
        """Send sticks in place of the pilot's: an unsent one is replaced."""
        self._sent_s = self._seconds()
        self._line.write_newest(messages.SET_RAW_RC, encode(messages.SET_RAW_RC, payload))

    def on_bytes(self, data: bytes) -> None:
        replies = self._decoder.feed(data)
        counters = self._decoder.counters
        self._poller.on_answers(counters.frames + counters.refused)
        if not replies:
            return
        self._heard_s, self._unanswered_s = self._seconds(), None
        if not self._is_heard:
            self._is_heard = True
            self.report_heard()
        for number, payload in replies:
            handler = self._handlers.get(number)
            try:
                if handler is None:
                    self._on_setting(number, payload)
                else:
                    handler(payload)
            except (struct.error, ValueError, IndexError):
                self.counters["invalid"] += 1

    def _tick(self) -> None:
        if not self._line.is_open:
            return
        silence_s = self._seconds() - self._heard_s
        if self._is_heard and silence_s > self.config.silence_s:
            self._on_silence()
        if silence_s > LOST_S:
            self._poller.forget()
        if self._unanswered_s is not None and self._seconds() - self._unanswered_s > ANSWER_S:
            self._unanswered_s = None
            self.log.warn(
                "{port} is open, and nothing there answers by MSP: is it the board's port, with MSP"
                " switched on, at {baud} baud?",
                port=self.config.port,
                baud=self.config.baud_rate,
                code="no_answer",
            )
        requests = b"".join(encode(each) for each in self._poller.due())
        if requests:
            self._line.write(requests)

    def _on_opened(self) -> None:
        self.log.info("opened {port}", port=self.config.port, code="port_opened")
        self._unanswered_s = self._seconds()
        self._decoder.reset()
        self._poller.reset()

    def _on_lost(self, why: str) -> None:
        self.log.warn("lost {port}: {why}", port=self.config.port, why=why, code="port_lost")
        self._on_silence()

    def _on_open_failed(self, why: str) -> None:
        self.log.warn("{reason}; trying again", reason=why, code="port_unavailable")

    def _on_silence(self) -> None:
        self._poller.reset()
        self._known.clear()
        self.status = self.curves = self._rates = self._is_forbidden = None
        if self._is_heard:
            self._is_heard = False
            self.report_silent()

    def _on_setting(self, number: int, payload: bytes) -> None:
        self._known[number] = payload
        if number not in messages.SETTINGS or not self._known.keys() >= set(messages.SETTINGS):
            return
        try:
            self.curves = messages.read_curves(self._known)
        except messages.UnfitError as error:
            self.curves = None
            self.up.vetoes.set(_VETO, f"{self.TITLE} gets no set-points: {error}")
        else:
            self.up.vetoes.clear(_VETO)

    def _on_attitude(self, payload: bytes) -> None:
        roll_deg, pitch_deg, heading_deg = messages.read_attitude(payload)
        self._sequence = (self._sequence + 1) & 0xFFFF
        rates = self._rates or (None, None, None)
        self.publish(
            OrientationCommand.from_data(
                {
                    "roll": roll_deg,
                    "pitch": pitch_deg,
                    "yaw": heading_deg,
                    "roll_rate": rates[0],
                    "pitch_rate": rates[1],
                    "yaw_rate": rates[2],
                    "sequence": self._sequence,
                }
            )
        )

    def _on_rates(self, payload: bytes) -> None:
        self._rates = messages.read_rates(payload)

    def _on_channels(self, payload: bytes) -> None:
        status = self.status
        if status is None:
            return
        is_overridden = BOX_OVERRIDE in status.boxes and self._is_followed
        valid = OVERRIDDEN_VALID if is_overridden else ALL_VALID
        channels = messages.read_channels(payload)
        self.publish(RXCommand(*channels, 0 if status.is_failsafe else valid))

    def _on_status(self, payload: bytes) -> None:
        box_ids = self._known.get(messages.BOX_IDS)
        if box_ids is None:
            return
        status = self.status = messages.read_status(payload, box_ids)
        is_armed = BOX_ARM in status.boxes
        self.up.vetoes.report(self.LINK, () if is_armed else tuple(status.reasons))
        self.publish_state(
            FlightStateCommand(
                self._flight_mode(status), is_armed, self._is_auto(status), status.is_failsafe,
                is_armed,
            )
        )  # fmt: skip
        self._forbid(bool(self.up.vetoes.own), is_armed)

    @property
    def _is_followed(self) -> bool:
        since_s: float = self._seconds() - self._sent_s
        return since_s <= FOLLOWED_S

    def _is_auto(self, status: Status) -> bool:
        return status.boxes >= {BOX_OVERRIDE, BOX_ANGLE} and self.curves is not None

    def _flight_mode(self, status: Status) -> str:
        if self._is_auto(status) and self._is_followed and not status.is_failsafe:
            return "SETPOINT"
        return "FBW" if BOX_ANGLE in status.boxes else "RATE"

    def _forbid(self, is_forbidden: bool, is_armed: bool) -> None:
        """Forbid or permit arming, never in flight: the board would stop the motor."""
        if is_forbidden != self._is_forbidden and not is_armed:
            self._is_forbidden = is_forbidden
            self._line.write(encode(messages.SET_ARMING_DISABLED, bytes((is_forbidden,))))

    def _on_motor(self, payload: bytes) -> None:
        servos = self._known.get(messages.SERVO)
        if servos is not None:
            ailerons, elevator, rudder = messages.read_surfaces(servos)
            throttle = messages.read_motor(payload)
            self.publish_servo(ServoCommand(ailerons, elevator, throttle, rudder))

    def _on_analog(self, payload: bytes) -> None:
        measured = messages.read_voltage(payload)
        if measured is not None:
            self.publish(measured)

    def _on_gps(self, payload: bytes) -> None:
        now_s = self._seconds()
        if payload == self._fix and now_s - self._fix_s < SAME_FIX_S:
            return
        fix = messages.read_fix(payload)
        if fix is not None:
            self._fix, self._fix_s = payload, now_s
            self.up.command_executor.execute_command(fix, self._receiver)
