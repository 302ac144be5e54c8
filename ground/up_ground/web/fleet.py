"""The summary of all aircraft, which every page gets each second."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from up.commands.telemetry_schema import FIELDS
from up.system.clock import Clock, Timer, cancel
from up_ground.telemetry import Telemetry
from up_ground.web.client_session import AgedMessage

if TYPE_CHECKING:
    from up_ground.web.aircraft_source import AircraftSource

ALARMS_DELAY_S = 0.1
"""Alarms of several aircraft, as of a lost proxy, leave in one summary."""

PATHS = (
    "flight_mode",
    "flight_control.mode",
    "armed",
    "navigation.latitude",
    "navigation.longitude",
    "navigation.heading",
    "navigation.height",
    "navigation.speed",
    "location.latitude",
    "location.longitude",
    "heading.actual",
    "orientation.yaw",
    "arduino.flight_battery_v",
    "arduino.flight_battery_low",
    "arduino.flight_battery_critical",
)
"""What the page's list and its map show of an aircraft that is not selected."""
_FIELDS = [field for field in FIELDS if field.path in PATHS]
_READINGS = sorted({field.reading for field in _FIELDS} - {""})


def row_of(
    name: str, telemetry: Telemetry, alarms: list[dict[str, str]], now_s: float
) -> dict[str, Any]:
    """Return the row: ``age_ms`` and ``data`` as in a frame, without values of a wrong type.

    Its size is bounded whatever the aircraft sends. ``data`` is missing before the first frame.
    """
    row: dict[str, Any] = {"name": name, "alarms": alarms}
    age_s = telemetry.age_s(now_s)
    if age_s is None:
        return row
    data: dict[str, Any] = {}
    for field in _FIELDS:
        *above, key = path = field.path.split(".")
        value: object = None
        if field.type == "number":
            number = telemetry.number(*path)
            value = None if number is None else round(number, field.decimals)
        elif field.type == "flag":
            value = telemetry.flag(*path)
        else:
            value = telemetry.text(*path)
        if value is not None:
            place = data
            for step in above:
                place = place.setdefault(step, {})
            place[key] = value
    ages = {reading: telemetry.number("age_ms", reading) for reading in _READINGS}
    data["age_ms"] = {
        reading: None if age_ms is None else round(age_ms)
        for reading, age_ms in ages.items()
        if age_ms is not None or telemetry.is_null("age_ms", reading)
    }
    return {**row, "age_ms": round(age_s * 1000), "data": data}


class FleetSummary:
    """Makes the message `fleet`; a server with one aircraft has none."""

    def __init__(
        self,
        clock: Clock,
        fleet: Mapping[str, AircraftSource],
        send: Callable[[AgedMessage], object],
    ) -> None:
        self._clock = clock
        self._fleet = fleet
        self._send = send
        self._timer: Timer | None = None

    def stop(self) -> None:
        cancel(self._timer)

    def send(self) -> None:
        if len(self._fleet) > 1:
            now_s = self._clock.seconds()
            rows = [each.row(now_s) for each in self._fleet.values()]
            fields = {"type": "fleet", "aircraft": rows}
            self._send(AgedMessage(fields, lambda at_s: at_s - now_s, self._clock.seconds))

    def on_alarms(self) -> None:
        """Send a summary soon, outside the seconds."""
        if self._timer is None or not self._timer.active():
            self._timer = self._clock.callLater(ALARMS_DELAY_S, self.send)
