"""Flies the figures of docs/navigation.md: the whole daemon, the firmware and a phone's GPS."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from bench.navigation_cost import cost_rows
from bench.navigation_flight import (
    HEIGHT_M,
    Flown,
    Sample,
    course_at,
    fly,
    least_over_stall,
    mode_at,
    rms,
    scenario_of,
)
from bench.navigation_random import fly_at_random, random_rows
from bench.table import LeftOutError, Row
from up.flight_modes.demand import Circle, Line, PathDemand
from up_simulator.aircraft import Weather
from up_simulator.aircraft.flight import FlightUnavailableError
from up_simulator.firmware.build import BoardUnavailableError
from up_simulator.firmware.preparation import PreparationError
from up_simulator.harness.workers import MAX_PROCESSES, Workers
from up_simulator.scenario.event import Event
from up_simulator.scenario.flight import ScenarioFlight
from up_simulator.scenario.scenario import GpsPart, Scenario

SEEDS, QUICK_SEEDS = 10, 1
RANDOM_FLIGHTS, QUICK_RANDOM_FLIGHTS = 40, 4
CONTROLLERS = ("arduino", "raspberry")
WIND_FROM_DEG = 0.0
AIRS = {
    "calm": Weather(wind_from_deg=WIND_FROM_DEG),
    "6 m/s, moderate": Weather(wind_m_s=6.0, wind_from_deg=WIND_FROM_DEG, turbulence="moderate"),
}
AGAINST = Weather(wind_m_s=7.7, wind_from_deg=WIND_FROM_DEG)
"""70 % of the airspeed of cruise."""
RADIUS_M, SMALL_WANDER_M = 50.0, 1.5
MOTOR_CODE, OVERRUN_CODE = "motor_stopped", "mode_overrun"
LOITER_S, CIRCLING_S, TWO_CIRCLES_S, CRUISE_S, LEG_S = 5.0, 35.0, 65.0, 110.0, 130.0
AGAIN_S, LOST_S, BACK_S, STOP_S, HOLD_END_S = 170.0, 190.0, 220.0, 240.0, 265.0
EXACT_CRUISE_S, EXACT_LEG_S, EXACT_END_S = 80.0, 95.0, 120.0
AWAY_S, HOME_STOP_S, HOME_END_S = 62.0, 270.0, 300.0
Figures = dict[str, float]


@dataclass(frozen=True, slots=True)
class Target:
    """A limit in calm air and in wind: of the mean of the seeds, or of the worst of them."""

    calm: float
    wind: float
    of_worst: bool = False
    is_least: bool = False


LOITER, LEG = "LOITER 50 m, radius rms", "leg, cross track rms from the commanded line"
STOPPED = "motor stopped in {}, s until logged", "motor stopped in {}, least airspeed over stall"
EXACT = "LOITER 50 m, radius rms", "leg, cross track rms"
TARGETS = {
    f"{LOITER}, GPS frame": Target(1.5, 2.4),
    f"{LOITER}, truth, wander of 1.5 m": Target(2.0, 2.5),
    f"{LEG}, GPS frame": Target(1.5, 1.8),
    "height rms, GPS frame": Target(1.8, 2.8),
    "height above home rms with barometer, truth": Target(1.0, 2.5),
    "height above home rms with sensors, truth": Target(1.0, 2.5),
    "wind error after two circles, m/s": Target(1.0, 1.0),
    "wind direction error after two circles, deg": Target(15.0, 15.0),
    "position error after 30 s without fixes": Target(30.0, 60.0, of_worst=True),
    "the same over its stated deviation": Target(2.0, 2.0, of_worst=True),
    "height error after 30 s without fixes": Target(12.0, 40.0),
    f"exact 10 Hz GPS: {EXACT[0]}": Target(0.3, 0.8),
    f"exact 10 Hz GPS: {EXACT[1]}": Target(0.3, 0.3),
    f"u-blox 10 Hz, GPS frame: {EXACT[0]}": Target(0.6, 1.6),
    f"u-blox 10 Hz, GPS frame: {EXACT[1]}": Target(0.6, 0.6),
    "RETURN, s until home": Target(HOME_STOP_S - AWAY_S, HOME_STOP_S - AWAY_S, of_worst=True),
    "RETURN, least airspeed over stall": Target(1.2, 1.2, of_worst=True, is_least=True),
    "RETURN, least height above home, m": Target(-10.0, -10.0, of_worst=True, is_least=True),
    **{STOPPED[0].format(mode): Target(3.0, 3.0) for mode in ("LOITER", "RETURN")},
    **{
        STOPPED[1].format(mode): Target(1.1, 1.1, of_worst=True, is_least=True)
        for mode in ("LOITER", "RETURN")
    },
}
OVERRUNS, LOOP_US, CRASHES = "overruns of a mode's step", "loop step of the manager, us", "crashes"


def rows(quick: bool = False) -> Iterable[Row]:
    seeds = range(1, 1 + (QUICK_SEEDS if quick else SEEDS))
    try:
        yield from cost_rows()
        with Workers(MAX_PROCESSES) as workers:
            for flight, controller, air in plan():
                found = workers.fly(flight, [(seed, controller, air) for seed in seeds])
                yield from rows_of(f"{controller}, {air}", list(seeds), found)
            count = QUICK_RANDOM_FLIGHTS if quick else RANDOM_FLIGHTS
            seeds = range(1, count + 1)
            yield from random_rows(workers.fly(fly_at_random, [(seed,) for seed in seeds]))
    except (BoardUnavailableError, FlightUnavailableError, PreparationError) as error:
        raise LeftOutError(str(error)) from error


def plan() -> Iterable[tuple[Callable[[int, str, str], Figures], str, str]]:
    """Return the kinds of flights, each with the place of the control loop and the air."""
    for controller in CONTROLLERS:
        for air in AIRS:
            yield hold, controller, air
            yield hold_with_small_wander, controller, air
            yield hold_with_barometer, controller, air
            yield hold_with_exact_gps, controller, air
            yield hold_with_receiver, controller, air
            yield hold_with_sensors, controller, air
        yield come_home, controller, "against 7.7 m/s"


def rows_of(where: str, seeds: list[int], found: list[Figures]) -> Iterable[Row]:
    """Return a row for each figure: mean of the seeds, and the worst with its seed."""
    for what in found[0]:
        values = [each.get(what, math.inf) for each in found]
        limit = TARGETS.get(what)
        is_least = limit is not None and limit.is_least
        worst = (min if is_least else max)(values)
        mean = statistics.fmean(values)
        target, met = "", None
        if limit is not None:
            bound = limit.calm if where.endswith("calm") else limit.wind
            judged = worst if limit.of_worst else mean
            target = f"{'worst' if limit.of_worst else 'mean'} {'>=' if is_least else '<='} "
            target += f"{bound:g}"
            met = judged >= bound if is_least else judged <= bound
        text = f"{mean:.2f}, worst {worst:.2f} (seed {seeds[values.index(worst)]})"
        yield Row(f"{what}: {where}", text, target=target, met=met)


def radius_errors(samples: list[Sample], wander: float) -> list[float]:
    """Return the radius errors, m; ``wander`` is the part of the GPS's error added."""
    errors = []
    for each in samples:
        path = each.path
        if not isinstance(path, Circle):
            return []
        errors.append(math.hypot(*each.off_m(*path.centre, wander)) - path.radius_m)
    return errors


