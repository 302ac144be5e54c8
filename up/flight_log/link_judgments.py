"""Faults of the links: the ground's, the phone's, and the readings that they deliver."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from statistics import median

from up.flight_log.facts import TELEMETRY, Facts
from up.flight_log.json_message import number_at
from up.flight_log.spans import Span, duration_text
from up.flight_log.wrong import Judge, Wrong

GROUND_LINKS = ("mission_control", "ground")
PHONE_LINK = "android"
READINGS: dict[str, tuple[str, float]] = {
    "up.orientation.update": ("attitude", 0.5),
    "up.location.update": ("location", 2.5),
}
"""Name of the reading, and the shortest gap (s) that is reported."""
_PATIENCE = 4
"""A gap of more than this many usual intervals is reported."""
_LOOKED_AT = 1000


def ground_lost(facts: Facts) -> Iterator[Wrong]:
    """The link to the ground; switching it off after landing is not a loss."""
    for link in GROUND_LINKS:
        for span in facts.link_lost(lambda name, link=link: name == link):  # type: ignore[misc]
            flies = facts.was_armed(span) or not span.is_open
            text = f"the link to the ground was lost {span.length_text}"
            yield Wrong(span.begin_s, "warning" if flies else "info", text, span.length_s)


def phone_lost(facts: Facts) -> Iterator[Wrong]:
    """The airborne phone: its sensors and, where it carries them, the uplink."""
    for span in facts.link_lost(lambda link: link == PHONE_LINK):
        flies = facts.was_armed(span) or not span.is_open
        text = f"the phone was gone {span.length_text}"
        yield Wrong(span.begin_s, "warning" if flies else "info", text, span.length_s)


def phone_refused(facts: Facts) -> Iterator[Wrong]:
    """Another phone that tried to take the link, from telemetry's `android.competitor`."""
    hosts: dict[float, str] = {}
    for each in facts.log.messages(TELEMETRY):
        android = each.data.get("android")
        host = android.get("competitor") if isinstance(android, dict) else None
        hosts[each.time_s] = host if isinstance(host, str) else ""
    for span in facts.spans((time_s, host != "") for time_s, host in hosts.items()):
        text = f"another phone was refused {span.length_text}: {hosts[span.begin_s]}"
        yield Wrong(span.begin_s, "warning", text, span.length_s)


def reading_missing(facts: Facts) -> Iterator[Wrong]:
    """A reading that arrived and then stopped."""
    for topic, (name, least_s) in READINGS.items():
        limit_s = max(least_s, _PATIENCE * _interval_s(facts, topic))
        for begin_s, length_s in facts.log.gaps(limit_s, topic):
            span = Span(begin_s, begin_s + length_s)
            is_open = span.end_s >= facts.log.length_s
            level = "alarm" if topic == "up.orientation.update" else "warning"
            if not facts.was_armed(span):
                level = "info" if is_open else "warning"
            until = " until the end" if is_open else ""
            text = f"no {name} came for {duration_text(length_s)}{until}"
            yield Wrong(begin_s, level, text, length_s)  # type: ignore[arg-type]


def battery_low(facts: Facts) -> Iterator[Wrong]:
    """The phone's battery: losing the phone loses its sensors and the uplink."""
    for each in facts.log.messages("android.battery.low"):
        if each.data.get("low") is True:
            level = number_at(each.data, ("level",))
            percent = "" if level is None else f": {level:g} percent"
            yield Wrong(each.time_s, "alarm", f"the phone's battery was low{percent}")


def _interval_s(facts: Facts, topic: str) -> float:
    """Return the usual time between two messages, from the first ones."""
    times_s = facts.log.times(topic)[:_LOOKED_AT]
    return median(b - a for a, b in pairwise(times_s)) if times_s[1:] else 0.0


LINK_JUDGMENTS: tuple[Judge, ...] = (
    ground_lost,
    phone_lost,
    phone_refused,
    reading_missing,
    battery_low,
)
