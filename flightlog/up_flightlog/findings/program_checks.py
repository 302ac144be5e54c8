"""Faults of the program: load, gains, modes, refused Commands, the recording, logged errors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from up.flight_log.gain_changes import changes_text
from up.flight_log.json_message import number_at
from up.flight_log.origin_text import KEY
from up_flightlog.findings.finding import Check, Finding, Level, lasting
from up_flightlog.findings.flight_context import ERROR, FlightContext
from up_flightlog.read.spans import Span

MIN_SILENCE_S = 2.0
"""Something is logged many times a second; a total silence this long is reported."""
ANSWER_S = 3.0
"""A Command is answered within this time (docs/protocols.md 4)."""
PROVISIONAL = "black box (provisional)"
"""The mode of ``up.system.state`` while the board is silent."""
_ANSWERED = "up.command.answered"
_MAX_KINDS = 100
_MAX_LINES = 50
_BLOCKED = "event_loop_blocked"
_RECORDER: dict[str, tuple[Level, str]] = {
    "recording_stopped": ("alarm", "recording stopped: {problem}"),
    "recording_resumed": ("warning", "recording resumed: {count:.0f} messages were lost"),
    "messages_dropped": ("warning", "{count:.0f} messages were not recorded: the disk is too slow"),
    "recording_removed": ("warning", "{path} was deleted; recording continued in a new file"),
}
"""The recorder's log lines by code: the level of the finding, and its text from the fields."""
_REPORTED = frozenset({*_RECORDER, _BLOCKED, "battery_low"})
"""Log lines that other checks report."""


def event_loop_blocked(context: FlightContext) -> Iterator[Finding]:
    """Blocked event loops; logged once each, counted in telemetry.

    Nothing depends on the program during its start: a block then is reported, but is not a fault.
    """
    known = (state.time_s for state in context.states if state.flight_mode is not None)
    begin_s = next(known, float("-inf"))
    for line in context.log_lines:
        if line.code != _BLOCKED:
            continue
        call, ms = str(line.fields.get("call")), number_at(line.fields, ("ms",)) or 0.0
        count = _blocks(context.last_telemetry, call)
        level: Level = "warning"
        if line.time_s >= begin_s:
            detail = f", {count:.0f} times in all" if count > 1 else ""
        else:
            detail = " during start-up"
            count -= _blocks(context.first_telemetry(begin_s), call)
            if count > 0:
                detail += f", and {_times(count)} in flight"
            else:
                level = "info"
        text = f"Raspilot was blocked for more than {ms:.0f} ms by {call}"
        fields = {"call": call, "count": count}
        yield Finding(line.time_s, level, _BLOCKED, text, detail, subject=call, fields=fields)


def panic(context: FlightContext) -> Iterator[Finding]:
    """Panic Mode: the load was too high and all senders reduced their rate."""
    commands = {each.time_s: each.data for each in context.log.messages("up.panic")}
    for span in context.spans((at_s, data.get("panic") is True) for at_s, data in commands.items()):
        load = number_at(commands[span.begin_s], ("utilization",))
        detail = "" if load is None else f", at {load:g} percent of load"
        fields = {} if load is None else {"load": load}
        yield lasting(span, "warning", "panic", "Panic Mode", detail, fields=fields)


def gains_changed(context: FlightContext) -> Iterator[Finding]:
    """Gains set in flight, and by which link."""
    known: Mapping[str, Any] = {}
    answers = [
        (each.time_s, each.data.get("outcome"))
        for each in context.log.messages(_ANSWERED)
        if each.data.get("name") == "arduino.pids.tunings"
    ]
    for each in context.log.messages("arduino.pids.tunings", "arduino.pids.values"):
        is_set = each.topic == "arduino.pids.tunings"
        gains = each.data.get("pids") if is_set else each.data
        if not isinstance(gains, dict) or each.data.get("request") is True:
            continue
        sent_s = each.time_s
        outcome = next((what for time_s, what in answers if 0 <= time_s - sent_s <= ANSWER_S), "")
        if is_set and outcome == "nack":
            continue
        if is_set and _flies(context, each.time_s):
            origin = each.data.get(KEY)
            by = f" by {origin}" if isinstance(origin, str) else ""
            changes = changes_text(known, gains) or "no value differs" if known else ""
            yield Finding(
                each.time_s,
                "warning",
                "gains_changed",
                f"gains were {'changed' if known else 'set'} in flight{by}",
                f": {changes}" if known else "; the earlier gains are unknown",
                subject=changes,
                fields={"origin": origin, "changes": changes},
            )
        known = gains


