"""The Arduino as a module: its readings on the bus, its state in telemetry (thesis 4.2.4)."""

from collections import Counter
from collections.abc import Mapping
from typing import Any

from serial_cog.config import ARDUINO
from serial_cog.modules.serial_provider import SerialProvider
from twisted.internet.defer import Deferred

from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand, read_status
from arduino_cog.request_tracker import RequestTracker
from arduino_cog.wire import ATTITUDE, IN_FLIGHT, INPUTS, ORIENTATION, OUTPUTS
from up.commands.board_schema import OLDEST_SIZE, STATUS, VERSION, Reason
from up.commands.board_status import (
    flight_mode_name,
    forward_m_s2_of,
    refusal_name,
    refusal_text,
    telemetry_of,
)
from up.commands.flight_state_command import FlightBatteryCommand, FlightStateCommand
from up.commands.orientation_command import AccelerationCommand, OrientationCommand
from up.commands.refusal import Code, CommandRefusedError
from up.commands.rx_command import RXCommand
from up.commands.servo_command import ServoCommand
from up.config import ConfigErrors, ConfigProblem
from up.flight_controller.base_board import BaseBoard
from up.flight_controller.gains_wire import THREE_AXES_SIZE, TWO_AXES_SIZE
from up.flight_controller.profile_wire import PROFILE_SIZE
from up.needs import needs
from up.system.clock import Timer, cancel

LINK = "arduino"
ALIVE_S = 0.4
STATUS_LIMIT_S = 1.0
_VETO = "arduino firmware"
_START = ord("s")
_ECHOES = {"s": 0, "a": 0, "d": 0, "h": 2, "b": 2, "B": 2, "l": 8, "p": 3, "t": 48}

_unpack_orientation = ORIENTATION.unpack
_unpack_inputs = INPUTS.unpack
_unpack_outputs = OUTPUTS.unpack


