"""Small logs for the tests, and the official package's reading of them."""

from __future__ import annotations

import io
import json
from typing import Any

from mcap.exceptions import McapError
from mcap.records import Message
from mcap.stream_reader import CRCValidationError, StreamReader

from up.flight_log.mcap_writer import McapWriter
from up_flightlog.read.flight_log import FlightLog

START_NS = 1_700_000_000_000_000_000
SECOND_NS = 1_000_000_000


class LogMaker:
    """Writes a log to memory: topics are declared when they are first used."""

    def __init__(self, start_ns: int = START_NS) -> None:
        self.out = bytearray()
        self.writer = McapWriter(self.out.extend)
        self.writer.start()
        self.start_ns = start_ns
        self._channels: dict[str, int] = {}

    def channel(self, topic: str, schema: dict[str, Any] | None = None) -> int:
        number = self._channels.get(topic)
        if number is None:
            schema_id = self.writer.add_schema(topic, schema or {"type": "object"})
            number = self._channels[topic] = self.writer.add_channel(topic, schema_id)
        return number

    def add(self, time_s: float, topic: str, **data: Any) -> None:
        self.raw(time_s, topic, json.dumps(data).encode())

    def raw(self, time_s: float, topic: str, data: bytes) -> None:
        time_ns = self.start_ns + round(time_s * SECOND_NS)
        self.writer.message(self.channel(topic), time_ns, data)

    def finished(self) -> bytes:
        self.writer.finish()
        return bytes(self.out)

    def log(self, folder, is_finished: bool = True) -> FlightLog:
        path = folder / "flight.mcap"
        path.write_bytes(self.finished() if is_finished else self.out)
        return FlightLog.read([path])


def small_log() -> bytes:
    maker = LogMaker()
    maker.writer.add_metadata("flight", {"aircraft": "glider-1", "host": "pi"})
    maker.writer.add_attachment("config/pids.yml", "text/yaml", b"rate: 2.0\n", START_NS)
    for number in range(6):
        maker.add(number * 0.1, "up.orientation.update", roll=number * 1.5, _origin="arduino")
        if number % 2:
            maker.add(number * 0.1, "up.altitude.change", altitude=100 + number)
    return maker.finished()


def official_messages(data: bytes) -> list[tuple[int, int, int, int, bytes]]:
    found: list[tuple[int, int, int, int, bytes]] = []
    try:
        for record in StreamReader(io.BytesIO(data)).records:
            if isinstance(record, Message):
                found.append(
                    (
                        record.channel_id,
                        record.sequence,
                        record.log_time,
                        record.publish_time,
                        record.data,
                    )
                )
    except (McapError, CRCValidationError, ValueError, OverflowError):
        pass
    except Exception as error:
        # A cut in the middle of a number is a struct.error to it.
        if type(error).__name__ != "error":
            raise
    return found
