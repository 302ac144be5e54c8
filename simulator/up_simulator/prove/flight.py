"""One flight of a proof, flown by the scenario engine and judged."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.prove.cases import Case, demands, home_m, scenario_of, times_of
from up_simulator.prove.judge import Figures, Limits, Sample, Verdict, figures_of, judge
from up_simulator.prove.rows import Row, row_of
from up_simulator.prove.setup import Setup
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.flight import ScenarioFlight
from up_simulator.scenario.run import CAUSES, CannotFlyError

SAMPLE_S = 0.1
SETTLING_S = 1.0
"""The first second, in which the model finds its balance, is not judged."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """A flight that was flown; ``refusal`` is the answer to the Command that was refused."""

    case: Case
    verdict: Verdict
    figures: Figures
    track: list[Sample]
    crash: str | None = None
    refusal: str = ""
    failure: str = ""
    cpu_s: float = 0.0

    @property
    def is_held(self) -> bool:
        return self.verdict.is_held


class _Probe:
    """Reads what flies, in the daemon itself: the ground may have lost its link."""

    def __init__(self, flight: ScenarioFlight, home: tuple[float, float]) -> None:
        self.track: list[Sample] = []
        self._flight = flight
        self._home = home

    def __call__(self, time_s: float) -> None:
        if time_s < SETTLING_S or (self.track and time_s < self.track[-1].time_s + SAMPLE_S - 1e-6):
            return
        state = self._flight.state
        mode, telemetry = None, {}
        daemon = self._flight.participants.raspilot
        assert isinstance(daemon, InProcessRaspilot)
        if daemon.up is not None:
            manager: Any = daemon.module("FlightModeManager")
            failsafes: Any = daemon.module("Failsafes")
            mode, telemetry = manager.acting_mode, failsafes.telemetry_content["failsafe"]
        self.track.append(
            Sample(
                time_s,
                state.north_m - self._home[0],
                state.east_m - self._home[1],
                state.height_m,
                state.airspeed_m_s,
                state.climb_m_s,
                mode,
                self._flight.board_mode,
                tuple(telemetry.get("active", ())),
                telemetry.get("cause"),
            )
        )


def refusals(setup: Setup) -> list[str]:
    """Boot the aircraft on the ground; return why this configuration may not fly.

    Raises CannotFlyError if the aircraft or its board cannot be simulated here.
    """
    case = Case("gps_lost", "turn", setup.controller, 0.0, 180.0, "none", 1)
    flight = _built(case, setup)
    try:
        flight.boot()
        daemon, record = flight.participants.raspilot, flight.record
        assert isinstance(daemon, InProcessRaspilot)
        found = [] if daemon.up is None else daemon.up.vetoes.all
        if record.failure is not None:
            found = record.failure.splitlines()
        return found or list(record.notes.values())
    finally:
        flight.participants.stop()


def fly_case(case: Case, setup: Setup) -> Outcome:
    """Fly and judge one flight. Raises CannotFlyError."""
    began_s = time.process_time()
    flight = _built(case, setup)
    probe = _Probe(flight, home_m(case, setup))
    record = flight.fly(probe)
    limits = limits_of(case, setup)
    failure = record.failure or ("" if probe.track else "; ".join(record.notes.values()))
    nack = next((each for each in record.pending_commands if each.answer), None)
    refusal = f"{nack.event.title}: {nack.answer}" if nack is not None else ""
    cpu_s = time.process_time() - began_s
    if not probe.track:
        nothing = Figures(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None, 0.0)
        verdict = Verdict((("failed", 0.0),))
        return Outcome(case, verdict, nothing, [], record.crash, refusal, failure, cpu_s)
    verdict = judge(probe.track, limits, record.crash)
    if nack is not None:
        verdict = Verdict((("refused", nack.sent_s), *verdict.found))
    if failure:
        verdict = Verdict((*verdict.found, ("failed", record.flown_s)))
    figures = figures_of(probe.track, limits)
    return Outcome(case, verdict, figures, probe.track, record.crash, refusal, failure, cpu_s)


def limits_of(case: Case, setup: Setup) -> Limits:
    row, times, fence = row_of(case.row), times_of(case, setup), setup.fence
    trigger = demands(row, case.point)
    order = [each for each in setup.values["failsafe.yml"] if each != "others"]
    action = str(setup.trigger(trigger)["action"]) if trigger else ""
    return Limits(
        setup.stall_m_s,
        times.fail_s,
        times.settled_s,
        times.deadline_s,
        trigger,
        action,
        tuple(order[: order.index(trigger)]) if trigger else (),
        fence["radius_m"],
        fence["ceiling_m"],
        fence["floor_m"],
        may_land=row.may_land or _only_warns(row, action),
        is_blown=row.is_blown,
        arrived_m=3 * float(setup.value("return.yml", "radius_m")),
    )


def _only_warns(row: Row, action: str) -> bool:
    """Return whether the owner wants the Arduino's own circle, which ends on the ground."""
    return row.of_sticks and action == "warn"


def _built(case: Case, setup: Setup) -> ScenarioFlight:
    try:
        return build_flight(scenario_of(case, setup))
    except tuple(CAUSES) as error:
        raise CannotFlyError(error) from error
