"""Position and links as messages: the phone's measurements or, without a phone, the truth."""

from __future__ import annotations

import math
from collections.abc import Iterator

from up.commands.altitude_command import AltitudeCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.panic_command import PanicCommand
from up.commands.system_commands import LinkStateCommand
from up.flight_log.origin_text import KEY as ORIGIN
from up_simulator.scenario.board_topics import News
from up_simulator.scenario.log import ROW_S
from up_simulator.scenario.log_row import Data, LogRow, Message

BATTERY_TOPIC = "android.battery"
PLACE_S = 0.2
SHARE = 0.5
PHONE, TRUTH, INTERNAL = "android (sensor)", "simulator (sensor)", "internal"
_TRUE_PLACE = {
    "latitude": "latitude_deg",
    "longitude": "longitude_deg",
    "altitude": "altitude_m",
    "speed": "speed_m_s",
    "bearing": "track_deg",
}


class TruePlace:
    """The true position, five times a second, without a phone; its origin field marks it."""

    def __init__(self) -> None:
        self._due_s = -math.inf

    def messages(self, row: LogRow) -> Iterator[Message]:
        """Yield place, altitude and heading when they are due."""
        if row.time_s < self._due_s - ROW_S / 2:
            return
        self._due_s = row.time_s + PLACE_S
        place: Data = {key: row.number(f"truth.{name}") for key, name in _TRUE_PLACE.items()}
        heading = row.number("truth.yaw_deg")
        if None in place.values() or heading is None:
            return
        yield LocationCommand.NAME, {**place, ORIGIN: TRUTH}
        altitude: Data = {"altitude": place["altitude"], "mode": "actual"}
        yield AltitudeCommand.NAME, {**altitude, ORIGIN: TRUTH}
        yield HeadingCommand.NAME, {"heading": heading, "mode": "actual", ORIGIN: TRUTH}


class SeenByGround:
    """The phone's measurements and the daemon's notes, as received by a ground station."""

    def __init__(self) -> None:
        self._frames: float | None = None
        self._news = {name: News(SHARE) for name in ("location", "altitude", "heading", "battery")}
        self._links: dict[str, bool] = {}
        self._panic: Data = {}

    def messages(self, row: LogRow) -> Iterator[Message]:
        """Yield the new data of the newest telemetry."""
        frames = row.number("ground.frames")
        if frames is None or frames == self._frames:
            return
        self._frames = frames
        fresh = {name for name, news in self._news.items() if _is_new(news, name, row)}
        if "location" in fresh:
            yield from _location(row)
        if "altitude" in fresh and (altitude := row.number("ground.altitude")) is not None:
            yield AltitudeCommand.NAME, {"altitude": altitude, "mode": "actual", ORIGIN: PHONE}
        if "heading" in fresh and (heading := row.number("ground.heading.actual")) is not None:
            yield HeadingCommand.NAME, {"heading": heading, "mode": "actual", ORIGIN: PHONE}
        if "battery" in fresh and (level := row.whole("ground.android.batteryLevel")) is not None:
            yield BATTERY_TOPIC, {"level": level, ORIGIN: PHONE}
        yield from self._noted(row)

    def _noted(self, row: LogRow) -> Iterator[Message]:
        for link in ("arduino", "android"):
            is_connected = row.flag(f"ground.{link}.connected")
            if is_connected is not None and is_connected != self._links.get(link):
                self._links[link] = is_connected
                data: Data = {"link": link, "connected": is_connected}
                yield LinkStateCommand.NAME, {**data, ORIGIN: INTERNAL}
        is_panic, delay_ms = row.flag("ground.load.panic"), row.whole("ground.load.delay_ms")
        panic: Data = {"panic": is_panic, "delay_ms": delay_ms}
        if None not in panic.values() and panic != self._panic:
            self._panic = panic
            yield PanicCommand.NAME, {**panic, ORIGIN: INTERNAL}


def _is_new(news: News, name: str, row: LogRow) -> bool:
    age_ms = row.number(f"ground.age_ms.{name}")
    return news.is_new(None if age_ms is None else age_ms / 1000, row.time_s)


def _location(row: LogRow) -> Iterator[Message]:
    keys = ("latitude", "longitude", "altitude")
    place: Data = {key: row.number(f"ground.location.{key}") for key in keys}
    if place["latitude"] is not None and place["longitude"] is not None:
        yield LocationCommand.NAME, {**place, ORIGIN: PHONE}
