"""Notices a motor that stopped silently: the energy does not follow the throttle."""

from __future__ import annotations

from raspilot.navigation.airframe_model import AirframeModel

DELAY_S = 1.0
"""From the throttle to the estimate of the climb."""
MISSING_PART = 0.5
"""A stop is suspected while more than this part of the motor's power is missing."""
MISSING_M = 1.5
"""Energy (as height) that is missing beyond that when the motor counts as stopped."""
MIN_MISSING_M_S = 0.5
"""Less is never suspected: it may be a downdraught."""
IDLE_PART, FORGET_M_S = 0.3, 0.3
"""Below this part of the power of level flight nothing is known: a suspicion fades."""
BIAS_S, MAX_BIAS_M_S = 30.0, 0.5


class EnergyWatch:
    """A cumulative sum of the missing energy; falls back to 0 when the motor pulls again.

    A steady difference between the airframe and its numbers is learned, up to 0.5 m/s.
    """

    def __init__(self, model: AirframeModel) -> None:
        self._model = model
        self.reset()

    def reset(self) -> None:
        self.is_stopped = False
        self._power_m_s: float | None = None
        self._missing_m = 0.0
        self._bias_m_s = 0.0

    def has_stopped(
        self, energy_m_s: float, throttle: float, airspeed_m_s: float, load: float, dt_s: float
    ) -> bool:
        """Return whether the motor counts as stopped, after this energy rate (m/s of climb)."""
        power_m_s = self._model.power_m_s(throttle)
        if self._power_m_s is None:
            self._power_m_s = power_m_s
        self._power_m_s += (power_m_s - self._power_m_s) * min(1.0, dt_s / DELAY_S)
        expected_m_s = self._power_m_s - self._model.sink_m_s(airspeed_m_s, load)
        residual_m_s = energy_m_s - expected_m_s - self._bias_m_s
        growth_m_s = -residual_m_s - max(MIN_MISSING_M_S, MISSING_PART * self._power_m_s)
        if self._power_m_s < IDLE_PART * self._model.power_m_s(self._model.level_throttle):
            growth_m_s = -FORGET_M_S
        missing_m = self._missing_m + growth_m_s * dt_s
        self._missing_m = max(0.0, min(2.0 * MISSING_M, missing_m))
        if self._missing_m == 0.0:
            self.is_stopped = False
            bias_m_s = self._bias_m_s + residual_m_s * dt_s / BIAS_S
            self._bias_m_s = max(-MAX_BIAS_M_S, min(MAX_BIAS_M_S, bias_m_s))
        elif self._missing_m > MISSING_M:
            self.is_stopped = True
        return self.is_stopped
