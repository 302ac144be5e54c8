"""The telemetry tree (docs/protocols.md 6), rebuilt from the Commands that determine it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from up.commands import board_status
from up.commands.schema_rows import Field
from up.commands.telemetry_schema import FIELDS, READINGS
from up.earth import bearing_deg, compass_deg, distance_m
from up.flight_log.json_message import number_at
from up.flight_log.origin_text import KEY, link_and_role
from up_flightlog.read.source_filter import SourceFilter

ANGLES = ("yaw", "pitch", "roll")
QUALITY = ("satellites", "accuracy", "fix", "pdop")
PLACE = ("latitude", "longitude", "altitude", *QUALITY)


class FrameState:
    """Applies logged Commands in the order of time and returns the telemetry of a moment.

    Of several sources of a reading the one followed in flight counts. Newer Commands update the
    last logged frame of telemetry.
    """

    def __init__(self, followed: SourceFilter, home: tuple[float, float] | None = None) -> None:
        self._followed = followed
        self._home = home
        self._tree: dict[str, Any] = {
            "orientation": dict.fromkeys(ANGLES),
            "rates": dict.fromkeys(ANGLES),
            "location": dict.fromkeys(PLACE),
            "altitude": None,
            "heading": {"actual": None, "required": None},
            "flight_mode": None,
            "armed": None,
        }
        self._times_s: dict[str, float] = {}
        self._sources: dict[str, str] = {}

    def apply(self, topic: str, time_s: float, data: Mapping[str, Any]) -> None:
        """Apply one Command; those that telemetry does not show change nothing."""
        handler = _HANDLERS.get(topic)
        if handler is not None:
            handler(self, time_s, data)
        copied = _COPIED.get(topic, ())
        reading = copied[0].reading if copied else ""
        if not reading or self._accepts(reading, time_s, data):
            for each in copied:
                group, _, name = each.path.rpartition(".")
                if group:
                    self._update(group, {name: data.get(each.key)})
                else:
                    self._tree[name] = data.get(each.key)

    def apply_frame(self, time_s: float, tree: Mapping[str, Any]) -> None:
        """Apply a logged frame of telemetry: it has more data than the Commands."""
        self._tree = {**self._tree, **tree}
        ages, sources = tree.get("age_ms"), tree.get("source")
        for reading in READINGS:
            age_ms = number_at(ages, (reading,))
            if age_ms is not None:
                self._times_s[reading] = time_s - age_ms / 1000
        if isinstance(sources, dict):
            self._sources.update({name: each for name, each in sources.items() if each})

    def tree(self, time_s: float) -> dict[str, Any]:
        """Return the telemetry of that moment; the caller owns the tree except its leaves."""
        known = self._times_s
        ages = {
            reading: round((time_s - known[reading]) * 1000) if reading in known else None
            for reading in READINGS
        }
        return {**self._tree, "age_ms": ages, "source": dict(self._sources)}

    def _accepts(self, reading: str, time_s: float, data: Mapping[str, Any]) -> bool:
        if not self._followed.accepts(reading, time_s, data):
            return False
        self._times_s[reading] = time_s
        self._sources[reading], _ = link_and_role(data.get(KEY))
        return True

    def _update(self, key: str, values: Mapping[str, Any]) -> None:
        # A new dict: frames returned earlier keep the old one.
        known = self._tree.get(key)
        self._tree[key] = {**known, **values} if isinstance(known, dict) else dict(values)

    def _on_location(self, time_s: float, data: Mapping[str, Any]) -> None:
        place = place_of(data)
        if place is None or not self._accepts("location", time_s, data):
            return
        self._tree["location"] = {
            "latitude": place[0],
            "longitude": place[1],
            "altitude": data.get("altitude"),
            **{key: data.get(key) for key in QUALITY},
        }
        home = self._home = self._home or place
        self._tree["home"] = {
            "distance": distance_m(*place, *home),
            "bearing": bearing_deg(*place, *home),
        }

    def _on_altitude(self, time_s: float, data: Mapping[str, Any]) -> None:
        if data.get("mode") != "required" and self._accepts("altitude", time_s, data):
            self._tree["altitude"] = data.get("altitude")

    def _on_heading(self, time_s: float, data: Mapping[str, Any]) -> None:
        heading = number_at(data, ("heading",))
        if heading is None:
            return
        if data.get("mode") == "required":
            self._update("heading", {"required": compass_deg(heading)})
        elif self._accepts("heading", time_s, data):
            self._update("heading", {"actual": compass_deg(heading)})

    def _on_flight_state(self, time_s: float, data: Mapping[str, Any]) -> None:
        if data.get("flight_mode") is None:
            self._times_s.pop("flight", None)
        else:
            self._accepts("flight", time_s, data)
        self._tree["flight_mode"] = data.get("flight_mode")
        self._tree["armed"] = data.get("armed")
        self._update("arduino", {"failsafe": data.get("failsafe")})

    def _on_status(self, time_s: float, data: Mapping[str, Any]) -> None:
        self._update("arduino", board_status.telemetry_of(data))
        self._tree["vetoes"] = [f"arduino: {each}" for each in board_status.vetoes_of(data)]

    def _on_link(self, time_s: float, data: Mapping[str, Any]) -> None:
        link = data.get("link")
        if link in ("android", "arduino"):
            self._update(link, {"connected": data.get("connected")})


_HANDLERS: dict[str, Callable[[FrameState, float, Mapping[str, Any]], None]] = {
    "up.location.update": FrameState._on_location,
    "up.altitude.change": FrameState._on_altitude,
    "up.heading.change": FrameState._on_heading,
    "up.flight.state": FrameState._on_flight_state,
    board_status.TOPIC: FrameState._on_status,
    "up.link.state": FrameState._on_link,
}
_COPIED: dict[str, list[Field]] = {}
for _field in FIELDS:
    if _field.command:
        _COPIED.setdefault(_field.command, []).append(_field)
TOPICS = (*_HANDLERS, *_COPIED)
"""The topics that determine telemetry."""


def place_of(data: Mapping[str, Any]) -> tuple[float, float] | None:
    """Return latitude and longitude, deg, of a location; None without valid ones."""
    latitude, longitude = number_at(data, ("latitude",)), number_at(data, ("longitude",))
    if latitude is None or longitude is None or abs(latitude) > 90 or abs(longitude) > 180:
        return None
    return latitude, longitude
