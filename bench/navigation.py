"""Flies the figures of docs/navigation.md: the whole daemon, the firmware and a phone's GPS."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from bench.table import LeftOutError, Row
from tools.tuning.workers import MAX_PROCESSES, Workers
from up.earth import bearing_deg, distance_m
from up_simulator.aircraft.flight import FlightState, FlightUnavailableError
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.firmware.preparation import PreparationError
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.flight import ScenarioFlight
from up_simulator.scenario.initial_conditions import StartPart, WeatherPart
from up_simulator.scenario.scenario import GroundPart, PhonePart, RaspilotPart, Scenario
from up_simulator.scenario.sticks import StickPoint

SEEDS = 10
CONTROLLERS = ("arduino", "raspberry")
AIRS = {"calm": (0.0, "none"), "6 m/s, moderate": (6.0, "moderate")}
STALL_M_S, RADIUS_M = 6.5, 50.0
SAMPLE_STEPS = 10
LOITER_S, CIRCLING_S, CRUISE_S, LEG_S, END_S = 10.0, 60.0, 130.0, 145.0, 190.0
STOP_S, STOPPED_END_S = 90.0, 120.0
LOST_S, LOST_END_S = 80.0, 110.0
AWAY_S, RETURN_END_S = 62.0, 330.0
Figures = dict[str, float]


@dataclass(frozen=True, slots=True)
class Sample:
    """The truth, the slow error of the GPS (north, east, up), and what the daemon reports."""

    time_s: float
    truth: FlightState
    wander_m: tuple[float, float, float]
    mode: str | None
    navigation: dict[str, float] = field(default_factory=dict)
    target: dict[str, float] = field(default_factory=dict)
    motor_stopped: bool = False


def rows(quick: bool = False) -> Iterable[Row]:
    seeds = range(1, 3 if quick else SEEDS + 1)
    try:
        with Workers(MAX_PROCESSES) as workers:
            for controller in CONTROLLERS:
                for air, (wind_m_s, turbulence) in AIRS.items():
                    flights = [(seed, controller, wind_m_s, turbulence) for seed in seeds]
                    where = f"{controller}, {air}"
                    yield from _rows(where, workers.fly(hold, flights), wind_m_s > 0)
                    yield from _rows(where, workers.fly(lose_position, flights), wind_m_s > 0)
                    yield from _rows(where, workers.fly(stop_motor, flights), wind_m_s > 0)
                against = [(seed, controller, 7.7, "none") for seed in seeds]
                where = f"{controller}, against 7.7 m/s"
                yield from _rows(where, workers.fly(come_home, against), True)
    except (BoardUnavailableError, FlightUnavailableError, PreparationError) as error:
        raise LeftOutError(str(error)) from error


TARGETS: dict[str, tuple[float, float]] = {
    "LOITER 50 m, radius rms, GPS frame": (1.5, 2.4),
    "LOITER 50 m, radius rms, truth": (2.0, 2.5),
    "leg, cross track rms, GPS frame": (1.5, 1.8),
    "height rms, truth": (1.0, 2.5),
    "wind error after two circles": (1.0, 1.0),
    "position error after 30 s without fixes": (30.0, 60.0),
    "height error after 30 s without fixes": (12.0, 40.0),
    "s until a stopped motor is noticed": (3.0, 3.0),
}
"""At most this: calm, and in wind."""
LEAST: dict[str, float] = {
    "least airspeed over stall, motor stopped": 1.1,
    "least airspeed over stall, RETURN": 1.2,
}


def _rows(where: str, found: list[Figures], has_wind: bool) -> Iterable[Row]:
    for what in found[0]:
        values = [each.get(what, math.inf) for each in found]
        is_least = what in LEAST
        worst = (min if is_least else max)(values)
        seed = values.index(worst) + 1
        mean = sum(values) / len(values)
        target, met = "", None
        if is_least:
            target, met = f">= {LEAST[what]:g}", worst >= LEAST[what]
        elif what in TARGETS:
            limit = TARGETS[what][has_wind]
            target, met = f"<= {limit:g}", mean <= limit
        text = f"{mean:.2f}, worst {worst:.2f} (seed {seed})"
        yield Row(f"{what}: {where}", text, target=target, met=met)


def _scenario(
    seed: int, controller: str, wind_m_s: float, turbulence: str, duration_s: float, *events: Event
) -> Scenario:
    return Scenario(
        title="navigation",
        seed=seed,
        duration_s=duration_s,
        board="host",
        may_crash=True,
        start=StartPart(height_m=120.0),
        weather=WeatherPart(wind_m_s=wind_m_s, wind_from_deg=0.0, turbulence=turbulence),  # type: ignore[arg-type]
        raspilot=RaspilotPart("in process", {"config.yml": {"flight controller": controller}}),
        phone=PhonePart(),
        ground=GroundPart(period_ms=100),
        sticks=(StickPoint(at_s=0.0, mode="AUTO", arm=True, throttle=0.55),),
        events=events,
    )


def _mode(at_s: float, mode: str) -> Event:
    return Event(at_s, command=CommandPart("up.flight_mode.set", {"mode": mode}))


def _fly(scenario: Scenario) -> list[Sample]:
    """Return a sample each 20 ms; a crash ends the flight."""
    flight = build_flight(scenario)
    samples: list[Sample] = []
    try:
        flight.boot()
        steps = 0
        while not flight.is_over:
            flight.step()
            steps += 1
            if steps % SAMPLE_STEPS == 0:
                samples.append(_sample(flight))
    finally:
        flight.participants.stop()
    if flight.record.failure:
        raise RuntimeError(flight.record.failure)
    return samples


def _sample(flight: ScenarioFlight) -> Sample:
    ground, phone = flight.participants.ground, flight.participants.phone
    assert ground is not None and phone is not None
    navigation = dict(ground.telemetry.get("navigation") or {})
    return Sample(
        flight.time_s,
        flight.state,
        phone.sensors.wander_m,
        (ground.telemetry.get("flight_control") or {}).get("mode"),
        navigation,
        dict(navigation.get("target") or {}),
        bool(navigation.get("motor_stopped")),
    )


def _between(samples: list[Sample], begin_s: float, end_s: float) -> list[Sample]:
    return [each for each in samples if begin_s <= each.time_s < end_s]


def _rms(values: Iterable[float]) -> float:
    found = list(values)
    return math.sqrt(sum(each * each for each in found) / len(found)) if found else math.inf


def _off_m(sample: Sample, latitude: float, longitude: float) -> tuple[float, float]:
    """Return how far the truth is north and east of a position."""
    truth = sample.truth
    there = (latitude, longitude, truth.latitude_deg, truth.longitude_deg)
    away_m, bearing = distance_m(*there), math.radians(bearing_deg(*there))
    return away_m * math.cos(bearing), away_m * math.sin(bearing)


def _radius_errors(samples: list[Sample], part: float) -> list[float]:
    """Return the radius errors; ``part`` of the wander is added: 1 is the GPS frame."""
    errors = []
    for each in samples:
        if each.target.get("radius") is None:
            return []
        north_m, east_m = _off_m(each, each.target["latitude"], each.target["longitude"])
        north_m += part * each.wander_m[0]
        east_m += part * each.wander_m[1]
        errors.append(math.hypot(north_m, east_m) - each.target["radius"])
    return errors


def hold(seed: int, controller: str, wind_m_s: float, turbulence: str) -> Figures:
    """Return the figures of LOITER, then of a leg in CRUISE."""
    events = (_mode(LOITER_S, "LOITER"), _mode(CRUISE_S, "CRUISE"))
    samples = _fly(_scenario(seed, controller, wind_m_s, turbulence, END_S, *events))
    circling = _between(samples, CIRCLING_S, CRUISE_S)
    leg = _between(samples, LEG_S, END_S)
    wind = _between(samples, 80.0, 81.0)[0].navigation.get("wind") or {}
    from_rad = math.radians(wind.get("from") or 0.0)
    speed = wind.get("speed") or 0.0
    wind_error = math.hypot(speed * math.cos(from_rad) - wind_m_s, speed * math.sin(from_rad))
    figures = {
        "LOITER 50 m, radius rms, GPS frame": _rms(_radius_errors(circling, 1.0)),
        "LOITER 50 m, radius rms, truth": _rms(_radius_errors(circling, 0.0)),
        "leg, cross track rms, GPS frame": _rms(_across(leg, 1.0)),
        "leg, cross track rms, truth": _rms(_across(leg, 0.0)),
        "wind error after two circles": wind_error,
    }
    altitudes = [each.target.get("altitude") or math.nan for each in circling]
    off = [each.truth.altitude_m - at for each, at in zip(circling, altitudes, strict=True)]
    figures["height rms, truth"] = _rms(off)
    wander = [each.wander_m[2] for each in circling]
    figures["height rms, GPS frame"] = _rms(a + b for a, b in zip(off, wander, strict=True))
    figures["least airspeed over stall, RETURN"] = _least(samples)
    return figures


def _across(leg: list[Sample], part: float) -> list[float]:
    """Return the distances from the straight line that fits the leg best."""
    if not leg or leg[0].mode != "CRUISE":
        return []
    points = [
        (each.truth.north_m + part * each.wander_m[0], each.truth.east_m + part * each.wander_m[1])
        for each in leg
    ]
    north = sum(point[0] for point in points) / len(points)
    east = sum(point[1] for point in points) / len(points)
    xx = sum((point[0] - north) ** 2 for point in points)
    yy = sum((point[1] - east) ** 2 for point in points)
    xy = sum((point[0] - north) * (point[1] - east) for point in points)
    course = 0.5 * math.atan2(2 * xy, xx - yy)
    sine, cosine = math.sin(course), math.cos(course)
    return [cosine * (point[1] - east) - sine * (point[0] - north) for point in points]


def lose_position(seed: int, controller: str, wind_m_s: float, turbulence: str) -> Figures:
    """Return the errors of 30 s of dead reckoning."""
    events = (_mode(LOITER_S, "LOITER"), Event(LOST_S, gps="lost"))
    samples = _fly(_scenario(seed, controller, wind_m_s, turbulence, LOST_END_S, *events))
    last = samples[-1]
    if last.truth.time_s < LOST_END_S - 1.0:
        return {"position error after 30 s without fixes": math.inf}
    north_m, east_m = _off_m(last, last.navigation["latitude"], last.navigation["longitude"])
    return {
        "position error after 30 s without fixes": math.hypot(north_m, east_m),
        "height error after 30 s without fixes": abs(
            last.truth.altitude_m - last.navigation["altitude"]
        ),
        "least airspeed over stall, RETURN": _least(samples),
    }


def stop_motor(seed: int, controller: str, wind_m_s: float, turbulence: str) -> Figures:
    """Return when a stopped motor was noticed in LOITER, and the least airspeed."""
    events = (_mode(LOITER_S, "LOITER"), Event(STOP_S, motor="stopped"))
    scenario = _scenario(seed, controller, wind_m_s, turbulence, STOPPED_END_S, *events)
    samples = _fly(scenario)
    after = _between(samples, STOP_S, STOPPED_END_S)
    noticed = [each.time_s for each in after if each.motor_stopped]
    return {
        "s until a stopped motor is noticed": noticed[0] - STOP_S if noticed else math.inf,
        "least airspeed over stall, motor stopped": _least(after),
    }


def come_home(seed: int, controller: str, wind_m_s: float, turbulence: str) -> Figures:
    """Return the figures of RETURN from about 1 km against the wind."""
    downwind = CommandPart("up.heading.change", {"heading": 180.0, "mode": "required"})
    events = (
        _mode(2.0, "CRUISE"),
        Event(3.0, command=downwind),
        _mode(AWAY_S, "RETURN"),
    )
    samples = _fly(_scenario(seed, controller, wind_m_s, turbulence, RETURN_END_S, *events))
    back = _between(samples, AWAY_S + 1.0, RETURN_END_S)
    home = back[-1].target
    away = [
        math.hypot(*_off_m(each, home["latitude"], home["longitude"])) for each in (back[0], *back)
    ]
    arrived = [each.time_s for each, far in zip(back, away[1:], strict=True) if far < 2 * RADIUS_M]
    return {
        "RETURN, m away at the start": away[0],
        "RETURN, s until home": arrived[0] - AWAY_S if arrived else math.inf,
        "least airspeed over stall, RETURN": _least(back),
        "RETURN, greatest loss of height, m": back[0].truth.altitude_m
        - min(each.truth.altitude_m for each in back),
    }


def _least(samples: list[Sample]) -> float:
    return min(each.truth.airspeed_m_s for each in samples) / STALL_M_S
