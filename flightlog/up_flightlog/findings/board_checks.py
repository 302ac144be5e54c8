"""Faults of the board: receiver, IMU, resets, its loop and its line."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import asdict
from math import inf

from up.commands.board_status import has_bit, reset_causes_of
from up.commands.telemetry_schema import RULES
from up.flight_log.json_message import number_at
from up_flightlog.findings.finding import Check, Finding, Level, lasting
from up_flightlog.findings.flight_context import INPUTS, RX, FlightContext
from up_flightlog.read.spans import Span, joined

MIN_LOSS_S = 0.1
"""Shorter gaps are not reported: one bad pulse is not a loss."""
LATE_US = 1000
ESTIMATE_LIMIT_DEG = 2.0
_ALL_VALID = 0b111111
_FREQUENT = 100
_RESTORED = 7


def _level(context: FlightContext, span: Span) -> Level:
    """A loss while armed is an alarm; switching the transmitter off after landing is not."""
    if context.was_armed(span):
        return "alarm"
    return "info" if span.is_open else "warning"


def receiver_lost(context: FlightContext) -> Iterator[Finding]:
    """The pilot's pulses: from the inputs themselves, otherwise from the board's status."""
    bad: list[tuple[float, int]] = []
    if RX in context.log.topics:
        lost = context.lost(_validity(context, bad))
    else:
        (rule,) = (each for each in RULES if each.code == "receiver_lost")
        lost = context.alarm_spans(rule)
    for span in joined(lost, 2 * MIN_LOSS_S):
        if span.length_s < MIN_LOSS_S:
            continue
        within = bad[bisect_left(bad, (span.begin_s,)) : bisect_left(bad, (span.end_s,))]
        lost_channels = [
            name for bit, name in enumerate(INPUTS) if any(not v >> bit & 1 for _, v in within)
        ]
        if 0 < len(lost_channels) < len(INPUTS):
            names = ", ".join(lost_channels)
            text = f"no valid pulses of {names}"
            yield lasting(span, _level(context, span), "channels_lost", text, subject=names)
        else:
            yield lasting(span, _level(context, span), "receiver_lost", "the receiver was lost")


def _validity(context: FlightContext, bad: list[tuple[float, int]]) -> Iterator[tuple[float, bool]]:
    valid, before = context.sticks["valid"], -1.0
    for time_s, bits in zip(valid.times_s, valid.values, strict=True):
        if not (0 <= bits <= _ALL_VALID and bits.is_integer()):
            continue
        if bits != _ALL_VALID:
            bad.append((time_s, int(bits)))
        if bits != before:
            before = bits
            yield time_s, bits == _ALL_VALID


def failsafe(context: FlightContext) -> Iterator[Finding]:
    """The receiver's failsafe: the board circled without the pilot."""
    for span in context.spans((each.time_s, each.is_failsafe is True) for each in context.states):
        text = "the receiver failsafe was active"
        yield lasting(span, _level(context, span), "failsafe", text)


def alarms(context: FlightContext) -> Iterator[Finding]:
    """The conditions of telemetry that schema/ defines as findings."""
    for rule in RULES:
        for span in context.alarm_spans(rule) if rule.finding else ():
            yield lasting(span, _level(context, span), rule.code, rule.finding)


def board_reset(context: FlightContext) -> Iterator[Finding]:
    """A restart of the board: its uptime went back, or its status reports a restart in flight."""
    before: float | None = None
    for each in context.statuses:
        uptime_s = number_at(each.data, ("uptime_s",))
        restored = has_bit(each.data, "reset_cause", _RESTORED)
        if uptime_s is None:
            continue
        if (before is not None and uptime_s < before) or (before is None and restored):
            in_flight = bool(restored or context.was_armed(Span(each.time_s, each.time_s)))
            cause = reset_causes_of(each.data)
            yield Finding(
                each.time_s,
                "alarm" if in_flight else "warning",
                "board_reset",
                f"the board was reset {'in flight ' if in_flight else ''}({cause})",
                subject=cause,
                fields={"in_flight": in_flight, "cause": cause},
            )
        before = uptime_s


def board_silent(context: FlightContext) -> Iterator[Finding]:
    """The serial line: no frame came."""
    for span in context.link_lost(lambda link: link == "arduino"):
        # A program that stood still logs the loss and its end at the same moment.
        if span.length_s >= MIN_LOSS_S:
            yield lasting(span, _level(context, span), "board_silent", "the board was silent")


def loop_late(context: FlightContext) -> Iterator[Finding]:
    """The control loop on the board ran late."""
    late = [(each.time_s, number_at(each.data, ("late_us",)) or 0.0) for each in context.statuses]
    spans = context.spans((time_s, late_us >= LATE_US) for time_s, late_us in late)
    for span in joined(spans, 1.0):
        within = late[bisect_left(late, (span.begin_s,)) : bisect_right(late, (span.end_s, inf))]
        worst_us = max(us for _, us in within)
        yield Finding(
            span.begin_s,
            "warning" if context.was_armed(span) else "info",
            "board_loop_late",
            f"the board's control loop was up to {worst_us / 1000:.1f} ms late",
            fields={"late_us": worst_us},
        )


def frames_damaged(context: FlightContext) -> Iterator[Finding]:
    """Frames that the board dropped: the line between it and the Raspberry Pi is bad."""
    count, first_s = 0, 0.0
    before: float | None = None
    for each in context.statuses:
        errors = number_at(each.data, ("frame_errors",))
        if errors is None:
            continue
        if before is not None and errors > before:
            first_s = first_s if count else each.time_s
            count += int(errors - before)
        before = errors
    if count:
        plural = "" if count == 1 else "s"
        yield Finding(
            first_s,
            "warning" if count >= _FREQUENT else "info",
            "frames_damaged",
            f"the board dropped {count} damaged frame{plural} of the serial line",
            fields={"count": count},
        )


def estimate_wrong(context: FlightContext) -> Iterator[Finding]:
    """The attitude that the board estimates against the true one, in simulated flights."""
    for error in context.estimate_errors:
        if error.worst_deg > ESTIMATE_LIMIT_DEG:
            text = (
                f"the estimated {error.axis} was up to {error.worst_deg:.1f} deg from the true one"
                f" ({error.rms_deg:.1f} deg rms)"
            )
            yield Finding(
                error.worst_s,
                "warning",
                "estimate_error",
                text,
                subject=error.axis,
                fields=asdict(error),
            )


BOARD_CHECKS: tuple[Check, ...] = (
    receiver_lost,
    failsafe,
    alarms,
    board_reset,
    board_silent,
    loop_late,
    frames_damaged,
    estimate_wrong,
)
