"""The recorder: takes entries, writes them, limits the disk use; all on one thread."""

import time
from collections.abc import Callable, Iterable
from dataclasses import replace

from twisted.logger import Logger

from black_box_cog.config import MEGABYTE, BlackBoxConfig
from black_box_cog.disk import Disk
from black_box_cog.disk_error_state import DiskErrorState
from black_box_cog.flight_folder import FlightFolder, NoRoomError
from black_box_cog.flight_metadata import FlightMetadata
from black_box_cog.ingest_queue import Entry, IngestQueue, RecorderStatus
from black_box_cog.log_segment import LogSegment
from black_box_cog.pre_trigger_buffer import PreTriggerBuffer
from black_box_cog.segment_factory import SegmentFactory
from black_box_cog.throttle import CooperativeThrottle
from black_box_cog.timeline import Timeline
from up.commands.roles import Role
from up.log.limits import Once

BUSY_S = 0.2
"""Between two rounds while a flight is recorded."""
IDLE_S = 1.0
IDLE_END_S = 600.0
"""A flight ends after this time without external data."""
ROOM_CHECK_S = 10.0
STALLED_S = 3.0
"""A longer round is reported as a problem while it lasts."""
_BATCH = 500
_SOURCES = (Role.BOARD, Role.SENSOR)