class ArduinoProvider(BaseBoard):
    """Publishes the Arduino's data, keeps it started, and sends it the requests of other modules.

    Orientation (`O`, `o`), receiver inputs (`i`), servo outputs (`r`) and status (`x`) become
    Commands of the link ``arduino``. The Start Command is sent until the Arduino forwards, the veto
    of this program at least every 400 ms.
    """

    LINK = LINK
    TITLE = "the Arduino"
    GROUND_MODES = ("FBW", "RATE")

    serial = needs(SerialProvider)

    def load(self) -> bool:
        """Return True; raises if a controlling Raspberry Pi is configured with thesis framing."""
        if (
            self.context.application.flight_controller == "raspberry"
            and self.context.config(ARDUINO).framing == "thesis"
        ):
            path = self.context.config_folder / ARDUINO.filename
            what = (
                "framing: thesis brings no receiver inputs, which 'flight controller: raspberry'"
                " (config.yml) needs: choose checked here, or arduino there"
            )
            raise ConfigErrors([ConfigProblem(path, 1, 1, what, key="framing")])
        return True

    @property
    def is_checked(self) -> bool:
        """Return whether checked framing is used, so that the Arduino accepts every type."""
        return self.serial.framing == "checked"

    @property
    def connected(self) -> bool:
        return self.serial.connected

    @property
    def is_in_flight(self) -> bool | None:
        """Return whether the aircraft may be in flight; None while unknown."""
        return None if self.status is None else self.status.is_in_flight(self.has_motor)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the state of the Arduino beside that of the flight."""
        status = self.status
        counters = {**self.counters, "unmatched": self.requests.unmatched}
        return {
            **super().telemetry_content,
            "arduino": {
                "connected": self.connected,
                "framing": self.serial.framing,
                **telemetry_of(None if status is None else status.data),
            },
            "counters": {"arduino": counters},
        }

    def request(
        self, type_: str, payload: bytes = b"", *, answer: str = "K", may_repeat: bool = True
    ) -> Deferred[bytes]:
        """Send a request; the result is the payload of the answer (docs/protocols.md 2.3).

        Fails with CommandRefusedError; repeats the request once without an answer if
        ``may_repeat``. Raises CommandRefusedError when no Arduino is connected.
        """
        self.require_connected()
        return self.requests.request(type_, payload, answer=answer, may_repeat=may_repeat)

    def send_unanswered(self, type_: str, payload: bytes) -> None:
        """Send a message that gets no confirmation; raises CommandRefusedError."""
        self.require_connected()
        self.serial.send_command(type_, payload)

    def require_connected(self) -> None:
        """Raise CommandRefusedError when no Arduino is connected."""
        if not self.connected:
            raise CommandRefusedError(self.absent, Code.UNAVAILABLE)

    def require_checked(self, what: str) -> None:
        """Raise CommandRefusedError if thesis framing has no message for ``what``."""
        if not self.is_checked:
            raise CommandRefusedError(
                f"{what} needs the firmware of this project: arduino.yml says framing: thesis,"
                " which has no message for it",
                detail="old_firmware",
            )

    def send_stream(self, type_: str, payload: bytes) -> int | None:
        """Send a message of an unconfirmed stream; only the newest of a type waits."""
        return self.serial.send_command(type_, payload, True)

    def on_init(self) -> None:
        super().on_init()
        self.status: ArduinoStatusCommand | None = None
        self.has_motor: bool | None = None
        self.counters: Counter[str] = Counter()
        self._status_s = float("-inf")
        self._alive: Timer | None = None
        self._refusals_named: set[tuple[str, str]] = set()
        self.requests = RequestTracker(self.context.reactor, self.serial.send_command)
        self._veto_changed_before = self.up.vetoes.on_changed
        self.up.vetoes.on_changed = self._on_veto_changed
        self._subscribe()
        self.serial.add_listener(self)

    def on_start(self) -> bool:
        return True

    def on_stop(self) -> None:
        self._stop_alive()
        self.requests.fail_all("Raspilot stops")

    def _stop_alive(self) -> None:
        cancel(self._alive)
        self._alive = None

    def _subscribe(self) -> None:
        add = self.serial.add_handler
        add("r", self._on_outputs, OUTPUTS.size)
        add("T", lambda payload: self.requests.on_value("T", payload), TWO_AXES_SIZE)
        if not self.is_checked:
            add("o", self._on_attitude, ATTITUDE.size)
            add("!", self._on_refused_bare, 1)
            for letter, size in _ECHOES.items():
                add(letter, self._on_echo, size)
            return
        add("O", self._on_orientation, ORIENTATION.size)
        add("i", self._on_inputs, INPUTS.size)
        add("x", self._on_status, STATUS.size, least=OLDEST_SIZE)
        add("K", self._on_confirmed, 2)
        add("!", self._on_refused, 3)
        add("m", lambda payload: self.requests.on_value("m", payload), 1)
        add("G", lambda payload: self.requests.on_value("G", payload), THREE_AXES_SIZE)
        add("C", lambda payload: self.requests.on_value("C", payload), PROFILE_SIZE)

    def on_line_opened(self) -> None:
        """Greet the device at the other end of the line."""
        self._status_s = float("-inf")
        if self.is_checked:
            self._send_veto()
            self._send_start()
            if self._alive is None:
                self._alive = self.context.reactor.callLater(ALIVE_S, self._keep_alive)

    def on_line_lost(self) -> None:
        """Stop the keep-alive messages; a silent line is reported separately."""
        self._stop_alive()

    def on_line_heard(self) -> None:
        self.report_heard()

    def on_line_silent(self) -> None:
        self.status = None
        self.requests.fail_all(self.absent)
        self.report_silent()

    def _on_orientation(self, payload: bytes) -> None:
        sequence, yaw, pitch, roll, yaw_rate, pitch_rate, roll_rate = _unpack_orientation(payload)
        # The frame was checked, its values were not: a comparison is false for NaN.
        if (
            -360.0 <= yaw <= 360.0
            and -360.0 <= pitch <= 360.0
            and -360.0 <= roll <= 360.0
            and -4000.0 <= yaw_rate <= 4000.0
            and -4000.0 <= pitch_rate <= 4000.0
            and -4000.0 <= roll_rate <= 4000.0
        ):
            self._execute(
                OrientationCommand(roll, pitch, yaw, roll_rate, pitch_rate, yaw_rate, sequence),
                self.origin,
            )
        else:
            self.counters["invalid_orientations"] += 1

    def _on_attitude(self, payload: bytes) -> None:
        yaw, pitch, roll = ATTITUDE.unpack(payload)
        if -360.0 <= yaw <= 360.0 and -360.0 <= pitch <= 360.0 and -360.0 <= roll <= 360.0:
            self._execute(OrientationCommand(roll, pitch, yaw), self.origin)
        else:
            self.counters["invalid_orientations"] += 1

    def _on_inputs(self, payload: bytes) -> None:
        inputs = _unpack_inputs(payload)
        if max(inputs) <= 3000 and inputs[6] <= 63:
            self._execute(RXCommand(*inputs), self.origin)
        else:
            self.counters["invalid_inputs"] += 1

    def _on_outputs(self, payload: bytes) -> None:
        outputs = _unpack_outputs(payload)
        if max(outputs) > 3000:
            self.counters["invalid_outputs"] += 1
            return
        self.publish_servo(ServoCommand(*outputs))

    def _on_status(self, payload: bytes) -> None:
        status = read_status(payload)
        self._status_s = self._seconds()
        if status.version != VERSION:
            self.up.vetoes.set(
                _VETO,
                f"the firmware speaks version {status.version} of the serial line, this program"
                f" {VERSION}: flash the firmware that belongs to it",
            )
            return
        self.up.vetoes.clear(_VETO)
        previous, self.status = self.status, status
        self.up.vetoes.report(LINK, status.veto_names)
        if previous is not None and status.uptime_s < previous.uptime_s:
            self._on_reset(status)
        elif previous is None and status.is_restored:
            # It was silent before, or this program just started: reported in both cases.
            self.log.warn(
                "the Arduino continues after a reset ({reset_cause}){state}",
                code="board_restored",
                **_reset_of(status),
            )
        self.publish(status)
        self.publish_state(flight_state_of(status, self.has_motor))
        forward_m_s2 = forward_m_s2_of(status)
        if forward_m_s2 is not None:
            self.publish(AccelerationCommand(forward_m_s2))
        if status.battery_mv:
            self.publish(FlightBatteryCommand(status.battery_mv / 1000))

    def _on_reset(self, status: ArduinoStatusCommand) -> None:
        self.counters["resets"] += 1
        self.log.warn(
            "the Arduino was reset ({reset_cause}){state}",
            code="board_reset",
            **_reset_of(status),
        )
        self._send_start()
        self.notify_board_started()

    def _on_confirmed(self, payload: bytes) -> None:
        if payload[0] != _START:
            self.requests.on_confirmed(chr(payload[0]), payload[1])

    def _on_refused(self, payload: bytes) -> None:
        type_, sequence, reason = chr(payload[0]), payload[1], refusal_text(payload[2])
        detail = refusal_name(payload[2])
        if payload[2] == Reason.ONLY_ON_GROUND:
            reason += f" ({IN_FLIGHT})"
        if payload[2] == Reason.VETO and self.status is not None:
            reason += f" ({', '.join(self.status.veto_names)})"
        if not self.requests.on_refused(type_, sequence, reason, detail):
            self._log_refusal(type_, reason, detail)

    def _on_refused_bare(self, payload: bytes) -> None:
        type_ = chr(payload[0]) if payload else ""
        if not type_ or not self.requests.on_refused(
            type_, None, "an old firmware gives no reason"
        ):
            self._log_refusal(type_, "")

    def _on_echo(self, payload: bytes) -> None:
        """Take the confirmation of an old firmware; no request waits for it."""

    def _log_refusal(self, type_: str, reason: str, detail: str = "") -> None:
        """Count the refusal of a stream message, and log each kind once."""
        self.counters["refused_frames"] += 1
        if (type_, reason) not in self._refusals_named:
            self._refusals_named.add((type_, reason))
            self.log.info(
                "the Arduino refused {type_!r}: {reason}",
                code="board_refused",
                detail=detail,
                type_=type_,
                reason=reason or "no reason given",
            )

    def _keep_alive(self) -> None:
        """Send the keep-alive, and start an Arduino that does not forward."""
        self._alive = self.context.reactor.callLater(ALIVE_S, self._keep_alive)
        self._send_veto()
        if self._seconds() - self._status_s > STATUS_LIMIT_S:
            self._send_start()

    def _on_veto_changed(self) -> None:
        self._veto_changed_before()
        if self.is_checked:
            self._send_veto()

    def _send_veto(self) -> None:
        self.send_stream("v", b"\x01" if self.up.vetoes.own else b"\x00")

    def _send_start(self) -> None:
        self.serial.send_command("s")


def _reset_of(status: ArduinoStatusCommand) -> dict[str, Any]:
    state = ", and is armed" if status.is_armed else ""
    return {"reset_cause": status.reset_causes, "armed": status.is_armed, "state": state}


def flight_state_of(status: ArduinoStatusCommand, has_motor: bool | None) -> FlightStateCommand:
    """Return the authority, in the terms that flight controllers use."""
    return FlightStateCommand(
        flight_mode_name(status.mode),
        status.is_armed,
        status.is_at_auto,
        status.is_failsafe,
        status.is_in_flight(has_motor),
    )
