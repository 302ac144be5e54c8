"""The one place that decides what the aircraft does at AUTO, and publishes it."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

from twisted.internet.defer import Deferred
from twisted.internet.task import deferLater

from raspilot.flight_controller.attitude_controller import AttitudeController
from raspilot.flight_controller.board_authority import BoardAuthority
from raspilot.flight_controller.demand_converter import DemandConverter
from raspilot.flight_controller.flight_memory import MEMORY, Place
from raspilot.flight_controller.flight_target import FlightTarget
from raspilot.flight_controller.home import HomeKeeper, target_of_place, telemetry_of
from raspilot.flight_controller.required import check_required
from raspilot.flight_modes.guided import GUIDED, Guided
from raspilot.modules.navigation_estimator import NavigationEstimator
from up.commands.flight_state_command import FlightModeCommand, FlightStateCommand
from up.commands.location_command import LocationCommand
from up.commands.navigation_commands import HomeCommand, NavigationTargetCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.output_command import OutputCommand, SetpointCommand
from up.commands.refusal import CommandRefusedError
from up.commands.roles import Role
from up.flight_controller.base_board import BaseBoard, ground_modes
from up.flight_controller.base_flight_controller import BaseFlightController
from up.flight_modes.declarations import AUTO, auto_mode_problem
from up.flight_modes.demand import Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation, Target
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import NavigationState
from up.flight_modes.selector import FlightModeSelector
from up.mode import WITH_BOARD
from up.needs import wants
from up.providers.base_provider import Reading
from up.providers.up_location_provider import UpLocationProvider

MIN_STEP_S, MAX_STEP_S = 1e-3, 0.25
ATTITUDE_PAUSE_S = 0.1
"""A longer pause resets the control loop; in Panic Mode the board's frames come every 150 ms."""
FOLLOW_S = 1.0
"""The board reports five times a second whether it follows."""
RESUME_S = 3.0
"""After a restart in flight the readings get this time before a fallback acts."""
MAX_RX_AGE_S, MAX_NAVIGATION_AGE_S = 0.25, 3.0
MAX_DEAD_RECKONING_S = 120.0
"""How long without a fix the modes get the estimate; those that need a fix end earlier."""


