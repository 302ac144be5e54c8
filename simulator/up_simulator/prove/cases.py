"""The flights of a proof, each as a generated scenario."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from up.flight_modes.navigation_state import LocalFrame, Point
from up_simulator.aircraft.motor import charge_at
from up_simulator.aircraft.start import GROUND_M, START_LATITUDE_DEG, START_LONGITUDE_DEG, StartPart
from up_simulator.aircraft.weather import Weather
from up_simulator.in_process.config_folder import merge
from up_simulator.prove.judge import WARN, Limits
from up_simulator.prove.rows import GPS_FAULTS, Row, point_of, row_of
from up_simulator.prove.setup import Setup
from up_simulator.scenario.event import CommandPart, Event
from up_simulator.scenario.scenario import (
    GroundPart,
    PhonePart,
    RaspilotPart,
    Scenario,
    SwitchPart,
)
from up_simulator.scenario.sticks import StickPoint

HOME_S, MODE_S, CLIMB_S, FAIL_S = 2.0, 4.0, 5.0, 12.0
TURN_S = 10.0
"""The turn for home after a reaction."""
MARGIN_S, STALLED_S = 6.0, 15.0
"""From a failure to its detection, beyond the delay of failsafe.yml; and of no progress."""
CLIMB_M, MAX_START_M = 80.0, 4900.0
NEAR_M, LOW_M = 200.0, 25.0
"""How far inside a border the aircraft begins to fly towards it."""
TURBULENCE = ("none", "light", "moderate")
MAX_WIND_M_S = 8.0
GALE = 1.1
GPS_WITHIN_S, GPS_LASTS_S = 10.0, 10.0
"""A second failure begins so soon after the first one, and lasts so long at most."""
BELIEVED_S = 7.0
"""After a jump of 300 m, until the aircraft can have been at the true place again."""
THOROUGH = 500


@dataclass(frozen=True, slots=True)
class Case:
    """One flight: a row at a point of a flight, in its weather. ``gps`` is a second failure."""

    row: str
    point: str
    controller: str
    wind_m_s: float
    from_deg: float
    turbulence: str
    seed: int
    gps: str = ""

    @property
    def weather(self) -> str:
        words = f"wind {self.wind_m_s:.1f} m/s from {self.from_deg:.0f} deg"
        gps = f", GPS {self.gps} for some time" if self.gps else ""
        return f"{'calm' if not self.wind_m_s else words}, turbulence {self.turbulence}{gps}"


def left_out(setup: Setup, codes: Sequence[str]) -> dict[str, str]:
    """Return the rows that this configuration and airframe do not have, and why."""
    found: dict[str, str] = {}
    for row in map(row_of, codes):
        value = setup.value(*row.needs) if row.needs else True
        if value is None:
            found[row.code] = f"{row.needs[0]}: {': '.join(row.needs[1:])} is not set"
        elif row.needs[:1] == ("flight_battery.yml",) and not setup.divider:
            found[row.code] = "the airframe measures no voltage (battery: divider)"
        elif row.border == "floor_m" and value < 10.0:
            found[row.code] = f"failsafe.yml: fence: floor_m: {value:g} m is near the ground"
        elif row.of_sticks and "FBW" not in setup.switch.values():
            found[row.code] = "airframe.yml: switch: no position selects FBW"
    return found


def quick(setup: Setup, codes: Sequence[str], wind_m_s: float, seeds: int) -> Iterator[Case]:
    """Yield each row at each of its points, with the wind from home.

    Failsafes fly in calm and in wind at every point, other failures in turn.
    """
    for row in map(row_of, codes):
        for at, name in enumerate(row.points):
            winds = (0.0, wind_m_s) if row.trigger else ((0.0, wind_m_s)[at % 2],)
            for wind in dict.fromkeys(winds[-1:] if row.is_blown else winds):
                for seed in range(1, seeds + 1):
                    air = "light" if wind else "none"
                    case = Case(row.code, name, setup.controller, wind, 180.0, air, seed + at)
                    yield _blown(case, setup) if row.is_blown else case


def thorough(
    setup: Setup, codes: Sequence[str], controllers: Sequence[str], seeds: int
) -> Iterator[Case]:
    """Yield at least THOROUGH flights in drawn weather, with drawn failures of the GPS."""
    places = [
        (row, name, controller)
        for controller in controllers
        for row in map(row_of, codes)
        for name in row.points
    ]
    for number in range(1, max(seeds, -(-THOROUGH // max(1, len(places)))) + 1):
        for row, name, controller in places:
            draw = random.Random(f"{row.code} {name} {controller} {number}")
            case = Case(
                row.code, name, controller, round(draw.uniform(0.0, MAX_WIND_M_S), 1),
                round(draw.uniform(0.0, 359.0)), draw.choice(TURBULENCE), number,
            )  # fmt: skip
            if draw.random() < 0.5 and row.begin.keys().isdisjoint(("gps", "phone")):
                case = replace(case, gps=draw.choice(GPS_FAULTS))
            yield _blown(case, setup) if row.is_blown else case


def _blown(case: Case, setup: Setup) -> Case:
    most = setup.value("navigation.yml", "airspeed", "maximum_m_s")
    return replace(case, wind_m_s=round(min(30.0, GALE * most), 1), from_deg=180.0, gps="")


_NOTHING: dict[str, Any] = {"action": "", "delay_s": 0.0}


def is_by_sticks(case: Case) -> bool:
    """Return whether the pilot flies when this failure comes there."""
    return row_of(case.row).of_sticks and point_of(case.point).by_sticks


def demands(case: Case) -> str:
    """Return the key of failsafe.yml that has to answer; empty: none."""
    row = row_of(case.row)
    return "" if row.of_sticks and not is_by_sticks(case) else row.trigger


def limits_of(case: Case, setup: Setup) -> Limits:
    """Return what the flight must keep with this configuration."""
    row, fence, trigger = row_of(case.row), setup.fence, demands(case)
    demanded = setup.trigger(trigger) if trigger else _NOTHING
    fail_s, over_s = FAIL_S, FAIL_S + (row.lasts_s or 0.0)
    if row.border or row.is_blown:
        fail_s, over_s = MODE_S, MODE_S + _approach_s(row, setup)
    deadline_s = (over_s if fail_s == MODE_S else fail_s) + demanded["delay_s"] + MARGIN_S
    order = [each for each in setup.values["failsafe.yml"] if each != "others"]
    return Limits(
        setup.stall_m_s,
        fail_s,
        deadline_s,
        max(deadline_s, _order_s(case) if fail_s == FAIL_S else over_s + row.order_s) + TURN_S,
        trigger,
        demanded["action"],
        tuple(order[: order.index(trigger)]) if trigger else (),
        None if fence["radius_m"] is None else fence["radius_m"] + _blind_m(case),
        fence["ceiling_m"],
        fence["floor_m"],
        # The Arduino's own circle, where the owner wants it, ends on the ground.
        may_land=row.may_land or (row.of_sticks and demanded["action"] == WARN),
        is_blown=row.is_blown,
        arrived_m=3 * setup.value("return.yml", "radius_m"),
        circle_m=2 * setup.value("loiter.yml", "radius_m") if case.point == "turn" else 0.0,
    )


def _order_s(case: Case) -> float:
    """Return when the ground commands RETURN: a position is known again."""
    row = row_of(case.row)
    over_s = FAIL_S + (row.lasts_s or 0.0)
    if case.gps:
        over_s = max(over_s, FAIL_S + GPS_WITHIN_S + GPS_LASTS_S)
    return over_s + row.order_s


def _blind_m(case: Case) -> float:
    """Return how far the wind drifts a circle without a position, or with a wrong one."""
    row = row_of(case.row)
    is_blind = not row.begin.keys().isdisjoint(("gps", "phone"))
    blind_s = (row.lasts_s or 0.0) if is_blind else GPS_LASTS_S if case.gps else 0.0
    if "jumped" in (case.gps, row.begin.get("gps")):
        blind_s += BELIEVED_S
    return case.wind_m_s * blind_s


def _approach_s(row: Row, setup: Setup) -> float:
    """Return how long the way to a border, or the recognition of no progress, takes, s."""
    if row.border == "radius_m":
        return NEAR_M / float(setup.value("navigation.yml", "airspeed", "minimum_m_s"))
    if row.border:
        limit = "climb_limit_m_s" if row.border == "ceiling_m" else "sink_limit_m_s"
        return STALLED_S / 3 + LOW_M / float(setup.value("navigation.yml", "vertical", limit))
    return STALLED_S


def height_of(case: Case, setup: Setup) -> float:
    """Return how high the flight begins, above home and ground, m."""
    row, fence = row_of(case.row), setup.fence
    height_m = float(setup.value("return.yml", "height_m"))
    ceiling_m, floor_m = fence["ceiling_m"], fence["floor_m"]
    if row.border == "floor_m":
        height_m = floor_m + LOW_M
    elif row.border == "ceiling_m":
        height_m = ceiling_m - LOW_M
    elif point_of(case.point).climbs:
        height_m = max(15.0, height_m / 2)
    if ceiling_m is not None:
        height_m = min(height_m, ceiling_m - 20.0)
    return min(MAX_START_M, max(10.0, height_m))


def away_of(case: Case, setup: Setup) -> float:
    """Return how far home is behind the start, m: the failure comes at the point's distance."""
    point, radius_m = point_of(case.point), setup.fence["radius_m"]
    away_m = point.away_m if radius_m is None else min(point.away_m, radius_m - NEAR_M)
    speed_m_s = case.wind_m_s + setup.value("navigation.yml", "airspeed", "cruise_m_s")
    if row_of(case.row).border == "radius_m":
        return float(radius_m - NEAR_M)
    return float(away_m - (speed_m_s * FAIL_S if point.mode == "CRUISE" else 0.0))


