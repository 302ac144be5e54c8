"""The gains that the Arduino uses, and their copy in pids.yml (thesis 3.3.2, 4.2.4)."""

from typing import Any

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand
from arduino_cog.mirrored_parameter import MirroredParameter
from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import IN_FLIGHT
from up.base_module import BaseModule
from up.commands.gains import GainSet
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import Code, CommandRefusedError
from up.flight_controller.gains_store import GainsStore, refuse_unused
from up.flight_controller.gains_wire import pack_gains, read_gains, without_rudder
from up.flight_controller.pids_file import PIDS, PidsFile
from up.mode import WITH_BOARD
from up.needs import needs, wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider

LOW_THROTTLE_US = 1050
_VETO = PIDS.filename


class PIDTuningsProvider(BaseModule):
    """Keeps the gains of the Arduino and pids.yml equal; the Arduino's are authoritative.

    The gains of a new or reset board are read. A valid pids.yml is sent to it once, only on the
    ground and only if it differs or the EEPROM holds none. A set from the ground is accepted as a
    whole, in flight too, and saved after the Arduino confirmed it. An old firmware (thesis framing)
    does not report arming: it gets pids.yml only at its first connection and while its throttle
    output is low.
    """

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)
    mission_control = wants(BaseMissionControlProvider)

    def load(self) -> bool:
        """Return whether the Arduino is the flight controller, so that it uses its gains."""
        return bool(self.context.application.flight_controller == "arduino")

    @property
    def current(self) -> GainSet | None:
        """Return the gains that the Arduino last reported; None while unknown."""
        return self._board.current

    @property
    def pids(self) -> GainSet | None:
        """Return the Arduino's gains, a missing rudder from pids.yml; None while unknown."""
        return None if self.current is None else self.current.completed(self._saved)

    def on_init(self) -> None:
        self._is_pushed = False
        self._is_logged = False
        self._file = PidsFile(self.context.config_folder)
        self._store = GainsStore(self._file, self.context.reactor)
        self._load()
        self._is_thesis = not self.arduino.is_checked
        type_ = "T" if self._is_thesis else "G"
        self._board = MirroredParameter(
            self.arduino, type_, type_, read_gains, "set of gains", self._publish
        )
        self.arduino.add_board_listener(self.on_board_started)
        executor = self.up.command_executor
        executor.register_command(PIDTuningsCommand, self.on_tunings)
        executor.register_command(ArduinoStatusCommand, self.on_status)

    def on_board_started(self) -> None:
        """Read the gains of a board that may be another one, or was reset."""
        self._board.current = None
        self._is_logged = False
        if not self._is_thesis:
            self._is_pushed = False
        self._board.read().addCallbacks(lambda _: self._reconcile(), self._on_failed)

    def on_status(self, status: ArduinoStatusCommand) -> None:
        """Send pids.yml when a board leaves flight, or is first known to be on the ground."""
        if self.current is not None:
            self._reconcile()

    def on_tunings(self, command: PIDTuningsCommand) -> Deferred[Any]:
        """Answer a request, or set the gains: the outcome is the Arduino's."""
        gains = command.gains
        if gains is None:
            return self._answer()
        return self._set(gains, command)

    def _load(self) -> None:
        self._saved, problem = self._file.load()
        self._is_saved = (self.context.config_folder / PIDS.filename).exists()
        self._is_good = problem is None
        if problem is None:
            self.up.vetoes.clear(_VETO)
        else:
            self.log.error("{reason}", code="gains_invalid", reason=str(problem))
            self.up.vetoes.set(_VETO, str(problem))

    def _answer(self) -> Deferred[Any]:
        if self.mission_control is None:
            raise CommandRefusedError("no ground station is configured", Code.UNAVAILABLE)
        return self._board.read().addCallback(self._send_values)

    def _send_values(self, current: GainSet) -> None:
        assert self.mission_control is not None
        if not self.mission_control.send_command(self._values_of(current)):
            raise CommandRefusedError("the ground station is not connected", Code.UNAVAILABLE)

    def _publish(self, current: GainSet) -> None:
        self.up.command_executor.execute_command(self._values_of(current))

    def _values_of(self, current: GainSet) -> PIDTuningsValuesCommand:
        return PIDTuningsValuesCommand.of(current.completed(self._saved))

    def _reconcile(self) -> None:
        """Send pids.yml to the board, if it is needed and harmless."""
        if self._is_pushed or self._board.is_setting or not self._may_push():
            return
        self._is_pushed = True
        wanted = self._in_form(self._saved)
        if not self._differs(wanted):
            self.log.info("the Arduino has the gains of pids.yml", code="gains_equal")
            return
        self.log.info("the Arduino gets the gains of pids.yml, which differ", code="gains_sent")
        self._transmit(wanted).addErrback(self._on_failed)

    def _may_push(self) -> bool:
        """Return whether pids.yml may be sent: it is valid and the board surely on the ground."""
        if self.current is None or not self._is_good or not self._is_saved:
            return False
        if self._is_thesis:
            servo = self.arduino.servo
            return servo is not None and servo.throttle_us <= LOW_THROTTLE_US
        if self.arduino.is_in_flight is not False:
            self._log_in_flight()
            return False
        return True

    def _log_in_flight(self) -> None:
        """Log once that a board in flight has other gains than pids.yml."""
        if self.arduino.is_in_flight and not self._is_logged:
            self._is_logged = True
            if self._differs(self._in_form(self._saved)):
                self.log.warn(
                    "the Arduino keeps other gains than pids.yml has: in flight; {in_flight}",
                    code="gains_differ_in_flight",
                    in_flight=IN_FLIGHT,
                )

    def _in_form(self, gains: GainSet) -> GainSet:
        """Return a set in the form of the framing: an old firmware has no rudder gains."""
        return without_rudder(gains) if self._is_thesis else gains

    def _differs(self, wanted: GainSet) -> bool:
        status = self.arduino.status
        if status is not None and not status.is_gains_stored:
            return True
        current = self.current
        return current is None or pack_gains(current) != pack_gains(wanted)

    def _set(self, gains: GainSet, command: PIDTuningsCommand) -> Deferred[Any]:
        if self._is_thesis and gains.has_rudder:
            raise CommandRefusedError(
                "an old firmware (framing: thesis) has no rudder gains", detail="old_firmware"
            )
        if self._board.is_setting:
            raise CommandRefusedError("another set of gains is being sent", detail="busy")
        refuse_unused(command, gains, (self.current or gains).completed(self._saved))
        if not (self._is_thesis or gains.has_rudder):
            if self.current is None:
                raise CommandRefusedError("the Arduino's gains are not known yet", detail="unknown")
            gains = gains.completed(self.current)
        return self._transmit(gains).addCallback(self._save, gains)

    def _transmit(self, gains: GainSet) -> Deferred[Any]:
        """Send a set; the result fires when the Arduino has confirmed it."""
        try:
            payload = pack_gains(gains)
        except ValueError as error:
            raise CommandRefusedError(str(error), Code.INVALID) from None
        type_ = "g" if gains.has_rudder else "t"
        # Reading back shows the gains in use; an old firmware confirms in no other way.
        return self._board.send(
            type_,
            payload,
            lambda current: _in_form_of(gains, current) == payload,
            is_answered=not self._is_thesis,
        )

    def _save(self, _: object, gains: GainSet) -> Deferred[Any]:
        """Save the confirmed gains without blocking the bus on the disk."""
        self._is_pushed = True
        whole = gains.completed(self.current or gains)
        return self._store.save(whole).addCallbacks(lambda _: self._load(), self._on_unsaved)

    def _on_unsaved(self, failure: Failure) -> Failure:
        self.log.error("{reason}", code="gains_not_saved", reason=failure.getErrorMessage())
        return failure

    def _on_failed(self, failure: Failure) -> None:
        failure.trap(CommandRefusedError)
        self.log.warn("gains: {reason}", code="gains_failed", reason=failure.getErrorMessage())


def _in_form_of(sent: GainSet, current: GainSet) -> bytes:
    """Return the board's gains in the wire's form, without the rudder if none was sent."""
    return pack_gains(current if sent.has_rudder else without_rudder(current))
