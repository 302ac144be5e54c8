"""CIRCLE: a gentle turn that needs no position."""

from raspilot.navigation.airframe_model import AirframeModel, load_of
from up.config import ConfigFile, key
from up.flight_modes.demand import AttitudeDemand, Bank, Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode, FlightSituation
from up.flight_modes.navigation_file import NAVIGATION
from up.quick_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class CircleConfig:
    """The mode CIRCLE."""

    bank_deg: float = key(
        20.0, "Bank, right wing down positive.", unit="deg", minimum=-35, maximum=35
    )


CIRCLE = ConfigFile("circle.yml", CircleConfig)
MAX_ALTITUDE_SD_M = 25.0
"""Above it the altitude is unknown; without barometer and fixes after about 25 s."""


class CircleMode(FlightMode):
    """Banks and holds the altitude at entry, by dead reckoning too; else it glides, motor off."""

    NAME = "CIRCLE"
    FALLBACK = "GLIDE"
    CONFIG = CIRCLE

    def enter(self, situation: FlightSituation) -> None:
        self._altitude_m: float | None = None

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        state, bank_deg = situation.navigation, self.config.bank_deg
        if state is None or state.altitude_sd_m > MAX_ALTITUDE_SD_M:
            self._altitude_m = None
            model = AirframeModel(self.context.config(NAVIGATION))
            pitch_deg = model.glide_pitch_deg(model.speeds.minimum_m_s * 1.1, load_of(bank_deg))
            return AttitudeDemand(bank_deg, pitch_deg, 0.0)
        if self._altitude_m is None:
            self._altitude_m = state.altitude_m
        return PathDemand(Bank(bank_deg), self._altitude_m)
