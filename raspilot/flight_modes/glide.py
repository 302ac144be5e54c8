"""GLIDE: motor off, towards home."""

from raspilot.navigation.airframe_model import AirframeModel, load_of
from raspilot.navigation.planning import airspeed_for_wind_m_s, circle_around, course_to_deg
from up.flight_modes.demand import AttitudeDemand, Bank, Circle, Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation
from up.flight_modes.navigation_file import NAVIGATION

RADIUS_M = 50.0
AIRSPEED_PERIOD_S = 1.0
BANK_DEG = 10.0
"""A gentle turn where home is unknown: it stays near."""


class Glide(FlightMode):
    """Flies to home at the flattest glide for the wind and circles there; else a gentle turn."""

    NAME = "GLIDE"
    FALLBACK = ""

    def enter(self, situation: FlightSituation) -> None:
        self._circle: Circle | None = None
        self._chosen_s = float("-inf")

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        state, home = situation.navigation, situation.home
        config = self.context.config(NAVIGATION)
        best_m_s = max(config.airspeed.minimum_m_s, config.airspeed.best_glide_m_s)
        if state is None:
            self._circle = None
            pitch_deg = AirframeModel(config).glide_pitch_deg(best_m_s, load_of(BANK_DEG))
            return AttitudeDemand(BANK_DEG, pitch_deg, 0.0)
        if home is None:
            return PathDemand(Bank(BANK_DEG), airspeed_m_s=best_m_s, motor=False)
        if self._circle is None or self._circle.centre != home.point:
            self._circle = circle_around(config, state, home.point, RADIUS_M)
        if situation.time_s - self._chosen_s >= AIRSPEED_PERIOD_S:
            self._chosen_s = situation.time_s
            course_deg, wind = course_to_deg(state.position, home.point), state.wind_m_s
            self._airspeed_m_s = airspeed_for_wind_m_s(config, course_deg, wind, motor=False)
        return PathDemand(self._circle, airspeed_m_s=self._airspeed_m_s, motor=False)