def line_errors(samples: list[Sample], wander: float) -> list[float]:
    """Return the distances from the commanded line, m."""
    errors = []
    for each in samples:
        path = each.path
        if not isinstance(path, Line):
            return []
        north_m, east_m = each.off_m(*path.point, wander)
        course = math.radians(path.course_deg)
        errors.append(math.cos(course) * east_m - math.sin(course) * north_m)
    return errors


def height_errors(samples: list[Sample], wander: float) -> list[float]:
    """Return the errors of the altitude, m."""
    errors = []
    for each in samples:
        demand = each.demand
        if not isinstance(demand, PathDemand) or demand.altitude_m is None:
            return []
        errors.append(each.truth.altitude_m + wander * each.wander_m[2] - demand.altitude_m)
    return errors


def height_above_home_errors(samples: list[Sample]) -> list[float]:
    """Return the errors of the height above home: home has the error that altitudes have."""
    errors = height_errors(samples, 0.0)
    return [error + each.home_error_m for error, each in zip(errors, samples, strict=False)]


def airspeed_errors(samples: list[Sample]) -> list[float]:
    """Return the errors of the estimated airspeed, m/s."""
    return [each.state.airspeed_m_s - each.truth.airspeed_m_s for each in samples if each.state]


def hold(seed: int, controller: str, air: str) -> Figures:
    """LOITER, a leg across the wind, 30 s without fixes, a stopped motor; no barometer."""
    events = (
        mode_at(LOITER_S, "LOITER"),
        mode_at(CRUISE_S, "CRUISE"),
        course_at(CRUISE_S + 1.0, 90.0),
        mode_at(AGAIN_S, "LOITER"),
        Event(LOST_S, gps="lost"),
        Event(BACK_S, gps="back"),
        Event(STOP_S, motor="stopped"),
    )
    weather = AIRS[air]
    flown = fly(scenario_of(seed, controller, weather, HOLD_END_S, *events), _no_barometer)
    circling = flown.between(CIRCLING_S, CRUISE_S)
    leg = flown.between(LEG_S, AGAIN_S)
    stopped = flown.between(STOP_S, HOLD_END_S)
    figures = {
        f"{LOITER}, GPS frame": rms(radius_errors(circling, 1.0)),
        f"{LOITER}, truth": rms(radius_errors(circling, 0.0)),
        f"{LEG}, GPS frame": rms(line_errors(leg, 1.0)),
        f"{LEG}, truth": rms(line_errors(leg, 0.0)),
        "height rms, GPS frame": rms(height_errors(circling, 1.0)),
        "height rms, truth": rms(height_errors(circling, 0.0)),
        "airspeed rms": rms(airspeed_errors(circling)),
        "LOITER 50 m, bank, standard deviation, deg": statistics.pstdev(
            each.truth.roll_deg for each in circling
        ),
        **_wind(flown, weather.wind_m_s),
        **_lost(flown),
        STOPPED[0].format("LOITER"): flown.after(MOTOR_CODE, STOP_S),
        STOPPED[1].format("LOITER"): least_over_stall(stopped),
        "least airspeed over stall, motor on": least_over_stall(flown.between(LOITER_S, STOP_S)),
    }
    return figures | _common(flown)


