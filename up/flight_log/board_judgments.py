"""Faults of the board: receiver, IMU, resets, its loop and its line."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import asdict
from math import inf

from up.flight_log.board_status import (
    IMU_VALID,
    PI_HEARD,
    RECEIVER_VALID,
    has_bit,
    reset_causes_of,
)
from up.flight_log.facts import Facts
from up.flight_log.json_message import number_at
from up.flight_log.spans import Span, joined
from up.flight_log.wrong import Judge, Level, Wrong

RX = "up.rx.update"
CHANNELS = ("ailerons", "elevator", "throttle", "rudder", "aux1", "aux2")
BLINK_S = 0.1
"""Shorter gaps are not reported: one bad pulse is not a loss."""
LATE_US = 1000
ESTIMATE_LIMIT_DEG = 2.0
_ALL_VALID = 0b111111
_FREQUENT = 100
_RESTORED = 7


def _level(facts: Facts, span: Span) -> Level:
    """A loss while armed is an alarm; switching the transmitter off after landing is not."""
    if facts.was_armed(span):
        return "alarm"
    return "info" if span.is_open else "warning"


def receiver_lost(facts: Facts) -> Iterator[Wrong]:
    """The pilot's pulses: from the inputs themselves, otherwise from the board's status."""
    bad: list[tuple[float, int]] = []
    if RX in facts.log.topics:
        lost = facts.lost(_validity(facts, bad))
    else:
        lost = facts.flag_lost(RECEIVER_VALID)
    for span in joined(lost, 2 * BLINK_S):
        if span.length_s < BLINK_S:
            continue
        within = bad[bisect_left(bad, (span.begin_s,)) : bisect_left(bad, (span.end_s,))]
        gone = [
            name for bit, name in enumerate(CHANNELS) if any(not v >> bit & 1 for _, v in within)
        ]
        text = f"the receiver was lost {span.length_text}"
        if 0 < len(gone) < len(CHANNELS):
            text = f"no valid pulses of {', '.join(gone)} {span.length_text}"
        yield Wrong(span.begin_s, _level(facts, span), text, span.length_s)


def _validity(facts: Facts, bad: list[tuple[float, int]]) -> Iterator[tuple[float, bool]]:
    for each in facts.log.messages(RX):
        valid = each.data.get("valid")
        if type(valid) is int and 0 <= valid <= _ALL_VALID:
            if valid != _ALL_VALID:
                bad.append((each.time_s, valid))
            yield each.time_s, valid == _ALL_VALID


def failsafe(facts: Facts) -> Iterator[Wrong]:
    """The receiver's failsafe: the board circled without the pilot."""
    for span in facts.spans((each.time_s, each.is_failsafe is True) for each in facts.states):
        yield Wrong(
            span.begin_s,
            _level(facts, span),
            f"the receiver's failsafe acted {span.length_text}",
            span.length_s,
        )


def imu_invalid(facts: Facts) -> Iterator[Wrong]:
    """No attitude: the board could not stabilise."""
    for span in facts.flag_lost(IMU_VALID):
        text = f"the IMU was invalid {span.length_text}"
        yield Wrong(span.begin_s, _level(facts, span), text, span.length_s)


def board_reset(facts: Facts) -> Iterator[Wrong]:
    """A restart of the board: its uptime went back, or its status reports a restart in flight."""
    before: float | None = None
    for each in facts.statuses():
        uptime_s = number_at(each.data, ("uptime_s",))
        restored = has_bit(each.data, "reset_cause", _RESTORED)
        if uptime_s is None:
            continue
        if (before is not None and uptime_s < before) or (before is None and restored):
            in_flight = restored or facts.was_armed(Span(each.time_s, each.time_s))
            where = "in flight " if in_flight else ""
            level: Level = "alarm" if in_flight else "warning"
            text = f"the board was reset {where}({reset_causes_of(each.data)})"
            yield Wrong(each.time_s, level, text)
        before = uptime_s


def board_silent(facts: Facts) -> Iterator[Wrong]:
    """The serial line: no frame came."""
    for span in facts.link_lost(lambda link: link == "arduino"):
        # A program that stood still logs the loss and its end at the same moment.
        if span.length_s >= BLINK_S:
            text = f"the board was silent {span.length_text}"
            yield Wrong(span.begin_s, _level(facts, span), text, span.length_s)


def raspberry_unheard(facts: Facts) -> Iterator[Wrong]:
    """The other direction: the board received nothing from Raspilot."""
    for span in facts.flag_lost(PI_HEARD):
        text = f"the board did not hear Raspilot {span.length_text}"
        yield Wrong(span.begin_s, _level(facts, span), text, span.length_s)


def loop_late(facts: Facts) -> Iterator[Wrong]:
    """The control loop on the board ran late."""
    late = [(each.time_s, number_at(each.data, ("late_us",)) or 0.0) for each in facts.statuses()]
    spans = facts.spans((time_s, late_us >= LATE_US) for time_s, late_us in late)
    for span in joined(spans, 1.0):
        within = late[bisect_left(late, (span.begin_s,)) : bisect_right(late, (span.end_s, inf))]
        worst_us = max(us for _, us in within)
        text = f"the board's control loop was up to {worst_us / 1000:.1f} ms late"
        yield Wrong(span.begin_s, "warning" if facts.was_armed(span) else "info", text)


def frames_damaged(facts: Facts) -> Iterator[Wrong]:
    """Frames that the board dropped: the line between it and the Raspberry Pi is bad."""
    count, first_s = 0, 0.0
    before: float | None = None
    for each in facts.statuses():
        errors = number_at(each.data, ("frame_errors",))
        if errors is None:
            continue
        if before is not None and errors > before:
            first_s = first_s if count else each.time_s
            count += int(errors - before)
        before = errors
    if count:
        plural = "" if count == 1 else "s"
        text = f"the board dropped {count} damaged frame{plural} of the serial line"
        yield Wrong(first_s, "warning" if count >= _FREQUENT else "info", text)


def estimate_wrong(facts: Facts) -> Iterator[Wrong]:
    """The attitude that the board estimates against the true one, in simulated flights."""
    for error in facts.estimate_errors:
        if error.worst_deg > ESTIMATE_LIMIT_DEG:
            text = (
                f"the estimated {error.axis} was up to {error.worst_deg:.1f} deg from the true one"
                f" ({error.rms_deg:.1f} deg rms)"
            )
            yield Wrong(error.worst_s, "warning", text, code="estimate_error", values=asdict(error))


BOARD_JUDGMENTS: tuple[Judge, ...] = (
    receiver_lost,
    failsafe,
    imu_invalid,
    board_reset,
    board_silent,
    raspberry_unheard,
    loop_late,
    frames_damaged,
    estimate_wrong,
)
