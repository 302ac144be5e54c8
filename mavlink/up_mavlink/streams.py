"""Which messages of telemetry one client gets, and how often."""

from __future__ import annotations

from collections.abc import Iterator

from up_mavlink.modes import CURRENT, MONITOR
from up_mavlink.telemetry_messages import BUILDERS

MIN_INTERVAL_S = 0.02
SLACK_S = 0.005
MISSION_CURRENT = "MISSION_CURRENT"
DEFAULTS_S: dict[str, float | None] = {
    **{name: interval_s for name, (_, interval_s) in BUILDERS.items()},
    MISSION_CURRENT: 1.0,
    CURRENT: 1.0,
    MONITOR: 3.0,
}
STREAMS = {
    2: ("SYS_STATUS", "GPS_RAW_INT", MISSION_CURRENT),
    3: ("RC_CHANNELS", "SERVO_OUTPUT_RAW"),
    6: ("GLOBAL_POSITION_INT",),
    10: ("ATTITUDE",),
    11: ("VFR_HUD",),
    12: ("BATTERY_STATUS", "SYSTEM_TIME"),
}
"""The messages of REQUEST_DATA_STREAM by the number of their stream; 0 is all of them."""


class Streams:
    """Messages leave with the frames of telemetry, and so at most as often as these arrive."""

    def __init__(self) -> None:
        self._intervals_s = dict(DEFAULTS_S)
        self._sent_s: dict[str, float] = {}

    def interval_us(self, name: str) -> int:
        """Return the interval of a message; -1: it is sent on request."""
        interval_s = self._intervals_s.get(name)
        return -1 if interval_s is None else round(interval_s * 1e6)

    def set_interval(self, name: str, interval_us: float) -> bool:
        """Set an interval; 0 is the default, a negative one disables. False: no such message."""
        if name not in DEFAULTS_S:
            return False
        if interval_us == 0:
            self._intervals_s[name] = DEFAULTS_S[name]
        elif interval_us < 0:
            self._intervals_s[name] = None
        else:
            self._intervals_s[name] = max(MIN_INTERVAL_S, interval_us / 1e6)
        return True

    def set_rate(self, stream: int, rate_hz: int) -> None:
        """Set the rate of a stream of REQUEST_DATA_STREAM; 0 disables it."""
        names = sum(STREAMS.values(), ()) if stream == 0 else STREAMS.get(stream, ())
        for name in names:
            self.set_interval(name, 1e6 / rate_hz if rate_hz > 0 else -1)

    def due(self, now_s: float) -> Iterator[str]:
        for name, interval_s in self._intervals_s.items():
            if interval_s is None:
                continue
            if now_s - self._sent_s.get(name, -1e9) >= interval_s - SLACK_S:
                self._sent_s[name] = now_s
                yield name