def _no_barometer(flight: ScenarioFlight) -> None:
    assert flight.participants.phone is not None
    flight.participants.phone.sensors.has_barometer = False


def _wind(flown: Flown, wind_m_s: float) -> Figures:
    at = flown.between(TWO_CIRCLES_S, TWO_CIRCLES_S + 1.0)
    if not at or at[0].state is None:
        return {"wind error after two circles, m/s": math.inf}
    state = at[0].state
    north, east = state.wind_m_s
    figures = {"wind error after two circles, m/s": math.hypot(north + wind_m_s, east)}
    if wind_m_s:
        turned = math.remainder(state.wind_from_deg - WIND_FROM_DEG, 360.0)
        figures["wind direction error after two circles, deg"] = abs(turned)
    return figures


def _lost(flown: Flown) -> Figures:
    """Return the errors when the last fix was taken 30 s ago."""
    at = flown.between(BACK_S - 0.1, BACK_S)
    if not at or at[-1].state is None:
        return {"position error after 30 s without fixes": math.inf}
    last, state = at[-1], at[-1].state
    error_m = math.hypot(*last.off_m(*state.position, 0.0))
    return {
        "position error after 30 s without fixes": error_m,
        "the same over its stated deviation": error_m / state.position_sd_m,
        "height error after 30 s without fixes": abs(last.truth.altitude_m - state.altitude_m),
    }


def _common(flown: Flown) -> Figures:
    overruns = sum(code == OVERRUN_CODE for _, code in flown.codes)
    return {
        LOOP_US: statistics.median(flown.step_us),
        OVERRUNS: float(overruns),
        CRASHES: float(flown.crash is not None),
    }


def hold_with_small_wander(seed: int, controller: str, air: str) -> Figures:
    """LOITER with the wander that the target of the truth is stated for; the phones have more."""
    scenario = scenario_of(seed, controller, AIRS[air], CRUISE_S, mode_at(LOITER_S, "LOITER"))
    circling = fly(scenario, _small_wander).between(CIRCLING_S, CRUISE_S)
    return {f"{LOITER}, truth, wander of 1.5 m": rms(radius_errors(circling, 0.0))}


def _small_wander(flight: ScenarioFlight) -> None:
    assert flight.participants.phone is not None
    sensors = flight.participants.phone.sensors
    sensors.use_receiver(1.0, sensors.gps_delay_s, wander_m=SMALL_WANDER_M, noise=1.0)
    sensors.has_barometer = False


