"""NMEA 0183: the sentences GGA, RMC, GSA and GST of one receiver make fixes."""

import math
from collections import Counter
from collections.abc import Iterator
from datetime import time
from typing import Any

from pynmeagps import NMEAReader
from pynmeagps.exceptions import NMEAMessageError, NMEAParseError, NMEATypeError
from pynmeagps.nmeahelpers import calc_checksum

from gps_cog.fix import HDOP_M, GpsFix
from up.protocols.line_decoder import LineDecoder

KNOT_M_S = 1852.0 / 3600.0
MAX_LINE_BYTES = 128
"""The standard has 82; some receivers exceed it."""
DETAILS_AGE_S = 5.0
"""How long the accuracy and the dilution of a receiver that no longer sends them are used."""
KINDS = {1: "3d", 2: "dgps", 4: "rtk", 5: "rtk"}
"""By the quality of GGA. Estimated, manual and simulated positions are dropped."""
MEASURED_MODES = "ADFRP"
_USED = (b"GGA", b"RMC", b"GSA", b"GST")


class NmeaDecoder:
    """Turns bytes into fixes; noise and damaged sentences are dropped and counted.

    A fix is complete when GGA and RMC of one time have arrived, or the one of them that the
    receiver sends at all. GSA and GST only add to it.
    """

    PERIOD_S = 86400.0
    set_up = b""

    def __init__(self) -> None:
        self.counters: Counter[str] = Counter()
        self.understood = 0
        self._lines = LineDecoder(MAX_LINE_BYTES)
        self._time: time | None = None
        self._seen: dict[str, Any] = {}
        self._expected = {"GGA", "RMC"}
        self._details: dict[str, tuple[float, Any]] = {}

    def reset(self) -> None:
        """Discard the partial line: the port was opened again."""
        self._lines = LineDecoder(MAX_LINE_BYTES)

    def feed(self, data: bytes) -> Iterator[GpsFix]:
        before = self._lines.dropped_too_long
        lines = self._lines.feed(data)
        self.counters["noise"] += self._lines.dropped_too_long - before
        for line in lines:
            message = self._parse(line)
            if message is not None:
                fix = self._take(message)
                if fix is not None:
                    yield fix

    def _parse(self, line: bytes) -> Any:
        """Return a sentence that is used; otherwise None."""
        start = line.rfind(b"$")
        content, star, check = line[start + 1 :].partition(b"*")
        if start < 0 or not star or len(check) != 2:
            self.counters["noise"] += 1
            return None
        if check.upper() != calc_checksum(content.decode("latin-1")).encode():
            self.counters["checksum"] += 1
            return None
        self.understood += 1
        if content[2:5] not in _USED:
            return None
        try:
            return NMEAReader.parse(b"$" + content + b"*" + check + b"\r\n")
        except (NMEAMessageError, NMEAParseError, NMEATypeError, ValueError, TypeError, KeyError):
            self.counters["invalid"] += 1
            return None

    def _take(self, message: Any) -> GpsFix | None:
        kind = message.msgID
        at = getattr(message, "time", None)
        if kind == "GSA":
            self._details[kind] = (self._stamp_s, message)
            return None
        if not isinstance(at, time):
            # A receiver without a clock has no fix.
            return GpsFix(None) if kind == "GGA" else None
        if kind == "GST":
            self._details[kind] = (_seconds(at), message)
            return None
        if at != self._time:
            if self._seen:
                self._expected = set(self._seen)
            self._time, self._seen = at, {}
        is_complete = set(self._seen) >= self._expected
        self._seen[kind] = message
        if is_complete:
            # The fix of this time was published without it.
            return None
        return self._fix() if set(self._seen) >= self._expected else None

    def _fix(self) -> GpsFix:
        gga, rmc = self._seen.get("GGA"), self._seen.get("RMC")
        gsa, gst = self._detail("GSA"), self._detail("GST")
        kind = "2d" if gga is None else KINDS.get(_number(gga, "quality"))
        if kind == "3d" and _number(gsa, "navMode") == 2:
            kind = "2d"
        if rmc is not None:
            mode = getattr(rmc, "posMode", "") or "A"
            if getattr(rmc, "status", "") != "A" or mode not in MEASURED_MODES:
                kind = None
        place = gga or rmc
        return GpsFix(
            kind,
            self._stamp_s,
            _number(place, "lat", math.nan),
            _number(place, "lon", math.nan),
            None if kind == "2d" else _number(gga, "alt"),
            _accuracy_m(gga, gst),
            _scaled(_number(rmc, "spd"), KNOT_M_S),
            _number(rmc, "cog"),
            None,
            _number(gga, "numSV"),
            _number(gsa, "PDOP"),
        )

    @property
    def _stamp_s(self) -> float:
        return 0.0 if self._time is None else _seconds(self._time)

    def _detail(self, kind: str) -> Any:
        known = self._details.get(kind)
        if known is None or abs(known[0] - self._stamp_s) > DETAILS_AGE_S:
            return None
        return known[1]


def _seconds(at: time) -> float:
    return at.hour * 3600.0 + at.minute * 60.0 + at.second + at.microsecond / 1e6


def _number(message: Any, name: str, otherwise: Any = None) -> Any:
    """Return a number of a sentence; an empty field is a text."""
    value = getattr(message, name, None)
    return value if isinstance(value, int | float) else otherwise


def _scaled(value: float | None, unit: float) -> float | None:
    return None if value is None else value * unit


def _accuracy_m(gga: Any, gst: Any) -> float | None:
    north_m, east_m = _number(gst, "stdLat"), _number(gst, "stdLong")
    if north_m is not None and east_m is not None:
        return math.hypot(north_m, east_m)
    return _scaled(_number(gga, "HDOP"), HDOP_M)
