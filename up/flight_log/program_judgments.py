"""What went wrong in the program: load, gains, modes, the recording itself, errors of its log."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from up.flight_log.facts import Facts, LogLine
from up.flight_log.json_message import number_at
from up.flight_log.origin_text import KEY
from up.flight_log.spans import Span, duration_text
from up.flight_log.wrong import Judge, Level, Wrong

SILENT_S = 2.0
"""Something is logged many times a second; nothing at all for so long is told."""
LOG_ERROR = 4
_MOST_LINES = 50
_HELD = re.compile(r"(\S+) holds the reactor for more than (\d+) ms")
_REFUSED = re.compile(r"\S+ refused (up\.arm|up\.disarm|up\.flight_mode\.set): (.+)")
_RECORDER: tuple[tuple[re.Pattern[str], Level, str], ...] = (
    (re.compile(r"the flight is not recorded: (.+?)(?:; tried .*)?"), "alarm", "recording ended: "),
    (re.compile(r"records again, .*; (\d+ messages are lost)"), "warning", "recorded again: "),
    (re.compile(r"(\d+ messages were not recorded: .+)"), "warning", ""),
    (re.compile(r"(.+ was removed; a new file is begun)"), "warning", ""),
)


def held_up(facts: Facts) -> Iterator[Wrong]:
    """Whoever held the reactor, and with it everything; logged once, counted in telemetry."""
    counts: Any = facts.last_telemetry.get("counters")
    for line in facts.log_lines:
        match = _HELD.match(line.text)
        if match is not None:
            count = number_at(counts, ("reactor", match[1]))
            often = f", {count:.0f} times in all" if count is not None and count > 1 else ""
            text = f"Raspilot was held up for more than {match[2]} ms by {match[1]}{often}"
            yield Wrong(line.time_s, "warning", text)


def panic(facts: Facts) -> Iterator[Wrong]:
    """Panic Mode: the load was too high and everybody sent less."""
    commands = {each.time_s: each.data for each in facts.log.messages("up.panic")}
    for span in facts.spans((at_s, data.get("panic") is True) for at_s, data in commands.items()):
        load = number_at(commands[span.begin_s], ("utilization",))
        why = "" if load is None else f", at {load:g} percent of load"
        yield Wrong(span.begin_s, "warning", f"Panic Mode {span.length_text}{why}")


def gains_changed(facts: Facts) -> Iterator[Wrong]:
    """Gains that were set while it flew, and by whom."""
    known: Mapping[str, Any] = {}
    for each in facts.log.messages("arduino.pids.tunings", "arduino.pids.values"):
        is_set = each.topic == "arduino.pids.tunings"
        gains = each.data.get("pids") if is_set else each.data
        if not isinstance(gains, dict) or each.data.get("request") is True:
            continue
        if is_set and _flies(facts, each.time_s):
            changes = ", ".join(_changes(known, gains)) or "to what they were"
            who = each.data.get(KEY)
            by = f" by {who}" if isinstance(who, str) else ""
            yield Wrong(each.time_s, "warning", f"gains were changed in flight{by}: {changes}")
        known = gains


def arming_refused(facts: Facts) -> Iterator[Wrong]:
    """What the ground asked for and did not get."""
    for line in facts.log_lines:
        match = _REFUSED.match(line.text)
        if match is not None:
            yield Wrong(line.time_s, "info", f"{match[1]} was refused: {match[2]}")


def provisional(facts: Facts) -> Iterator[Wrong]:
    """Black Box Mode because the board did not answer."""
    states = (
        (each.time_s, "provisional" in str(each.data.get("mode")))
        for each in facts.log.messages("up.system.state")
    )
    for span in facts.spans(states):
        text = f"provisionally in Black Box Mode {span.length_text}: no frame came from the board"
        yield Wrong(span.begin_s, "alarm" if facts.was_armed(span) else "warning", text)


def nothing_logged(facts: Facts) -> Iterator[Wrong]:
    """A gap in everything: the program stood still, or the recording did."""
    for begin_s, length_s in facts.log.gaps(SILENT_S):
        armed = facts.was_armed(Span(begin_s, begin_s + length_s))
        text = f"nothing at all was logged for {duration_text(length_s)}"
        yield Wrong(begin_s, "alarm" if armed else "warning", text)


def recording(facts: Facts) -> Iterator[Wrong]:
    """What the recorder says of itself: a full disk, a slow one, a file that was removed."""
    for line in facts.log_lines:
        for pattern, level, lead in _RECORDER:
            match = pattern.fullmatch(line.text)
            if match is not None:
                yield Wrong(line.time_s, level, f"{lead}{match[1]}")


def errors(facts: Facts) -> Iterator[Wrong]:
    """The errors of the program's log that no other judgment tells; each text once."""
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
    """The log itself: cut off, damaged, parts of it unreadable."""
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


def _changes(before: Mapping[str, Any], after: Mapping[str, Any], path: str = "") -> Iterator[str]:
    """Yield what differs, ``ratePIDs.ailerons.p 2 to 2.5``."""
    for key, value in after.items():
        if key.startswith("_"):
            continue
        place, old = f"{path}.{key}" if path else key, before.get(key)
        if isinstance(value, dict):
            yield from _changes(old if isinstance(old, dict) else {}, value, place)
        elif value != old:
            known, new = number_at(before, (key,)), number_at(after, (key,))
            told = value if new is None else f"{new:g}"
            yield f"{place} {told}" if known is None else f"{place} {known:g} to {told}"


PROGRAM_JUDGMENTS: tuple[Judge, ...] = (
    held_up,
    panic,
    gains_changed,
    arming_refused,
    provisional,
    nothing_logged,
    recording,
    errors,
    log_damaged,
)
