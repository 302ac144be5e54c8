"""Faults of the links: the ground's, the phone's, and the readings that they deliver."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from statistics import median

from up.flight_log.json_message import number_at
from up_flightlog.findings.finding import Check, Finding, Level, lasting
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.read.spans import Span

GROUND_LINKS = ("mission_control", "ground")
PHONE_LINK = "android"
READINGS: dict[str, tuple[str, float]] = {
    "up.orientation.update": ("attitude", 0.5),
    "up.location.update": ("location", 2.5),
}
"""Name of the reading, and the shortest gap (s) that is reported."""
_GAP_INTERVALS = 4
"""A gap of more than this many usual intervals is reported."""
_SAMPLE = 1000


def ground_lost(context: FlightContext) -> Iterator[Finding]:
    """The link to the ground; switching it off after landing is not a loss."""
    for link in GROUND_LINKS:
        for span in context.link_lost(lambda name, link=link: name == link):  # type: ignore[misc]
            text = "the link to the ground was lost"
            yield lasting(span, _level(context, span), "ground_lost", text, fields={"link": link})


def phone_lost(context: FlightContext) -> Iterator[Finding]:
    """The airborne phone: its sensors and, where it carries them, the uplink."""
    for span in context.link_lost(lambda link: link == PHONE_LINK):
        yield lasting(span, _level(context, span), "phone_lost", "the phone was disconnected")


def phone_refused(context: FlightContext) -> Iterator[Finding]:
    """Another phone that tried to take the link, from telemetry's `android.competitor`."""
    hosts: dict[float, str] = {}
    for time_s, host in context.telemetry("android.competitor"):
        hosts[time_s] = host if isinstance(host, str) else ""
    for span in context.spans((time_s, host != "") for time_s, host in hosts.items()):
        host = hosts[span.begin_s]
        text = "another phone was refused"
        yield lasting(span, "warning", "phone_refused", text, f": {host}", fields={"host": host})


def reading_missing(context: FlightContext) -> Iterator[Finding]:
    """A reading that arrived and then stopped."""
    for topic, (name, min_s) in READINGS.items():
        limit_s = max(min_s, _GAP_INTERVALS * _interval_s(context, topic))
        for begin_s, length_s in context.log.gaps(limit_s, topic):
            end_s = begin_s + length_s
            span = Span(begin_s, end_s, is_open=end_s >= context.log.length_s)
            level: Level = "alarm" if topic == "up.orientation.update" else "warning"
            if not context.was_armed(span):
                level = "info" if span.is_open else "warning"
            yield lasting(span, level, "reading_missing", f"no {name} arrived", subject=name)


def battery_low(context: FlightContext) -> Iterator[Finding]:
    """The phone's battery: losing the phone loses its sensors and the uplink."""
    for each in context.log.messages("android.battery.low"):
        if each.data.get("low") is True:
            level = number_at(each.data, ("level",))
            percent = "" if level is None else f": {level:g} percent"
            text = "the phone's battery was low"
            fields = {} if level is None else {"level": level}
            yield Finding(each.time_s, "alarm", "battery_low", text, percent, fields=fields)


def _level(context: FlightContext, span: Span) -> Level:
    return "warning" if context.was_armed(span) or not span.is_open else "info"


def _interval_s(context: FlightContext, topic: str) -> float:
    """Return the usual time between two messages, from the first ones."""
    times_s = context.log.times(topic)[:_SAMPLE]
    return median(b - a for a, b in pairwise(times_s)) if times_s[1:] else 0.0


LINK_CHECKS: tuple[Check, ...] = (
    ground_lost,
    phone_lost,
    phone_refused,
    reading_missing,
    battery_low,
)
