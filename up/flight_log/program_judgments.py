"""Faults of the program: load, gains, modes, the recording itself, errors of its log."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from up.flight_log.facts import Facts, LogLine
from up.flight_log.gain_changes import changes_text
from up.flight_log.json_message import number_at
from up.flight_log.origin_text import KEY
from up.flight_log.spans import Span, duration_text
from up.flight_log.wrong import Judge, Level, Wrong

SILENT_S = 2.0
"""Something is logged many times a second; a total silence this long is reported."""
LOG_ERROR = 4
_MOST_LINES = 50
_HELD = re.compile(r"(\S+) holds the reactor for more than (\d+) ms")
_RECORDER: tuple[tuple[re.Pattern[str], Level, str], ...] = (
    (re.compile(r"the flight is not recorded: (.+?)(?:; tried .*)?"), "alarm", "recording ended: "),
    (re.compile(r"records again, .*; (\d+ messages are lost)"), "warning", "recorded again: "),
    (re.compile(r"(\d+ messages were not recorded: .+)"), "warning", ""),
    (re.compile(r"(.+ was removed; a new file is begun)"), "warning", ""),
)


def held_up(facts: Facts) -> Iterator[Wrong]:
    """Blocked event loops; logged once each, counted in telemetry.

    Nothing depends on the program during its start: a block then is reported, but is not a fault.
    """
    known = (state.time_s for state in facts.states if state.flight_mode is not None)
    begin_s = next(known, float("-inf"))
    for line in facts.log_lines:
        match = _HELD.match(line.text)
        if match is None:
            continue
        text = f"Raspilot was held up for more than {match[2]} ms by {match[1]}"
        count = _holds(facts.last_telemetry, match[1])
        if line.time_s >= begin_s:
            often = f", {count:.0f} times in all" if count > 1 else ""
            yield Wrong(line.time_s, "warning", f"{text}{often}")
            continue
        later = count - _holds(facts.first_telemetry(begin_s), match[1])
        if later > 0:
            text += f" while it started, and {_times(later)} in flight"
            yield Wrong(line.time_s, "warning", text)
        else:
            yield Wrong(line.time_s, "info", f"{text} while it started")


def panic(facts: Facts) -> Iterator[Wrong]:
    """Panic Mode: the load was too high and all senders reduced their rate."""
    commands = {each.time_s: each.data for each in facts.log.messages("up.panic")}
    for span in facts.spans((at_s, data.get("panic") is True) for at_s, data in commands.items()):
        load = number_at(commands[span.begin_s], ("utilization",))
        why = "" if load is None else f", at {load:g} percent of load"
        text = f"Panic Mode {span.length_text}{why}"
        yield Wrong(span.begin_s, "warning", text, span.length_s)


ANSWER_S = 3.0
"""A Command is answered within this time (docs/protocols.md 4)."""


def gains_changed(facts: Facts) -> Iterator[Wrong]:
    """Gains set in flight, and by which link."""
    known: Mapping[str, Any] = {}
    answers = [
        (each.time_s, each.data.get("outcome"))
        for each in facts.log.messages("up.command.answered")
        if each.data.get("name") == "arduino.pids.tunings"
    ]
    for each in facts.log.messages("arduino.pids.tunings", "arduino.pids.values"):
        is_set = each.topic == "arduino.pids.tunings"
        gains = each.data.get("pids") if is_set else each.data
        if not isinstance(gains, dict) or each.data.get("request") is True:
            continue
        asked_s = each.time_s
        outcome = next((what for time_s, what in answers if 0 <= time_s - asked_s <= ANSWER_S), "")
        if is_set and outcome == "nack":
            continue
        if is_set and _flies(facts, each.time_s):
            who = each.data.get(KEY)
            by = f" by {who}" if isinstance(who, str) else ""
            text = f"gains were set in flight{by}; which flew before is not told"
            if known:
                changes = changes_text(known, gains) or "to what they were"
                text = f"gains were changed in flight{by}: {changes}"
            yield Wrong(each.time_s, "warning", text)
        known = gains


def provisional(facts: Facts) -> Iterator[Wrong]:
    """Black Box Mode because the board did not answer."""
    states = (
        (each.time_s, "provisional" in str(each.data.get("mode")))
        for each in facts.log.messages("up.system.state")
    )
    for span in facts.spans(states):
        text = f"provisionally in Black Box Mode {span.length_text}: no frame came from the board"
        level: Level = "alarm" if facts.was_armed(span) else "warning"
        yield Wrong(span.begin_s, level, text, span.length_s)


def nothing_logged(facts: Facts) -> Iterator[Wrong]:
    """A gap in all topics: the program or the recording stood still."""
    for begin_s, length_s in facts.log.gaps(SILENT_S):
        armed = facts.was_armed(Span(begin_s, begin_s + length_s))
        text = f"nothing at all was logged for {duration_text(length_s)}"
        yield Wrong(begin_s, "alarm" if armed else "warning", text, length_s)


def recording(facts: Facts) -> Iterator[Wrong]:
    """The recorder's own reports: a full disk, a slow one, a deleted file."""
    for line in facts.log_lines:
        for pattern, level, lead in _RECORDER:
            match = pattern.fullmatch(line.text)
            if match is not None:
                yield Wrong(line.time_s, level, f"{lead}{match[1]}")


def errors(facts: Facts) -> Iterator[Wrong]:
    """The errors of the program's log that no other judgment reports; each text once."""
    seen: dict[str, list[Any]] = {}
    for line in facts.log_lines:
        if line.level >= LOG_ERROR and not _is_told_elsewhere(line):
            text = f"{line.name}: {line.text}" if line.name else line.text
            if text in seen:
                seen[text][1] += 1
            elif len(seen) < _MOST_LINES:
                seen[text] = [line.time_s, 1]
    for text, (time_s, count) in seen.items():
        yield Wrong(time_s, "warning", text + (f" ({count} times)" if count > 1 else ""))


def log_damaged(facts: Facts) -> Iterator[Wrong]:
    """The log itself: truncated, damaged, partly unreadable."""
    for problem in facts.log.problems:
        yield Wrong(facts.log.length_s, "warning", problem)


def _is_told_elsewhere(line: LogLine) -> bool:
    return (
        _HELD.match(line.text) is not None
        or line.text.startswith("the phone's battery is low")
        or any(pattern.fullmatch(line.text) for pattern, _, _ in _RECORDER)
    )


def _flies(facts: Facts, time_s: float) -> bool:
    state = facts.state_at(time_s)
    return state is not None and (state.is_armed is True or state.is_auto is True)


def _holds(frame: Mapping[str, Any], culprit: str) -> float:
    """Return how often the event loop was blocked, at least 1: the log line is the first time."""
    return max(1.0, number_at(frame.get("counters"), ("reactor", culprit)) or 0.0)


def _times(count: float) -> str:
    return "once" if count == 1 else f"{count:.0f} times"


PROGRAM_JUDGMENTS: tuple[Judge, ...] = (
    held_up,
    panic,
    gains_changed,
    provisional,
    nothing_logged,
    recording,
    errors,
    log_damaged,
)
