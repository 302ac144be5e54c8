"""The events of a flight, computed once, so that any moment of it can be shown."""

from __future__ import annotations

from array import array
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from up.commands.event_rules import INFO, Report
from up.commands.telemetry_schema import SILENT_S
from up.protocols.general_message import GeneralMessage
from up.sanitize_text import sanitize_text
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.telemetry_frames import Frame, frames
from up_ground.telemetry import NAME, Telemetry
from up_ground.web.event_monitor import EventMonitor
from up_ground.web.event_rules import LinkSnapshot
from up_ground.web.track import Home, Track, track_message

GAINS = "arduino.pids.values"
GAINS_WANTED = "arduino.pids.tunings"
PROFILE = "arduino.profile.values"


@dataclass(frozen=True, slots=True)
class Reported:
    """Values from a moment of the flight on, s."""

    time_s: float
    values: dict[str, Any]


def last_before(told: Sequence[Reported], time_s: float) -> Reported | None:
    """Return the last reported value before a time; None without a report."""
    place = bisect_right(told, time_s, key=lambda each: each.time_s)
    return told[place - 1] if place else None


def gains_of(log: FlightLog) -> list[Reported]:
    """Return the gains that the board reported; without a report, those requested from it.

    Raises FlightLogError when a file becomes unreadable.
    """
    told = _reports(log, GAINS)
    if told:
        return told
    wanted = ((each.time_s, each.values.get("pids")) for each in _reports(log, GAINS_WANTED))
    return [Reported(time_s, gains) for time_s, gains in wanted if isinstance(gains, dict)]


def _reports(log: FlightLog, topic: str) -> list[Reported]:
    return [
        Reported(each.time_s, {key: value for key, value in each.data.items() if key[:1] != "_"})
        for each in log.messages(topic)
    ]


MARK = "black_box.mark"
_STEP_S = 0.25
_MAX_STEP_S = 5.0


class ReplayTimeline:
    """Every event, alarm and place of a flight with its time; times are the log's seconds."""

    def __init__(self, log: FlightLog, aircraft: str) -> None:
        self.aircraft = aircraft
        self.length_s = log.length_s
        self.events: list[dict[str, Any]] = []
        self._event_times_s: list[float] = []
        self._alarms: list[dict[str, Any]] = []
        self._alarm_times_s: list[float] = []
        self._track = Track()
        self._home = Home()
        self._frame_times_s = array("d")
        self._gains = gains_of(log)
        self._profiles = _reports(log, PROFILE)
        self._now_s = 0.0
        # A user who stops at a moment wants to see the alarms of that moment.
        self._monitor = EventMonitor(aircraft, self._record, hold_s=0.0)
        self._read(log)

    @property
    def home(self) -> dict[str, float] | None:
        return self._home.position()

    def events_until(self, time_s: float) -> list[dict[str, Any]]:
        """Return the newest events up to a moment, with their ages at that moment."""
        return self.events_between(-1.0, time_s)[-200:]

    def events_between(self, after_s: float, until_s: float) -> list[dict[str, Any]]:
        """Return the events of a span, with their ages at its end."""
        first = bisect_right(self._event_times_s, after_s)
        last = bisect_right(self._event_times_s, until_s)
        return [
            {
                **self.events[place],
                "age_ms": round((until_s - self._event_times_s[place]) * 1000),
                "time_s": round(self._event_times_s[place], 3),
            }
            for place in range(first, last)
        ]

    def alarms_at(self, time_s: float) -> dict[str, Any]:
        place = bisect_right(self._alarm_times_s, time_s)
        if not place:
            return {"type": "alarms", "aircraft": self.aircraft, "active": []}
        return self._alarms[place - 1]

    def frame_time_s(self, time_s: float) -> float | None:
        """Return the time of the newest frame before a moment; None if there was none."""
        place = bisect_right(self._frame_times_s, time_s)
        return self._frame_times_s[place - 1] if place else None

    def gains_at(self, time_s: float) -> Reported | None:
        """Return the last reported gains; None if there was no report."""
        return last_before(self._gains, time_s)

    def profile_at(self, time_s: float) -> Reported | None:
        """Return the last reported profile of the airframe; None without a report."""
        return last_before(self._profiles, time_s)

    def track_until(self, time_s: float) -> dict[str, Any]:
        return track_message(self.aircraft, self._track.points_until(time_s))

    def _read(self, log: FlightLog) -> None:
        telemetry = Telemetry()
        marks = [
            (each.time_s, sanitize_text(each.data.get("text") or "", 200))
            for each in log.messages(MARK)
        ]
        marks.reverse()
        for frame in frames(log):
            self._wait(telemetry, frame.time_s, marks)
            self._report_marks(marks, frame.time_s)
            self._process(telemetry, frame)
        self._wait(telemetry, log.length_s, marks)
        self._report_marks(marks, log.length_s)
        self._now_s = log.length_s
        is_silent = bool(self._frame_times_s) and log.length_s - self._frame_times_s[-1] > SILENT_S
        self._monitor.update(telemetry, _link(is_silent), log.length_s)

    def _process(self, telemetry: Telemetry, frame: Frame) -> None:
        self._now_s = frame.time_s
        self._frame_times_s.append(frame.time_s)
        telemetry.update(GeneralMessage(NAME, frame.data, None, frame.beacon), frame.time_s)
        self._track.update(telemetry, frame.time_s)
        self._home.update(telemetry)
        self._monitor.update(telemetry, _link(False), frame.time_s)

    def _wait(self, telemetry: Telemetry, until_s: float, marks: list[tuple[float, str]]) -> None:
        """Advance the time between two frames to the events that it contains."""
        if not telemetry.frames:
            return
        begin_s = self._now_s
        while self._now_s + _STEP_S < min(until_s, begin_s + _MAX_STEP_S):
            next_s = self._now_s + _STEP_S
            self._report_marks(marks, next_s)
            self._now_s = next_s
            link = _link(self._now_s - begin_s > SILENT_S)
            self._monitor.update(telemetry, link, self._now_s)

    def _report_marks(self, marks: list[tuple[float, str]], until_s: float) -> None:
        while marks and marks[-1][0] <= until_s:
            time_s, text = marks.pop()
            self._now_s = max(self._now_s, time_s)
            report = Report(INFO, "mark", f"mark: {text}", {"text": text})
            self._monitor.report("mark", report, self._now_s)

    def _record(self, message: dict[str, Any]) -> None:
        is_event = message["type"] == "event"
        times_s = self._event_times_s if is_event else self._alarm_times_s
        times_s.append(self._now_s)
        (self.events if is_event else self._alarms).append(message)


def _link(is_silent: bool) -> LinkSnapshot:
    return LinkSnapshot(True, "", None, True, is_silent)


def past(events: Iterable[dict[str, Any]]) -> Iterable[dict[str, Any]]:
    """Return events in the form for past ones."""
    return ({**each, "is_past": True} for each in events)
