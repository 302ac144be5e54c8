"""The present alarms: faults that need immediate attention."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from up_ground.telemetry import Telemetry
from up_ground.web.facts import ALARM, NOT_YET, WARNING, board_state, phone_state

OVER_S = 2.0
"""An alarm ends when its cause has been away for this time."""
BATTERY_LOW = 20.0
BATTERY_EMPTY = 10.0
_BATTERY_BACK = 3.0


@dataclass(frozen=True, slots=True)
class Alarm:
    """Something that is wrong; ``kind`` is one word, one alarm of each kind at most."""

    kind: str
    level: str
    text: str


@dataclass(frozen=True, slots=True)
class LinkFacts:
    """State of the link at a moment; None: not known."""

    is_open: bool
    reason: str
    is_aircraft_online: bool | None
    was_heard: bool
    is_silent: bool
    is_late: bool = False
    """Telemetry arrives, but is as old as if the link were silent."""


class Alarms:
    """The active alarms. One begins immediately and ends ``over_s`` after its cause."""

    def __init__(self, over_s: float = OVER_S) -> None:
        self._over_s = over_s
        self._had_board = False
        self.active: tuple[Alarm, ...] = ()
        self._seen_s: dict[str, float] = {}
        self._known: dict[str, Alarm] = {}

    def take(self, telemetry: Telemetry, link: LinkFacts, now_s: float) -> bool:
        """Update to this moment; return whether the alarms changed."""
        self._had_board = self._had_board or board_state(telemetry) is True
        wrong = _wrong(telemetry, link, "battery" in self._known, self._had_board)
        found = {each.kind: each for each in wrong}
        self._known.update(found)
        self._seen_s.update(dict.fromkeys(found, now_s))
        for kind, seen_s in list(self._seen_s.items()):
            if kind not in found and now_s - seen_s >= self._over_s:
                del self._seen_s[kind], self._known[kind]
        active = tuple(self._known[kind] for kind in sorted(self._known))
        has_changed = active != self.active
        self.active = active
        return has_changed

    def message(self, aircraft: str) -> dict[str, Any]:
        """Return the message for the pages."""
        return {
            "type": "alarms",
            "aircraft": aircraft,
            "active": [
                {"kind": each.kind, "level": each.level, "text": each.text} for each in self.active
            ],
        }


def _wrong(telemetry: Telemetry, link: LinkFacts, was_low: bool, had_board: bool) -> list[Alarm]:
    found: list[Alarm] = []
    if link.was_heard and link.is_silent:
        found.append(Alarm("silent", ALARM, _silence(link)))
    flag = telemetry.flag
    if flag("arduino", "failsafe"):
        found.append(Alarm("failsafe", ALARM, "failsafe: the board flies without a receiver"))
    elif flag("arduino", "receiver_valid") is False:
        level = ALARM if flag("armed") else WARNING
        found.append(Alarm("receiver", level, "the receiver is lost"))
    if flag("arduino", "imu_valid") is False:
        found.append(Alarm("imu", ALARM, "the IMU is invalid: nothing stabilises"))
    if board_state(telemetry) is NOT_YET and not had_board:
        found.append(Alarm("board", WARNING, "the board is not here yet"))
    elif flag("arduino", "connected") is False:
        found.append(Alarm("board", ALARM, "the board is gone"))
    if phone_state(telemetry) is False:
        found.append(Alarm("phone", WARNING, "the phone is gone"))
    level_percent = telemetry.number("android", "batteryLevel")
    if level_percent is not None:
        bound = BATTERY_LOW + (_BATTERY_BACK if was_low else 0.0)
        if level_percent < bound:
            level = ALARM if level_percent < BATTERY_EMPTY else WARNING
            word = "nearly empty" if level == ALARM else "low"
            found.append(Alarm("battery", level, f"the phone's battery is {word}"))
    return found


def _silence(link: LinkFacts) -> str:
    if not link.is_open:
        return f"no link: {link.reason}"[:300] if link.reason else "no link"
    if link.is_aircraft_online is False:
        return "the aircraft is not connected to the proxy"
    return "telemetry comes too late" if link.is_late else "the aircraft is silent"
