"""The result of a scenario: its flight, its verdicts, and those of its control run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from up_simulator.picture.flight_picture import Failure
from up_simulator.scenario.expectation import Expectation, Verdict
from up_simulator.scenario.flight_record import FlightRecord
from up_simulator.scenario.measures import MEASURES, limit_text
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.step import evaluate_step
from up_simulator.scenario.sticks import StickPoint
from up_simulator.scenario.window import NoWindowError, window_of

NO_CRASH = "It does not crash"
_LASTING = ("becomes", "becomes_below", "becomes_above", "changes_above")
"""Kinds of expectation that, once held, cannot fail later."""


@dataclass(slots=True)
class Result:
    """A flight with its verdicts; ``control`` is the record of the control run, where one flew."""

    record: FlightRecord
    verdicts: list[Verdict]
    control: FlightRecord | None = None

    @property
    def is_held(self) -> bool:
        records = (self.record, self.control)
        broken = any(record is not None and record.is_cut_short for record in records)
        return not broken and all(verdict.is_held for verdict in self.verdicts)

    @property
    def is_interrupted(self) -> bool:
        return any(
            record is not None and record.is_interrupted for record in (self.record, self.control)
        )


def evaluate(expectation: Expectation, record: FlightRecord) -> Verdict:
    """Return the verdict on one expectation."""
    scenario = record.scenario
    try:
        window = window_of(expectation, record.log, record.event_times, scenario.duration_s)
    except NoWindowError as error:
        has_crashed = record.crash_s is not None
        figure = f"crashed at {record.crash_s:.2f} s" if has_crashed else "none"
        limit, code = limit_text(expectation), "crashed" if has_crashed else error.code
        return Verdict(expectation.name, False, figure, limit, str(error), has_crashed, code)
    if expectation.step is not None:
        verdict = evaluate_step(expectation, expectation.step, window, record.log)
    else:
        verdict = MEASURES[expectation.kind](expectation, window)
    # A crash may end a flight that is allowed to crash; an interruption or a failure never may.
    may_end = scenario.may_crash and not record.is_cut_short
    if verdict.is_held and window.is_cut and not may_end and expectation.kind not in _LASTING:
        why = f"the flight ended at {window.times_s[-1]:.2f} s, inside the window"
        return replace(verdict, is_held=False, why=why, code="flight_ended")
    return verdict


def verdicts_of(record: FlightRecord) -> list[Verdict]:
    """Return the verdicts on one flight: each expectation, each answer, and that it is whole."""
    scenario = record.scenario
    verdicts = [evaluate(expectation, record) for expectation in scenario.expect]
    answers = (pending.verdict() for pending in record.pending_commands)
    verdicts += [verdict for verdict in answers if verdict is not None]
    sent = {id(pending.event) for pending in record.pending_commands}
    for event in scenario.events:
        if event.command is not None and id(event) not in sent:
            why = "the flight ended before"
            verdicts.append(Verdict(event.title, False, "never sent", "", why, code="not_sent"))
    if not scenario.may_crash:
        verdicts.append(_completion(record))
    return verdicts


def failed_parts(result: Result) -> Iterator[Failure]:
    """Yield signal and window of every expectation that did not hold."""
    record = result.record
    for expectation, verdict in zip(record.scenario.expect, result.verdicts, strict=False):
        offset_s = record.event_times.get(expectation.after, 0.0)
        if verdict.is_held or (expectation.after and expectation.after not in record.event_times):
            continue
        end_s = record.flown_s if expectation.to_s is None else offset_s + expectation.to_s
        text = f"{expectation.name}: {verdict.figure} ({verdict.limit})"
        begin_s = min(offset_s + expectation.from_s, record.flown_s)
        yield Failure(expectation.signal, begin_s, max(begin_s, end_s), text)


def control_scenario(scenario: Scenario) -> Scenario:
    """Return the scenario of the control run: the same without the parts that make it succeed."""
    control = scenario.control
    assert control is not None
    sticks = scenario.sticks
    if control.mode is not None:
        held = StickPoint(at_s=0.0, mode=control.mode)
        sticks = (held, *(replace(point, mode=None, aux1_us=None) for point in sticks))
    return replace(
        scenario,
        sticks=sticks,
        board=control.board or scenario.board,
        control=None,
    )


def control_verdicts(scenario: Scenario, record: FlightRecord) -> list[Verdict]:
    """Return, for every expectation that must fail in the control run, whether it visibly does."""
    control = scenario.control
    assert control is not None
    about = control.about or (
        f"in {control.mode}" if control.mode else f"with board {control.board}"
    )
    verdicts = [
        _inverted(evaluate(expectation, record), about)
        for expectation in scenario.expect
        if expectation.name in control.fails
    ]
    if record.is_cut_short:
        why = f"it was cut short at {record.flown_s:.2f} s"
        return [replace(each, is_held=False, why=why, code="cut_short") for each in verdicts]
    return verdicts


def _inverted(verdict: Verdict, about: str) -> Verdict:
    name = f"Without it ({about}) this must fail: '{verdict.name}'"
    why = code = ""
    if verdict.is_held:
        code, why = "control_held", "it holds in the control run too: this flight shows nothing"
    elif not verdict.has_figure:
        code, why = "control_not_measured", f"it cannot be measured there: {verdict.why}"
    return Verdict(name, not code, verdict.figure, f"required: {verdict.limit}", why, code=code)


def _completion(record: FlightRecord) -> Verdict:
    if record.crash is not None:
        figure = f"crashed at {record.crash_s:.2f} s"
        return Verdict(NO_CRASH, False, figure, "no crash", record.crash, code="crashed")
    figure = f"{record.flown_s:g} s flown"
    if not record.is_cut_short:
        return Verdict(NO_CRASH, True, figure, "no crash")
    why = f"it was cut short at {record.flown_s:.2f} s"
    return Verdict(NO_CRASH, False, figure, "no crash", why, code="cut_short")
