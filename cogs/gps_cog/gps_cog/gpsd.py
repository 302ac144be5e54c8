"""The protocol of gpsd: JSON reports, one per line."""

import json
import math
from collections import Counter
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Any

from gps_cog.fix import GpsFix
from up.protocols.line_decoder import LineDecoder

MAX_LINE_BYTES = 10240
"""The longest report of gpsd."""
MAX_NUMBER = 1e9
EPH_SIGMAS = 2.0
"""The errors that gpsd computes itself are those that 95 % of the fixes do not exceed."""
STATUS_KINDS = {2: "dgps", 3: "rtk", 4: "rtk"}


class GpsdDecoder:
    """Turns the reports TPV, SKY and GST of one device into fixes; others are ignored.

    Malformed reports are dropped and counted.
    """

    PERIOD_S = 0.0

    def __init__(self, device: str = "") -> None:
        self.counters: Counter[str] = Counter()
        self._device = device
        self._lines = LineDecoder(MAX_LINE_BYTES)
        self._sky: dict[str, Any] = {}
        self._errors: dict[str, Any] = {}

    @property
    def watch(self) -> bytes:
        wanted = {"enable": True, "json": True} | ({"device": self._device} if self._device else {})
        return b"?WATCH=" + json.dumps(wanted).encode() + b";\n"

    def reset(self) -> None:
        """Discard the partial report: the connection is a new one."""
        self._lines = LineDecoder(MAX_LINE_BYTES)
        self._sky = {}
        self._errors = {}

    def feed(self, data: bytes) -> Iterator[GpsFix]:
        """Yield the fixes in the reports that the bytes complete."""
        for line in self._lines.feed(data):
            try:
                report = json.loads(line)
            except (ValueError, RecursionError):
                report = None
            if not isinstance(report, dict):
                self.counters["noise"] += 1
            elif not self._device or report.get("device") == self._device:
                if report.get("class") == "SKY":
                    self._sky = {**self._sky, **report}
                elif report.get("class") == "GST":
                    self._errors = report
                elif report.get("class") == "TPV":
                    yield self._fix(report)

    def _fix(self, report: dict[str, Any]) -> GpsFix:
        mode = report.get("mode")
        kind = {2: "2d", 3: "3d"}.get(mode) if isinstance(mode, int) else None
        status = report.get("status")
        if kind == "3d" and isinstance(status, int):
            kind = STATUS_KINDS.get(status, kind)
        is_flat = kind == "2d"
        return GpsFix(
            kind,
            _seconds(report.get("time")),
            _number(report, "lat", math.nan),
            _number(report, "lon", math.nan),
            None if is_flat else _number(report, "altMSL", _number(report, "alt")),
            self._accuracy_m(report),
            _number(report, "speed"),
            _number(report, "track"),
            None if is_flat else _number(report, "climb"),
            self._satellites(),
            _number(self._sky, "pdop"),
        )

    def _accuracy_m(self, report: dict[str, Any]) -> float | None:
        north_m, east_m = _number(self._errors, "lat"), _number(self._errors, "lon")
        if north_m is not None and east_m is not None:
            return math.hypot(north_m, east_m)
        error_m = _number(report, "eph")
        return None if error_m is None else error_m / EPH_SIGMAS

    def _satellites(self) -> int | None:
        used = self._sky.get("uSat")
        if isinstance(used, int):
            return used
        listed = self._sky.get("satellites")
        if not isinstance(listed, list):
            return None
        return sum(isinstance(each, dict) and each.get("used") is True for each in listed)


def _number(report: dict[str, Any], name: str, otherwise: Any = None) -> Any:
    value: Any = report.get(name)
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    # A whole number of JSON has any size.
    return value if is_number and abs(value) < MAX_NUMBER else otherwise


def _seconds(text: Any) -> float | None:
    """Return seconds of a time as 2026-11-24T00:25:13.000Z."""
    try:
        return datetime.fromisoformat(text).replace(tzinfo=UTC).timestamp()
    except (TypeError, ValueError):
        return None
