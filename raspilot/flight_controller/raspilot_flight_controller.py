"""Raspilot's flight controller on the Raspberry Pi (thesis 3.2.3, 3.3.2, 4.4.6)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from raspilot.flight_controller import sticks
from raspilot.flight_controller.cascade import Cascade, YawDamper, pitch_rate_in_turn
from up.commands.flight_state_command import (
    FlightModeCommand,
    FlightStateCommand,
    FlyByWireLimitsCommand,
)
from up.commands.gains import Gains, GainSet
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import Code, CommandRefusedError
from up.commands.roles import Role
from up.flight_controller.base_flight_controller import BaseFlightController
from up.flight_controller.gains_store import GainsStore, refuse_unused
from up.flight_controller.pids_file import PidsFile
from up.mode import WITH_BOARD, Mode
from up.needs import wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider

ROLL_RATE_LIMIT_DEG_S = 120.0
PITCH_RATE_LIMIT_DEG_S = 80.0
MIN_STEP_S, MAX_STEP_S = 1e-3, 0.1
REQUEST_PERIOD_S = 5.0
MIN_US, MAX_US = 1000, 2000
STICK_THROTTLE = 0
_NO_GAINS = Gains(0.0)
_NOT_PERMITTED = "does not fly: the board does not let it"


class RaspilotFlightController(BaseFlightController):
    """Computes an Output from every orientation frame while the board gives the Pi control.

    FBW: the sticks require bank and pitch within the limits of airframe.yml, by default those of
    the Arduino; the rudder is stick plus yaw damper. ACRO: the sticks pass through, when
    orientation is missing. The throttle is always the stick's. Without a valid receiver, or from an
    orientation that is not the board's, nothing is sent: the board's own failsafe acts. Loaded with
    ``flight controller: raspberry``.
    """

    MODES: ClassVar[frozenset[Mode]] = WITH_BOARD
    FLIGHT_MODES: ClassVar[Mapping[str, Mapping[str, float]]] = {
        "FBW": {"rx": 0.25, "orientation": 0.1},
        "ACRO": {"rx": 0.25},
    }

    mission_control = wants(BaseMissionControlProvider)

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self.outputs = 0
        self._limits = sticks.DEFAULT_LIMITS
        self._is_asked = True
        self._is_board_ready = False
        self._asked_at_s = float("-inf")
        self._state: FlightStateCommand | None = None
        self._computed_at_s = float("-inf")
        self._logged = _NOT_PERMITTED

    def load(self) -> bool:
        """Return whether the configuration moved the control loop to the Raspberry Pi."""
        return self.context.application.flight_controller == "raspberry"

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the flight mode and the missing readings; counts only delivered Outputs."""
        dropped = self.up.command_executor.control.refused[self.class_name]
        return {
            "flight_control": {
                "mode": self.flight_mode if self.is_flying else None,
                "offered": self.offered_modes,
                "missing": self.missing_for("FBW"),
            },
            "counters": {"flight_control": {"outputs": self.outputs - dropped}},
        }

    @property
    def is_flying(self) -> bool:
        """Return whether Outputs reach the board: another module may have control."""
        owner = self.up.command_executor.control.owner
        return self._is_board_ready and owner == self.class_name

    def on_init(self) -> None:
        super().on_init()
        pids = PidsFile(self.context.config_folder)
        self._gains_store = GainsStore(pids, self.context.reactor)
        self.gains, problem = pids.load()
        if problem:
            self.log.error("{reason}", reason=str(problem), code="gains_invalid")
            self.up.vetoes.set("pids.yml", str(problem))
        self._build(self.gains)
        # With its origin the bus need not search the publisher of each Output.
        self._origin = Origin(self.class_name, Role.INTERNAL)
        executor = self._executor = self.up.command_executor
        executor.register_command(OrientationCommand, self._on_orientation)
        executor.register_command(FlightStateCommand, self._on_flight_state)
        executor.register_command(FlightModeCommand, self._on_flight_mode)
        executor.register_command(FlyByWireLimitsCommand, self._on_limits)
        executor.register_command(PIDTuningsCommand, self._on_tunings)

    def _build(self, gains: GainSet) -> None:
        rate, stabilize = gains.rate, gains.stabilize
        self._roll = Cascade(rate.ailerons, stabilize.ailerons, ROLL_RATE_LIMIT_DEG_S)
        self._pitch = Cascade(rate.elevator, stabilize.elevator, PITCH_RATE_LIMIT_DEG_S)
        self._yaw = YawDamper(rate.rudder or _NO_GAINS)

    def _on_orientation(self, command: OrientationCommand) -> None:
        executor = self._executor
        # A phone's frame could carry a sequence too; only the board's is valid.
        if (
            not self._is_board_ready
            or command.sequence is None
            or executor.origin.role is not Role.BOARD
        ):
            return
        # Without rates the sticks pass through.
        mode = "ACRO" if command.roll_rate_deg_s is None else "FBW"
        rx = self.rx.fresh(self.FLIGHT_MODES[mode]["rx"])
        reading = self.orientation.fresh(self.FLIGHT_MODES["FBW"]["orientation"])
        if rx is None or reading is None or reading.value is not command:
            return
        now_s = reading.time_s
        dt_s = now_s - self._computed_at_s
        self._computed_at_s = now_s
        if dt_s > MAX_STEP_S or self.flight_mode in (None, "ACRO"):
            # The controllers paused: their state belongs to an earlier part of the flight.
            self._reset()
            dt_s = min(dt_s, MAX_STEP_S)
        self.flight_mode = mode
        if mode == "ACRO":
            output = _pass_through(command.sequence, rx.value)
        else:
            output = self._fly_by_wire(command, rx.value, max(dt_s, MIN_STEP_S))
        self.outputs += 1
        executor.execute_command(output, self._origin)

    def _fly_by_wire(self, attitude: OrientationCommand, rx: Any, dt_s: float) -> OutputCommand:
        ailerons_us = self._roll.hold_angle(
            sticks.roll_deg(rx.ailerons_us, self._limits),
            attitude.roll_deg,
            attitude.roll_rate_deg_s or 0.0,
            dt_s,
        )
        wanted_deg_s = self._pitch.rate_towards(
            sticks.pitch_deg(rx.elevator_us, self._limits), attitude.pitch_deg, dt_s
        )
        elevator_us = self._pitch.hold_rate(
            pitch_rate_in_turn(wanted_deg_s, attitude.roll_deg, attitude.yaw_rate_deg_s or 0.0),
            attitude.pitch_rate_deg_s or 0.0,
            dt_s,
        )
        damping_us = self._yaw.deflection_us(attitude.yaw_rate_deg_s or 0.0, dt_s)
        return OutputCommand(
            _pulse(sticks.CENTRE_US + ailerons_us),
            _pulse(sticks.CENTRE_US + elevator_us),
            STICK_THROTTLE,
            _pulse(rx.rudder_us + damping_us),
            attitude.sequence or 0,
        )

    def _reset(self) -> None:
        self._roll.reset()
        self._pitch.reset()
        self._yaw.reset()

    def _on_flight_state(self, command: FlightStateCommand) -> None:
        ready = command.flight_mode == "OUTPUT"
        was_ready, self._is_board_ready = self._is_board_ready, ready
        if was_ready or not ready:
            # Not at the first state: its first Output takes control.
            self._log_change_of_control()
        is_news, self._state = command != self._state, command
        if not command.is_auto:
            self._is_asked = True
        if command.is_auto and not ready and self._is_asked:
            self._request_control(is_news)

    def _log_change_of_control(self) -> None:
        owner = self.up.command_executor.control.owner
        if not self._is_board_ready:
            text = _NOT_PERMITTED
        elif self.is_flying:
            text = "flies"
        else:
            text = f"does not fly: {owner or 'no module'} has control"
        if text != self._logged:
            self._logged = text
            self.log.info(
                "{text}",
                text=text,
                code="control_changed",
                flies=self._is_board_ready and self.is_flying,
                permitted=self._is_board_ready,
                owner=owner,
            )

    def _request_control(self, at_once: bool) -> None:
        """Request AUTO from the board: after a state change, and periodically in case of loss."""
        now_s = self.context.reactor.seconds()
        if at_once or now_s - self._asked_at_s >= REQUEST_PERIOD_S:
            self._asked_at_s = now_s
            self.up.command_executor.execute_command(FlightModeCommand("AUTO"))

    def _on_flight_mode(self, command: FlightModeCommand) -> None:
        # The board accepts a mode only with the switch at AUTO; a refused mode does not count.
        if self._state is not None and self._state.is_auto:
            self._is_asked = command.mode == "AUTO"

    def _on_limits(self, command: FlyByWireLimitsCommand) -> None:
        self._limits = sticks.Limits.of(command)

    def _on_tunings(self, command: PIDTuningsCommand) -> Deferred[None] | None:
        gains = command.gains
        if gains is not None:
            refuse_unused(gains, self.gains)
            self.gains = gains.completed(self.gains)
            self._roll.tune(self.gains.rate.ailerons, self.gains.stabilize.ailerons)
            self._pitch.tune(self.gains.rate.elevator, self.gains.stabilize.elevator)
            self._yaw.tune(self.gains.rate.rudder or _NO_GAINS)
            self.log.info("flies with other gains", code="gains_changed")
            return self._gains_store.save(self.gains).addCallbacks(self._on_saved, self._on_unsaved)
        if self.mission_control is None:
            raise CommandRefusedError("no ground station is configured", Code.UNAVAILABLE)
        if not self.mission_control.send_command(PIDTuningsValuesCommand.of(self.gains)):
            raise CommandRefusedError("the ground station is not connected", Code.UNAVAILABLE)
        return None

    def _on_saved(self, _: None) -> None:
        self.up.vetoes.clear("pids.yml")

    def _on_unsaved(self, failure: Failure) -> Failure:
        self.log.error("{reason}", reason=failure.getErrorMessage(), code="gains_not_saved")
        return failure


def _pass_through(sequence: int, rx: Any) -> OutputCommand:
    return OutputCommand(
        _pulse(rx.ailerons_us),
        _pulse(rx.elevator_us),
        STICK_THROTTLE,
        _pulse(rx.rudder_us),
        sequence,
    )


def _pulse(us: float) -> int:
    if us >= MAX_US:
        return MAX_US
    return round(us) if us > MIN_US else MIN_US
