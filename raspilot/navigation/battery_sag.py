"""How much less a weak battery gives: the speed controller chops its voltage."""

LOADED = 0.8
"""Part of the level flight's throttle from which on the battery is under load."""
REFERENCE_RISE_V = 0.02
"""By a single measurement: one false one changes little."""
MIN_SHARE = 0.7
"""A battery is empty above it; below it the divider is broken."""


class BatterySag:
    """Compares the voltage with the flight's highest under load.

    The airframe's performance was measured with the sag of a good battery. ``share`` is the part
    of the throttle that the voltage leaves, 1 before a measurement under load.
    """

    def __init__(self, level_throttle: float) -> None:
        self._loaded = LOADED * level_throttle
        self.reset()

    def reset(self) -> None:
        """Begin again: another battery, or a calibration."""
        self.share = 1.0
        self._reference_v = 0.0

    def measure(self, voltage_v: float, throttle: float) -> None:
        """Take a voltage (V) at a throttle of 0 to 1."""
        if throttle >= self._loaded:
            known_v = self._reference_v or voltage_v
            self._reference_v = max(known_v, min(voltage_v, known_v + REFERENCE_RISE_V))
        if self._reference_v:
            self.share = max(MIN_SHARE, min(1.0, voltage_v / self._reference_v))
