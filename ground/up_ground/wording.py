"""Numbers and ages as the ground station writes them; unknown is ``--``."""

from __future__ import annotations

from up_ground.link_status import LinkState, LinkStatus
from up_ground.telemetry import Telemetry

UNKNOWN = "--"


def number_text(value: float | None, decimals: int = 1, width: int = 0, sign: bool = False) -> str:
    """Return a number right-aligned in ``width``; one that does not fit is shown as stars."""
    if value is None:
        return UNKNOWN.rjust(width)
    text = f"{value:{'+' if sign else ''}.{decimals}f}"
    if float(text) == 0:
        text = text.replace("-", "+" if sign else "")
    return "*" * width if 0 < width < len(text) else text.rjust(width)


def age_text(age_s: float | None) -> str:
    """Return an age in at most six characters: ``0.03 s``, ``12.4 s``, ``3 min``, ``2 h``."""
    if age_s is None:
        return UNKNOWN
    if age_s < 9.995:
        return f"{max(0.0, age_s):.2f} s"
    if age_s < 99.95:
        return f"{age_s:.1f} s"
    if age_s < 3600:
        return f"{age_s / 60:.0f} min"
    return f"{age_s / 3600:.0f} h" if age_s < 360_000 else "days"


def flag_text(value: bool | None, yes: str = "yes", no: str = "no") -> str:
    """Return the word for a flag."""
    return UNKNOWN if value is None else (yes if value else no)


def busy_text(telemetry: Telemetry) -> str:
    """Return the load and telemetry's period while the Raspberry Pi is busy (Panic Mode)."""
    percent = number_text(telemetry.number("load", "cpu"), 0)
    period_ms = telemetry.number("system", "period_ms") or telemetry.number("load", "delay_ms")
    return f"Raspberry Pi busy ({percent} %): telemetry every {number_text(period_ms, 0)} ms"


def seat_text(status: LinkStatus) -> str:
    """Return this ground's seat and the number of the ground that commands."""
    if status.seat is None:
        return UNKNOWN
    if status.seat.value == "command" or not status.is_holder_known:
        return status.seat.value
    holder = "nobody commands" if status.holder is None else f"ground {status.holder} commands"
    return f"listen ({holder})"


def link_text(status: LinkStatus, now_s: float) -> str:
    """Return the state of the connection, with its last error."""
    if status.state is LinkState.OPEN or not status.failures:
        return status.state.value
    return f"down for {age_text(now_s - status.since_s)}, attempt {status.failures + 1}"
