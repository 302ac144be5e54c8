"""Forbids arming while home is missing, or is outside the fence."""

from typing import Any

from raspilot.failsafe.config import FAILSAFE
from raspilot.flight_controller.flight_memory import Place
from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.return_home import RETURN, Return
from raspilot.mission.borders import leads_straight, local_borders, margin_m
from raspilot.modules.phone_watch import PHONE_LINK
from raspilot.modules.plans import Plans
from up.base_periodic_module import BasePeriodicModule
from up.commands.system_commands import LinkStateCommand
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import LocalFrame, Point
from up.mission.items import Border
from up.mode import WITH_BOARD
from up.needs import needs, wants
from up.providers.up_location_provider import UpLocationProvider

HOME = Point(0.0, 0.0)


class HomeChecks(BasePeriodicModule):
    """Checks home on the ground; in flight nothing changes.

    Home is required where a failsafe flies RETURN and a position can be expected: a phone is
    connected, or a location has arrived. A pilot without either flies by hand, where no mode needs
    home. Home must be inside the fence, and by the radius of RETURN's circle if a failsafe uses it.
    """

    MODES = WITH_BOARD
    LOAD_ORDER = 210
    PERIOD_S = 0.5

    flight = needs(FlightModeManager)
    location = wants(UpLocationProvider)
    plans = wants(Plans)

    def on_init(self) -> None:
        self._has_phone = False
        self._checked: tuple[Place | None, tuple[Border, ...]] | None = None
        failsafes = self.context.config(FAILSAFE).triggers.values()
        self._returns = any(each.action == Return.NAME for each in failsafes)
        self._navigation = self.context.config(NAVIGATION)
        self.up.command_executor.register_command(LinkStateCommand, self._on_link)

    def on_fault(self) -> None:
        self.up.vetoes.set("home", "its checks failed; see the log")

    def _on_link(self, command: LinkStateCommand) -> None:
        if command.link == PHONE_LINK:
            self._has_phone = command.connected

    def on_period(self) -> None:
        state, place = self.flight.board.state, self.flight.home.place
        if state is not None and state.is_in_flight:
            return
        if place is None and self._is_needed:
            self.up.vetoes.set(
                "home",
                "not set, and a failsafe flies RETURN: wait for a position accurate to"
                f" {self._navigation.home_accuracy_m:g} m (navigation.yml: home_accuracy_m,"
                " arm_without_home)",
            )
        else:
            self.up.vetoes.clear("home")
        fence: Any = () if self.plans is None else self.plans.fences.items
        if (place, fence) != self._checked:
            self._checked = place, fence
            self._check_fence(place, fence)

    @property
    def _is_needed(self) -> bool:
        has_location = self.location is not None and self.location.reading is not None
        return (
            self._returns
            and (self._has_phone or has_location)
            and not self._navigation.arm_without_home
        )

    def _check_fence(self, place: Place | None, fence: tuple[Border, ...]) -> None:
        self.up.vetoes.clear("fence")
        if place is None:
            return
        frame = LocalFrame(place.latitude_deg, place.longitude_deg)
        borders = local_borders(fence, frame)
        inside_m = margin_m(borders, HOME)
        radius_m = self.context.config(RETURN).radius_m
        where = f"home ({place.latitude_deg:.5f}, {place.longitude_deg:.5f}) is"
        if inside_m < 0.0:
            self.up.vetoes.set(
                "fence",
                f"{where} {-inside_m:.0f} m outside: move home, or upload another fence",
            )
        elif self._returns and inside_m < radius_m:
            self.up.vetoes.set(
                "fence",
                f"{where} {inside_m:.0f} m inside: RETURN would cross it (return.yml: radius_m:"
                f" {radius_m:g} m)",
            )
        elif self._returns and not leads_straight(borders, HOME):
            self.log.warn(
                "RETURN flies straight home, from parts of the fence across its border",
                code="return_crosses_fence",
            )
