"""The flight log's writer and reader beside the official ``mcap`` package, in turns.

The log is that of a flight: 300 messages a second, attitude and receiver fastest, telemetry ten
times a second. CPU time of this process, in alternating rounds.
"""

import gc
import json
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

from bench.table import Row, compared
from bench.timing import Limit
from up.flight_log.compression import compressor
from up.flight_log.mcap_writer import McapWriter
from up_flightlog.read.flight_log import FlightLog

PEER = "mcap (official)"
MINUTES, QUICK_MINUTES = 30, 1
ROUNDS = 3
BETTER = Limit(2.0, is_minimum=True)
START_NS = 1_700_000_000_000_000_000
TICK_NS = 10_000_000
CHUNK_TICKS, CHUNK_BYTES = 20, 8192
ROLL = "up.orientation.update"
_STICKS = {"ailerons": 1500, "elevator": 1512, "throttle": 1234, "rudder": 1500}
_ANGLES = {"roll": 12.345678, "pitch": -3.2345, "yaw": 123.456, "roll_rate": 1.23456}
_ORIGIN = {"_origin": "arduino (board)"}
TOPICS: dict[str, tuple[int, bytes]] = {
    ROLL: (1, json.dumps({**_ANGLES, "sequence": 12345, **_ORIGIN}).encode()),
    "up.rx.update": (1, json.dumps({**_STICKS, "valid": 63, **_ORIGIN}).encode()),
    "up.servo.update": (1, json.dumps({**_STICKS, **_ORIGIN}).encode()),
    "up.telemetry.update": (10, json.dumps({f"part{n}": _ANGLES for n in range(12)}).encode()),
    "arduino.status": (20, json.dumps({f"field{n}": n for n in range(13)}).encode()),
    "up.location.update": (100, json.dumps({"latitude": 50.0, "longitude": 14.0}).encode()),
}
"""Period in ticks of 10 ms, and message."""


@dataclass(frozen=True, slots=True)
class _Rounds:
    ours: list[float] = field(default_factory=list)
    theirs: list[float] = field(default_factory=list)


Put = Callable[[int, int, bytes], object]


def messages(minutes: float) -> Iterator[tuple[int, int, bytes]]:
    """Yield (number of the topic, time in ns, data) of a flight."""
    topics = list(enumerate(TOPICS.values()))
    for tick in range(round(minutes * 6000)):
        time_ns = START_NS + tick * TICK_NS
        for number, (every, data) in topics:
            if tick % every == 0:
                yield number, time_ns, data


def write_ours(write: Callable[[bytes], object], minutes: float) -> tuple[int, float]:
    writer = McapWriter(write, compress=compressor())
    writer.start()
    channels = [
        writer.add_channel(topic, writer.add_schema(topic, {"type": "object"})) for topic in TOPICS
    ]

    def put(number: int, time_ns: int, data: bytes) -> None:
        # As the recorder does after its rounds.
        if number == 0 and time_ns // TICK_NS % CHUNK_TICKS == 0:
            writer.end_chunk()
        writer.message(channels[number], time_ns, data)

    count, spent_s = _put_all(minutes, put)
    writer.finish()
    return count, spent_s


def write_theirs(official: Any, path: Path, minutes: float) -> tuple[int, float]:
    """Write the same by the official package, in chunks of about the same size."""
    with path.open("wb") as file:
        writer = official.Writer(
            file, chunk_size=CHUNK_BYTES, compression=official.CompressionType.ZSTD
        )
        writer.start()
        channels = [
            writer.register_channel(
                topic, "json", writer.register_schema(topic, "jsonschema", b'{"type":"object"}')
            )
            for topic in TOPICS
        ]
        counts = _put_all(
            minutes,
            lambda number, time_ns, data: writer.add_message(
                channels[number], time_ns, data, time_ns
            ),
        )
        writer.finish()
    return counts


def read_theirs(reader: Any, path: Path) -> int:
    with path.open("rb") as file:
        records = reader.StreamReader(file, validate_crcs=True).records
        return sum(hasattr(record, "channel_id") for record in records)


def series_theirs(reader: Any, path: Path) -> int:
    with path.open("rb") as file:
        found = reader.make_reader(file).iter_messages(topics=[ROLL])
        return len([json.loads(message.data)["roll"] for _, _, message in found])


def rows(quick: bool = False) -> Iterable[Row]:
    minutes = QUICK_MINUTES if quick else MINUTES
    try:
        official, stream, reader = map(
            import_module, ("mcap.writer", "mcap.stream_reader", "mcap.reader")
        )
    except ImportError:
        official = None
    write_us, read_s, series_s = (_Rounds() for _ in range(3))
    with tempfile.TemporaryDirectory(prefix="up-bench-") as folder:
        mine, theirs = Path(folder, "ours.mcap"), Path(folder, "theirs.mcap")
        for _ in range(ROUNDS):
            with mine.open("wb") as file:
                count, spent_s = write_ours(file.write, minutes)
            write_us.ours.append(spent_s / count * 1e6)
            read_s.ours.append(_cpu_s(lambda: FlightLog.read([mine])))
            log = FlightLog.read([mine])
            series_s.ours.append(_cpu_s(partial(log.series, ROLL, "roll")))
            if official is not None:
                count, spent_s = write_theirs(official, theirs, min(minutes, 5))
                write_us.theirs.append(spent_s / count * 1e6)
                read_s.theirs.append(_cpu_s(lambda: read_theirs(stream, mine)))
                series_s.theirs.append(_cpu_s(lambda: series_theirs(reader, mine)))
        megabytes = mine.stat().st_size / 1e6
    what = f"flight log of {minutes} min, {megabytes:.0f} MB"
    yield compared(
        "flight log, a message written", "us", write_us.ours, PEER, write_us.theirs, BETTER
    )
    yield compared(f"{what}, read and checked", "s", read_s.ours, PEER, read_s.theirs, BETTER)
    yield compared(f"{what}, one number of one topic", "s", series_s.ours, PEER, series_s.theirs)


def _put_all(minutes: float, put: Put) -> tuple[int, float]:
    """Write a flight in batches, so that creating the messages is not counted."""
    count, spent_s = 0, 0.0
    batch: list[tuple[int, int, bytes]] = []
    for each in messages(minutes):
        batch.append(each)
        if len(batch) == 1000:
            spent_s += _spent_s(batch, put)
            count += len(batch)
            batch.clear()
    spent_s += _spent_s(batch, put)
    return count + len(batch), spent_s


def _spent_s(batch: list[tuple[int, int, bytes]], put: Put) -> float:
    began = time.process_time()
    for number, time_ns, data in batch:
        put(number, time_ns, data)
    return time.process_time() - began


def _cpu_s(work: Callable[[], object]) -> float:
    gc.collect()
    began_s = time.process_time()
    work()
    return time.process_time() - began_s
