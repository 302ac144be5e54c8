"""Telemetry as the texts of the OSD's elements."""

import math
from collections.abc import Callable, Iterator

from msp_cog.displayport import plain
from up.commands.event_rules import is_hidden, state_of
from up.commands.telemetry_schema import RULES, SILENT_S
from up.telemetry_frame import Frame

WARNING_S = 1.5
"""How long each of several warnings is shown."""
FAR_M = 10_000


class OsdTexts:
    """The texts of the newest frame of telemetry; a value that is unknown or stale is dashes.

    The flight's time counts while the aircraft is armed, or in flight.
    """

    def __init__(self) -> None:
        self._frame = Frame()
        self._frame_s = -math.inf
        self._now_s = 0.0
        self._began_s: float | None = None
        self._elements: dict[str, Callable[[], str]] = {
            "mode": self._mode,
            "time": self._time,
            "altitude": lambda: self._measure("ALT", "M", "navigation", "height"),
            "speed": lambda: self._measure("GS", "M/S", "navigation", "speed"),
            "airspeed": lambda: self._measure("AS", "M/S", "navigation", "airspeed"),
            "home": self._home,
            "battery": self._battery,
            "satellites": lambda: self._measure("SAT", "", "location", "satellites"),
            "warnings": self._warning,
        }

    def update(self, frame: Frame, now_s: float) -> None:
        """Take a frame that was made at a monotonic time."""
        self._frame, self._frame_s = frame, now_s
        flags = frame.flag("armed"), frame.flag("in_flight")
        if True in flags:
            self._began_s = now_s if self._began_s is None else self._began_s
        elif False in flags:
            self._began_s = None

    @property
    def is_armed(self) -> bool:
        return self._frame.flag("armed") is True

    def text(self, element: str, now_s: float) -> str:
        """Return the text of an element, in characters that the goggles have."""
        self._now_s = now_s
        return plain(self._elements[element]())

    def _number(self, *path: str, reading: str = "") -> float | None:
        found = self._frame.number(*path)
        return None if found is None or self._is_stale(reading or path[0]) else found

    def _is_stale(self, reading: str = "") -> bool:
        age_s = self._now_s - self._frame_s
        return age_s > SILENT_S or (reading != "" and self._frame.is_stale(reading, age_s))

    def _measure(self, label: str, unit: str, *path: str) -> str:
        value = self._number(*path)
        shown = "---" if value is None else str(round(value))
        return f"{label} {shown}{unit}"

    def _mode(self) -> str:
        mode = "" if self._is_stale("flight") else self._frame.mode
        return f"{mode}{'' if self.is_armed else '*'}" if mode else "----"

    def _time(self) -> str:
        if self._began_s is None or self._is_stale():
            return "--:--"
        minutes, seconds = divmod(int(self._now_s - self._began_s), 60)
        return f"{minutes:02}:{seconds:02}"

    def _home(self) -> str:
        """Return distance and turn to home, which is unknown until it is set."""
        is_set = self._frame.number("home", "latitude") is not None
        distance_m = self._number("home", "distance", reading="location") if is_set else None
        if distance_m is None:
            return "HOME ---M ----"
        far = distance_m >= FAR_M
        distance = f"{distance_m / 1000:.1f}KM" if far else f"{round(distance_m)}M"
        bearing_deg = self._number("home", "bearing", reading="location")
        heading_deg = self._number("navigation", "heading")
        if bearing_deg is None or heading_deg is None:
            return f"HOME {distance} ----"
        turn_deg = round(math.remainder(bearing_deg - heading_deg, 360))
        return f"HOME {distance} {'L' if turn_deg < 0 else 'R'}{abs(turn_deg):03}"

    def _battery(self) -> str:
        voltage_v = self._number("arduino", "flight_battery_v", reading="flight")
        shown = "--.-" if voltage_v is None else f"{voltage_v:.1f}"
        return f"BAT {shown}V"

    def _warning(self) -> str:
        if self._is_stale():
            return "NO DATA"
        warnings = list(dict.fromkeys(self._warnings()))
        return warnings[int(self._now_s / WARNING_S) % len(warnings)] if warnings else ""

    def _warnings(self) -> Iterator[str]:
        """Yield the failsafe that flies, the alarms of telemetry, and the failsafes that hold."""
        frame = self._frame
        cause = frame.text("failsafe", "cause")
        if cause:
            yield f"FAILSAFE {_words(cause)}"
        for rule in RULES:
            if not rule.alarm or rule.type != "flag" or is_hidden(rule, frame):
                continue
            if state_of(rule, frame, None) is True:
                yield _words(rule.code)
        yield from map(_words, frame.texts("failsafe", "active") or ())


def _words(code: str) -> str:
    return code.replace("_", " ")
