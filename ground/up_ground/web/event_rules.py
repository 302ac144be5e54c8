"""The rules for events and alarms: which values of a frame, which text."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from up_ground.status_text import busy_text
from up_ground.telemetry import Telemetry

INFO, WARNING, ALARM = "info", "warning", "alarm"
NOT_YET = "not yet"
"""A part that was never connected and never reported anything does not count as lost."""

Words = Callable[[Any, Any], tuple[str, str] | None]


@dataclass(frozen=True, slots=True)
class EventRule:
    """A value of the frame: ``read`` returns it or None (unknown, does not count as a change).

    ``words(before, now)`` returns level and text of the change, or None for no event; ``before``
    is None for the first value.
    """

    key: str
    kind: str
    read: Callable[[Telemetry], Any]
    words: Words


def _flag(key: str, kind: str, path: str, bad: bool, said_bad: str, said_good: str,
          level: str = WARNING) -> EventRule:  # fmt: skip
    """Return a rule that is reported when it becomes bad, and when it is good again."""
    steps = path.split(".")

    def words(before: Any, now: Any) -> tuple[str, str] | None:
        if now is bad:
            return level, said_bad
        return None if before is None else (INFO, said_good)

    return EventRule(key, kind, lambda telemetry: telemetry.flag(*steps), words)


def board_state(telemetry: Telemetry) -> bool | str | None:
    """Return whether the board is connected, or ``NOT_YET``; None if not reported."""
    return _state(telemetry, "arduino", ("flight", "rx", "servo"))


def phone_state(telemetry: Telemetry) -> bool | str | None:
    """Return whether the phone is connected, or ``NOT_YET``; None if not reported."""
    return _state(telemetry, "android", ("battery",))


def _state(telemetry: Telemetry, link: str, readings: tuple[str, ...]) -> bool | str | None:
    is_there = telemetry.flag(link, "connected")
    was_there = any(telemetry.number("age_ms", each) is not None for each in readings)
    return NOT_YET if is_there is False and not was_there else is_there


def _part(key: str, read: Callable[[Telemetry], Any], back: str, level: str) -> EventRule:
    """Return a rule of a part that may connect after the program, and disconnect."""

    def words(before: Any, now: Any) -> tuple[str, str] | None:
        if now is False or (now is NOT_YET and before is True):
            return level, f"the {key} is gone"
        if now is NOT_YET:
            return (INFO, f"the {key} is not here yet") if before is None else None
        if before is None:
            return None
        return INFO, f"the {key} is {'here' if before is NOT_YET else back}"

    return EventRule(key, "link", read, words)


def _armed(before: Any, now: Any) -> tuple[str, str] | None:
    if before is None:
        return (WARNING, "the aircraft is armed") if now else None
    return (WARNING, "armed") if now else (INFO, "disarmed")


def _named(what: str) -> Words:
    def words(before: Any, now: Any) -> tuple[str, str] | None:
        return None if before is None else (INFO, f"{what} {now} (was {before})")

    return words


def _vetoes(before: Any, now: Any) -> tuple[str, str] | None:
    is_armed, vetoes = now
    if before is None and not vetoes:
        return None
    if before is not None and before[1] == vetoes:
        return None
    if not vetoes:
        return INFO, "nothing speaks against arming any more"
    against = "against arming again" if is_armed else "against arming"
    return INFO, f"{against}: {'; '.join(vetoes)}"[:400]


def _read_vetoes(telemetry: Telemetry) -> Any:
    vetoes = telemetry.texts("vetoes")
    return None if vetoes is None else (bool(telemetry.flag("armed")), tuple(sorted(vetoes)))


def _restored(before: Any, now: Any) -> tuple[str, str] | None:
    if not now:
        return None
    return ALARM, "the board was reset in flight and went on as before"


@dataclass(frozen=True, slots=True)
class _Busy:
    """The Raspberry Pi is busy: all instances are equal, so a new load figure is not a change."""

    words: str = field(compare=False)


def _read_busy(telemetry: Telemetry) -> Any:
    is_busy = telemetry.flag("load", "panic")
    return _Busy(busy_text(telemetry)) if is_busy else is_busy


def _busy(before: Any, now: Any) -> tuple[str, str] | None:
    if now:
        return INFO, now.words
    return None if before is None else (INFO, "Raspberry Pi not busy any more")


def _source(reading: str) -> EventRule:
    def words(before: Any, now: Any) -> tuple[str, str] | None:
        return None if before is None else (WARNING, f"{reading} comes from {now} (was {before})")

    return EventRule(
        f"source {reading}",
        "source",
        lambda telemetry: telemetry.text("source", reading),
        words,
    )


def _role(before: Any, now: Any) -> tuple[str, str] | None:
    return None if before is None else (WARNING, f"the ground is {now} now (was {before})")


EVENT_RULES: tuple[EventRule, ...] = (
    EventRule("flight mode", "mode", lambda t: t.text("flight_mode"), _named("flight mode")),
    EventRule("mode", "mode", lambda t: t.text("mode"), _named("mode")),
    EventRule("switch", "mode", lambda t: t.text("arduino", "switch"), _named("switch position")),
    EventRule("armed", "armed", lambda t: t.flag("armed"), _armed),
    _flag("failsafe", "failsafe", "arduino.failsafe", True,
          "failsafe: the board flies without a receiver", "the failsafe is over", ALARM),
    _flag("receiver", "failsafe", "arduino.receiver_valid", False,
          "the receiver is lost", "the receiver is back"),
    _flag("imu", "source", "arduino.imu_valid", False,
          "the IMU is invalid: nothing stabilises", "the IMU is valid", ALARM),
    EventRule("restored", "source", lambda t: t.flag("arduino", "restored"), _restored),
    _part("board", board_state, "back", ALARM),
    _part("phone", phone_state, "here again", WARNING),
    EventRule("competitor", "source", lambda t: t.text("android", "competitor"),
         lambda _, now: (WARNING, f"another phone, {now}, is refused: one is connected")),
    EventRule("panic", "panic", _read_busy, _busy),
    EventRule("vetoes", "veto", _read_vetoes, _vetoes),
    EventRule("role", "link", lambda t: t.text("ground", "role", limit=12), _role),
    *(_source(each) for each in ("orientation", "location", "altitude", "heading", "battery")),
)  # fmt: skip


ALARM_HOLD_S = 2.0
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
class LinkSnapshot:
    """State of the link at a moment; None: not known."""

    is_open: bool
    reason: str
    is_aircraft_online: bool | None
    was_heard: bool
    is_silent: bool
    is_late: bool = False
    """Telemetry arrives, but is as old as if the link were silent."""


class Alarms:
    """The active alarms. One begins immediately and ends ``hold_s`` after its cause."""

    def __init__(self, hold_s: float = ALARM_HOLD_S) -> None:
        self._over_s = hold_s
        self._had_board = False
        self.active: tuple[Alarm, ...] = ()
        self._seen_s: dict[str, float] = {}
        self._known: dict[str, Alarm] = {}

    def update(self, telemetry: Telemetry, link: LinkSnapshot, now_s: float) -> bool:
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


def _wrong(telemetry: Telemetry, link: LinkSnapshot, was_low: bool, had_board: bool) -> list[Alarm]:
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


def _silence(link: LinkSnapshot) -> str:
    if not link.is_open:
        return f"no link: {link.reason}"[:300] if link.reason else "no link"
    if link.is_aircraft_online is False:
        return "the aircraft is not connected to the proxy"
    return "telemetry comes too late" if link.is_late else "the aircraft is silent"