class Recorder:
    """``work`` is one round, ``finish`` the last; they raise no error of the disk.

    Small pieces of work release the interpreter, so that control never waits long. ``status`` and
    ``last_source_s`` may be read from any thread.
    """

    def __init__(
        self,
        queue: IngestQueue,
        config: BlackBoxConfig,
        folder: FlightFolder,
        metadata: FlightMetadata,
        disk: Disk,
        now: Callable[[], float] = time.perf_counter,
        wall_ns: Callable[[], int] = time.time_ns,
        pause: Callable[[float], object] = time.sleep,
    ) -> None:
        self.log = Logger(namespace="BlackBox")
        self.last_source_s = float("-inf")
        self._queue = queue
        self._config = config
        self._now = now
        self._throttle = CooperativeThrottle(pause)
        self._segments = SegmentFactory(
            folder, metadata, disk, self._throttle, lambda: Timeline(now, wall_ns)
        )
        self._segment: LogSegment | None = None
        self._last_external_s = float("-inf")
        self._buffer = PreTriggerBuffer()
        self._disk_error = DiskErrorState(self.log, folder.path)
        self._synced_s = self._room_checked_s = float("-inf")
        self._earlier_bytes = 0
        self._batch_size = 0
        self._dropped = 0
        self._dropped_reported = 0
        self._logged = Once()
        self._published: tuple[float, RecorderStatus] = (now(), RecorderStatus())

    @property
    def status(self) -> RecorderStatus:
        """Return the state after the last round, or that the current one does not end."""
        published_s, status = self._published
        silent_s = self._now() - published_s
        if silent_s < STALLED_S:
            return status
        problem = f"no data written for {silent_s:.0f} s: the disk does not respond"
        return replace(status, dropped=self._all_dropped, problem=problem)

    @property
    def round_s(self) -> float:
        """Return the maximum delay of the next round."""
        return IDLE_S if self._segment is None else BUSY_S

    def prepare(self, steps: Iterable[object]) -> None:
        """Do in advance, in small pieces, the work of a flight's start."""
        self._throttle.run(steps)

    def work(self) -> None:
        # The entries of a failed round are lost.
        self._dropped += self._batch_size
        waiting = len(self._queue)
        while waiting > 0:
            entries = self._queue.pop(min(waiting, _BATCH))
            self._batch_size = len(entries)
            waiting -= len(entries) or waiting
            self._note_sources(entries)
            if self._segment is None:
                dropped = self._buffer.add(entries)
                self._dropped += dropped if self._disk_error.problem is not None else 0
            else:
                self._write(self._segment, entries)
            self._batch_size = 0
        if self._segment is None and self._may_start():
            self._start()
        if self._segment is not None:
            self._maintain(self._segment)
        self._publish_status(self._now())

    def finish(self) -> None:
        self._throttle.disable()
        self.work()
        if self._segment is not None:
            self._end(self._segment)
        self._publish_status(float("inf"))

    def _note_sources(self, entries: list[Entry]) -> None:
        for time_s, _, origin in entries:
            if origin.role is not Role.INTERNAL:
                self._last_external_s = time_s
                if origin.role in _SOURCES:
                    self.last_source_s = time_s

    def _may_start(self) -> bool:
        return self._disk_error.may_retry(self._now()) and self._should_record

    @property
    def _should_record(self) -> bool:
        return self._config.always or self._now() - self._last_external_s < IDLE_END_S

    def _start(self) -> None:
        """Open a file with the held entries; a failure is kept as the problem."""
        try:
            segment = self._open(self._buffer.entries)
        except (OSError, NoRoomError) as error:
            self._fail(error)
            return
        self._buffer.clear()
        self._log_started(segment)

    def _open(self, entries: list[Entry]) -> LogSegment:
        segment = self._segment = self._segments.open(entries)
        self._synced_s = self._room_checked_s = self._now()
        return segment

    def _log_started(self, segment: LogSegment) -> None:
        if self._disk_error.problem is None:
            self.log.info(
                "recording the flight into {path}",
                path=str(segment.name.path),
                code="recording_started",
            )
        else:
            self.log.info(
                "recording again, into {path}; {count} messages are lost",
                code="recording_resumed",
                path=str(segment.name.path),
                count=self._all_dropped - self._dropped_reported,
            )
            self._dropped_reported = self._all_dropped
        self._disk_error.clear()

    def _write(self, segment: LogSegment, entries: list[Entry]) -> None:
        self._throttle.run(map(segment.put, entries))
        try:
            segment.flush()
        except OSError as error:
            self._fail(error)

    def _maintain(self, segment: LogSegment) -> None:
        """Sync the file, and check its size, its name and the clock."""
        now_s = self._now()
        try:
            # The next round would be too late.
            if now_s + BUSY_S > self._synced_s + self._config.sync_s:
                if not segment.file.is_synced:
                    segment.file.sync()
                self._synced_s = now_s
                segment = self._check_file(segment)
            if segment.file.size >= self._config.file_size_mb * MEGABYTE:
                self._end(segment)
                self._open([])
            elif now_s > self._room_checked_s + ROOM_CHECK_S:
                self._room_checked_s = now_s
                self._segments.make_room()
            if not self._should_record:
                self.log.info(
                    "the flight ended: no data for {s:.0f} s", s=IDLE_END_S, code="flight_ended"
                )
                self._end(segment)
                self._segments.end_flight()
                self._earlier_bytes = 0
        except (OSError, NoRoomError) as error:
            self._fail(error)

    def _check_file(self, segment: LogSegment) -> LogSegment:
        """Report changes of file and clock; return the segment that is now recorded."""
        if not segment.file.is_linked:
            self.log.warn(
                "{path} was deleted; recording continues in a new file",
                path=str(segment.name.path),
                code="recording_removed",
            )
            segment.file.close()
            self._segment = None
            segment = self._open([])
        jump_s = self._segments.jump_s()
        if jump_s is not None:
            self.log.warn(
                "the wall clock jumped {jump_s:+.0f} s; the time of the log continues without it",
                jump_s=jump_s,
                code="clock_jumped",
            )
        if self._all_dropped > self._dropped_reported:
            self.log.warn(
                "{count} messages were not recorded: the disk is too slow",
                code="messages_dropped",
                count=self._all_dropped - self._dropped_reported,
            )
            self._dropped_reported = self._all_dropped
        for topic in segment.unwritten:
            if self._logged.first(topic):
                self.log.error(
                    "cannot encode {topic} as JSON; it is not recorded",
                    topic=topic,
                    code="encoding_failed",
                )
        return segment

    def _end(self, segment: LogSegment) -> None:
        """Finish and close the file; a disk error is kept as the problem."""
        self._segment = None
        try:
            segment.finish()
        except OSError as error:
            self._disk_error.report(error)
        self._close(segment)

    def _close(self, segment: LogSegment) -> None:
        self._earlier_bytes += segment.file.size
        segment.file.close()

    def _fail(self, error: Exception) -> None:
        segment, self._segment = self._segment, None
        if segment is not None:
            self._dropped += segment.lost
            if isinstance(error, NoRoomError):
                # The disk is not full yet: the file ends properly.
                self._end(segment)
            else:
                self._close(segment)
        self._disk_error.delay_retry(self._now())
        self._disk_error.report(error)

    @property
    def _all_dropped(self) -> int:
        return self._dropped + self._queue.dropped

    def _publish_status(self, now_s: float) -> None:
        segment = self._segment
        size = self._earlier_bytes + (0 if segment is None else segment.file.size)
        status = RecorderStatus(
            segment is not None,
            None if segment is None else segment.name.path.name,
            round(size / MEGABYTE, 2),
            self._all_dropped,
            self._disk_error.problem,
        )
        self._published = now_s, status
