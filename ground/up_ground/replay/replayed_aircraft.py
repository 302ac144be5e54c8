"""A flight of the past as the server's one aircraft."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from up.flight_log.mcap_format import FlightLogError
from up.system.clock import Clock, Timer
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.telemetry_frames import Frame, frames
from up_ground.replay.player import Player
from up_ground.replay.timeline import ReplayTimeline, past
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.answers import Answer
from up_ground.web.client_session import ClientSession, FrameMessage, message_bytes
from up_ground.web.gains_history import GainsHistory
from up_ground.web.messages import PageFault, Reader

if TYPE_CHECKING:
    from up_ground.web.client_hub import ClientHub

REPLAY = "this is a replay"
REPEAT_S = 0.25
_BEFORE_S = 0.5
"""Frames that are made lie elsewhere, by less than this, when they are made from elsewhere on."""


class ReplayedAircraft(AircraftSource):
    """Shows a flight to the pages; any page that could control an aircraft plays and pauses it."""

    def __init__(
        self,
        clock: Clock,
        log: FlightLog,
        timeline: ReplayTimeline,
        title: str,
        subscribers: ClientHub,
    ) -> None:
        self.name = timeline.aircraft
        self._clock = clock
        self._log = log
        self._timeline = timeline
        self._title = title
        self._subscribers = subscribers
        self._frames = 0
        self._timer: Timer | None = None
        self._player = Player(
            clock,
            log.length_s,
            self._open_at,
            show=self._show,
            moved=self._on_moved,
            changed=self._on_changed,
        )

    @property
    def summary(self) -> str:
        return f"{self.name}: {self._title}, {self._timeline.length_s:.0f} s"

    def start(self) -> None:
        self._player.play()
        self._repeat()

    async def stop(self) -> None:
        self._player.stop()
        if self._timer is not None:
            self._timer.cancel()

    def past(self) -> Iterable[dict[str, Any]]:
        now_s = self._player.time_s
        yield self._replay()
        yield self._timeline.track_until(now_s)
        yield from past(self._timeline.events_until(now_s))
        yield self._timeline.alarms_at(now_s)
        yield self._gains(now_s)
        yield self._profile(now_s)

    def status(self, page: ClientSession) -> dict[str, Any]:
        pages = [{"page": each.number, "name": each.name} for each in self._subscribers.all()]
        return {
            "type": "status",
            "aircraft": self.name,
            "link": {"state": "connected", "aircraft_online": True, "frames": self._frames},
            "control": {
                "holder": "nobody",
                "holder_name": "",
                "asked_by": None,
                "asks_you": False,
                "pages": pages,
            },
            "role": "observer",
            "tune_in_flight": None,
            "home": self._timeline.home,
        }

    def on_replay(self, page: ClientSession, action: str, message: Reader) -> None:
        """Play, pause, go to a moment (value: seconds), set the speed (value: a factor)."""
        if not page.may_control:
            raise PageFault(f"this page may only watch: {page.denial}", "watch_only")
        if action in ("seek", "speed"):
            value = message.number("value")
            if not math.isfinite(value) or value < 0:
                raise PageFault("value is not a number of at least 0")
            if action == "seek":
                self._seek(value)
            else:
                try:
                    self._player.set_speed(value)
                except ValueError as error:
                    raise PageFault(str(error)) from None
        elif action == "play":
            if self._player.time_s >= self._player.length_s:
                self._seek(0.0)
            self._player.play()
        else:
            self._player.pause()

    def on_control(self, page: ClientSession, action: str, to: int | None) -> None:
        raise PageFault(REPLAY, "replay")

    def on_command(self, page: ClientSession, message: Reader) -> None:
        page.send(Answer("refused", "replay", REPLAY).message(message.whole("ask")))

    def _seek(self, time_s: float) -> None:
        self._player.seek(time_s)
        for each in self.past():
            self._subscribers.notify(self.name, each)

    def _open_at(self, time_s: float) -> Any:
        try:
            newest_s = self._timeline.frame_time_s(time_s)
            since_s = time_s if newest_s is None else newest_s - _BEFORE_S
            yield from frames(self._log, since_s=max(0.0, since_s))
        except FlightLogError:
            # The file became unreadable during playback: keep the part already shown.
            return

    def _show(self, frame: Frame) -> None:
        self._frames += 1

        def age_s(now_s: float) -> float:
            return max(0.0, self._player.time_s - frame.time_s)

        self.newest_frame = FrameMessage(
            self.name, frame.beacon, frame.data, age_s, self._clock.seconds, frame.time_s
        )
        self._subscribers.send_latest(self.name, "frame", self.newest_frame)

    def _on_moved(self, before_s: float, now_s: float) -> None:
        for event in self._timeline.events_between(before_s, now_s):
            self._subscribers.notify(self.name, event)
        alarms = self._timeline.alarms_at(now_s)
        if alarms != self._timeline.alarms_at(before_s):
            self._subscribers.notify(self.name, alarms)
        if self._timeline.gains_at(now_s) is not self._timeline.gains_at(before_s):
            self._subscribers.notify(self.name, self._gains(now_s))
        if self._timeline.profile_at(now_s) is not self._timeline.profile_at(before_s):
            self._subscribers.notify(self.name, self._profile(now_s))

    def _gains(self, time_s: float) -> dict[str, Any]:
        history = GainsHistory()
        flying = self._timeline.gains_at(time_s)
        if flying is not None:
            history.on_values(flying.values, flying.time_s)
        return history.message(self.name, time_s)

    def _profile(self, time_s: float) -> dict[str, Any]:
        reported = self._timeline.profile_at(time_s)
        profile = None if reported is None else reported.values
        return {"type": "profile", "aircraft": self.name, "profile": profile}

    def _on_changed(self) -> None:
        self._subscribers.send_latest(self.name, "replay", lambda: message_bytes(self._replay()))

    def _repeat(self) -> None:
        self._timer = self._clock.callLater(REPEAT_S, self._repeat)
        self._on_changed()

    def _replay(self) -> dict[str, Any]:
        return {
            "type": "replay",
            "name": self._title,
            "time_s": round(self._player.time_s, 3),
            "length_s": round(self._player.length_s, 3),
            "speed": self._player.speed,
            "is_playing": self._player.is_playing,
        }
