"""One flight for the navigation's figures: the daemon, the firmware and a phone's GPS."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from time import thread_time_ns
from typing import Any

from twisted.logger import ILogObserver, LogEvent, globalLogPublisher
from zope.interface import implementer

from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.modules.navigation_estimator import NavigationEstimator
from up.flight_modes.demand import Demand, PathDemand
from up.flight_modes.flight_mode import FlightMode
from up.flight_modes.navigation_file import Airspeed
from up.flight_modes.navigation_state import NavigationState
from up_simulator.aircraft import Weather
from up_simulator.aircraft.flight import FlightState
from up_simulator.aircraft.start import StartPart
from up_simulator.in_process.raspilot import InProcessRaspilot
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.flight import ScenarioFlight
from up_simulator.scenario.scenario import GroundPart, PhonePart, RaspilotPart, Scenario
from up_simulator.scenario.sticks import StickPoint

STALL_M_S = Airspeed().stall_m_s
HEIGHT_M = 120.0
SAMPLE_STEPS = 10
TELEMETRY_MS = 1000
"""The figures are read in the daemon: telemetry only carries the beacons of the Commands."""


@dataclass(frozen=True, slots=True)
class Sample:
    """The truth, the slow error of the GPS (north, east, up; m), the estimate and the demand.

    ``home_error_m`` is home's altitude less the true one of the aircraft when home was set.
    """

    time_s: float
    truth: FlightState
    wander_m: tuple[float, float, float]
    mode: str | None
    state: NavigationState | None
    demand: Demand | None
    home_error_m: float = math.inf

    @property
    def path(self) -> Any:
        return self.demand.path if isinstance(self.demand, PathDemand) else None

    def off_m(self, north_m: float, east_m: float, wander: float) -> tuple[float, float]:
        """Return how far it is from a point; ``wander`` is the part of the GPS's error added."""
        assert self.state is not None
        at = self.state.frame.point(self.truth.latitude_deg, self.truth.longitude_deg)
        north_m = at.north_m + wander * self.wander_m[0] - north_m
        return north_m, at.east_m + wander * self.wander_m[1] - east_m


@dataclass(frozen=True, slots=True)
class Flown:
    """A flight: a sample each 20 ms, the codes that the daemon logged and when (s)."""

    samples: list[Sample]
    codes: list[tuple[float, str]]
    crash: str | None
    step_us: list[float]

    def between(self, begin_s: float, end_s: float) -> list[Sample]:
        return [each for each in self.samples if begin_s <= each.time_s < end_s]

    def after(self, code: str, since_s: float) -> float:
        """Return how long after a time the program logged a code, s."""
        found = [time_s for time_s, each in self.codes if each == code and time_s >= since_s]
        return found[0] - since_s if found else math.inf


def scenario_of(
    seed: int, controller: str, weather: Weather, duration_s: float, *events: Event
) -> Scenario:
    return Scenario(
        title="navigation",
        seed=seed,
        duration_s=duration_s,
        board="host",
        may_crash=True,
        start=StartPart(height_m=HEIGHT_M),
        weather=weather,
        raspilot=RaspilotPart("in process", {"config.yml": {"flight controller": controller}}),
        phone=PhonePart(),
        ground=GroundPart(period_ms=TELEMETRY_MS),
        sticks=(StickPoint(at_s=0.0, mode="AUTO", arm=True, throttle=0.55),),
        events=events,
    )


def mode_at(at_s: float, mode: str) -> Event:
    return Event(at_s, command=CommandPart("up.flight_mode.set", {"mode": mode}))


def course_at(at_s: float, course_deg: float) -> Event:
    data = {"heading": course_deg, "mode": "required"}
    return Event(at_s, command=CommandPart("up.heading.change", data))


def fly(
    scenario: Scenario,
    prepare: Callable[[ScenarioFlight], None] = lambda _flight: None,
    begun: Callable[[InProcessRaspilot], None] = lambda _daemon: None,
) -> Flown:
    """Fly a scenario; raises RuntimeError if a part of it failed. A crash ends the flight.

    ``prepare`` gets the flight before it boots, ``begun`` the daemon when it runs.
    """
    flight = build_flight(scenario)
    prepare(flight)
    flown = Flown([], [], None, [])

    @implementer(ILogObserver)
    def note(event: LogEvent) -> None:
        if event.get("code"):
            flown.codes.append((flight.time_s, str(event["code"])))

    timed = FlightModeManager._on_orientation

    def on_orientation(self: FlightModeManager, command: Any) -> None:
        began_ns = thread_time_ns()
        timed(self, command)
        flown.step_us.append((thread_time_ns() - began_ns) / 1e3)

    globalLogPublisher.addObserver(note)
    FlightModeManager._on_orientation = on_orientation  # type: ignore[method-assign]
    try:
        flight.boot()
        daemon = flight.participants.raspilot
        assert isinstance(daemon, InProcessRaspilot)
        begun(daemon)
        probe = _Probe(flight, daemon)
        steps = 0
        while not flight.is_over:
            flight.step()
            steps += 1
            if steps % SAMPLE_STEPS == 0:
                flown.samples.append(probe.sample())
    finally:
        FlightModeManager._on_orientation = timed  # type: ignore[method-assign]
        globalLogPublisher.removeObserver(note)
        flight.participants.stop()
    if flight.record.failure:
        raise RuntimeError(flight.record.failure)
    return replace(flown, crash=flight.record.crash)


class _Probe:
    """Reads the estimate, and what the mode that acts demands, in the daemon."""

    def __init__(self, flight: ScenarioFlight, daemon: InProcessRaspilot) -> None:
        assert daemon.up is not None and flight.participants.phone is not None
        self._flight = flight
        self._sensors = flight.participants.receiver or flight.participants.phone.sensors
        estimator = daemon.module("NavigationEstimator")
        assert isinstance(estimator, NavigationEstimator)
        self._estimator = estimator
        manager = daemon.module("FlightModeManager")
        assert isinstance(manager, FlightModeManager)
        self._home = manager.home
        self._home_error_m = math.inf
        self._newest: tuple[str, Demand] | None = None
        for mode in daemon.up.get_modules(FlightMode):
            self._watch(mode)

    def _watch(self, mode: FlightMode) -> None:
        step = mode.step

        def watched(situation: Any, dt_s: float) -> Demand:
            demand = step(situation, dt_s)
            self._newest = mode.NAME, demand
            return demand

        mode.step = watched  # type: ignore[method-assign]

    def sample(self) -> Sample:
        flight = self._flight
        name, demand = self._newest or (None, None)
        state, truth, place = self._estimator.state, flight.state, self._home.place
        if place is not None and math.isinf(self._home_error_m):
            self._home_error_m = place.altitude_m - truth.altitude_m
        return Sample(
            flight.time_s, truth, self._sensors.wander_m, name, state, demand, self._home_error_m
        )


def rms(values: Iterable[float]) -> float:
    found = list(values)
    return math.sqrt(sum(each * each for each in found) / len(found)) if found else math.inf


def least_over_stall(samples: list[Sample]) -> float:
    return min((each.truth.airspeed_m_s for each in samples), default=0.0) / STALL_M_S