class FlightModeManager(BaseFlightController):
    """Runs the selected flight mode on every orientation frame while the board lets the Pi fly.

    Its demand becomes an Output (``flight controller: raspberry``) or a set-point (``arduino``).
    Without a mode that can act, or from an orientation that is not the board's, nothing is
    published: the board's own failsafe acts. When the switch leaves AUTO, the selection ends.
    ``choices`` counts the selections by the pilot, the ground and the failsafes; ``path_demand`` is
    the newest demand, None for one without a path.
    """

    MODES = WITH_BOARD
    LOAD_ORDER = 100
    CONFIG = NAVIGATION
    IS_SET_BY_GROUND = True
    WRITTEN_FILES = (MEMORY,)
    SELECTS_MODES = True

    attitude_controller = wants(AttitudeController)
    location = wants(UpLocationProvider)
    estimator = wants(NavigationEstimator)

    def on_init(self) -> None:
        super().on_init()
        self.published = 0
        self.choices = 0
        self.is_resumed = False
        self.path_demand: PathDemand | None = None
        self._is_asked = True
        self._has_begun = False
        self._stepped_at_s = float("-inf")
        self._resumed_at_s = float("-inf")
        self._situation: FlightSituation | None = None
        self._target: Target | None = None
        self._resumed_place: Place | None = None
        self._requests: dict[str, float] = {}
        self._continuing = ""
        self._ground_modes = ground_modes(self.up.get_modules(BaseBoard))
        self._selector = FlightModeSelector(self.up.get_modules(FlightMode), self._is_fresh)
        for path, problem in self._selector.problems.items():
            self.log.error("{problem}", problem=problem, module=path, code="mode_invalid")
            self.up.vetoes.set(path, problem)
        modes, auto = self._selector.modes, self.config.auto_mode
        self._auto = auto if auto in modes else None
        problem_of_auto = auto_mode_problem(auto, {*modes, *self._ground_modes})
        if problem_of_auto:
            self.up.vetoes.set("navigation.yml", problem_of_auto)
        self._selector.select(self._auto)
        # With its origin the bus need not search the publisher of each Command.
        self._origin = Origin(self.class_name, Role.INTERNAL)
        self.board = BoardAuthority(
            self.up.command_executor,
            self.context.reactor,
            self._origin,
            self.log,
            is_output=self.attitude_controller is not None,
        )
        self._converter = DemandConverter(self.config, self.board, self.attitude_controller)
        self.home = HomeKeeper(
            self.context.config_folder,
            self.context.reactor,
            self.config.home_accuracy_m,
            self._on_home_changed,
        )
        self._flight_target = FlightTarget(self.home.memory)
        self.orientation.subscribe(self._on_orientation)
        executor = self._executor = self.up.command_executor
        executor.register_command(FlightStateCommand, self._on_flight_state)
        executor.register_command(FlightModeCommand, self._on_flight_mode)
        executor.register_command(NavigationTargetCommand, self._on_target)
        executor.register_command(HomeCommand, self._on_home)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the flight modes, home and target; counts only delivered Commands."""
        dropped = self._executor.control.refused[self.class_name]
        selector = self._selector
        is_flying, target = self.is_flying, self.home.memory.values.target
        offers = selector.offers(self._situation)
        if self._auto is not None:
            missing = selector.missing_for(self._auto)
            offers = {AUTO: missing[0] if missing else None, **offers}
        return {
            "flight_control": {
                "mode": self.acting_mode,
                "selected": selector.selected,
                "fallback": selector.reason if is_flying else None,
                "modes": offers,
                "board_modes": list(self._ground_modes),
            },
            "navigation": {"target": telemetry_of(target if is_flying else None, "radius")},
            "home": self.home.telemetry(self._navigation, self.config.airspeed.cruise_m_s),
            "counters": {"flight_control": {"published": self.published - dropped}},
        }

    @property
    def acting_mode(self) -> str | None:
        """Return the flight mode that the aircraft flies now; None: none of the Raspberry Pi."""
        return self._selector.active if self.is_flying else None

    @property
    def is_flying(self) -> bool:
        """Return whether the board follows its Commands: another module may have control."""
        return self.board.is_flown

    @property
    def situation(self) -> FlightSituation | None:
        """Return what the modes saw in the newest step."""
        return self._situation

    @property
    def is_flown_by_sticks(self) -> bool:
        """Return whether the selected mode, or the board's, follows the sticks."""
        mode = self._selector.modes.get(self._selector.selected or "")
        return mode is None or "rx" in mode.NEEDS

    @property
    def is_uninterrupted(self) -> bool:
        """Return whether the selected mode permits no failsafe now."""
        mode = self._selector.modes.get(self._selector.selected or "")
        return mode is not None and mode.is_uninterrupted

    @property
    def _navigation(self) -> NavigationState | None:
        return self._estimate(MAX_NAVIGATION_AGE_S)

    def _estimate(self, max_age_s: float) -> NavigationState | None:
        provider: Any = self._providers.get("navigation")
        is_fresh = provider is not None and provider.fresh(max_age_s) is not None
        state: NavigationState | None = provider.state if is_fresh else None
        return state

    def _on_orientation(self, reading: Reading[OrientationCommand]) -> None:
        command = reading.value
        # A phone's frame could carry a sequence too; only the board's is valid.
        if command.sequence is None or self._executor.origin.role is not Role.BOARD:
            return
        estimate = self._estimate(MAX_DEAD_RECKONING_S)
        navigation = None if estimate is None else self._navigation
        self.home.update(navigation, self.board.state)
        if navigation is not None and self._resumed_place is not None:
            self._target = target_of_place(self._resumed_place, navigation.frame)
            self._resumed_place = None
        if navigation is None:
            navigation = estimate
        rx = self.rx.fresh(MAX_RX_AGE_S)
        now_s = reading.time_s
        situation = self._situation = FlightSituation(
            now_s,
            command,
            navigation,
            None if rx is None else rx.value,
            None if navigation is None else self.home.of(navigation.frame),
            self._target,
            self._requests.get("course"),
            self._requests.get("altitude"),
        )
        selector = self._selector
        if selector.selected is None or not self.board.may_publish:
            return
        dt_s = now_s - self._stepped_at_s
        self._stepped_at_s = now_s
        if dt_s > ATTITUDE_PAUSE_S and self.attitude_controller is not None:
            self.attitude_controller.reset()
        dt_s = min(dt_s, MAX_STEP_S)
        if now_s - self._resumed_at_s < RESUME_S and selector.missing_for(selector.selected):
            return
        made = selector.step(situation, max(dt_s, MIN_STEP_S), self._carry_out)
        if made is not None:
            self.published += 1
            self._executor.execute_command(made, self._origin)
        self._succeed(situation)

    def _succeed(self, situation: FlightSituation) -> None:
        """Select the mode that the one which acts has named as its successor."""
        selector = self._selector
        mode = selector.modes.get(selector.active or "")
        if mode is None or not mode.successor or selector.active != selector.selected:
            return
        goal, continuing = mode.goal, mode.NAME if mode.continues else ""
        for name in filter(None, (self._continuing, mode.successor)):
            with suppress(CommandRefusedError):
                selector.check(name, replace(situation, target=goal))
                self._select(name, is_choice=False)
                self._target, self._continuing = goal, continuing
                return

    def _carry_out(
        self, demand: Demand, situation: FlightSituation, dt_s: float
    ) -> OutputCommand | SetpointCommand:
        self.path_demand = demand if isinstance(demand, PathDemand) else None
        if self.path_demand is not None and situation.navigation is not None:
            selector = self._selector
            mode = selector.modes.get(selector.selected or "")
            self._flight_target.follow(
                self.path_demand,
                None if mode is None else mode.goal,
                situation.navigation,
                is_fallback=selector.running != selector.selected,
            )
        return self._converter.convert(demand, situation, dt_s)

    def _select(self, name: str | None, *, is_choice: bool = True) -> None:
        self.choices += is_choice
        selector = self._selector
        selector.select(name)
        self._requests.clear()
        self._continuing = ""
        self._flight_target.forget()
        if name is None or "target" not in selector.modes[name].REQUESTS:
            self._target = None
        self.home.memory.update(mode=name or "", target=None)

    def _on_flight_state(self, command: FlightStateCommand) -> None:
        was_followed = self.board.is_followed
        previous, self.board.state = self.board.state, command
        if was_followed or not self.board.is_followed:
            # Not at the first state: its first Command takes control.
            self.board.log_change()
        if not self._has_begun and command.is_in_flight is not None:
            self._has_begun = True
            if command.is_in_flight:
                self._resume(command)
            else:
                self.home.memory.clear()
        elif command.flight_mode and not command.is_auto and not command.is_failsafe:
            self._is_asked = True
            if self._selector.selected != self._auto:
                self._select(self._auto)
        if command.is_in_flight:
            self._save_barometer()
        if not command.is_auto or self.board.is_followed or self._auto is None:
            return
        if self._is_asked:
            self.board.request(command != previous)

    def _save_barometer(self) -> None:
        if self.estimator is None:
            return
        vertical = self.estimator.estimator.vertical
        if vertical.source is not None and vertical.held_offset_m is not None:
            self.home.memory.follow_barometer(vertical.source, vertical.held_offset_m)

    def _resume(self, state: FlightStateCommand) -> None:
        """Continue a flight after a restart of the program: home, target, mode."""
        memory = self.home.memory.values
        self._resumed_at_s = self.context.reactor.seconds()
        self.is_resumed = True
        self.home.resume()
        if memory.barometer is not None and self.estimator is not None:
            vertical = self.estimator.estimator.vertical
            vertical.resume(memory.barometer.source, memory.barometer.offset_m)
        name = memory.mode if state.is_auto and memory.mode in self._selector.modes else self._auto
        self._select(name)
        # Another restart may come before a position does.
        self.home.memory.update(target=memory.target)
        self._resumed_place = memory.target
        self.log.warn(
            "the program started in flight: home and flight mode {mode} are resumed",
            mode=name,
            home=self.home.place is not None,
            code="flight_resumed",
        )

    def _on_flight_mode(self, command: FlightModeCommand) -> Deferred[None] | None:
        name = command.mode
        if self._executor.origin == self._origin:
            return None
        if name == AUTO or name in self._ground_modes:
            # The board accepts a mode only with the switch at AUTO; a refused one does not count.
            if self.board.is_auto:
                self._is_asked = name == AUTO
                self._select(self._auto if name == AUTO else None)
            return None
        self._selector.check(name, self._situation)
        if self.board.state is not None and self.board.state.is_in_flight is False:
            raise CommandRefusedError(f"{name} needs an armed aircraft", detail="not_armed")
        return self._enter(name)

    def enter_failsafe(self, name: str) -> Deferred[None] | None:
        """Fly a mode, or the first of its fallbacks that does not refuse; as a Command would."""
        modes, situation = self._selector.modes, self._situation
        while situation is not None and not self._selector.missing_for(name):
            fallback = modes[name].FALLBACK
            if fallback not in modes or not modes[name].refusal(situation):
                break
            name = fallback
        return None if name == self._selector.selected else self._enter(name)

    def _enter(self, name: str) -> Deferred[None] | None:
        if self.board.is_followed:
            self._select(name)
            return None
        if self.board.is_failsafe:
            self._select(name)
            return deferLater(self.context.reactor, FOLLOW_S, self._check_followed)
        done = self._executor.execute_and_wait(FlightModeCommand(AUTO), self._origin)
        return done.addCallback(lambda _: self._select(name))

    def _check_followed(self) -> None:
        if not self.board.is_followed:
            self._select(self._auto)
            raise CommandRefusedError(
                "the board does not follow the Raspberry Pi without the receiver"
                " (airframe.yml: receiver_lost: pi_may_fly)",
                detail="not_allowed",
            )

    def _on_target(self, command: NavigationTargetCommand) -> None:
        target, situation = self.home.target_of(command, self._navigation), self._situation
        name, modes = self.acting_mode or "", self._selector.modes
        if name not in modes or "target" not in modes[name].REQUESTS:
            name = Guided.NAME
        if situation is not None and name in modes:
            self._selector.check(name, replace(situation, target=target))
        self._target = target
        if situation is not None:
            # The mode may be selected before the next step.
            self._situation = replace(situation, target=target)

    def _on_home(self, command: HomeCommand) -> None:
        self.home.set(command, self._navigation)

    def _on_home_changed(self, place: Place) -> None:
        if self.estimator is not None:
            self.estimator.home_altitude_m = place.altitude_m
        if self.location is not None:
            self.location.home = LocationCommand(
                place.latitude_deg, place.longitude_deg, place.altitude_m
            )

    def require(self, what: str, value: float) -> None:
        """Follow a course (deg) or altitude (m) that the ground requests.

        Raises CommandRefusedError unless the mode that acts follows it.
        """
        modes, limit_m = self._selector.modes, self.context.config(GUIDED).max_climb_m
        check_required(what, value, self.acting_mode, modes, self._situation, limit_m)
        self._requests[what] = value

    def required(self, what: str) -> float | None:
        """Return the course or altitude that the ground requested of the present mode."""
        return self._requests.get(what)
