"""The numbers and tables of a flight that its report and ``up log info`` share."""

from __future__ import annotations

from collections.abc import Iterator

from up_flightlog.findings.summary import FlightSummary
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.spans import duration_text

TOPIC_HEAD = ["topic", "messages", "per second"]


def figures_of(summary: FlightSummary) -> Iterator[tuple[str, str]]:
    """Yield names and values; those that the log lacks are left out."""
    yield "armed", duration_text(summary.armed_s) if summary.armed else "never"
    if summary.highest_m is not None and summary.lowest_m is not None:
        yield "altitude", f"{summary.lowest_m:.0f} to {summary.highest_m:.0f} m"
    if summary.top_speed_m_s is not None:
        yield "top speed", f"{summary.top_speed_m_s:.1f} m/s"
    if summary.track_m is not None:
        yield "track", _distance(summary.track_m)
    if summary.farthest_m is not None:
        yield "farthest from home", _distance(summary.farthest_m)
    if summary.lowest_battery_percent is not None:
        yield "lowest phone battery", f"{summary.lowest_battery_percent:.0f} percent"
    if summary.lowest_flight_battery_v is not None:
        yield "lowest flight battery", f"{summary.lowest_flight_battery_v:.2f} V"


def gap_rows(summary: FlightSummary) -> list[list[str]]:
    """Return the sources and their longest silence."""
    return [[name, duration_text(gap_s)] for name, gap_s in summary.gaps_s.items()]


def topic_rows(log: FlightLog) -> list[list[str]]:
    """Return the rows below ``TOPIC_HEAD``."""
    seconds = max(log.length_s, 1e-9)
    return [
        [topic, str(count), f"{count / seconds:.1f}" if log.length_s else "-"]
        for topic, count in sorted(log.topics.items())
    ]


def _distance(metres: float) -> str:
    return f"{metres / 1000:.2f} km" if metres >= 1000 else f"{metres:.0f} m"
