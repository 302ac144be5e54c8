"""Creates the files of a flight, one after the other."""

import contextlib
from collections.abc import Callable, Sequence

from black_box_cog.disk import Disk
from black_box_cog.flight_folder import FlightFolder
from black_box_cog.flight_metadata import FlightMetadata
from black_box_cog.ingest_queue import Entry
from black_box_cog.log_file import LogFile
from black_box_cog.log_segment import LogSegment
from black_box_cog.throttle import CooperativeThrottle
from black_box_cog.timeline import Timeline
from up.flight_log.flight_file import FlightFile


class SegmentFactory:
    """Opens the next file of the current flight; ``make_timeline`` creates one for a new flight.

    The methods raise OSError and NoRoomError.
    """

    def __init__(
        self,
        folder: FlightFolder,
        metadata: FlightMetadata,
        disk: Disk,
        throttle: CooperativeThrottle,
        make_timeline: Callable[[], Timeline],
    ) -> None:
        self._folder = folder
        self._metadata = metadata
        self._disk = disk
        self._throttle = throttle
        self._make_timeline = make_timeline
        self._timeline = make_timeline()
        self._last: FlightFile | None = None

    def open(self, entries: Sequence[Entry] = ()) -> LogSegment:
        """Open a file that begins with these entries; a failure leaves no file."""
        if self._last is None:
            self._timeline = self._make_timeline()
        self._folder.make_room(self._last)
        name, descriptor = self._create()
        file = LogFile(self._disk, name.path, descriptor)
        try:
            segment = LogSegment(file, name, self._timeline)
            self._throttle.run(segment.head(self._metadata))
            self._throttle.run(map(segment.put, entries))
            segment.flush()
            file.sync()
            self._disk.sync_folder(name.folder)
        except OSError:
            file.close()
            with contextlib.suppress(OSError):
                self._disk.remove(name.path)
            raise
        self._last = name
        return segment

    def make_room(self) -> None:
        self._folder.make_room(self._last)

    def end_flight(self) -> None:
        self._last = None

    def jump_s(self) -> float | None:
        """Return how far the wall clock jumped from the log's time, or None."""
        return self._timeline.jump_s()

    def _create(self) -> tuple[FlightFile, int]:
        if self._last is not None:
            return self._folder.create_part(self._last)
        return self._folder.create(self._timeline.start_unix_s, self._metadata.aircraft)
