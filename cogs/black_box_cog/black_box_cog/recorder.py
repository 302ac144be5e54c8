"""The recorder: takes what came, writes it, keeps the disk in bounds; all of it on one thread."""

from __future__ import annotations

import contextlib
import time
from collections import deque
from collections.abc import Callable, Sequence

from twisted.logger import Logger

from black_box_cog.config import MEGABYTE, BlackBoxConfig
from black_box_cog.disk import Disk
from black_box_cog.flight_facts import FlightFacts
from black_box_cog.flight_folder import FlightFolder, NoRoomError
from black_box_cog.intake import Entry, Intake, LogLine
from black_box_cog.log_file import LogFile
from black_box_cog.part import Part
from black_box_cog.recorder_status import RecorderStatus
from black_box_cog.timeline import Timeline
from up.commands.roles import Role
from up.flight_log.flight_file import FlightFile
from up.log.limits import Once

BUSY_S = 0.2
"""Between two rounds while a flight is recorded."""
IDLE_S = 1.0
LINGER_S = 600.0
"""A flight is over when nothing has come from outside for so long."""
RETRY_S = 60.0
ROOM_EVERY_S = 10.0
HELD = 1000
"""So much of what was said before a flight goes into its log."""
_HELD_LINES = 300
_TAKE = 500
_BATCH_S = 0.0003
_PAUSE_S = 0.002
_SOURCES = (Role.BOARD, Role.SENSOR)


