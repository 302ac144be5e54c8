"""The profile of the airframe on the Arduino, and its comparison with airframe.yml."""

from typing import Any

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from arduino_cog.commands.arduino_commands import (
    ArduinoProfileRequestCommand,
    ArduinoProfileValuesCommand,
)
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from arduino_cog.mirrored_parameter import MirroredParameter
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import IN_FLIGHT
from up.base_module import BaseModule
from up.commands.flight_state_command import FlyByWireLimitsCommand
from up.commands.refusal import Code, CommandRefusedError
from up.config.schema import plain_value
from up.flight_controller.profile_wire import (
    AIRFRAME,
    Profile,
    differences,
    flat,
    pack_profile,
    read_profile,
)
from up.mode import WITH_BOARD
from up.needs import needs, wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider

FIRST_WAIT_S = 1.0
MAX_WAIT_S = 60.0
_VETO = AIRFRAME.filename


class ArduinoProfile(BaseModule):
    """Writes the values of airframe.yml to the Arduino's profile, whose other values stay.

    The profile is read whenever a board answers that may be another one: whether it has a motor
    determines the meaning of "in flight". It is sent only on the ground and only where it differs,
    with increasing delays between attempts. Until the board has it, arming is vetoed under the
    file's name. Its limits of FBW are published for a flight controller on the Raspberry Pi. An
    airframe.yml without values changes and vetoes nothing, and an old firmware (thesis framing) has
    no profile.
    """

    MODES = WITH_BOARD
    CONFIG = AIRFRAME

    arduino = needs(ArduinoProvider)
    mission_control = wants(BaseMissionControlProvider)

    @property
    def current(self) -> Profile | None:
        """Return the profile that the Arduino last reported; None while unknown."""
        return self._board.current

    def on_init(self) -> None:
        self._is_settled = False
        self._is_reading = False
        self._is_logged = False
        self._wait_s = FIRST_WAIT_S
        self._next_s = float("-inf")
        self._wanted = dict(flat(plain_value(AIRFRAME.schema, self.config)))
        self._board = MirroredParameter(
            self.arduino, "c", "C", read_profile, "profile", self._publish
        )
        executor = self.up.command_executor
        executor.register_command(ArduinoProfileRequestCommand, self.on_request)
        if not self.arduino.is_checked:
            if self._wanted:
                self.log.warn(
                    "{veto} is not used: an old firmware (framing: thesis) keeps no profile",
                    code="profile_not_supported",
                    veto=_VETO,
                )
            return
        self.arduino.add_board_listener(self.on_board_started)
        executor.register_command(ArduinoStatusCommand, self.on_status)

    def on_request(self, command: ArduinoProfileRequestCommand) -> Deferred[Any]:
        """Answer with the Arduino's current profile."""
        self.arduino.require_checked("the profile")
        if self.mission_control is None:
            raise CommandRefusedError("no ground station is configured", Code.UNAVAILABLE)
        return self._board.read().addCallback(self._send_values)

    def on_board_started(self) -> None:
        """Compare again: this board may be another one, or was reset."""
        self._board.current = self.arduino.has_motor = None
        self._is_settled = self._is_logged = False
        self._wait_s = FIRST_WAIT_S
        self._next_s = float("-inf")
        self._veto("the Arduino's profile is not known yet")
        self._publish_limits()
        self._reconcile()

    def on_status(self, status: ArduinoStatusCommand) -> None:
        """Continue a change that waits for an answer, for its retry or for disarming."""
        if self._wanted and not status.is_profile_valid and self._board.current is not None:
            self._is_settled = False
        self._reconcile()

    def _reconcile(self) -> None:
        is_busy = self._is_reading or self._board.is_setting
        if self._is_settled or is_busy or self.context.reactor.seconds() < self._next_s:
            return
        current = self._board.current
        if current is None:
            self._is_reading = True
            self._board.read().addCallbacks(self._on_read, self._on_failed)
        else:
            self._compare(current)

    def _compare(self, current: Profile) -> None:
        """Send the profile if it is needed and harmless."""
        self.arduino.has_motor = current["motor"]
        if not self._wanted:
            self._is_settled = True
            return
        try:
            payload = pack_profile({**current, **self._wanted})
        except ValueError as error:
            self._give_up(f"does not fit the Arduino's profile: {error}")
            return
        # Rounded as on the wire, so that it equals the value read back.
        wanted = read_profile(payload)
        status = self.arduino.status
        changes = differences(current, wanted)
        if status is not None and not status.is_profile_valid:
            changes.append("the Arduino's copy is damaged")
        if not changes:
            self._settle()
            return
        text = "; ".join(changes)
        self.up.vetoes.set(_VETO, f"the Arduino has another profile ({text})")
        if self.arduino.is_in_flight is None:
            return
        if self.arduino.is_in_flight:
            self._log_in_flight(text)
            return
        self.log.info(
            "the Arduino gets the profile of {veto}, which differs: {text}",
            code="profile_sent",
            veto=_VETO,
            text=text,
        )
        sent = self._board.send("C", payload, lambda now: now == wanted)
        sent.addCallbacks(lambda _: self._on_sent(), self._on_failed)

    def _publish_limits(self) -> None:
        """Publish the limits for a flight controller on the Raspberry Pi."""
        limits = self.config.fly_by_wire
        command = FlyByWireLimitsCommand(
            limits.roll_deg, limits.pitch_up_deg, limits.pitch_down_deg
        )
        self.up.command_executor.execute_command(command)

    def _back_off(self) -> None:
        """Wait before the next attempt, longer each time."""
        self._next_s = self.context.reactor.seconds() + self._wait_s
        self._wait_s = min(self._wait_s * 2, MAX_WAIT_S)

    def _on_read(self, current: Profile) -> None:
        self._is_reading = False
        self._compare(current)

    def _on_sent(self) -> None:
        self.log.info("the Arduino has stored the profile", code="profile_stored")
        # If the board then reports a damaged copy, its EEPROM is worn: do not write again.
        self._back_off()
        self._settle()

    def _settle(self) -> None:
        self._is_settled = True
        self.up.vetoes.clear(_VETO)

    def _give_up(self, reason: str) -> None:
        self._is_settled = True
        self.log.error("{veto} {reason}", code="profile_invalid", veto=_VETO, reason=reason)
        self.up.vetoes.set(_VETO, reason)

    def _log_in_flight(self, changes: str) -> None:
        if not self._is_logged:
            self._is_logged = True
            self.log.warn(
                "the Arduino keeps another profile than {veto} has ({changes}):"
                " in flight; {in_flight}",
                code="profile_differs_in_flight",
                veto=_VETO,
                changes=changes,
                in_flight=IN_FLIGHT,
            )

    def _veto(self, reason: str) -> None:
        if self._wanted:
            self.up.vetoes.set(_VETO, reason)

    def _on_failed(self, failure: Failure) -> None:
        failure.trap(CommandRefusedError)
        refusal: Any = failure.value
        self._is_reading = False
        # After a lost answer the board's profile is unknown.
        self._board.current = None
        self._back_off()
        reason, detail = refusal.reason, refusal.detail
        self.log.warn("profile: {reason}", code="profile_failed", reason=reason, detail=detail)
        self._veto(f"the Arduino does not have this profile: {reason}")

    def _publish(self, current: Profile) -> None:
        self.arduino.has_motor = current["motor"]
        self.up.command_executor.execute_command(ArduinoProfileValuesCommand.of(current))

    def _send_values(self, current: Profile) -> None:
        assert self.mission_control is not None
        if not self.mission_control.send_command(ArduinoProfileValuesCommand.of(current)):
            raise CommandRefusedError("the ground station is not connected", Code.UNAVAILABLE)