def hold_with_barometer(seed: int, controller: str, air: str) -> Figures:
    """LOITER with the barometer of the phone."""
    scenario = scenario_of(seed, controller, AIRS[air], CRUISE_S, mode_at(LOITER_S, "LOITER"))
    circling = fly(scenario).between(CIRCLING_S, CRUISE_S)
    return {
        "height above home rms with barometer, truth": rms(height_above_home_errors(circling)),
        "altitude rms with barometer, truth": rms(height_errors(circling, 0.0)),
    }


def hold_with_exact_gps(seed: int, controller: str, air: str) -> Figures:
    """LOITER and a leg with ten exact fixes a second."""
    flown = fly(_circle_and_leg(seed, controller, air), _exact_gps)
    return _radius_and_leg("exact 10 Hz GPS", flown)


def hold_with_receiver(seed: int, controller: str, air: str) -> Figures:
    """The same with a u-blox receiver on a serial port (gps cog), whose error wanders by 0.7 m."""
    flown = fly(replace(_circle_and_leg(seed, controller, air), gps=GpsPart()))
    figures = _radius_and_leg("u-blox 10 Hz, GPS frame", flown, 1.0)
    return figures | _radius_and_leg("u-blox 10 Hz, truth", flown)


def hold_with_sensors(seed: int, controller: str, air: str) -> Figures:
    """LOITER with barometer and pitot tube at the I2C bus (sensors cog), without the phone's."""
    scenario = scenario_of(seed, controller, AIRS[air], CRUISE_S, mode_at(LOITER_S, "LOITER"))
    scenario = replace(scenario, sensors=("bmp388", "ms4525do"))
    circling = fly(scenario, _no_barometer).between(CIRCLING_S, CRUISE_S)
    return {
        "height above home rms with sensors, truth": rms(height_above_home_errors(circling)),
        "airspeed rms with sensors": rms(airspeed_errors(circling)),
    }


def _circle_and_leg(seed: int, controller: str, air: str) -> Scenario:
    events = (
        mode_at(LOITER_S, "LOITER"),
        mode_at(EXACT_CRUISE_S, "CRUISE"),
        course_at(EXACT_CRUISE_S + 1.0, 90.0),
    )
    return scenario_of(seed, controller, AIRS[air], EXACT_END_S, *events)


def _radius_and_leg(what: str, flown: Flown, wander: float = 0.0) -> Figures:
    circling = flown.between(CIRCLING_S, EXACT_CRUISE_S)
    leg = flown.between(EXACT_LEG_S, EXACT_END_S)
    return {
        f"{what}: {EXACT[0]}": rms(radius_errors(circling, wander)),
        f"{what}: {EXACT[1]}": rms(line_errors(leg, wander)),
    }


def _exact_gps(flight: ScenarioFlight) -> None:
    assert flight.participants.phone is not None
    flight.participants.phone.sensors.use_receiver(0.1)


def come_home(seed: int, controller: str, _air: str) -> Figures:
    """A kilometre downwind, RETURN against the wind, then the motor stops at home."""
    events = (
        mode_at(2.0, "CRUISE"),
        course_at(3.0, 180.0 + WIND_FROM_DEG),
        mode_at(AWAY_S, "RETURN"),
        Event(HOME_STOP_S, motor="stopped"),
    )
    flown = fly(scenario_of(seed, controller, AGAINST, HOME_END_S, *events), _no_barometer)
    back, stopped = flown.between(AWAY_S + 1.0, HOME_STOP_S), flown.between(HOME_STOP_S, HOME_END_S)
    away = [math.hypot(each.truth.north_m, each.truth.east_m) for each in back]
    near = [each.time_s for each, m in zip(back, away, strict=True) if m < 2 * RADIUS_M]
    return {
        "RETURN, m away at the start": away[0],
        "RETURN, s until home": near[0] - AWAY_S if near else math.inf,
        "RETURN, least airspeed over stall": least_over_stall(back),
        "RETURN, least height above home, m": min(each.truth.height_m for each in back) - HEIGHT_M,
        STOPPED[0].format("RETURN"): flown.after(MOTOR_CODE, HOME_STOP_S),
        STOPPED[1].format("RETURN"): least_over_stall(stopped),
        **_common(flown),
    }
