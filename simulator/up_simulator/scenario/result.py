"""The result of a scenario: its flight, its verdicts, and those of its control run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from up_simulator.scenario.expectation import Expectation, Verdict
from up_simulator.scenario.flight_record import FlightRecord
from up_simulator.scenario.log import FlightLog
from up_simulator.scenario.measures import MEASURES, limit_text
from up_simulator.scenario.scenario import Scenario
from up_simulator.scenario.step import judge_step
from up_simulator.scenario.sticks import StickPoint
from up_simulator.scenario.window import NoWindowError, Window, window_of


@dataclass(frozen=True, slots=True)
class FlightFacts:
    """Input of the evaluation: the log, the times of the events, the planned duration, a crash."""

    log: FlightLog
    event_times: Mapping[str, float]
    duration_s: float
    crash_s: float | None = None
    may_crash: bool = False


def judge(expectation: Expectation, facts: FlightFacts) -> Verdict:
    """Return the verdict on one expectation."""
    try:
        window = window_of(expectation, facts.log, facts.event_times, facts.duration_s)
    except NoWindowError as error:
        has_crashed = facts.crash_s is not None
        figure = f"crashed at {facts.crash_s:.2f} s" if has_crashed else "none"
        limit = limit_text(expectation)
        return Verdict(expectation.name, False, figure, limit, str(error), has_crashed)
    verdict = _measure(expectation, window, facts.log)
    if verdict.is_held and window.is_cut and not facts.may_crash and not _is_done(expectation):
        why = f"the flight ended at {window.times_s[-1]:.2f} s, inside the window"
        return replace(verdict, is_held=False, why=why)
    return verdict


def _measure(expectation: Expectation, window: Window, log: FlightLog) -> Verdict:
    if expectation.step is not None:
        return judge_step(expectation, expectation.step, window, log)
    return MEASURES[expectation.kind](expectation, window)


def _is_done(expectation: Expectation) -> bool:
    """Return whether an expectation that held once cannot fail later."""
    return expectation.kind in ("becomes", "becomes_below", "becomes_above", "changes_above")


NO_CRASH = "It does not crash"


@dataclass(slots=True)
class Result:
    """A flight with its verdicts; ``control`` is the record of the control run, where one flew."""

    record: FlightRecord
    verdicts: list[Verdict]
    control: FlightRecord | None = None

    @property
    def is_held(self) -> bool:
        """Return whether everything that was expected is true."""
        records = (self.record, self.control)
        broken = any(record is not None and record.is_broken_off for record in records)
        return not broken and all(verdict.is_held for verdict in self.verdicts)

    @property
    def is_interrupted(self) -> bool:
        """Return whether the user ended the flight or its control run."""
        return any(
            record is not None and record.is_interrupted for record in (self.record, self.control)
        )


def verdicts_of(record: FlightRecord) -> list[Verdict]:
    """Return the verdicts on one flight: each expectation, each answer, and that it is whole."""
    scenario = record.scenario
    facts = facts_of(record)
    verdicts = [judge(expectation, facts) for expectation in scenario.expect]
    for question in record.questions:
        verdict = question.verdict()
        if verdict is not None:
            verdicts.append(verdict)
    asked = {id(question.event) for question in record.questions}
    for event in scenario.events:
        if event.command is not None and id(event) not in asked:
            verdicts.append(
                Verdict(event.title, False, "never sent", "", "the flight ended before")
            )
    if not scenario.may_crash:
        verdicts.append(_whole(record))
    return verdicts


@dataclass(frozen=True, slots=True)
class FailedPart:
    """Where in the flight an expectation was not held, for a picture."""

    signal: str
    begin_s: float
    end_s: float
    text: str


def failed_parts(result: Result) -> Iterator[FailedPart]:
    """Yield signal and window of every expectation that did not hold."""
    record = result.record
    for expectation, verdict in zip(record.scenario.expect, result.verdicts, strict=False):
        offset_s = record.event_times.get(expectation.after, 0.0)
        if verdict.is_held or (expectation.after and expectation.after not in record.event_times):
            continue
        end_s = record.flown_s if expectation.to_s is None else offset_s + expectation.to_s
        text = f"{expectation.name}: {verdict.figure} ({verdict.limit})"
        begin_s = min(offset_s + expectation.from_s, record.flown_s)
        yield FailedPart(expectation.signal, begin_s, max(begin_s, end_s), text)


def facts_of(record: FlightRecord) -> FlightFacts:
    """Return the input of the evaluation."""
    scenario = record.scenario
    # A crash may end a flight that is allowed to crash; being broken off never may.
    may_end = scenario.may_crash and not record.is_broken_off
    return FlightFacts(record.log, record.event_times, scenario.duration_s, record.crash_s, may_end)


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
    """Return, for every expectation that must fail without it, whether it visibly does."""
    control = scenario.control
    assert control is not None
    facts = facts_of(record)
    words = control.about or (
        f"in {control.mode}" if control.mode else f"with board {control.board}"
    )
    verdicts = [
        _failing(judge(expectation, facts), words)
        for expectation in scenario.expect
        if expectation.name in control.fails
    ]
    if record.is_broken_off:
        why = _cut_short(record)
        return [replace(verdict, is_held=False, why=why) for verdict in verdicts]
    return verdicts


def _failing(verdict: Verdict, words: str) -> Verdict:
    fails = not verdict.is_held and verdict.has_figure
    why = ""
    if verdict.is_held:
        why = "it holds all the same: this flight shows nothing"
    elif not verdict.has_figure:
        why = f"it cannot be measured there: {verdict.why}"
    name = f"Without it ({words}) this must fail: '{verdict.name}'"
    return Verdict(name, fails, verdict.figure, f"asked for: {verdict.limit}", why)


def _cut_short(record: FlightRecord) -> str:
    return f"it was cut short at {record.flown_s:.2f} s" if record.is_broken_off else ""


def _whole(record: FlightRecord) -> Verdict:
    if record.crash is None:
        figure = f"{record.flown_s:g} s flown"
        return Verdict(NO_CRASH, not record.is_broken_off, figure, "no crash", _cut_short(record))
    return Verdict(NO_CRASH, False, f"crashed at {record.crash_s:.2f} s", "no crash", record.crash)
