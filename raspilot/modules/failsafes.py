"""Flies home, or what failsafe.yml says, when something fails in flight."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from twisted.internet.defer import maybeDeferred
from twisted.internet.task import LoopingCall
from twisted.python.failure import Failure

from raspilot.failsafe.config import FAILSAFE, WARN
from raspilot.failsafe.engine import FailsafeEngine
from raspilot.failsafe.fence import FenceWatch
from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.return_home import RETURN, Return
from up.base_started_module import BaseStartedModule
from up.fields import suggestion
from up.flight_modes.flight_mode import FlightMode
from up.mode import WITH_BOARD, Mode
from up.needs import needs
from up.providers.base_mission_control_provider import BaseMissionControlProvider
from up.providers.base_provider import BaseProvider

PERIOD_S = 0.2


class Failsafes(BaseStartedModule):
    """Watches the triggers of failsafe.yml in flight at AUTO, or without the receiver.

    With the switch elsewhere the pilot flies and nothing acts. A trigger's action is a flight
    mode, selected like one by the ground.
    """

    MODES: ClassVar[frozenset[Mode]] = WITH_BOARD
    LOAD_ORDER: ClassVar[int] = 200
    CONFIG = FAILSAFE

    flight = needs(FlightModeManager)

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self._acting: str | None = None
        self._is_entering = False
        self._choices = 0
        self._was_linked = False
        self._reported: list[str] = []

    def on_init(self) -> None:
        self._engine = FailsafeEngine(self.config.triggers)
        self._fence = FenceWatch(self.config.fence)
        self._grounds = self.up.get_modules(BaseMissionControlProvider)
        self._batteries = [
            each for each in self.up.get_modules(BaseProvider) if each.READING == "battery"
        ]
        for number, problem in enumerate(self._contradictions()):
            self.up.vetoes.set(f"failsafe.yml.{number}", problem)
        reactor = self.context.reactor
        self._seconds = reactor.seconds
        self._loop = LoopingCall(self._check)
        self._loop.clock = reactor

    def on_start(self) -> bool:
        self._loop.start(PERIOD_S, now=False)
        return True

    def on_stop(self) -> None:
        if self._loop.running:
            self._loop.stop()

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the failures, and the one because of which the present mode flies."""
        cause = self._acting if self.flight.is_flying else None
        return {"failsafe": {"active": self._engine.active, "cause": cause}}

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

    def _check(self) -> None:
        flight, state = self.flight, self.flight.board.state
        if state is None or not state.is_in_flight:
            self._engine.update(self._seconds(), {})
            self._acting, self._was_linked = None, False
            self._report()
            return
        self._engine.update(self._seconds(), self._conditions())
        self._report()
        if self._is_entering:
            return
        if flight.choices != self._choices:
            self._choices = flight.choices
            self._acting = None
            self._engine.override()
        if state.is_auto or state.is_failsafe:
            by_sticks = flight.is_flown_by_sticks
            code = self._engine.wanted(
                self._acting, ("uplink_lost",) if by_sticks else ("receiver_lost",)
            )
            if code is not None:
                self._act(code)

    def _conditions(self) -> dict[str, bool]:
        flight, limits = self.flight, self.config.phone_battery
        situation = flight.situation
        is_linked = any(each.wants_telemetry for each in self._grounds)
        # A restart in flight does not forget that there was a ground.
        self._was_linked = self._was_linked or is_linked or flight.is_resumed
        levels = [each.fresh(each.MAX_AGE_S) for each in self._batteries]
        return {
            "fence": situation is not None
            and self._fence.is_crossed(situation.navigation, situation.home),
            "receiver_lost": flight.board.is_failsafe,
            "uplink_lost": self._was_linked and not is_linked,
            "phone_battery": any(
                level is not None and level.value < limits.below_percent for level in levels
            ),
        }

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
        if active != self._reported:
            self._reported = list(active)
            self.log.warn("failures: {active}", active=active, code="failsafe_active")
