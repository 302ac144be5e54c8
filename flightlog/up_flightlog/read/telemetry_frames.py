"""The telemetry of a flight, frame by frame, as the ground received or would have received it."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from up_flightlog.read.flight_log import FlightLog, LoggedMessage
from up_flightlog.read.frame_state import TOPICS, FrameState
from up_flightlog.read.source_filter import SourceFilter
from up_flightlog.read.track_statistics import fixes

TELEMETRY = "up.telemetry.update"
MISSING_S = 0.5
"""After this long without a logged frame, frames are built from the other topics."""
_SILENT_S = 1.5
"""After a longer gap the aircraft may have sent nothing: no frame is built."""
_MIN_PERIOD_S = 0.01
_WARM_UP_S = 10.0
_BEACON = "_beacon"


@dataclass(frozen=True, slots=True)
class Frame:
    """One frame; ``time_s`` counts from the log's first message, ``data`` is as telemetry's."""

    time_s: float
    data: dict[str, Any]
    beacon: int | None = None


def frames(
    log: FlightLog,
    period_s: float = 0.1,
    since_s: float = 0.0,
    without: Collection[str] = (),
) -> Iterator[Frame]:
    """Yield the telemetry in the order of time (docs/protocols.md 6).

    Logged telemetry is returned unchanged. Without it (no subscriber, or no link), a frame is built
    every ``period_s`` from the Commands, with the ages of that moment. ``since_s`` skips the time
    before it; built frames lack the readings of the topics ``without``. Raises FlightLogError when
    a file can no longer be read.
    """
    if _is_all_there(log):
        for message in log.messages(TELEMETRY, since_s=since_s):
            yield _logged(message)
        return
    home = next(((each.latitude_deg, each.longitude_deg) for each in fixes(log)), None)
    state = FrameState(SourceFilter(log), home)
    step_s = max(period_s, _MIN_PERIOD_S)
    due_s = newest_s = logged_s = -1.0
    topics = [topic for topic in (TELEMETRY, *TOPICS) if topic not in without]
    for message in log.messages(*topics, since_s=max(0.0, since_s - _WARM_UP_S)):
        now_s = message.time_s
        # After recent telemetry, silence in all topics means that the program stood still.
        limit_s = MISSING_S if newest_s - logged_s < MISSING_S else _SILENT_S
        while 0.0 <= due_s < min(now_s, newest_s + limit_s):
            if due_s >= since_s:
                yield Frame(due_s, state.tree(due_s))
            due_s += step_s
        due_s = max(due_s, now_s)
        newest_s = now_s
        if message.topic != TELEMETRY:
            state.apply(message.topic, now_s, message.data)
            continue
        logged_s = now_s
        frame = _logged(message)
        state.apply_frame(now_s, frame.data)
        if now_s >= since_s:
            yield frame
        due_s = now_s + MISSING_S
    if since_s <= due_s <= newest_s:
        yield Frame(due_s, state.tree(due_s))


def _logged(message: LoggedMessage) -> Frame:
    beacon = message.data.get(_BEACON)
    data = {key: value for key, value in message.data.items() if not key.startswith("_")}
    return Frame(message.time_s, data, beacon if type(beacon) is int else None)


def _is_all_there(log: FlightLog) -> bool:
    """Return whether telemetry was logged from the beginning to the end."""
    times_s = [0.0, *log.times(TELEMETRY), log.length_s]
    if len(times_s) == 2:
        return False
    return all(later - each <= MISSING_S for each, later in pairwise(times_s))