def scenario_of(case: Case, setup: Setup) -> Scenario:
    """Return the scenario of a flight: home behind it, a mode, the failure and its end."""
    row, point, limits = row_of(case.row), point_of(case.point), limits_of(case, setup)
    height_m = height_of(case, setup)
    by_sticks = is_by_sticks(case)
    events = [Event(HOME_S, command=CommandPart("up.home.set", _home(case, setup)))]
    if not by_sticks:
        events.append(_mode(MODE_S, point.mode))
    climb_m = CLIMB_M if point.climbs else {"ceiling_m": CLIMB_M, "floor_m": -CLIMB_M}.get(
        row.border, 0.0
    )  # fmt: skip
    if climb_m and not by_sticks:
        # Below home it would be refused.
        altitude_m = GROUND_M + max(1.0, height_m + climb_m)
        altitude = {"altitude": altitude_m, "mode": "required"}
        events.append(Event(CLIMB_S, command=CommandPart("up.altitude.change", altitude)))
    if row.begin:
        events.append(Event(limits.fail_s, name="failure", **_changed(row.begin, setup)))
        if row.end:
            events.append(Event(limits.fail_s + (row.lasts_s or 0.0), name="end", **row.end))
        if not row.trigger and point.mode != "RETURN":
            events.append(_mode(_order_s(case), "RETURN"))
    if case.gps:
        draw = random.Random(f"gps {case.seed}")
        begin_s = FAIL_S + draw.uniform(0.0, GPS_WITHIN_S)
        events.append(Event(begin_s, gps=case.gps))  # type: ignore[arg-type]
        events.append(Event(begin_s + draw.uniform(2.0, GPS_LASTS_S), gps="back"))
    sticks = [StickPoint(at_s=0.0, mode="FBW" if by_sticks else "AUTO", arm=True, throttle=0.55)]
    if by_sticks and point.climbs:
        sticks.append(StickPoint(at_s=1.0, over_s=1.0, elevator=0.3, throttle=0.85))
    files = setup.files
    return Scenario(
        title=row.about,
        airframe=setup.airframe,
        seed=case.seed,
        duration_s=limits.settled_s + (0.0 if limits.fail_s == MODE_S else row.rest_s),
        board="host",
        may_crash=True,
        may_land=limits.may_land,
        start=StartPart(height_m=height_m),
        weather=Weather(case.wind_m_s, case.from_deg, case.turbulence),  # type: ignore[arg-type]
        switch=SwitchPart(**setup.switch),  # type: ignore[arg-type]
        profile=files.get("airframe.yml", {}),
        gains=files.get("pids.yml", {}),
        raspilot=RaspilotPart(
            "in process",
            merge(
                files,
                {
                    "config.yml": {"flight controller": case.controller},
                    # The aircraft is armed before its first fix.
                    "navigation.yml": {"arm_without_home": True},
                },
            ),
        ),
        phone=PhonePart(),
        ground=GroundPart(period_ms=500),
        sticks=tuple(sticks),
        events=tuple(events),
    )


def _mode(at_s: float, mode: str) -> Event:
    return Event(at_s, command=CommandPart("up.flight_mode.set", {"mode": mode}))


def home_m(case: Case, setup: Setup) -> tuple[float, float]:
    """Return home, north and east of the start, m."""
    return -away_of(case, setup), 0.0


def _home(case: Case, setup: Setup) -> dict[str, float]:
    frame = LocalFrame(START_LATITUDE_DEG, START_LONGITUDE_DEG)
    latitude, longitude = frame.degrees(Point(*home_m(case, setup)))
    return {"latitude": latitude, "longitude": longitude, "altitude": GROUND_M}


def _changed(change: Any, setup: Setup) -> dict[str, Any]:
    """Return a change with the battery's charge for a limit of the owner."""
    return {
        key: charge_at(setup.value("flight_battery.yml", value) / setup.cells)
        if key == "flight_battery"
        else value
        for key, value in change.items()
    }
