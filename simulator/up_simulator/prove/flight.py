"""One flight of a proof, flown by the scenario engine and judged."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.prove.cases import Case, home_m, limits_of, scenario_of
from up_simulator.prove.judge import Figures, Found, Sample, figures_of, judge
from up_simulator.prove.setup import Setup
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.flight import ScenarioFlight
from up_simulator.scenario.run import CAUSES, CannotFlyError

SAMPLE_S = 0.1
SETTLING_S = 1.0
"""The first second, in which the model finds its balance, is not judged."""


_NO_FIGURES = Figures(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, None, 0.0)


@dataclass(frozen=True, slots=True)
class Outcome:
    """A flight; ``found`` lists the failures. The texts say why a Command or the flight failed."""

    case: Case
    found: Found
    figures: Figures
    track: list[Sample]
    crash: str | None
    refusal: str
    failure: str
    cpu_s: float

    @property
    def codes(self) -> tuple[str, ...]:
        return tuple(code for code, _ in self.found)

    @property
    def is_held(self) -> bool:
        return not self.found


class _Probe:
    """Reads what flies, in the daemon itself: the ground may have lost its link."""

    def __init__(self, flight: ScenarioFlight, home: tuple[float, float]) -> None:
        self.track: list[Sample] = []
        self._flight = flight
        self._north_m, self._east_m = home
        self._next_s = SETTLING_S

    def __call__(self, time_s: float) -> None:
        if time_s < self._next_s - 1e-6:
            return
        self._next_s = time_s + SAMPLE_S
        state, daemon = self._flight.state, self._flight.participants.raspilot
        assert isinstance(daemon, InProcessRaspilot)
        mode, failsafe = None, {}
        if daemon.up is not None:
            manager: Any = daemon.module("FlightModeManager")
            failsafes: Any = daemon.module("Failsafes")
            mode, failsafe = manager.acting_mode, failsafes.telemetry_content["failsafe"]
        self.track.append(
            Sample(
                time_s, state.north_m - self._north_m, state.east_m - self._east_m, state.height_m,
                state.airspeed_m_s, mode, self._flight.board_mode,
                tuple(failsafe.get("active", ())), failsafe.get("cause"),
            )
        )  # fmt: skip


def refusals(setup: Setup, controller: str) -> list[str]:
    """Boot the aircraft on the ground; return why this configuration may not fly.

    Raises CannotFlyError if the aircraft or its board cannot be simulated here.
    """
    flight = _built(Case("gps_lost", "turn", controller, 0.0, 180.0, "none", 1), setup)
    try:
        flight.boot()
        daemon, record = flight.participants.raspilot, flight.record
        assert isinstance(daemon, InProcessRaspilot)
        if record.failure is not None:
            return record.failure.splitlines()
        vetoes = [] if daemon.up is None else daemon.up.vetoes.all
        return vetoes or list(record.notes.values())
    finally:
        flight.participants.stop()


def fly_case(case: Case, setup: Setup) -> Outcome:
    """Fly and judge one flight; Ctrl-C ends it without a judgement."""
    began_s = time.process_time()
    try:
        flight = _built(case, setup)
    except CannotFlyError as error:
        return Outcome(case, (("failed", 0.0),), _NO_FIGURES, [], None, "", str(error), 0.0)
    probe = _Probe(flight, home_m(case, setup))
    record = flight.fly(probe)
    if record.is_interrupted:
        raise KeyboardInterrupt
    limits, track = limits_of(case, setup), probe.track
    failure = record.failure or ("" if track else "; ".join(record.notes.values()))
    refused = next((each for each in record.pending_commands if each.answer), None)
    found = judge(track, limits, record.crash) if track else ()
    if refused is not None:
        found = (("refused", refused.sent_s), *found)
    if failure or not track:
        found = (*found, ("failed", record.flown_s))
    figures = figures_of(track, limits) if track else _NO_FIGURES
    refusal = "" if refused is None else f"{refused.event.title}: {refused.answer}"
    cpu_s = time.process_time() - began_s
    return Outcome(case, found, figures, track, record.crash, refusal, failure, cpu_s)


def _built(case: Case, setup: Setup) -> ScenarioFlight:
    try:
        flight = build_flight(scenario_of(case, setup))
    except tuple(CAUSES) as error:
        raise CannotFlyError(error) from error
    # The flight begins in the air; on the ground its estimate would have given home's altitude.
    assert flight.participants.phone is not None
    flight.participants.phone.sensors.know_altitude()
    return flight