class Recorder:
    """``work`` is one round, ``finish`` the last; nothing raised by the disk leaves them.

    The interpreter is held for ``_BATCH_S`` at a time, so that control never waits for it longer.
    ``status`` and ``last_source_s`` may be read from any thread.
    """

    def __init__(
        self,
        intake: Intake,
        config: BlackBoxConfig,
        folder: FlightFolder,
        facts: FlightFacts,
        disk: Disk,
        now: Callable[[], float] = time.perf_counter,
        wall_ns: Callable[[], int] = time.time_ns,
        pause: Callable[[float], object] = time.sleep,
    ) -> None:
        self.log = Logger(namespace="BlackBox")
        self.status = RecorderStatus()
        self.last_source_s = float("-inf")
        self._intake = intake
        self._config = config
        self._folder = folder
        self._facts = facts
        self._disk = disk
        self._now = now
        self._wall_ns = wall_ns
        self._pause = pause
        self._part: Part | None = None
        self._last: FlightFile | None = None
        self._timeline = Timeline(now, wall_ns)
        self._last_outside_s = float("-inf")
        self._held: deque[Entry] = deque()
        self._held_lines: deque[Entry] = deque(maxlen=_HELD_LINES)
        self._problem: str | None = None
        self._kind: object = None
        self._retry_s = float("-inf")
        self._synced_s = self._looked_s = float("-inf")
        self._earlier_bytes = 0
        self._dropped = 0
        self._dropped_said = 0
        self._said = Once()

    @property
    def round_s(self) -> float:
        """Return how long the next round may wait."""
        return IDLE_S if self._part is None else BUSY_S

    def work(self) -> None:
        """Write what has come."""
        waiting = len(self._intake)
        while waiting > 0:
            entries = self._intake.take(min(waiting, _TAKE))
            waiting -= len(entries) or waiting
            self._look_at(entries)
            if self._part is None:
                self._hold(entries)
            else:
                self._write(self._part, entries)
        if self._part is None and self._shall_begin():
            self._begin()
        if self._part is not None:
            self._care_for(self._part)
        self._tell()

    def finish(self) -> None:
        """Write what is left, and the summary."""
        self._pause = _no_pause
        self.work()
        if self._part is not None:
            self._end(self._part)
            self._tell()

    def _look_at(self, entries: list[Entry]) -> None:
        for time_s, _, origin in entries:
            if origin.role is not Role.INTERNAL:
                self._last_outside_s = time_s
                if origin.role in _SOURCES:
                    self.last_source_s = time_s

    def _shall_begin(self) -> bool:
        return self._now() >= self._retry_s and self._shall_record

    @property
    def _shall_record(self) -> bool:
        return self._config.always or self._now() - self._last_outside_s < LINGER_S

    def _hold(self, entries: list[Entry]) -> None:
        """Keep the newest for the file to come; of what is lost to a problem, the log's lines."""
        for entry in entries:
            if len(self._held) >= HELD:
                oldest = self._held.popleft()
                if isinstance(oldest[1], LogLine):
                    self._held_lines.append(oldest)
                elif self._problem is not None:
                    self._dropped += 1
            self._held.append(entry)

    def _begin(self) -> None:
        """Open a file, with what was held for it; a problem is kept instead."""
        if self._last is None:
            self._timeline = Timeline(self._now, self._wall_ns)
        try:
            part = self._open_part([*self._held_lines, *self._held])
        except (OSError, NoRoomError) as error:
            self._fail(error)
            return
        self._held.clear()
        self._held_lines.clear()
        self._say_begun(part)

    def _open_part(self, entries: Sequence[Entry] = ()) -> Part:
        """Open a file that begins with these entries; without success none is left."""
        self._folder.make_room(self._last)
        if self._last is None:
            start_unix_s, aircraft = self._timeline.start_unix_s, self._facts.aircraft
            name, descriptor = self._folder.create(start_unix_s, aircraft)
        else:
            name, descriptor = self._folder.create_part(self._last)
        file = LogFile(self._disk, name.path, descriptor)
        try:
            part = Part(file, name, self._facts, self._timeline)
            self._put(part, entries)
            file.flush()
            file.sync()
            self._disk.sync_folder(name.folder)
        except OSError:
            file.close()
            with contextlib.suppress(OSError):
                self._disk.remove(name.path)
            raise
        self._part, self._last = part, name
        self._synced_s = self._looked_s = self._now()
        return part

    def _say_begun(self, part: Part) -> None:
        if self._problem is None:
            self.log.info("records the flight into {path}", path=str(part.name.path))
        else:
            self.log.info(
                "records again, into {path}; {count} messages are lost",
                path=str(part.name.path),
                count=self._all_dropped - self._dropped_said,
            )
            self._dropped_said = self._all_dropped
        self._problem = self._kind = None

    def _write(self, part: Part, entries: Sequence[Entry]) -> None:
        self._put(part, entries)
        try:
            part.file.flush()
        except OSError as error:
            self._fail(error)

    def _put(self, part: Part, entries: Sequence[Entry]) -> None:
        """Encode, with pauses in which the reactor's thread has the interpreter."""
        due_s = time.perf_counter() + _BATCH_S
        for entry in entries:
            part.put(entry)
            if time.perf_counter() > due_s:
                self._pause(_PAUSE_S)
                due_s = time.perf_counter() + _BATCH_S

    def _care_for(self, part: Part) -> None:
        """Force the file onto the disk, look after its size, its name and the clock."""
        now_s = self._now()
        try:
            # The round after this one would come too late.
            if now_s + BUSY_S > self._synced_s + self._config.sync_s:
                if not part.file.is_synced:
                    part.file.sync()
                self._synced_s = now_s
                part = self._look_after(part)
            if part.file.size >= self._config.file_size_mb * MEGABYTE:
                self._go_on(part)
            elif now_s > self._looked_s + ROOM_EVERY_S:
                self._looked_s = now_s
                self._folder.make_room(part.name)
            if not self._shall_record:
                self.log.info("the flight is over: nothing came for {s:.0f} s", s=LINGER_S)
                self._end(part)
                self._last = None
                self._earlier_bytes = 0
        except (OSError, NoRoomError) as error:
            self._fail(error)

    def _look_after(self, part: Part) -> Part:
        """Say what happened to file and clock; return the part that is recorded into now."""
        if not part.file.is_linked:
            self.log.warn("{path} was removed; a new file is begun", path=str(part.name.path))
            part.file.close()
            self._part = None
            part = self._open_part()
        jump_s = self._timeline.jump_s()
        if jump_s is not None:
            self.log.warn(
                "the wall clock is {jump_s:+.0f} s from the log's time, which goes on as it began",
                jump_s=jump_s,
            )
        if self._all_dropped > self._dropped_said:
            self.log.warn(
                "{count} messages were not recorded: the disk is too slow",
                count=self._all_dropped - self._dropped_said,
            )
            self._dropped_said = self._all_dropped
        for topic in part.unwritten:
            if self._said.first(topic):
                self.log.error("{topic} cannot be written as JSON and is left out", topic=topic)
        return part

    def _go_on(self, part: Part) -> None:
        self._end(part)
        self._open_part()

    def _end(self, part: Part) -> None:
        """Finish and close the file; what the disk refuses is kept as the problem."""
        self._part = None
        try:
            part.finish()
        except OSError as error:
            self._note(error)
        self._close(part)

    def _close(self, part: Part) -> None:
        self._earlier_bytes += part.file.size
        part.file.close()

    def _fail(self, error: Exception) -> None:
        """Stop recording politely, and say so once."""
        part, self._part = self._part, None
        if part is not None:
            self._dropped += part.file.lost
            if isinstance(error, NoRoomError):
                # The disk is not full yet: the file ends as it should.
                self._end(part)
            else:
                self._close(part)
        self._retry_s = self._now() + RETRY_S
        self._note(error)

    def _note(self, error: Exception) -> None:
        reason = getattr(error, "strerror", None) or str(error)
        path = getattr(error, "filename", None) or self._folder.path
        kind = getattr(error, "errno", None) or type(error)
        text = reason if isinstance(error, NoRoomError) else f"{path}: {reason}"
        if self._kind != kind:
            self._kind = kind
            self.log.error(
                "the flight is not recorded: {text}; tried again every minute", text=text
            )
        self._problem = text

    @property
    def _all_dropped(self) -> int:
        return self._dropped + self._intake.dropped

    def _tell(self) -> None:
        part = self._part
        size = self._earlier_bytes + (0 if part is None else part.file.size)
        self.status = RecorderStatus(
            part is not None,
            None if part is None else part.name.path.name,
            round(size / MEGABYTE, 2),
            self._all_dropped,
            self._problem,
        )


def _no_pause(seconds: float) -> None:
    """Take no pause: the program wants to end."""
