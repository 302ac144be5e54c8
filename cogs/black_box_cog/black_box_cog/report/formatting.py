"""Formats times, sizes and dates of a flight for people."""

from __future__ import annotations

from datetime import datetime

MIN_UNIX_S = 1_735_689_600.0
"""2025: no earlier flight was recorded; a Raspberry Pi without a clock starts long before."""
SIMULATED_UNIX_S = 946_684_800.0
"""2000-01-01: the start of the simulator scenarios' flights, which have no date."""
_MEGABYTE = 1e6
_DAY_S = 86400.0


def clock_text(seconds: float) -> str:
    """Return a time of the flight as minutes and seconds: 2:05.3."""
    tenths = round(seconds * 10)
    return f"{tenths // 600}:{tenths % 600 // 10:02d}.{tenths % 10}"


def start_text(unix_s: float) -> str:
    """Return the local time of a start, with a remark if the clock was certainly wrong."""
    if unix_s == SIMULATED_UNIX_S:
        return "no date (simulated)"
    if not unix_s:
        return "no time"
    try:
        text = datetime.fromtimestamp(unix_s).astimezone().strftime("%Y-%m-%d %H:%M:%S")
    except (OverflowError, ValueError, OSError):
        return "no time (the clock was wrong)"
    return text if is_clock_right(unix_s) else f"{text} (the clock was wrong)"


def is_clock_right(unix_s: float, now_unix_s: float | None = None) -> bool:
    """Return whether a flight can begin at that time: not before this program, nor tomorrow."""
    if unix_s == SIMULATED_UNIX_S:
        return True
    now_unix_s = datetime.now().timestamp() if now_unix_s is None else now_unix_s
    return MIN_UNIX_S <= unix_s <= now_unix_s + _DAY_S


def size_text(count: int) -> str:
    """Return a file's size in megabytes (decimal)."""
    return f"{count / _MEGABYTE:.1f} MB"
