"""Sends the measured airspeed to the Arduino, whose attitude needs it."""

from __future__ import annotations

import math

from arduino_cog.modules.arduino_provider import ArduinoProvider
from arduino_cog.wire import pack_airspeed
from up.base_started_module import BaseStartedModule
from up.flight_modes.navigation_state import NavigationState
from up.mode import WITH_BOARD
from up.needs import needs
from up.providers.base_provider import BaseProvider, Reading

PERIOD_S = 0.2
"""The board takes one in each cycle of its filter, 286 ms."""
MAX_WIND_SD_M_S = 2.0


class ArduinoAirspeed(BaseStartedModule):
    """Sends the airspeed of the reading ``navigation`` as `V` five times a second.

    Only one that a fix has measured: that of the estimator's model follows the board's pitch, and
    the board would find its own error confirmed. Not in thesis framing.
    """

    MODES = WITH_BOARD

    arduino = needs(ArduinoProvider)

    def on_init(self) -> None:
        self._sent_s = -math.inf

    def on_start(self) -> bool:
        if self.arduino.is_checked:
            for provider in self.up.get_modules(BaseProvider):
                if provider.READING == "navigation":
                    provider.subscribe(self.on_navigation)
        return True

    def on_navigation(self, reading: Reading[NavigationState]) -> None:
        state = reading.value
        airspeed_m_s = state.measured_airspeed_m_s
        if airspeed_m_s is None or state.wind_sd_m_s > MAX_WIND_SD_M_S:
            return
        if state.time_s - self._sent_s < PERIOD_S:
            return
        self._sent_s = state.time_s
        self.arduino.send_stream("V", pack_airspeed(airspeed_m_s))
