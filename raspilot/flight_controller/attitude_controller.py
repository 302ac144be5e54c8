"""The control loop on the Raspberry Pi: from an attitude to servo positions (thesis 3.3.2)."""

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from raspilot.flight_controller import sticks
from raspilot.flight_controller.cascade import Cascade, YawDamper, pitch_rate_in_turn
from raspilot.navigation.limits import limited
from up.base_module import BaseModule
from up.commands.flight_state_command import FlyByWireLimitsCommand
from up.commands.gains import Gains
from up.commands.orientation_command import OrientationCommand
from up.commands.output_command import OutputCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import Code, CommandRefusedError
from up.flight_controller.gains_store import GainsStore, refuse_unused
from up.flight_controller.pids_file import PidsFile
from up.flight_modes.demand import AttitudeDemand, SurfacesDemand
from up.flight_modes.selector import DemandError
from up.mode import WITH_BOARD
from up.needs import wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider

ROLL_RATE_LIMIT_DEG_S = 120.0
INVERTED_ROLL_RATE_LIMIT_DEG_S = 225.0
PITCH_RATE_LIMIT_DEG_S = 80.0
CENTRE_US = 1500
MIN_US, MAX_US = 1000, 2000
STICK_THROTTLE = 0
_NO_GAINS = Gains(0.0)


class AttitudeController(BaseModule):
    """Turns the demands of flight modes into Outputs, with gains that the ground may set.

    The rudder is the pilot's, plus a yaw damper. An attitude is held within the limits of Fly By
    Wire, as the board holds set-points. Loaded with ``flight controller: raspberry``.
    """

    MODES = WITH_BOARD

    mission_control = wants(BaseMissionControlProvider)

    def load(self) -> bool:
        """Return whether the configuration moved the control loop to the Raspberry Pi."""
        return self.context.application.flight_controller == "raspberry"

    def on_init(self) -> None:
        pids = PidsFile(self.context.config_folder)
        self._store = GainsStore(pids, self.context.reactor)
        self.gains, problem = pids.load()
        if problem:
            self.log.error("{reason}", reason=str(problem), code="gains_invalid")
            self.up.vetoes.set("pids.yml", str(problem))
        rate, stabilize = self.gains.rate, self.gains.stabilize
        self._roll = Cascade(rate.ailerons, stabilize.ailerons, ROLL_RATE_LIMIT_DEG_S)
        self._pitch = Cascade(rate.elevator, stabilize.elevator, PITCH_RATE_LIMIT_DEG_S)
        self._yaw = YawDamper(rate.rudder or _NO_GAINS)
        self._is_reset = True
        self._limits = sticks.DEFAULT_LIMITS
        self.up.command_executor.register_command(PIDTuningsCommand, self._on_tunings)
        self.up.command_executor.register_command(FlyByWireLimitsCommand, self._on_limits)

    def reset(self) -> None:
        """Forget what belongs to an earlier part of the flight."""
        if not self._is_reset:
            self._roll.reset()
            self._pitch.reset()
            self._yaw.reset()
            self._is_reset = True

    def output(
        self, demand: AttitudeDemand | SurfacesDemand, attitude: OrientationCommand, dt_s: float
    ) -> OutputCommand:
        """Return the Output for a demand, from the board's frame ``attitude``.

        Raises DemandError with the code ``rates`` for an attitude, if the frame has no rates.
        """
        throttle_us = STICK_THROTTLE
        if demand.throttle is not None:
            throttle_us = _pulse(MIN_US + demand.throttle * (MAX_US - MIN_US))
        if isinstance(demand, SurfacesDemand):
            self.reset()
            ailerons_us: float = demand.ailerons_us
            elevator_us: float = demand.elevator_us
            rudder_us: float = demand.rudder_us
        else:
            self._is_reset = False
            roll_rate, yaw_rate = attitude.roll_rate_deg_s, attitude.yaw_rate_deg_s
            pitch_rate = attitude.pitch_rate_deg_s
            if roll_rate is None or pitch_rate is None or yaw_rate is None:
                raise DemandError("the board's frame has no rotation rates", "rates")
            roll_deg = attitude.roll_deg
            limits = self._limits
            bank_deg = limited(demand.roll_deg, -limits.roll_deg, limits.roll_deg)
            nose_deg = limited(demand.pitch_deg, -limits.pitch_down_deg, limits.pitch_up_deg)
            is_inverted = abs(roll_deg) >= 90
            self._roll.stabilize.limit = (
                INVERTED_ROLL_RATE_LIMIT_DEG_S if is_inverted else ROLL_RATE_LIMIT_DEG_S
            )
            ailerons_us = CENTRE_US + self._roll.hold_angle(bank_deg, roll_deg, roll_rate, dt_s)
            wanted_deg_s = self._pitch.stabilize.step(nose_deg, attitude.pitch_deg, dt_s)
            turn_deg_s = pitch_rate_in_turn(wanted_deg_s, roll_deg, yaw_rate)
            elevator_us = CENTRE_US + self._pitch.hold_rate(turn_deg_s, pitch_rate, dt_s)
            rudder_us = demand.rudder_us + self._yaw.deflection_us(yaw_rate, dt_s)
        return OutputCommand(
            _pulse(ailerons_us),
            _pulse(elevator_us),
            throttle_us,
            _pulse(rudder_us),
            attitude.sequence or 0,
        )

    def _on_limits(self, command: FlyByWireLimitsCommand) -> None:
        self._limits = sticks.Limits.of(command)

    def _on_tunings(self, command: PIDTuningsCommand) -> Deferred[None] | None:
        gains = command.gains
        if gains is not None:
            refuse_unused(command, gains, self.gains)
            self.gains = gains.completed(self.gains)
            self._roll.tune(self.gains.rate.ailerons, self.gains.stabilize.ailerons)
            self._pitch.tune(self.gains.rate.elevator, self.gains.stabilize.elevator)
            self._yaw.tune(self.gains.rate.rudder or _NO_GAINS)
            self.log.info("flies with other gains", code="gains_changed")
            return self._store.save(self.gains).addCallbacks(self._on_saved, self._on_unsaved)
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


def _pulse(us: float) -> int:
    if us >= MAX_US:
        return MAX_US
    return round(us) if us > MIN_US else MIN_US
