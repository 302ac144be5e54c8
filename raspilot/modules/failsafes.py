"""Flies home, or what failsafe.yml says, when something fails in flight."""

from collections.abc import Iterator, Mapping
from typing import Any

from twisted.internet.defer import maybeDeferred
from twisted.python.failure import Failure

from raspilot.failsafe.config import FAILSAFE, WARN
from raspilot.failsafe.engine import FailsafeEngine
from raspilot.failsafe.fence import FenceWatch
from raspilot.failsafe.progress import ProgressWatch
from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.return_home import RETURN, Return
from raspilot.modules.plans import Plans
from up.base_periodic_module import BasePeriodicModule
from up.failures import FailureSource
from up.fields import suggestion
from up.flight_modes.flight_mode import FlightMode
from up.flight_modes.navigation_file import NAVIGATION
from up.log.limits import Once
from up.mode import WITH_BOARD
from up.needs import needs, wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider


class Failsafes(BasePeriodicModule):
    """Watches the triggers of failsafe.yml in flight at AUTO, or without the receiver.

    With the switch elsewhere the pilot flies and nothing acts. A trigger's action is a flight
    mode, selected like one by the ground.
    """

    MODES = WITH_BOARD
    LOAD_ORDER = 200
    PERIOD_S = 0.2
    CONFIG = FAILSAFE
    IS_SET_BY_GROUND = True

    flight = needs(FlightModeManager)
    plans = wants(Plans)

    def on_init(self) -> None:
        self._acting: str | None = None
        self._is_entering = False
        self._choices = 0
        self._was_linked = False
        self._logged: list[str] = []
        self._said = Once()
        self._engine = FailsafeEngine(self.config.triggers)
        fence = self.config.fence
        self._fence = FenceWatch(fence)
        limits = {"radius": fence.radius_m, "ceiling": fence.ceiling_m, "floor": fence.floor_m}
        # Every frame has them: those that are not set cost nothing.
        self._limits = {name: each for name, each in limits.items() if each is not None}
        self.flight.home.is_outside = self._fence.is_outside
        self._progress = ProgressWatch(self.context.config(NAVIGATION))
        self._grounds = self.up.get_modules(BaseMissionControlProvider)
        self._sources = self.up.get_modules(FailureSource)
        for number, problem in enumerate(self._contradictions()):
            self.up.vetoes.set(f"failsafe.yml.{number}", problem)
        self._seconds = self.context.reactor.seconds

    def on_start(self) -> None:
        reported = self._reported_failures()
        for code in self.config.others.keys() - reported.keys():
            hint = suggestion(code, reported)
            text = f"failsafe.yml: others: {code}: no module reports this failure{hint}"
            self.up.vetoes.set(f"failsafe.yml.{code}", text)
        super().on_start()

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the failures, the one because of which the present mode flies, and the fence."""
        cause = self._acting if self.flight.is_flying else None
        return {
            "failsafe": {"active": self._engine.active, "cause": cause},
            "fence": {"margin": self._fence.margin_m, **self._limits},
        }

    def _contradictions(self) -> Iterator[str]:
        modes = {each.NAME for each in self.up.get_modules(FlightMode)}
        actions = {code: each.action for code, each in self.config.triggers.items()}
        for code, action in actions.items():
            if action != WARN and action not in modes:
                hint = suggestion(action, [WARN, *modes])
                yield f"failsafe.yml: {code}: action: no flight mode {action!r} is loaded{hint}"
        if Return.NAME not in actions.values():
            return
        fence, home = self.config.fence, self.context.config(RETURN)
        borders = (
            ("ceiling_m", "height_m", fence.ceiling_m is None or fence.ceiling_m > home.height_m),
            ("floor_m", "height_m", fence.floor_m is None or fence.floor_m < home.height_m),
            ("radius_m", "radius_m", fence.radius_m is None or fence.radius_m > home.radius_m),
        )
        for border, limit, is_inside in borders:
            if not is_inside:
                yield (
                    f"failsafe.yml: fence: {border}: {getattr(fence, border):g} m: RETURN would"
                    f" cross it (return.yml: {limit}: {getattr(home, limit):g} m)"
                )

    def on_period(self) -> None:
        flight, state = self.flight, self.flight.board.state
        if state is None or not state.is_in_flight:
            self._engine.update(self._seconds(), {})
            self._acting, self._was_linked = None, False
            self._report()
            return
        if flight.choices != self._choices and not self._is_entering:
            self._choices = flight.choices
            self._acting = None
            self._engine.override()
        self._engine.update(self._seconds(), self._conditions())
        self._report()
        if self._is_entering:
            return
        if (state.is_auto or state.is_failsafe) and not flight.is_uninterrupted:
            by_sticks = flight.is_flown_by_sticks
            code = self._engine.wanted(
                self._acting, ("uplink_lost",) if by_sticks else ("receiver_lost",)
            )
            if code is not None:
                self._act(code)

    def _conditions(self) -> dict[str, bool]:
        flight, situation = self.flight, self.flight.situation
        is_linked = any(each.has_ground for each in self._grounds)
        # A restart in flight does not forget that there was a ground.
        self._was_linked = self._was_linked or is_linked or flight.is_resumed
        state = None if situation is None else situation.navigation
        demand = flight.path_demand if flight.acting_mode else None
        if self.plans is not None:
            borders: Any = self.plans.fences.items
            self._fence.use(borders)
        return {
            **self._reported_failures(),
            "fence": situation is not None
            and self._fence.is_crossed(situation.navigation, situation.home),
            "receiver_lost": flight.board.is_failsafe,
            "uplink_lost": self._was_linked and not is_linked,
            "no_progress": state is not None
            and self._progress.stalled_s(self._seconds(), demand, state) > 0.0,
        }

    def _reported_failures(self) -> dict[str, bool]:
        found: dict[str, bool] = {}
        for source in self._sources:
            try:
                found.update(source.failures)
            except (Exception, SystemExit):  # noqa: BLE001 - a fault costs one module's part only
                if self._said.first(source):
                    self.log.failure("a module's failures are unknown", code="failures_unknown")
        return found

    def _act(self, code: str) -> None:
        action = self.config.triggers[code].action
        self.log.error(
            "failsafe {failsafe}: {mode}", failsafe=code, mode=action, code="failsafe_acts"
        )
        self._is_entering = True
        entered = maybeDeferred(self.flight.enter_failsafe, action)
        entered.addCallbacks(lambda _: self._entered(code), self._refused, errbackArgs=(code,))

    def _entered(self, code: str) -> None:
        self._is_entering = False
        self._acting = code
        self._choices = self.flight.choices

    def _refused(self, failure: Failure, code: str) -> None:
        self._is_entering = False
        self._choices = self.flight.choices
        self._engine.override()
        self.log.error(
            "failsafe {failsafe} does not act: {reason}",
            failsafe=code,
            reason=failure.getErrorMessage(),
            code="failsafe_refused",
        )

    def _report(self) -> None:
        active = self._engine.active
        if active != self._logged:
            self._logged = list(active)
            self.log.warn("failures: {active}", active=active, code="failsafe_active")
