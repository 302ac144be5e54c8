"""Sends the measured airspeed to the Arduino: it tells an acceleration from a pitch angle."""

import math

from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import pack_airspeed
from up.base_started_module import BaseStartedModule
from up.flight_modes.navigation_state import NavigationState
from up.mode import WITH_BOARD
from up.needs import needs
from up.providers.base_provider import BaseProvider, Reading

PERIOD_S = 0.2
"""The board takes one in each cycle of its filter, which lasts 0.29 s."""
MAX_WIND_SD_M_S = 2.0


class ArduinoAirspeed(BaseStartedModule):
    """Sends the airspeed of the reading ``navigation`` as `A`; never in thesis framing."""

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    def on_start(self) -> bool:
        self._sent_s = -math.inf
        if self.arduino.is_checked:
            for provider in self.up.get_modules(BaseProvider):
                if provider.READING == "navigation":
                    provider.subscribe(self.on_navigation)
        return True

    def on_navigation(self, reading: Reading[NavigationState]) -> None:
        """Send an airspeed that the board may trust."""
        state = reading.value
        payload = payload_of(state)
        if payload is not None and state.time_s - self._sent_s >= PERIOD_S:
            self._sent_s = state.time_s
            self.arduino.send_stream("A", payload)


def payload_of(state: NavigationState) -> bytes | None:
    """Return the payload of `A`; None without an airspeed that a fix has measured.

    The airspeed of the estimator's model is not a measurement: it follows the board's pitch, whose
    error the board would find confirmed.
    """
    airspeed_m_s = state.measured_airspeed_m_s
    if airspeed_m_s is None or state.wind_sd_m_s > MAX_WIND_SD_M_S:
        return None
    return pack_airspeed(airspeed_m_s)
