"""The recorder: takes entries, writes them, limits the disk use; all on one thread."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import replace

from twisted.logger import Logger

from black_box_cog.config import MEGABYTE, BlackBoxConfig
from black_box_cog.disk import Disk
from black_box_cog.flight_facts import FlightFacts
from black_box_cog.flight_folder import FlightFolder, NoRoomError
from black_box_cog.flight_parts import FlightParts
from black_box_cog.held_entries import HeldEntries
from black_box_cog.intake import Entry, Intake
from black_box_cog.pace import Pace
from black_box_cog.part import Part
from black_box_cog.recorder_status import RecorderStatus
from black_box_cog.timeline import Timeline
from black_box_cog.trouble import Trouble
from up.commands.roles import Role
from up.log.limits import Once

BUSY_S = 0.2
"""Between two rounds while a flight is recorded."""
IDLE_S = 1.0
LINGER_S = 600.0
"""A flight ends after this time without external data."""
ROOM_EVERY_S = 10.0
HUNG_S = 3.0
"""A longer round is reported as a problem while it lasts."""
_TAKE = 500
_SOURCES = (Role.BOARD, Role.SENSOR)


class Recorder:
    """``work`` is one round, ``finish`` the last; they raise no error of the disk.

    Small pieces of work release the interpreter, so that control never waits long. ``status`` and
    ``last_source_s`` may be read from any thread.
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
        self.last_source_s = float("-inf")
        self._intake = intake
        self._config = config
        self._now = now
        self._pace = Pace(pause)
        self._parts = FlightParts(folder, facts, disk, self._pace, lambda: Timeline(now, wall_ns))
        self._part: Part | None = None
        self._last_outside_s = float("-inf")
        self._held = HeldEntries()
        self._trouble = Trouble(self.log, folder.path)
        self._synced_s = self._looked_s = float("-inf")
        self._earlier_bytes = 0
        self._in_hand = 0
        self._dropped = 0
        self._dropped_said = 0
        self._said = Once()
        self._told: tuple[float, RecorderStatus] = (now(), RecorderStatus())

    @property
    def status(self) -> RecorderStatus:
        """Return the state after the last round, or that the current one does not end."""
        told_s, status = self._told
        silent_s = self._now() - told_s
        if silent_s < HUNG_S:
            return status
        problem = f"nothing has been written for {silent_s:.0f} s: the disk does not answer"
        return replace(status, dropped=self._all_dropped, problem=problem)

    @property
    def round_s(self) -> float:
        """Return the maximum delay of the next round."""
        return IDLE_S if self._part is None else BUSY_S

    def prepare(self, steps: Iterable[object]) -> None:
        """Do in advance, in small pieces, the work of a flight's start."""
        self._pace.walk(steps)

    def work(self) -> None:
        """Write the queued entries."""
        # The entries of a failed round are lost.
        self._dropped += self._in_hand
        waiting = len(self._intake)
        while waiting > 0:
            entries = self._intake.take(min(waiting, _TAKE))
            self._in_hand = len(entries)
            waiting -= len(entries) or waiting
            self._look_at(entries)
            if self._part is None:
                gone = self._held.hold(entries)
                self._dropped += gone if self._trouble.problem is not None else 0
            else:
                self._write(self._part, entries)
            self._in_hand = 0
        if self._part is None and self._shall_begin():
            self._begin()
        if self._part is not None:
            self._care_for(self._part)
        self._tell(self._now())

    def finish(self) -> None:
        """Write the remaining entries, and the summary."""
        self._pace.hurry()
        self.work()
        if self._part is not None:
            self._end(self._part)
        self._tell(float("inf"))

    def _look_at(self, entries: list[Entry]) -> None:
        for time_s, _, origin in entries:
            if origin.role is not Role.INTERNAL:
                self._last_outside_s = time_s
                if origin.role in _SOURCES:
                    self.last_source_s = time_s

    def _shall_begin(self) -> bool:
        return self._trouble.is_time_to_try(self._now()) and self._shall_record

    @property
    def _shall_record(self) -> bool:
        return self._config.always or self._now() - self._last_outside_s < LINGER_S

    def _begin(self) -> None:
        """Open a file with the held entries; a failure is kept as the problem."""
        try:
            part = self._open(self._held.all)
        except (OSError, NoRoomError) as error:
            self._fail(error)
            return
        self._held.clear()
        self._say_begun(part)

    def _open(self, entries: list[Entry]) -> Part:
        part = self._part = self._parts.open(entries)
        self._synced_s = self._looked_s = self._now()
        return part

    def _say_begun(self, part: Part) -> None:
        if self._trouble.problem is None:
            self.log.info("records the flight into {path}", path=str(part.name.path))
        else:
            self.log.info(
                "records again, into {path}; {count} messages are lost",
                path=str(part.name.path),
                count=self._all_dropped - self._dropped_said,
            )
            self._dropped_said = self._all_dropped
        self._trouble.forget()

    def _write(self, part: Part, entries: list[Entry]) -> None:
        self._pace.walk(map(part.put, entries))
        try:
            part.file.flush()
        except OSError as error:
            self._fail(error)

    def _care_for(self, part: Part) -> None:
        """Sync the file, and check its size, its name and the clock."""
        now_s = self._now()
        try:
            # The next round would be too late.
            if now_s + BUSY_S > self._synced_s + self._config.sync_s:
                if not part.file.is_synced:
                    part.file.sync()
                self._synced_s = now_s
                part = self._look_after(part)
            if part.file.size >= self._config.file_size_mb * MEGABYTE:
                self._end(part)
                self._open([])
            elif now_s > self._looked_s + ROOM_EVERY_S:
                self._looked_s = now_s
                self._parts.make_room()
            if not self._shall_record:
                self.log.info("the flight is over: nothing came for {s:.0f} s", s=LINGER_S)
                self._end(part)
                self._parts.end_flight()
                self._earlier_bytes = 0
        except (OSError, NoRoomError) as error:
            self._fail(error)

    def _look_after(self, part: Part) -> Part:
        """Report changes of file and clock; return the part that is now recorded."""
        if not part.file.is_linked:
            self.log.warn("{path} was removed; a new file is begun", path=str(part.name.path))
            part.file.close()
            self._part = None
            part = self._open([])
        jump_s = self._parts.jump_s()
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

    def _end(self, part: Part) -> None:
        """Finish and close the file; a disk error is kept as the problem."""
        self._part = None
        try:
            part.finish()
        except OSError as error:
            self._trouble.note(error)
        self._close(part)

    def _close(self, part: Part) -> None:
        self._earlier_bytes += part.file.size
        part.file.close()

    def _fail(self, error: Exception) -> None:
        """Stop recording cleanly, and report it once."""
        part, self._part = self._part, None
        if part is not None:
            self._dropped += part.file.lost
            if isinstance(error, NoRoomError):
                # The disk is not full yet: the file ends properly.
                self._end(part)
            else:
                self._close(part)
        self._trouble.wait(self._now())
        self._trouble.note(error)

    @property
    def _all_dropped(self) -> int:
        return self._dropped + self._intake.dropped

    def _tell(self, now_s: float) -> None:
        part = self._part
        size = self._earlier_bytes + (0 if part is None else part.file.size)
        status = RecorderStatus(
            part is not None,
            None if part is None else part.name.path.name,
            round(size / MEGABYTE, 2),
            self._all_dropped,
            self._trouble.problem,
        )
        self._told = now_s, status