def provisional(context: FlightContext) -> Iterator[Finding]:
    """Black Box Mode because the board did not answer."""
    states = (
        (each.time_s, each.data.get("mode") == PROVISIONAL)
        for each in context.log.messages("up.system.state")
    )
    for span in context.spans(states):
        level: Level = "alarm" if context.was_armed(span) else "warning"
        text, detail = "provisionally in Black Box Mode", ": no frame came from the board"
        yield lasting(span, level, "provisional_mode", text, detail)


def nothing_logged(context: FlightContext) -> Iterator[Finding]:
    """A gap in all topics: the program or the recording stood still."""
    for begin_s, length_s in context.log.gaps(MIN_SILENCE_S):
        span = Span(begin_s, begin_s + length_s)
        level: Level = "alarm" if context.was_armed(span) else "warning"
        yield lasting(span, level, "log_gap", "nothing was logged")


def command_refused(context: FlightContext) -> Iterator[Finding]:
    """Refused Commands, one finding per Command, link and reason, with its count."""
    first_s: dict[tuple[str, str, str], float] = {}
    counts: dict[tuple[str, str, str], int] = {}
    codes: dict[tuple[str, str, str], str] = {}
    unlogged, unlogged_s = 0, 0.0
    for each in context.log.messages(_ANSWERED):
        left_out = each.data.get("untold")
        if type(left_out) is int and left_out > 0:
            unlogged, unlogged_s = unlogged + left_out, unlogged_s or each.time_s
        if each.data.get("outcome") != "nack":
            continue
        name, link, reason = (str(each.data.get(key) or "") for key in ("name", "link", "reason"))
        kind = (name or "a message", link, reason.removeprefix(f"{name}: "))
        if kind in counts:
            counts[kind] += 1
        elif len(counts) < _MAX_KINDS:
            counts[kind], first_s[kind] = 1, each.time_s
            codes[kind] = str(each.data.get("code") or "")
    for kind, count in counts.items():
        name, link, reason = kind
        yield Finding(
            first_s[kind],
            "info",
            "command_refused",
            f"{name} of {link} was refused: {reason}",
            f", {count} times" if count > 1 else "",
            subject=f"{name} {link} {codes[kind]}",
            fields={"name": name, "link": link, "reason": codes[kind], "count": count},
        )
    if unlogged:
        text = f"{unlogged} answers to Commands came too fast to be logged"
        yield Finding(unlogged_s, "info", "answers_dropped", text, fields={"count": unlogged})


def recording(context: FlightContext) -> Iterator[Finding]:
    """The recorder's own reports: a full disk, a slow one, a deleted file."""
    for line in context.log_lines:
        if line.code in _RECORDER:
            level, text = _RECORDER[line.code]
            fields = {
                "count": number_at(line.fields, ("count",)) or 0.0,
                **{key: str(line.fields.get(key)) for key in ("problem", "path")},
            }
            summary = text.format_map(fields)
            yield Finding(line.time_s, level, line.code, summary, fields=line.fields)


def errors(context: FlightContext) -> Iterator[Finding]:
    """The errors of the program's log that no other check reports; each text once."""
    seen: dict[str, list[Any]] = {}
    for line in context.log_lines:
        if line.level >= ERROR and line.code not in _REPORTED:
            text = f"{line.name}: {line.text}" if line.name else line.text
            if text in seen:
                seen[text][1] += 1
            elif len(seen) < _MAX_LINES:
                seen[text] = [line, 1]
    for text, (line, count) in seen.items():
        detail = f" ({count} times)" if count > 1 else ""
        subject = line.code or text
        fields = {"code": line.code, **line.fields}
        yield Finding(
            line.time_s, "warning", "logged_error", text, detail, subject=subject, fields=fields
        )


def log_damaged(context: FlightContext) -> Iterator[Finding]:
    """The log itself: truncated, damaged, partly unreadable."""
    for problem in context.log.problems:
        yield Finding(
            context.log.length_s, "warning", "log_damaged", problem.text, subject=problem.code
        )


def _flies(context: FlightContext, time_s: float) -> bool:
    state = context.state_at(time_s)
    return state is not None and (state.is_armed is True or state.is_auto is True)


def _blocks(frame: Mapping[str, Any], call: str) -> float:
    """Return how often the event loop was blocked, at least 1: the log line is the first time."""
    return max(1.0, number_at(frame.get("counters"), ("reactor", call)) or 0.0)


def _times(count: float) -> str:
    return "once" if count == 1 else f"{count:.0f} times"


PROGRAM_CHECKS: tuple[Check, ...] = (
    event_loop_blocked,
    panic,
    gains_changed,
    provisional,
    nothing_logged,
    command_refused,
    recording,
    errors,
    log_damaged,
)
