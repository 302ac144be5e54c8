"""From the demand of a flight mode to what the board carries out."""

from dataclasses import replace

from raspilot.flight_controller.attitude_controller import AttitudeController
from raspilot.flight_controller.board_authority import BoardAuthority
from raspilot.navigation.path_controller import PathController
from up.commands.output_command import OutputCommand, SetpointCommand
from up.flight_modes.demand import AttitudeDemand, Demand, PathDemand, SurfacesDemand
from up.flight_modes.flight_mode import FlightSituation
from up.flight_modes.navigation_file import NavigationConfig
from up.flight_modes.selector import DemandError

PATH_PAUSE_S = 0.5
"""A longer pause resets the path controller."""


class DemandConverter:
    """Turns demands into Outputs, or into set-points without a controller on the Raspberry Pi."""

    def __init__(
        self,
        config: NavigationConfig,
        board: BoardAuthority,
        controller: AttitudeController | None,
    ) -> None:
        self._board = board
        self._controller = controller
        self._has_motor = config.performance.motor
        self._path_controller = PathController(config)
        self._path_at_s = float("-inf")

    def convert(
        self, demand: Demand, situation: FlightSituation, dt_s: float
    ) -> OutputCommand | SetpointCommand:
        """Return what carries out a demand after ``dt_s``; raises DemandError."""
        if isinstance(demand, PathDemand):
            demand = self._attitude_of(demand, situation, dt_s)
        # In receiver failsafe the board follows nothing but set-points that are marked so.
        if self._controller is not None and not self._board.is_failsafe:
            return self._controller.output(demand, situation.orientation, dt_s)
        if isinstance(demand, SurfacesDemand):
            raise DemandError("the Arduino's control loop takes attitudes, not surfaces")
        throttle = None if demand.throttle is None else max(0.0, min(1.0, demand.throttle))
        return SetpointCommand(
            max(-90.0, min(90.0, demand.roll_deg)),
            max(-90.0, min(90.0, demand.pitch_deg)),
            throttle_us=None if throttle is None else round(1000 + 1000 * throttle),
            is_failsafe=self._board.is_failsafe,
        )

    def _attitude_of(
        self, demand: PathDemand, situation: FlightSituation, dt_s: float
    ) -> AttitudeDemand:
        navigation, home = situation.navigation, situation.home
        if navigation is None:
            raise DemandError("a path needs a position", "navigation")
        if situation.time_s - self._path_at_s > PATH_PAUSE_S:
            self._path_controller.reset()
        self._path_at_s = situation.time_s
        home_altitude_m = None if home is None else home.altitude_m
        attitude = self._path_controller.step(demand, navigation, dt_s, home_altitude_m)
        return attitude if self._has_motor else replace(attitude, throttle=None)
