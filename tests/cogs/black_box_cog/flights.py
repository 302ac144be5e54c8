"""A recorder whose clock and disk the test controls, and its flights by the official reader."""

import errno
import json
import os
import struct
import threading

from black_box_cog.config import MEGABYTE, BlackBoxConfig
from black_box_cog.disk import Disk
from black_box_cog.flight_folder import FlightFolder
from black_box_cog.flight_metadata import FlightMetadata
from black_box_cog.ingest_queue import IngestQueue, LogForwarder
from black_box_cog.recorder import Recorder
from mcap.exceptions import EndOfFile
from mcap.reader import make_reader
from mcap.records import Channel, Message
from mcap.stream_reader import StreamReader

from up.commands.orientation_command import OrientationCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.flight_log.flight_file import flight_files

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE = Origin("android", Role.SENSOR)
GROUND = Origin("mission_control", Role.OPERATOR)
START_UNIX_S = 1_786_699_800


class TestedDisk(Disk):
    """The real disk, whose calls are counted and can be refused: ``refuse["write"] = ENOSPC``."""

    __test__ = False

    def __init__(self):
        self.refuse = {}
        self.calls = []
        self.threads = set()
        self.free = None

    def __getattribute__(self, name):
        found = super().__getattribute__(name)
        if not callable(found) or name.startswith("_"):
            return found

        def call(*arguments):
            self.calls.append(name)
            self.threads.add(threading.get_ident())
            number = self.refuse.get(name)
            if number:
                raise OSError(number, os.strerror(number))
            return found(*arguments)

        return call

    def free_bytes(self, folder):
        return super().free_bytes(folder) if self.free is None else self.free


class HalfFullDisk(TestedDisk):
    """A disk with room for that many bytes, to the byte."""

    room = None

    def write(self, descriptor, data):
        if self.room is None:
            return super().write(descriptor, data)
        if not self.room:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        written = super().write(descriptor, data[: self.room])
        self.room -= written
        return written


class Flight:
    """A recorder in a folder, its rounds run by the test; it receives the log until it is over."""

    listening = set()

    def __init__(self, folder, disk=None, limit=20_000, **config):
        config = {"keep_free_mb": 0.0, **config}
        self.path = folder / "flights"
        self.now_s = 1000.0
        self.wall_s = float(START_UNIX_S)
        self.paused = 0
        self.disk = disk or TestedDisk()
        self.config = BlackBoxConfig(**config)
        self.queue = IngestQueue(limit, lambda: self.now_s)
        self.folder = FlightFolder(
            self.disk,
            self.path,
            self.config.total_size_mb * MEGABYTE,
            self.config.keep_free_mb * MEGABYTE,
        )
        metadata = FlightMetadata("kite", {"mode": "auto"}, ("up", "black_box_cog"), folder)
        self.recorder = Recorder(
            self.queue,
            self.config,
            self.folder,
            metadata,
            self.disk,
            lambda: self.now_s,
            lambda: int(self.wall_s * 1e9),
            self._pause,
        )
        self._lines = LogForwarder(self.queue.put)
        self._lines.start()
        self.listening.add(self._lines)

    @classmethod
    def stop_all(cls):
        """Stop receiving the log."""
        while cls.listening:
            cls.listening.pop().stop()

    def _pause(self, seconds):
        self.paused += 1

    def pass_s(self, seconds):
        """Let time pass, for both clocks."""
        self.now_s += seconds
        self.wall_s += seconds

    def say(self, number, origin=BOARD):
        """Publish one Command that is distinguishable from others by its roll."""
        self.queue.observe(OrientationCommand(float(number), 0.0, 0.0), origin)

    def fly(self, seconds, rate_hz=10, first=0, origin=BOARD):
        """Log numbers at a rate, with the recorder's rounds between; return the next number."""
        number = first
        for _ in range(round(seconds * rate_hz)):
            self.say(number, origin)
            number += 1
            self.pass_s(1 / rate_hz)
            self.recorder.work()
        return number

    @property
    def status(self):
        return self.recorder.status

    @property
    def files(self):
        return [each.path for each in flight_files(self.path)] if self.path.is_dir() else []

    @property
    def numbers(self):
        return [number for path in self.files for number in numbers_in(path)]


def messages(path):
    """Return (topic, log time ns, data) of every message that the official reader finds."""
    topics, found = {}, []
    with path.open("rb") as stream:
        try:
            for record in StreamReader(stream).records:
                if isinstance(record, Channel):
                    topics[record.id] = record.topic
                elif isinstance(record, Message):
                    data = json.loads(record.data)
                    found.append((topics[record.channel_id], record.log_time, data))
        except (EndOfFile, struct.error):
            # This is its message for a record that is cut off.
            pass
    return found


def numbers_in(path):
    return [
        int(data["roll"]) for topic, _, data in messages(path) if topic == "up.orientation.update"
    ]


def lines_in(path):
    """Return the lines of the program's log: level, logger, message, and code and fields."""
    return [data for topic, _, data in messages(path) if topic == "log"]


def codes_in(path):
    return [line.get("code") for line in lines_in(path)]


def codes_of(log):
    """Return the codes of captured log events."""
    return [event["code"] for event in log.events if "code" in event]


def summary_of(path):
    """Return the summary; None: the file did not end as it should."""
    with path.open("rb") as stream:
        return make_reader(stream).get_summary()
